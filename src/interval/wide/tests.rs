//! Against exact integers, and against an oracle of 600 bits: every interval contains the value, and is as narrow as
//! stated.

use super::*;
use crate::rounded::oracle::{Oracle, SCALE, from_log_odds, from_occupancy};
use crate::scalar::Scalar;
use num_bigint::BigInt;
use proptest::prelude::*;

/// `x` in units of `2^-SCALE`, for `x = m 2^e` with `e >= -SCALE`.
fn integer(x: Wide) -> BigInt {
    let magnitude = BigInt::from(x.m) << (SCALE as i32 + x.e);
    if x.negative { -magnitude } else { magnitude }
}

/// Not negative.
fn oracle(x: Wide) -> Oracle {
    Oracle::dyadic((x.m >> 64) as u64, x.e + 64).plus(&Oracle::dyadic(x.m as u64, x.e))
}

fn positive(m: u128, e: i32) -> Wide {
    Wide::from_integer(m, e)
}

/// Numbers of both signs up to `2^40`, of all lengths, and those about 0 and about powers of two.
fn number() -> impl Strategy<Value = Wide> {
    let magnitude = prop_oneof![
        (any::<u128>(), 0_u32..128, -200_i32..-88).prop_map(|(m, cut, e)| positive(m >> cut << cut, e)),
        (-100_i32..20, any::<u64>(), 0_i32..120)
            .prop_map(|(e, d, gap)| { positive(1, e).add(positive(u128::from(d), e - 64 - gap), Up) }),
    ];
    (magnitude, any::<bool>()).prop_map(|(x, negative)| if negative { -x } else { x })
}

fn both<F: Fn(Toward) -> Wide>(operation: F) -> (Wide, Wide) {
    (operation(Down), operation(Up))
}

/// The interval holds the value, which the oracle knows to some hundred units of `2^-SCALE`.
fn contains(interval: Interval<Wide>, exact: [&BigInt; 2]) -> Result<(), TestCaseError> {
    let [lower, upper] = [interval.lower, interval.upper].map(integer);
    prop_assert!(lower <= *exact[1] && *exact[0] <= upper, "{interval:?} misses the value");
    Ok(())
}

/// It holds the value and is at most `width` wide.
fn holds(interval: Interval<Wide>, exact: [&BigInt; 2], width: &BigInt) -> Result<(), TestCaseError> {
    contains(interval, exact)?;
    prop_assert!(integer(interval.upper) - integer(interval.lower) <= *width, "{interval:?} is too wide");
    Ok(())
}

/// `share 2^-bits` of a magnitude.
fn part(of: &BigInt, share: u32, bits: u32) -> BigInt {
    ((if *of < BigInt::ZERO { -of } else { of.clone() }) * share) >> bits
}

fn one() -> BigInt {
    BigInt::from(1) << SCALE
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    #[test]
    fn sums_are_next_to_the_exact_ones(a in number(), b in number()) {
        let (lower, upper) = both(|toward| a.add(b, toward));
        let (exact, lower, upper) = (integer(a) + integer(b), integer(lower), integer(upper));
        prop_assert!(lower <= exact && exact <= upper);
        // A unit of the larger operand or of the result, whichever is larger.
        let unit = integer(a).magnitude().max(integer(b).magnitude()).max(exact.magnitude()) >> 126_u32;
        prop_assert!(upper - lower <= unit.into());
    }

    /// Sterbenz: neighbours within a factor of 2 differ exactly.
    #[test]
    fn differences_of_neighbours_are_exact(m in any::<u128>(), d in any::<u128>(), e in -128_i32..-126) {
        let a = positive(m | TOP, e);
        // At the lower exponent, with an odd last bit as often as not, and at least a half of `a`.
        let b = positive(a.m.saturating_add(d >> (d & 127)), e - 1);
        prop_assert_eq!(a.add(-b, Down), a.add(-b, Up));
        prop_assert_eq!(integer(a.add(-b, Up)), integer(a) - integer(b));
    }

    #[test]
    fn products_are_next_to_the_exact_ones(a in number(), b in number()) {
        let (lower, upper) = both(|toward| a.mul(b, toward));
        let exact = integer(a) * integer(b);
        prop_assert!(integer(lower) << SCALE <= exact && exact <= integer(upper) << SCALE);
        prop_assert!((integer(upper) - integer(lower)) << (SCALE + 127) <= exact.magnitude().clone().into());
    }

    #[test]
    fn quotients_are_near_the_exact_ones(a in number(), b in number()) {
        let b = b.magnitude();
        prop_assume!(!b.is_zero());
        let (lower, upper) = both(|toward| a.div(b, toward));
        let (a, b) = (integer(a), integer(b));
        let scaled = &a << SCALE;
        prop_assert!(integer(lower) * &b <= scaled && scaled <= integer(upper) * &b);
        prop_assert!((integer(upper) - integer(lower)) * &b <= part(&scaled, 1, 116));
    }

    #[test]
    fn roots_are_near_the_exact_ones(a in number()) {
        let a = a.magnitude();
        let root = a.sqrt();
        let (lower, upper, square) = (integer(root.lower), integer(root.upper), integer(a) << SCALE);
        prop_assert!(&lower * &lower <= square && square <= &upper * &upper);
        prop_assert!(&upper - &lower <= part(&upper, 1, 115));
    }

    #[test]
    fn floats_and_back(x in any::<f64>(), y in any::<f32>()) {
        if !(x.is_finite() && y.is_finite()) {
            return Ok(());
        }
        for toward in [Down, Up] {
            prop_assert_eq!(Wide::from(x).to_real::<f64>(toward), x);
            prop_assert_eq!(Wide::from(y).to_real::<f32>(toward), y);
        }
        // Half the smallest number above `x`.
        let smallest = Wide::from(f64::from_bits(1));
        let between = Wide::from(x).add(smallest.mul(Wide::HALF, Up), Up);
        prop_assert_eq!(between.to_real::<f64>(Up), x.next_up());
        let (lower, upper) = (Wide::from(x).to_real::<f32>(Down), Wide::from(x).to_real::<f32>(Up));
        prop_assert!(f64::from(lower) <= x && x <= f64::from(upper) && upper <= lower.next_up());
    }

    #[test]
    fn the_order_is_that_of_the_numbers(a in number(), b in number()) {
        prop_assert_eq!(a.partial_cmp(&b), Some(integer(a).cmp(&integer(b))));
    }
}

proptest! {
    // The oracle takes its time.
    #![proptest_config(ProptestConfig::with_cases(300))]

    #[test]
    fn exponentials_hold_the_oracles(x in number()) {
        let x = x.magnitude();
        prop_assume!(x < positive(1, 8) && !x.is_zero());
        let power = oracle(x).exp_neg();
        holds((-x).exp(), power.bounds(), &part(power.bounds()[1], 1, 75))?;
        let inverse = Oracle::dyadic(1, 0).over(&power);
        holds(x.exp(), inverse.bounds(), &part(inverse.bounds()[1], 1, 75))?;
    }

    #[test]
    fn logarithms_hold_the_oracles(x in number(), near in any::<bool>(), k in 9_i32..60) {
        let x = x.magnitude();
        prop_assume!(!x.is_zero());
        // In (0, 1), or next to 1.
        let x = if near { Wide::ONE.add(-x.mul(positive(1, -k - 48), Down), Down) } else { positive(x.m, -128) };
        prop_assume!(x < Wide::ONE);
        let minus_ln = oracle(x).minus_ln();
        let width = if near { part(minus_ln.bounds()[1], 1, 67) } else { one() >> 74_u32 };
        holds(-x.ln(), minus_ln.bounds(), &width)?;
        let inverse = Interval::point(Wide::ONE) / Interval::point(x);
        holds(inverse.ln(), minus_ln.bounds(), &(width + (one() >> 74_u32)))?;
    }

    #[test]
    fn entropies_hold_the_oracles(x in number(), shift in -40_i32..2) {
        let x = x.magnitude();
        prop_assume!(!x.is_zero());
        let p = positive(x.m, -128).mul(positive(1, shift.min(0)), Down);
        for p in [p, Wide::ONE.add(-p, Down)] {
            prop_assume!(!p.is_zero() && p < Wide::ONE);
            let [entropy, _] = from_occupancy(&oracle(p));
            holds(Interval::point(p).entropy(), entropy.bounds(), &part(entropy.bounds()[1], 3, 67))?;
        }
    }

    #[test]
    fn entropies_at_log_odds_hold_the_oracles(m in 1_u128.., shift in -60_i32..7) {
        let l = positive(m, -128).mul(positive(1, shift), Down);
        let [entropy, ..] = from_log_odds(&oracle(l));
        for l in [l, -l] {
            holds(Interval::point(l).entropy_from_log_odds(), entropy.bounds(), &part(entropy.bounds()[1], 3, 67))?;
        }
    }

    /// A narrow interval's entropy comes from one end and a slope: it holds those at both ends.
    #[test]
    fn narrow_intervals_hold_their_ends(x in number(), gap in 71_i32..100) {
        let p = positive(x.m, -128);
        prop_assume!(!x.is_zero() && p < Wide::ONE);
        let other = p.add(positive(1, -gap), Down);
        prop_assume!(other < Wide::ONE);
        let entropy = Interval::between(p, other).entropy();
        for end in [p, other] {
            let [exact, _] = from_occupancy(&oracle(end));
            contains(entropy, exact.bounds())?;
        }
        let entropy = Interval::between(p, other).entropy_from_log_odds();
        for end in [p, other] {
            let [exact, ..] = from_log_odds(&oracle(end));
            contains(entropy, exact.bounds())?;
        }
    }
}

#[test]
fn beyond_the_exponents() {
    let huge = positive(1, LARGEST_EXPONENT);
    assert_eq!(huge.mul(huge, Up), Wide::INFINITY);
    assert!(huge.mul(huge, Down) < Wide::INFINITY && huge.mul(huge, Down) > huge);
    assert_eq!((-huge).mul(huge, Down), Wide::NEG_INFINITY);
    let tiny = Wide::ONE.div(positive(1, LARGEST_EXPONENT - 200), Down);
    assert_eq!(tiny.mul(tiny, Down), Wide::ZERO);
    assert!(tiny.mul(tiny, Up) > Wide::ZERO && tiny.mul(-tiny, Down) < Wide::ZERO);
    assert_eq!([huge.to_real::<f64>(Down), huge.to_real(Up)], [f64::MAX, f64::INFINITY]);
    assert_eq!([tiny.to_real::<f64>(Down), tiny.to_real(Up)], [0.0, f64::from_bits(1)]);
    assert_eq!([(-tiny).to_real::<f32>(Down), (-tiny).to_real(Up)], [-f32::from_bits(1), 0.0]);
}

#[test]
fn the_ends_of_the_exponential() {
    // 1024 is beyond the kernels: bounds from 1024 / ln 2 = 1477.3...
    let x = positive(1, 10);
    assert_eq!((x.exp().lower, x.exp().upper), (positive(1, 1477), Wide::INFINITY));
    assert_eq!(((-x).exp().lower, (-x).exp().upper), (Wide::ZERO, positive(1, -1477)));
    assert_eq!(Wide::NEG_INFINITY.exp().lower, Wide::ZERO);
    assert_eq!(Wide::ZERO.exp(), Interval::point(Wide::ONE));
    assert_eq!(Wide::ONE.ln(), Interval::point(Wide::ZERO));
}

#[test]
fn the_largest_significand_is_rounded_up_to_the_next_power_of_two() {
    let ends = both(|toward| Wide::rounded(false, u128::MAX, -5, true, toward));
    assert_eq!(ends, (positive(u128::MAX, -5), positive(1, 123)));
}

#[test]
fn both_ends_of_the_exponents() {
    let ends = |m, e| both(|toward| Wide::rounded(false, m, e, false, toward));
    let number = |m, e| Wide { negative: false, m, e };
    for e in [LARGEST_EXPONENT, -LARGEST_EXPONENT] {
        assert_eq!(ends(TOP, e), (number(TOP, e), number(TOP, e)));
    }
    let (largest, smallest) = (number(u128::MAX, LARGEST_EXPONENT), number(TOP, -LARGEST_EXPONENT));
    assert_eq!(ends(TOP, LARGEST_EXPONENT + 1), (largest, Wide::INFINITY));
    assert_eq!(ends(TOP, -LARGEST_EXPONENT - 1), (Wide::ZERO, smallest));
    let of_negative = both(|toward| Wide::rounded(true, TOP, -LARGEST_EXPONENT - 1, false, toward));
    assert_eq!(of_negative, (-smallest, Wide::ZERO));
}

#[test]
fn infinite_ends() {
    let (three, infinity) = (positive(3, 0), Wide::INFINITY);
    for toward in [Down, Up] {
        assert_eq!([three.mul(infinity, toward), infinity.mul(three, toward)], [infinity; 2]);
        assert_eq!((-three).mul(infinity, toward), -infinity);
        assert_eq!(infinity.mul(Wide::ZERO, toward), Wide::ZERO);
        assert_eq!([three.div(infinity, toward), infinity.div(three, toward)], [Wide::ZERO, infinity]);
        assert_eq!(infinity.div(infinity, toward), infinity);
    }
    for end in [Wide::ZERO, infinity] {
        assert_eq!(end.sqrt(), Interval::point(end));
    }
}

/// The lower half of a product decides whether it is exact: of `(2^127 + 1)^2` it is 1, of `2^127 (2^127 + 1)` its top bit.
#[test]
fn a_product_is_exact_or_not_by_one_bit() {
    let next = positive(TOP + 1, -127);
    let (lower, upper) = both(|toward| next.mul(next, toward));
    assert!(lower < upper);
    assert_eq!(both(|toward| Wide::ONE.mul(next, toward)), (next, next));
}

/// Minuends and subtrahends whose difference is half a unit below a power of two.
#[test]
fn a_difference_just_below_a_power_of_two() {
    let (large, small) = (positive(3 << 126, 1), positive(TOP + 1, 0));
    let (lower, upper) = both(|toward| large.add(-small, toward));
    let exact = integer(large) - integer(small);
    assert!(integer(lower) <= exact && exact <= integer(upper));
}

/// `ln 2 = 18 artanh(1/26) - 2 artanh(1/4801) + 8 artanh(1/8749)`
#[test]
fn ln_2_lies_between_its_ends() {
    let artanh = |n: u32| -> BigInt {
        let mut power = one() / n;
        let mut sum = BigInt::ZERO;
        for k in (1_u32..200).step_by(2) {
            sum += &power / k;
            power /= n * n;
        }
        sum
    };
    let ln_2: BigInt = artanh(26) * 18 - artanh(4801) * 2 + artanh(8749) * 8;
    // Some thousand floors.
    let ends = [Wide::LN_2.lower, Wide::LN_2.upper].map(integer);
    assert!(&ends[0] + 10_000 < ln_2 && ln_2 < &ends[1] - 10_000);
    assert_eq!(&ends[1] - &ends[0], BigInt::from(2) << (SCALE - 128));
}
