//! How often each of the 256 bytes occurs: all that a measure needs of a map of bytes.
//!
//! Maps of bytes mostly hold very few values. So where a stretch held at most [`FEW`], the next is compared with
//! these, many cells at once; only where something else turns up are its cells counted one by one.

/// The cells of a stretch: counts below fit a byte and 64 lanes.
const STRETCH: usize = 255 * LANES;
const LANES: usize = 64;
/// Comparing with more values takes as long as counting.
const FEW: usize = 4;

/// The number of cells of each value, at the value's bits as an unsigned byte.
pub(super) fn histogram(cells: &[i8]) -> [u64; 256] {
    let mut counts = [0; 256];
    let mut expected = None;
    let (stretches, rest) = cells.as_chunks::<STRETCH>();
    for stretch in stretches {
        if let Some(values) = expected
            && let Some(few) = count_few(stretch, values)
        {
            for (value, count) in values.into_iter().zip(few) {
                counts[usize::from(value as u8)] += u64::from(count);
            }
            continue;
        }
        let found = count_all(stretch);
        expected = few_values(&found);
        for (count, more) in counts.iter_mut().zip(found) {
            *count += u64::from(more);
        }
    }
    for (count, more) in counts.iter_mut().zip(count_all(rest)) {
        *count += u64::from(more);
    }
    counts
}

/// The values that occur, if they are few; filled up with one of them.
fn few_values(counts: &[u32; 256]) -> Option<[i8; FEW]> {
    let mut present = (0_u8..=255).filter(|&byte| counts[usize::from(byte)] > 0);
    let first = present.next()?;
    let mut values = [first as i8; FEW];
    for value in &mut values[1..] {
        *value = present.next().unwrap_or(first) as i8;
    }
    present.next().is_none().then_some(values)
}

/// How often each value occurs, if no other does; the first takes what is its own only once.
fn count_few(stretch: &[i8; STRETCH], values: [i8; FEW]) -> Option<[u32; FEW]> {
    let mut lanes = [[0_u8; LANES]; FEW];
    for row in stretch.as_chunks::<LANES>().0 {
        for (lanes, &value) in lanes.iter_mut().zip(&values) {
            for (count, &cell) in lanes.iter_mut().zip(row) {
                *count += u8::from(cell == value);
            }
        }
    }
    let mut counts = lanes.map(|lanes| lanes.iter().map(|&count| u32::from(count)).sum());
    for k in 1..FEW {
        if values[k] == values[0] {
            counts[k] = 0;
        }
    }
    (counts.iter().sum::<u32>() as usize == STRETCH).then_some(counts)
}

/// One by one, into four tables in turn: equal neighbours would wait for each other.
fn count_all(cells: &[i8]) -> [u32; 256] {
    let mut tables = [[0_u32; 256]; 4];
    let (eights, rest) = cells.as_chunks::<8>();
    for eight in eights {
        for (k, &cell) in eight.iter().enumerate() {
            tables[k % 4][usize::from(cell as u8)] += 1;
        }
    }
    for &cell in rest {
        tables[0][usize::from(cell as u8)] += 1;
    }
    core::array::from_fn(|byte| tables.iter().map(|table| table[byte]).sum())
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use proptest::prelude::*;

    fn naive(cells: &[i8]) -> [u64; 256] {
        let mut counts = [0; 256];
        for &cell in cells {
            counts[usize::from(cell as u8)] += 1;
        }
        counts
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(24))]
        /// Stretches of few values, of the same or of others, with a stranger here and there, and of all values.
        #[test]
        fn counts_are_those_of_counting(
            parts in prop::collection::vec(
                (prop::collection::vec(any::<i8>(), 1..7), 0..2 * STRETCH, prop::option::of(any::<i8>())),
                0..6,
            ),
        ) {
            let mut cells = Vec::new();
            for (values, length, stranger) in parts {
                cells.extend(values.iter().cycle().take(length));
                cells.extend(stranger);
            }
            prop_assert_eq!(histogram(&cells), naive(&cells));
        }
    }

    /// Lanes hold 255 of one value, and no more come in a stretch.
    #[test]
    fn one_value_only() {
        let cells = alloc::vec![-7_i8; 3 * STRETCH + 5];
        assert_eq!(histogram(&cells), naive(&cells));
        assert_eq!(few_values(&count_all(&cells)), Some([-7; FEW]));
    }
}
