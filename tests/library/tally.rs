//! The sums over a map: what they must not depend on, to the bit, and their rounding against integer arithmetic.

use super::common::{cell, mirrorable, occupancy, power};
use mean_information::cell::{Cell, entropy, information};
use mean_information::map::encoding::{Encoding, LogOdds};
use mean_information::{ExactSum, InformationSum, Tally};
use proptest::collection::vec;
use proptest::prelude::*;

fn tally(occupancies: &[f64]) -> Tally<f64> {
    occupancies.iter().map(|&p| cell(p)).collect()
}

/// `numerator 2^-60 / count` rounded to nearest even, as an `f64`, by integer arithmetic.
fn quotient(numerator: u128, count: u64) -> f64 {
    let shift = numerator.leading_zeros();
    let (q, r) = ((numerator << shift) / u128::from(count), (numerator << shift) % u128::from(count));
    let drop = 128 - q.leading_zeros() as i32 - 53;
    assert!(drop > 1, "enough bits to round");
    let (kept, rest, half) = (q >> drop, q & ((1 << drop) - 1), 1 << (drop - 1));
    let up = rest > half || rest == half && (r > 0 || kept & 1 == 1);
    (kept + u128::from(up)) as f64 * power(drop - shift as i32 - 60)
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    /// In blocks for a vector unit, one by one at the end; what is no probability counts nowhere.
    #[test]
    fn many_cells_at_once_are_the_single_cells(
        map in vec(prop_oneof![20 => occupancy(), 1 => Just(f64::NAN), 1 => -1.0..2.0], 0..1500),
        cut in 0..1500_usize,
    ) {
        let one_by_one: Tally<f64> = map.iter().flat_map(|&p| Cell::from_occupancy(p)).collect();
        prop_assert_eq!(&Tally::from_occupancies(&map), &one_by_one);
        let (left, right) = map.split_at(cut.min(map.len()));
        let mut information = InformationSum::from_occupancies(right);
        information.merge(&InformationSum::from_occupancies(left));
        prop_assert_eq!(&information, &InformationSum::from(&one_by_one));
        prop_assert_eq!(information.mean().to_bits(), one_by_one.mean_information().to_bits());
        prop_assert_eq!(information.total().to_bits(), one_by_one.information().to_bits());
        let singles: Vec<f32> = map.iter().map(|&p| p as f32).collect();
        let one_by_one: Tally<f32> = singles.iter().flat_map(|&p| Cell::from_occupancy(p)).collect();
        prop_assert_eq!(&Tally::from_occupancies(&singles), &one_by_one);
        prop_assert_eq!(InformationSum::from_occupancies(&singles), InformationSum::from(&one_by_one));
    }
}

/// Far cells alone, every other one, few, one, and in runs; with NaN and infinities among them, in several stretches.
#[test]
fn log_odds_far_from_0_are_the_single_cells() {
    let cell = |k: u32, is_far: bool| {
        let share = (0.618_033_988_7 * f64::from(k)).fract();
        let l = if is_far { 60.0 + 720.0 * share } else { 30.0 * share };
        match k % 101 {
            0 => f64::NAN,
            1 => f64::INFINITY,
            2 => 0.0,
            _ => {
                if k % 5 < 2 {
                    l
                } else {
                    -l
                }
            }
        }
    };
    let shares: [fn(u32) -> bool; 7] = [
        |_| true,
        |k| k % 2 == 0,
        |k| k % 16 == 7,
        |k| k % 97 == 0,
        |k| k == 4100,
        |k| k / 5000 == 1,
        |k| k % 40 < 20,
    ];
    for is_far in shares {
        let cells: Vec<f64> = (0..12_500).map(|k| cell(k, is_far(k))).collect();
        let one_by_one: Tally<f64> = cells.iter().flat_map(|&l| Cell::from_log_odds(l)).collect();
        assert_eq!(Tally::from_log_odds(&cells), one_by_one);
        assert_eq!(LogOdds::tally(&cells), one_by_one);
        let parts = cells.chunks(1777).map(Tally::from_log_odds);
        assert_eq!(parts.sum::<Tally<f64>>(), one_by_one);
        assert_eq!(InformationSum::from_log_odds(&cells), InformationSum::from(&one_by_one));
        let singles: Vec<f32> = cells.iter().map(|&l| l as f32).collect();
        let one_by_one: Tally<f32> = singles.iter().flat_map(|&l| Cell::from_log_odds(l)).collect();
        assert_eq!(Tally::from_log_odds(&singles), one_by_one);
    }
}

proptest! {
    #[test]
    fn mean_information_lies_in_the_unit_interval(map in vec(occupancy(), 0..200)) {
        let tally = tally(&map);
        prop_assert!((0.0..=1.0).contains(&tally.mean_information()));
        prop_assert_eq!(tally.cells(), map.len() as u64);
        prop_assert_eq!(tally.unknown(), map.iter().filter(|&&p| p == 0.5).count() as u64);
        prop_assert_eq!(tally.free(), map.iter().filter(|&&p| p < 0.5).count() as u64);
    }

    #[test]
    fn padding_with_unknown_cells_changes_no_bit(map in vec(occupancy(), 1..200), padding in 2_u64..1_000_000) {
        let bare = tally(&map);
        let mut padded = bare.clone();
        padded.add_many(Cell::unknown(), padding);
        prop_assert_eq!(padded.mean_information().to_bits(), bare.mean_information().to_bits());
        prop_assert_eq!(padded.information().to_bits(), bare.information().to_bits());
        prop_assert_eq!(padded.unknown(), bare.unknown() + padding);
    }

    /// A power of two times a float is a float.
    #[test]
    fn equal_cells_have_their_multiple_of_the_information_and_of_the_entropy(p in occupancy(), k in 1_i32..40) {
        let mut tally = Tally::new();
        tally.add_many(cell(p), 1 << k);
        prop_assert_eq!(tally.information().to_bits(), (information(p) * power(k)).to_bits());
        prop_assert_eq!(tally.entropy().to_bits(), (entropy(p) * power(k)).to_bits());
    }

    #[test]
    fn permuting_the_cells_changes_no_bit(
        (map, shuffled) in vec(occupancy(), 2..200).prop_flat_map(|map| (Just(map.clone()), Just(map).prop_shuffle())),
    ) {
        prop_assert_eq!(tally(&map), tally(&shuffled));
    }

    #[test]
    fn merging_parts_in_any_tree_changes_no_bit(map in vec(occupancy(), 3..200), a in 0.0..1.0, b in 0.0..1.0) {
        let cut = |x: f64| (x * map.len() as f64) as usize;
        let (a, b) = (cut(a).min(cut(b)), cut(a).max(cut(b)));
        let [first, middle, last] = [&map[..a], &map[a..b], &map[b..]].map(tally);
        let mut left = first.clone();
        left.merge(&middle);
        left.merge(&last);
        let mut right = last;
        right.merge(&middle);
        right.merge(&first);
        prop_assert_eq!(first.clone() + middle.clone(), [&first, &middle].into_iter().sum());
        let mut added = middle + first;
        added += &tally(&map[b..]);
        prop_assert_eq!(&added, &left);
        added += Tally::from_occupancies(&map);
        prop_assert_eq!(added.cells(), 2 * left.cells());
        prop_assert_eq!(&left, &tally(&map));
        prop_assert_eq!(left, right);
    }

    #[test]
    fn parts_add_up_whether_they_are_kept_or_not(map in vec(occupancy(), 0..200), part in 1_usize..70) {
        let parts: Vec<_> = map.chunks(part).map(tally).collect();
        let informations: Vec<_> = parts.iter().map(InformationSum::from).collect();
        let whole = tally(&map);
        prop_assert_eq!(&parts.iter().sum::<Tally<f64>>(), &whole);
        prop_assert_eq!(&informations.iter().sum::<InformationSum<f64>>(), &InformationSum::from(&whole));
        prop_assert_eq!(&informations.into_iter().sum::<InformationSum<f64>>(), &InformationSum::from(&whole));
        prop_assert_eq!(parts.into_iter().sum::<Tally<f64>>(), whole);
    }

    /// In any order, to the bits of a tally that never had them.
    #[test]
    fn removed_cells_leave_no_bit(
        map in vec(occupancy(), 0..60), (gone, shuffled) in vec(occupancy(), 1..60).prop_flat_map(|gone| (Just(gone.clone()), Just(gone).prop_shuffle())),
        many in 2_u64..1 << 40,
    ) {
        let alone = tally(&map);
        let mut all = alone.clone();
        for &p in &gone {
            all.add_many(cell(p), many);
        }
        for &p in &shuffled {
            all.remove(cell(p))?;
            all.remove_many(cell(p), many - 1)?;
        }
        prop_assert_eq!(&all, &alone);
        let single = |p: f64| Cell::from_occupancy(p as f32).unwrap();
        let alone: Tally<f32> = map.iter().map(|&p| single(p)).collect();
        let mut all: Tally<f32> = gone.iter().map(|&p| single(p)).collect();
        all.merge(&alone);
        for &p in &shuffled {
            all.remove(single(p))?;
        }
        prop_assert_eq!(all, alone);
    }

    /// What is refused changes nothing.
    #[test]
    fn more_than_was_added_cannot_be_removed(map in vec(occupancy(), 0..30), p in occupancy(), more in 1_u64..9) {
        let mut tally = tally(&map);
        let before = tally.clone();
        let alike = map.iter().filter(|&&q| cell(q).state() == cell(p).state()).count() as u64;
        prop_assert!(tally.remove_many(cell(p), alike + more).is_err());
        prop_assert_eq!(tally, before);
    }

    #[test]
    fn counting_many_is_counting_each(p in occupancy(), count in 2_u64..50) {
        let mut many = Tally::new();
        many.add_many(cell(p), count);
        prop_assert_eq!(many, (0..count).map(|_| cell(p)).collect());
    }

    #[test]
    fn exchanging_free_and_occupied_keeps_the_sums(map in vec(mirrorable(), 1..100)) {
        let (straight, mirrored) = (tally(&map), tally(&map.iter().map(|p| 1.0 - p).collect::<Vec<_>>()));
        prop_assert_eq!(straight.mean_information().to_bits(), mirrored.mean_information().to_bits());
        prop_assert_eq!(straight.entropy().to_bits(), mirrored.entropy().to_bits());
        prop_assert_eq!((straight.free(), straight.occupied()), (mirrored.occupied(), mirrored.free()));
    }

    /// Multiples of `2^-60` below 1, whose sum an integer holds exactly.
    #[test]
    fn sums_and_means_are_rounded_once(terms in vec(0_u64..1 << 53, 1..300), count in 1_u64..1 << 40) {
        let mut sum = ExactSum::new();
        let mut integer = 0_u128;
        for (k, &term) in terms.iter().enumerate() {
            let shift = k % 8;
            sum.add(term as f64 / (1_u64 << (60 - shift)) as f64);
            integer += u128::from(term) << shift;
        }
        prop_assume!(integer > 0);
        let count = count.max(terms.len() as u64);
        prop_assert_eq!(sum.mean::<f64>(count), quotient(integer, count));
    }

    #[test]
    fn the_mean_of_equal_cells_is_the_cell(p in occupancy(), count in 2_u64..1 << 40) {
        let mut tally = Tally::new();
        tally.add_many(cell(p), count);
        prop_assert_eq!(tally.mean_information().to_bits(), information(p).to_bits());
    }
}

#[test]
fn an_empty_map_and_an_unknown_map_have_no_information() {
    let mut tally = Tally::<f32>::new();
    assert_eq!((tally.mean_information(), tally.information(), tally.entropy()), (0.0, 0.0, 0.0));
    tally.add_many(Cell::unknown(), 700);
    assert_eq!((tally.mean_information(), tally.information(), tally.entropy()), (0.0, 0.0, 700.0));
    assert_eq!((tally.observed(), tally.unknown()), (0, 700));
}

/// Sequential summation in the format of the cells is off by 2 percent here; the exact sum is not off at all.
#[test]
fn a_long_sum_of_single_precision_cells_does_not_drift() {
    let p = 0.3_f32;
    let mut tally = Tally::new();
    tally.add_many(Cell::from_occupancy(p).unwrap(), 1 << 25);
    assert_eq!(tally.mean_information(), information(p));
    let term = information(p);
    let drifted = (0..1 << 25).fold(0.0_f32, |sum, _| sum + term) / (1 << 25) as f32;
    assert!((drifted / term - 1.0).abs() > 0.01);
}

/// Found by the property above: the quotient has 14 bits less than the sum.
#[test]
fn a_mean_of_few_bits_is_rounded_once() {
    let mut sum = ExactSum::new();
    sum.add(power(-60));
    assert_eq!(sum.mean::<f64>(8193).to_bits(), quotient(1, 8193).to_bits());
    assert_eq!(sum.mean::<f64>(8193).to_bits(), 0x3b5f_ff00_07ff_c002);
}

#[test]
#[should_panic(expected = "below 2^78")]
fn a_sum_too_large_panics_as_documented() {
    let mut sum = ExactSum::new();
    sum.add_many(1.0_f64, 1 << 63);
    for _ in 0..15 {
        let doubled = sum.clone();
        sum.merge(&doubled);
    }
}

#[test]
fn the_smallest_terms_are_kept() {
    let tiny = f64::from_bits(1);
    let mut sum = ExactSum::new();
    sum.add_many(tiny, 3);
    assert_eq!(sum.value::<f64>().to_bits(), 3);
    assert_eq!(sum.mean::<f64>(2).to_bits(), 2, "3/2 of the smallest float ties to even");
    sum.add(1.0_f64);
    assert_eq!(sum.value::<f64>(), 1.0);
    sum.add(f64::EPSILON / 2.0);
    assert_eq!(sum.value::<f64>(), 1.0_f64.next_up(), "the tie is broken by what lies a thousand bits below");
}

/// Parts are summed, and information counts what its tally does.
#[test]
fn information_and_tally_count_alike() {
    let cells = [0.125_f64, 0.5, 0.8125, 0.5, 1.0, 0.0, 0.5].map(|p| Cell::from_occupancy(p).unwrap());
    let tally: Tally<f64> = cells.into_iter().collect();
    let information: InformationSum<f64> = cells.into_iter().collect();
    assert_eq!(information, InformationSum::from(&tally));
    assert_eq!((information.unknown(), information.observed(), information.cells()), (3, 4, 7));
    assert_eq!(information.total(), tally.information());
    let parts = || cells.chunks(3).map(|part| part.iter().copied());
    assert_eq!(parts().map(Tally::from_iter).sum::<Tally<_>>(), tally);
    assert_eq!(parts().map(InformationSum::from_iter).sum::<InformationSum<_>>(), information);
    let mut many = InformationSum::new();
    for cell in cells {
        many.add_many(cell, 5);
    }
    assert_eq!(many, [(); 5].map(|()| information.clone()).into_iter().sum());
}

#[test]
#[should_panic(expected = "at most 2^64 - 1 cells")]
fn information_of_more_cells_than_can_be_counted_panics_as_documented() {
    let mut information = InformationSum::<f64>::new();
    information.add_many(Cell::unknown(), u64::MAX);
    information.add(Cell::from_occupancy(0.25).unwrap());
}

#[test]
#[should_panic(expected = "at most 2^64 - 1 cells")]
fn more_cells_than_can_be_counted_panic_as_documented() {
    let mut tally = Tally::<f64>::new();
    tally.add_many(Cell::unknown(), u64::MAX);
    tally.add(Cell::unknown());
}

#[test]
fn a_sum_is_not_taken_below_zero() {
    let (small, mut sum) = (power(-1074), ExactSum::new());
    sum.add_many(small, 5);
    for (x, count) in [(small, 6), (1.0, 1), (power(-1000), 3), (-0.5, 2), (f64::NAN, 2), (1.5, 2)] {
        let before = sum.clone();
        assert!(sum.remove_many(x, count).is_err(), "{x} {count}");
        assert_eq!(sum, before);
    }
    // A borrow from the highest limb to the lowest, and the place of 1 itself.
    sum.add_many(1.0_f64, 1 << 60);
    sum.remove_many(small, 7).unwrap();
    let mut expected = ExactSum::new();
    expected.add_many(1.0_f64, (1 << 60) - 1);
    for k in 1..=1074 {
        expected.add(power(-k));
    }
    expected.remove_many(small, 1).unwrap();
    assert_eq!(sum, expected);
    sum.remove_many(1.0_f64, (1 << 60) - 1).unwrap();
    assert_eq!(sum.value::<f64>(), 1.0);
    let refused = |mut sum: ExactSum, x: f64, count| sum.remove_many(x, count).unwrap_err().to_string();
    let [more, once] = [(0.75, 4), (1.0, 1)].map(|(x, count)| refused(sum.clone(), x, count));
    assert_eq!(more, "amount to remove from a sum is 3, allowed is at most the sum");
    assert_eq!(once, "amount to remove from a sum is 1, allowed is at most the sum");
    // No such number was added, though the sum has as much.
    sum.add_many(1.0_f64, 9);
    assert!(
        [1.5, -0.5]
            .map(|x| refused(sum.clone(), x, 2))
            .iter()
            .all(|text| text.ends_with("allowed is 0 to 1"))
    );
    // As much entropy is not there, though as many cells are.
    let mut tally = tally(&[0.03125, 0.96875]);
    assert!(tally.remove(cell(0.25)).is_err() && tally.remove(cell(0.03125)).is_ok());
}
