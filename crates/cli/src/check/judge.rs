//! Whether an answer is right, and how far off it is: decided in integers of any size.
//!
//! With a tolerance of 0.5 ulp the answer is the float nearest to some number of the enclosure, ties to even, and a
//! zero is `+0`. With a larger one it lies within so many ulp, spacings of the format's floats at the answer, of some
//! number of it.

use super::exact::Exact;
use super::values::{FloatFormat, NEAREST, Want};
use super::vectors::Test;
use mean_information::Real;
use mean_information_report::hex_float::{self, ParseError};
use mean_information_report::protocol::{Claim, Reply, errors};
use serde_json::Value as Json;

/// An answer, judged.
#[derive(Clone, Debug, PartialEq)]
pub struct Judged {
    /// True if it is right.
    pub right: bool,
    /// True if it is right only by the port's claim: the contract asks for more.
    pub by_claim: bool,
    /// The answer.
    pub answer: Answered,
    /// The distance from the exact result, if a number was wanted and answered.
    pub error: Option<Deviation>,
}

/// The distance of an answer from the nearest number that would be right.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Deviation {
    /// The distance in spacings of the format's floats at the answer; at the exact result if that is more than twice it.
    pub ulp: f64,
    /// The distance relative to the exact result.
    pub relative: f64,
    /// The distance: in bits, of an occupancy in units of `p`.
    pub absolute: f64,
    /// The exact result, about.
    pub exact: f64,
}

/// An answer, as far as it was understood.
#[derive(Clone, Debug, PartialEq)]
pub enum Answered {
    /// A float of the format, widened, with its text.
    Float(f64, String),
    /// A count.
    Count(u64),
    /// An error by its name.
    Error(String),
    /// A number that is no float of the format that was asked for.
    NotOfFormat(String),
    /// Something else.
    Unreadable {
        /// The answer's text.
        text: String,
        /// The form that it should have.
        wanted: &'static str,
    },
}

/// The error that an answer may have.
#[derive(Clone, Copy)]
enum Tolerance {
    /// A number of spacings of floats at the answer; [`NEAREST`] means the nearest float.
    Ulp(f64),
    /// An absolute error.
    Absolute(f64),
}

/// Judges a result or an error by the contract, in ulp, and by what the port claims.
pub(super) fn judge(test: &Test, contract: f64, claim: Claim, reply: &Reply) -> Judged {
    let judge = |tolerance| match test.format {
        FloatFormat::F32 => judge_as::<f32>(test, tolerance, reply),
        FloatFormat::F64 => judge_as::<f64>(test, tolerance, reply),
    };
    let judged = judge(Tolerance::Ulp(contract));
    if judged.right {
        return judged;
    }
    // A claim in ulp is about size: the sign is that of the exact result, and of a zero, all the same.
    let negative = matches!(judged.answer, Answered::Float(x, _) if x.is_sign_negative());
    let in_ulp = || claim.ulp > contract && !negative && judge(Tolerance::Ulp(claim.ulp)).right;
    let absolutely = || claim.bits > 0.0 && judge(Tolerance::Absolute(claim.bits)).right;
    let right = in_ulp() || absolutely();
    Judged { right, by_claim: right, ..judged }
}

fn judge_as<T: Real>(test: &Test, tolerance: Tolerance, reply: &Reply) -> Judged {
    let wants = || std::iter::once(&test.want).chain(&test.also);
    let without_error =
        |right: bool, answer: Answered| Judged { right, by_claim: false, answer, error: None };
    // Of a refused test it is not known which of the two the operation answers.
    let floats = matches!(test.want, Want::Enclosure { .. });
    let counts = matches!(test.want, Want::Count(_));
    let wanted = if counts {
        "a count is a JSON integer, such as 3"
    } else {
        "a float is a hexadecimal float in a string, such as \"0x1.8p-2\""
    };
    let unreadable = |text: String| Answered::Unreadable { text, wanted };
    match reply {
        Reply::Error(name) => {
            let right = name == errors::DOMAIN && wants().any(|want| *want == Want::Domain);
            without_error(right, Answered::Error(name.clone()))
        }
        Reply::Result(Json::String(text)) if !counts => match hex_float::parse::<T>(text) {
            Ok(x) => {
                let enclosures = wants().filter_map(|want| match want {
                    Want::Enclosure { lo, hi } if x.is_finite() => Some((&lo.value, &hi.value)),
                    _ => None,
                });
                let judged =
                    enclosures.map(|(lo, hi)| (is_right(x, lo, hi, tolerance), deviation(x, lo, hi)));
                let best = judged.min_by(|(a, d), (b, e)| b.cmp(a).then(d.ulp.total_cmp(&e.ulp)));
                Judged {
                    right: best.is_some_and(|(right, _)| right),
                    by_claim: false,
                    answer: Answered::Float(x.widen(), text.clone()),
                    error: best.map(|(_, error)| error),
                }
            }
            Err(ParseError::NotRepresentable) => without_error(false, Answered::NotOfFormat(text.clone())),
            Err(ParseError::Syntax) => without_error(false, unreadable(format!("\"{text}\""))),
        },
        Reply::Result(value) => match value.as_u64() {
            Some(n) if !floats => {
                let right = wants().any(|want| *want == Want::Count(n));
                without_error(right, Answered::Count(n))
            }
            _ => without_error(false, unreadable(value.to_string())),
        },
        // Nobody judges what was not answered.
        Reply::Skipped(reason) => without_error(false, unreadable(reason.clone())),
    }
}

/// Returns whether a finite answer is right for some number from `lo` to `hi`.
fn is_right<T: Real>(x: T, lo: &Exact, hi: &Exact, tolerance: Tolerance) -> bool {
    let reach = match tolerance {
        Tolerance::Absolute(reach) => Some(Exact::of(reach)),
        Tolerance::Ulp(ulp) => (ulp > NEAREST).then(|| Exact::of(ulp).scaled(spacing(x))),
    };
    if let Some(reach) = reach {
        let x = Exact::of(x);
        return x.minus(&reach).cmp(hi).is_le() && lo.cmp(&x.plus(&reach)).is_le();
    }
    // The mirror image of a negative answer is as right.
    let (lo, hi) = if x.is_sign_negative() { (negative(hi), negative(lo)) } else { (lo.clone(), hi.clone()) };
    let (m, e) = x.parts();
    if m == 0 && x.is_sign_negative() {
        return false;
    }
    let double = 2 * i128::from(m);
    let above = Exact::new(double + 1, e - 1);
    // The spacing below a power of two is half the spacing above, down to the smallest normal number.
    let below = if m == 1 << (T::PRECISION - 1) && e > T::MIN_EXPONENT {
        Exact::new(2 * double - 1, e - 2)
    } else {
        Exact::new(double - 1, e - 1)
    };
    // A midpoint goes to the even one.
    if m.is_multiple_of(2) {
        below.cmp(&hi).is_le() && lo.cmp(&above).is_le()
    } else {
        below.cmp(&hi).is_lt() && lo.cmp(&above).is_lt()
    }
}

fn negative(x: &Exact) -> Exact {
    Exact::new(0, 0).minus(x)
}

/// Returns the exponent of the spacing of floats at `x`.
fn spacing<T: Real>(x: T) -> i32 {
    if x.is_zero() { T::MIN_EXPONENT } else { x.parts().1 }
}

fn deviation<T: Real>(x: T, lo: &Exact, hi: &Exact) -> Deviation {
    let answer = Exact::of(x);
    let (distance, nearest) = if answer.cmp(lo).is_lt() {
        (lo.minus(&answer), lo)
    } else if answer.cmp(hi).is_gt() {
        (answer.minus(hi), hi)
    } else {
        (Exact::new(0, 0), &answer)
    };
    let exact = nearest.approximate();
    let unit = if answer.abs().scaled(1).cmp(&nearest.abs()).is_lt() {
        spacing(T::nearest(exact))
    } else {
        spacing(x)
    };
    // Scaled before they are rounded: below the smallest float there is something, too.
    let ulp = distance.scaled(-unit).approximate();
    let relative = if ulp == 0.0 { 0.0 } else { ulp / nearest.abs().scaled(-unit).approximate() };
    Deviation { ulp, relative, absolute: distance.approximate(), exact }
}

#[cfg(test)]
mod tests {
    use super::super::values::Decimal;
    use super::*;
    use serde_json::json;

    fn enclosure(lo: &str, hi: &str) -> Want {
        let decimal = |text: &str| Decimal { text: text.to_owned(), value: Exact::decimal(text).unwrap() };
        Want::Enclosure { lo: decimal(lo), hi: decimal(hi) }
    }

    fn test<T: Real>(want: Want, also: Vec<Want>) -> Test {
        let (id, format) =
            (String::new(), if T::PRECISION == 24 { FloatFormat::F32 } else { FloatFormat::F64 });
        Test {
            id,
            format,
            args: [].into(),
            want,
            also,
            tolerance_ulp: None,
            flags: Vec::new(),
            traps: [].into(),
        }
    }

    fn judged<T: Real>(x: T, ends: (&str, &str), tolerance: f64) -> Judged {
        let reply = Reply::Result(hex_float::format(x).into());
        judge(&test::<T>(enclosure(ends.0, ends.1), Vec::new()), tolerance, Claim::default(), &reply)
    }

    fn is_nearest<T: Real>(x: T, exact: &str) -> bool {
        judged(x, (exact, exact), NEAREST).right
    }

    #[test]
    fn only_the_nearest_float_is_right() {
        for (exact, right) in [
            ("4.99999999999999999e-1", 0.5_f64),
            ("1e-330", 0.0),
            ("3.5e-324", f64::from_bits(1)),
            ("0.1", 0.1),
            // A quarter of the spacing below 1: nearer to 1 than the midpoint, which the float below is not.
            ("0.99999999999999997224442438437108648940920829772949", 1.0),
            // Three quarters of it: nearer to the float below, for there the spacing is half as large.
            ("0.99999999999999991673327315311325946822762489318847", 1.0_f64.next_down()),
            ("-0.1", -0.1),
        ] {
            assert!(is_nearest(right, exact), "{exact}");
            assert!(!is_nearest(right.next_up(), exact), "{exact}");
            assert!(right == 0.0 || !is_nearest(right.next_down(), exact), "{exact}");
        }
        assert!(is_nearest(0.1_f32, "0.1") && !is_nearest(0.1_f32.next_up(), "0.1"));
        assert!(!is_nearest(-0.0_f64, "0") && !is_nearest(-0.1_f64, "0.1"));
        assert!(!is_nearest(f64::NAN, "0.1") && !is_nearest(f64::INFINITY, "0.1"));
    }

    #[test]
    fn ties_go_to_the_even_one() {
        // 1 + 2^-53, between 1 and 1 + 2^-52; and 1 + 3 2^-53.
        let (first, second) = (
            "1.00000000000000011102230246251565404236316680908203125",
            "1.00000000000000033306690738754696212708950042724609375",
        );
        let odd = 1.0_f64.next_up();
        assert!(is_nearest(1.0_f64, first) && !is_nearest(odd, first));
        assert!(is_nearest(odd.next_up(), second) && !is_nearest(odd, second));
    }

    /// Above 0.75 the spacing is 2^-53; the exact number is 0.75 + 3 2^-55.
    #[test]
    fn a_tolerance_counts_spacings_at_the_answer() {
        let exact = "0.7500000000000000832667268468867405317723751068115234375";
        let allowed = |x: f64, tolerance| judged(x, (exact, exact), tolerance).right;
        assert!(allowed(0.75, 0.75) && !allowed(0.75, 0.7499));
        let second = 0.75_f64.next_up().next_up();
        assert!(allowed(second, 1.25) && !allowed(second, 1.2499));
        // The answer's own spacing: 1 below 0.75 it is 2^-53, too; at 1 it is 2^-52.
        assert!(judged(1.0_f64, ("0.9999999999999995", "0.9999999999999995"), 2.2519).right);
        assert!(!judged(1.0_f64, ("0.9999999999999995", "0.9999999999999995"), 2.2517).right);
        // Some number of the enclosure is near enough, from either side.
        assert!(judged(0.5_f64, ("0.3", "0.500000000000000001"), 2.0).right);
        assert!(judged(0.5_f64, ("0.499999999999999999", "0.7"), 2.0).right);
        assert!(!judged(0.5_f64, ("0.51", "0.7"), 2.0).right);
        assert!(judged(0.0_f64, ("0", "0"), 2.0).right && judged(-0.0_f64, ("0", "0"), 2.0).right);
    }

    const TO_53: f64 = 9_007_199_254_740_992.0;

    #[test]
    fn errors_are_measured() {
        let error = |x: f64, exact: &str| judged(x, (exact, exact), 2.0).error.unwrap();
        assert_eq!(error(0.5, "0.5").ulp, 0.0);
        let expected = Deviation { ulp: 0.125 * TO_53, relative: 0.2, absolute: 0.125, exact: 0.625 };
        assert_eq!(error(0.75, "0.625"), expected);
        assert_eq!(error(0.4375, "0.625").ulp, 0.1875 * 2.0 * TO_53);
        // Less than half of the exact result: in its spacings.
        assert_eq!(error(0.0, "0.75").ulp, 0.75 * TO_53);
        assert_eq!((error(0.0, "1e-330").relative, error(0.0, "0").relative), (1.0, 0.0));
        let small = error(0.0, "1e-324").ulp;
        assert!((0.2..0.21).contains(&small), "{small}");
        assert_eq!(error(-0.5, "0.5").relative, 2.0);
        let ends = judged(0.75_f64, ("0.25", "0.5"), 2.0).error.unwrap();
        assert_eq!((ends.exact, ends.relative), (0.5, 0.5));
    }

    #[test]
    fn any_of_several_answers_is_right() {
        let counts = test::<f64>(Want::Count(3), vec![Want::Count(5)]);
        let also = vec![enclosure("0.5", "0.5"), Want::Domain];
        let test = test::<f64>(enclosure("0.25", "0.25"), also);
        let judged = |reply: &Reply| judge(&test, NEAREST, Claim::default(), reply);
        for (reply, right) in [
            (Reply::Result("0x1p-2".into()), true),
            (Reply::Result("0x1p-1".into()), true),
            (Reply::Result("0x1p+0".into()), false),
            (Reply::Result(json!(3)), false),
            (Reply::Result(json!([])), false),
            (Reply::Result("0.25".into()), false),
            (Reply::Result("nan".into()), false),
            (Reply::error("domain"), true),
            (Reply::error("range"), false),
        ] {
            assert_eq!(judged(&reply).right, right, "{reply:?}");
        }
        for (value, right) in [(json!(3), true), (json!(4), false), (json!(5), true), (json!(3.0), false)] {
            assert_eq!(
                judge(&counts, 0.0, Claim::default(), &Reply::Result(value.clone())).right,
                right,
                "{value}"
            );
        }
        // The nearest of them counts.
        let deviation = judged(&Reply::Result("0x1.1p-1".into())).error.unwrap();
        assert_eq!(deviation.exact, 0.5);
    }

    const RIGHT: (bool, bool) = (true, false);
    const BY_CLAIM: (bool, bool) = (true, true);
    const WRONG: (bool, bool) = (false, false);

    /// Returns whether the answer `x` to a test is right, and whether by claim.
    fn claimed(exact: &str, ulp: f64, bits: f64, x: f64) -> (bool, bool) {
        let reply = Reply::Result(hex_float::format(x).into());
        let judged =
            judge(&test::<f64>(enclosure(exact, exact), Vec::new()), NEAREST, Claim { ulp, bits }, &reply);
        (judged.right, judged.by_claim)
    }

    /// A claim in ulp is about size, and what it allows is counted.
    #[test]
    fn a_claim_excuses_no_sign() {
        let judged = |ulp, x| claimed("0", ulp, 0.0, x);
        assert_eq!([judged(3.0, 0.0), judged(3.0, f64::from_bits(2))], [RIGHT, BY_CLAIM]);
        assert_eq!([judged(3.0, -0.0), judged(3.0, f64::from_bits(4))], [WRONG; 2]);
    }

    /// Near 1/2 the information is tiny, and any answer that is tiny is near it; a count is exact.
    #[test]
    fn an_absolute_error_may_be_claimed() {
        let judged = |bits, x| claimed("1e-20", 0.0, bits, x);
        assert_eq!([judged(2e-16, 1.5e-16), judged(2e-16, -1.5e-16), judged(2e-16, 0.0)], [BY_CLAIM; 3]);
        assert_eq!([judged(2e-16, 2.1e-16), judged(2e-16, 1.0), judged(0.0, 0.0)], [WRONG; 3]);
        // The end of what is claimed, exactly: 2^-53 from 1.
        let below = |bits| claimed("1", 0.0, bits, 1.0_f64.next_down());
        assert_eq!([below(1.0 / TO_53), below((1.0 / TO_53).next_down())], [BY_CLAIM, WRONG]);
        // Beside a claim in ulp either will do.
        let both = |x| claimed("1e-20", 3.0, 2e-16, x);
        assert_eq!(
            [both(1e-20_f64.next_up().next_up()), both(1e-16), both(3e-16)],
            [BY_CLAIM, BY_CLAIM, WRONG]
        );
        let count = test::<f64>(Want::Count(3), Vec::new());
        assert!(!judge(&count, 0.0, Claim { ulp: 5.0, bits: 5.0 }, &Reply::Result(json!(4))).right);
    }
}
