//! Whether an answer is right: decided in integers of any size, from the decimals as they are written.

use mean_information::Real;
use mean_information::operations::{Answer, Refusal};
use mean_information_test_support::exact::Exact;
use serde_json::Value as Json;

/// The midpoints of a non-negative float and its neighbours; there is none below 0.
fn midpoints<T: Real>(x: T) -> (Option<Exact>, Exact) {
    let (m, e) = x.parts();
    let midpoint = |m: u64, e: i32| Exact { m: m.into(), binary: e, decimal: 0 };
    // The spacing below a power of two is half the spacing above, down to the smallest normal number.
    let below = if m == 1 << (T::PRECISION - 1) && e > T::MIN_EXPONENT {
        Some(midpoint(4 * m - 1, e - 2))
    } else {
        (m > 0).then(|| midpoint(2 * m - 1, e - 1))
    };
    (below, midpoint(2 * m + 1, e - 1))
}

/// Whether `x` is the float nearest to every number of the enclosure, ties to even.
fn is_nearest<T: Real>(x: T, lo: &Exact, hi: &Exact) -> bool {
    let (below, above) = midpoints(x);
    let even = x.parts().0.is_multiple_of(2);
    let inside = |order: std::cmp::Ordering| order.is_lt() || order.is_eq() && even;
    x.is_sign_positive() && below.is_none_or(|below| inside(below.compare(lo))) && inside(hi.compare(&above))
}

/// Whether every number of the enclosure is within thousandths of an ulp of `x >= 0`.
fn is_near<T: Real>(x: T, lo: &Exact, hi: &Exact, milliulps: u64) -> bool {
    let (m, e) = x.parts();
    let end = |m: u64| Exact { m: m.into(), binary: e, decimal: -3 };
    x.is_sign_positive()
        && end((1000 * m).saturating_sub(milliulps)).compare(lo).is_le()
        && hi.compare(&end(1000 * m + milliulps)).is_le()
}

/// The ends of an enclosure.
fn ends(want: &Json) -> Option<(Exact, Exact)> {
    let end = |name: &str| want[name].as_str().and_then(Exact::decimal);
    let (lo, hi) = (end("lo")?, end("hi")?);
    assert!(lo.compare(&hi).is_le(), "{want}: an enclosure that holds nothing");
    Some((lo, hi))
}

/// Whether the answer is the one wanted, or one of those that are as right; 500 thousandths of an ulp ask for the
/// nearest float.
pub(crate) fn is_right<T: Real>(answer: &Result<Answer<T>, Refusal>, test: &Json, milliulps: u64) -> bool {
    let also = test["also"].as_array().into_iter().flatten();
    std::iter::once(&test["want"]).chain(also).any(|want| match answer {
        Ok(Answer::Float(x)) => ends(want).is_some_and(|(lo, hi)| {
            if milliulps == 500 { is_nearest(*x, &lo, &hi) } else { is_near(*x, &lo, &hi, milliulps) }
        }),
        Ok(Answer::Count(n)) => want["count"].as_u64() == Some(*n),
        Err(Refusal::Domain(_)) => want["error"] == "domain",
        _ => false,
    })
}

/// The judge itself: the neighbours of the right answer are wrong, also where the spacing changes, and at 0.
#[test]
fn a_neighbour_of_the_nearest_float_is_refused() {
    for (text, right) in
        [("4.99999999999999999e-1", 0.5_f64), ("1e-330", 0.0), ("3.5e-324", f64::from_bits(1))]
    {
        let exact = Exact::decimal(text).unwrap();
        assert!(is_nearest(right, &exact, &exact), "{text}");
        assert!(!is_nearest(right.next_up(), &exact, &exact), "{text}");
        assert!(right == 0.0 || !is_nearest(right.next_down(), &exact, &exact), "{text}");
    }
    assert!(!is_nearest(-0.0_f64, &Exact::decimal("0").unwrap(), &Exact::decimal("0").unwrap()));
    // 1 - 2^-55 is a quarter of the spacing below 1: nearer to 1 than the midpoint, 1 - 2^-54, which 1 - 2^-53 is not.
    let exact = Exact { m: ((1_u64 << 55) - 1).into(), binary: -55, decimal: 0 };
    assert!(is_nearest(1.0_f64, &exact, &exact) && !is_nearest(1.0_f64.next_down(), &exact, &exact));
}

#[test]
fn a_tie_goes_to_the_even_one() {
    let tie = Exact { m: ((1_u64 << 54) + 1).into(), binary: -54, decimal: 0 };
    assert!(is_nearest(1.0_f64, &tie, &tie) && !is_nearest(1.0_f64.next_up(), &tie, &tie));
}

#[test]
fn a_tolerance_counts_in_thousandths() {
    // 0.75 and three quarters of its spacing.
    let exact = Exact { m: ((3_u64 << 53) + 3).into(), binary: -55, decimal: 0 };
    assert!(is_near(0.75_f64, &exact, &exact, 750) && !is_near(0.75_f64, &exact, &exact, 749));
    assert!(
        is_near(0.75_f64.next_up(), &exact, &exact, 250) && !is_near(0.75_f64.next_up(), &exact, &exact, 249)
    );
}
