//! C99's hexadecimal floats (`0x1.8p-2`): exact in both directions, and readable by `strtod`, Python and others.
//!
//! A finite number is written with the shortest significand that starts with `1.`, subnormals too.

use mean_information::Real;
use std::fmt;

/// Writes `x` exactly: `0x1.8p-2`, `-0x0p+0`, `inf`, `-inf` or `nan`.
///
/// ```
/// use mean_information_report::hex_float::format;
/// assert_eq!(format(0.375_f64), "0x1.8p-2");
/// assert_eq!(format(f32::from_bits(1)), "0x1p-149");
/// ```
pub fn format<T: Real>(x: T) -> String {
    if x.is_nan() {
        return "nan".to_owned();
    }
    let sign = if x.is_sign_negative() { "-" } else { "" };
    if x.is_infinite() {
        return format!("{sign}inf");
    }
    let (m, e) = x.parts();
    if m == 0 {
        return format!("{sign}0x0p+0");
    }
    // The leading one goes before the point and is shifted out here; the bits after it, left-aligned, are 16 digits.
    let leading = m.ilog2();
    let fraction = if leading == 0 { 0 } else { m << (64 - leading) };
    let exponent = e + leading as i32;
    if fraction == 0 {
        return format!("{sign}0x1p{exponent:+}");
    }
    let digits = format!("{fraction:016x}");
    format!("{sign}0x1.{}p{exponent:+}", digits.trim_end_matches('0'))
}

/// Reads a hexadecimal float, `inf`, `infinity` or `nan`, in either case and with an optional sign.
///
/// The exponent may be absent, as in `strtod`. NaN has no sign and no payload.
///
/// # Errors
/// [`ParseError::Syntax`] if it is none of these; [`ParseError::NotRepresentable`] if `T` has no such number: nothing
/// is ever rounded.
///
/// ```
/// use mean_information_report::hex_float::{ParseError, parse};
/// assert_eq!(parse("0x1.8p-2"), Ok(0.375_f64));
/// assert_eq!(parse::<f32>("0x1.0000001p+0"), Err(ParseError::NotRepresentable));
/// ```
pub fn parse<T: Real>(text: &str) -> Result<T, ParseError> {
    let (negative, magnitude) = match text.as_bytes() {
        [b'-', ..] => (true, &text[1..]),
        [b'+', ..] => (false, &text[1..]),
        _ => (false, text),
    };
    let x = match magnitude.to_ascii_lowercase().as_str() {
        "nan" => return Ok(T::nan()),
        "inf" | "infinity" => T::infinity(),
        finite => parse_finite(finite.strip_prefix("0x").ok_or(ParseError::Syntax)?)?,
    };
    Ok(if negative { -x } else { x })
}

/// Reads the lower-case digits and the exponent after `0x`.
fn parse_finite<T: Real>(text: &str) -> Result<T, ParseError> {
    let (significand, exponent) = match text.split_once('p') {
        Some((significand, exponent)) => (significand, parse_exponent(exponent)?),
        None => (text, 0),
    };
    let (whole, fraction) = significand.split_once('.').unwrap_or((significand, ""));
    let digits = format!("{whole}{fraction}");
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_hexdigit()) {
        return Err(ParseError::Syntax);
    }
    let shortest = digits.trim_end_matches('0');
    let dropped = digits.len() - shortest.len();
    let shortest = shortest.trim_start_matches('0');
    if shortest.is_empty() {
        return Ok(T::zero());
    }
    let m = u64::from_str_radix(shortest, 16).map_err(|_| ParseError::NotRepresentable)?;
    let e = exponent.saturating_add(4 * (dropped as i64 - fraction.len() as i64));
    let (m, e) = (m >> m.trailing_zeros(), e.saturating_add(i64::from(m.trailing_zeros())));
    let bits = 64 - m.leading_zeros();
    let highest = i64::from(T::max_value().parts().1) + i64::from(T::PRECISION);
    let fits = bits <= T::PRECISION
        && e >= i64::from(T::MIN_EXPONENT)
        && e.saturating_add(i64::from(bits)) <= highest;
    if fits { Ok(T::from_parts(m, e as i32)) } else { Err(ParseError::NotRepresentable) }
}

/// Reads a decimal exponent; one beyond `i64` saturates, since no number has it.
fn parse_exponent(text: &str) -> Result<i64, ParseError> {
    let digits = text.strip_prefix(['-', '+']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return Err(ParseError::Syntax);
    }
    let limit = if text.starts_with('-') { i64::MIN } else { i64::MAX };
    Ok(text.parse().unwrap_or(limit))
}

/// The reason why a text is not a number of the format asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ParseError {
    /// A text that is neither a hexadecimal float nor `inf` nor `nan`.
    Syntax,
    /// A number that the format does not have: too many bits, too large or too small.
    NotRepresentable,
}

impl fmt::Display for ParseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Syntax => "not a hexadecimal float such as 0x1.8p-2, nor inf or nan",
            Self::NotRepresentable => "not a number of this format: too many bits, too large or too small",
        })
    }
}

impl std::error::Error for ParseError {}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// What glibc's `printf("%a")` writes for normal numbers.
    #[test]
    fn format_agrees_with_c() {
        for (x, text) in [
            (0.1, "0x1.999999999999ap-4"),
            (-2.5, "-0x1.4p+1"),
            (1.0, "0x1p+0"),
            (0.0, "0x0p+0"),
            (-0.0, "-0x0p+0"),
            (f64::MAX, "0x1.fffffffffffffp+1023"),
            (f64::MIN_POSITIVE, "0x1p-1022"),
            (f64::INFINITY, "inf"),
            (f64::NEG_INFINITY, "-inf"),
            (f64::NAN, "nan"),
        ] {
            assert_eq!(format(x), text);
        }
        assert_eq!(format(0.1_f32), "0x1.99999ap-4");
        assert_eq!(format(f32::MAX), "0x1.fffffep+127");
    }

    #[test]
    fn subnormals() {
        assert_eq!(format(f64::from_bits(3)), "0x1.8p-1073");
        assert_eq!(parse("0x0.0000000000003p-1022"), Ok(f64::from_bits(3)));
        assert_eq!(parse("0x1p-1074"), Ok(f64::from_bits(1)));
        assert_eq!(parse("0x1.8p-148"), Ok(f32::from_bits(3)));
    }

    #[test]
    fn other_spellings() {
        assert_eq!(parse("0X1.8P+1"), Ok(3.0_f64));
        assert_eq!(parse("+0x18p-3"), Ok(3.0_f64));
        assert_eq!(parse("0x.18"), Ok(0.09375_f64));
        assert_eq!(parse("0x3."), Ok(3.0_f32));
        assert_eq!(parse("0x00000000000000000000000030.000000000000000000000000p-4"), Ok(3.0_f32));
        assert_eq!(parse("-Infinity"), Ok(f64::NEG_INFINITY));
        assert_eq!(parse("0x0p+99999999999999999999"), Ok(0.0_f64));
        assert_eq!(parse::<f64>("-0x0p+0").map(f64::to_bits), Ok((-0.0_f64).to_bits()));
        assert!(parse::<f64>("NaN").is_ok_and(f64::is_nan));
    }

    #[test]
    fn what_is_no_number() {
        for text in [
            "", "-", "0x", "0x.", "0xp3", "0x1p", "0x1p+", "0x1p-+3", "0x1p3.0", "1.5", "0x1.8.0", "0xg",
            "--0x1", "0x-1", " 0x1", "0x1 ", "infin", "nan(1)", "é",
        ] {
            assert_eq!(parse::<f64>(text), Err(ParseError::Syntax), "{text:?}");
        }
    }

    #[test]
    fn what_the_format_does_not_have() {
        for text in [
            "0x1p+1024",
            "0x1p-1075",
            "0x1.8p-1074",
            "0x1.00000000000008p+0",
            "0x123456789abcdef01p+0",
            "0x1p+99999999999999999999",
            "0x1p-99999999999999999999",
        ] {
            assert_eq!(parse::<f64>(text), Err(ParseError::NotRepresentable), "{text}");
        }
        for text in ["0x1p+128", "0x1p-150", "0x1.ffffffp+127", "0x1.999999999999ap-4"] {
            assert_eq!(parse::<f32>(text), Err(ParseError::NotRepresentable), "{text}");
        }
    }

    proptest! {
        #[test]
        fn there_and_back_f64(bits in any::<u64>()) {
            let x = f64::from_bits(bits);
            let back = parse::<f64>(&format(x));
            prop_assert!(back.is_ok_and(|y| y.to_bits() == bits || x.is_nan() && y.is_nan()));
        }

        #[test]
        fn there_and_back_f32(bits in any::<u32>()) {
            let x = f32::from_bits(bits);
            let back = parse::<f32>(&format(x));
            prop_assert!(back.is_ok_and(|y| y.to_bits() == bits || x.is_nan() && y.is_nan()));
        }
    }
}
