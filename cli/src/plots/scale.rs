//! Round numbers along an axis.

use crate::output::{decimal_exponent, short};

/// The multiples of 1, 2 or 5 times a power of ten within `0..=end`, at most `most` of them after 0, with their texts.
///
/// Decimal throughout, so that a tick is labelled `0.3` and not `0.30000000000000004`. `end` is positive and finite.
pub(super) fn ticks(end: f64, most: usize) -> Vec<(f64, String)> {
    let exponent = decimal_exponent(end);
    // From the step that gives fewest ticks downwards; the last that does not give too many.
    let steps = (exponent - 4..=exponent).rev().flat_map(|n| [5_u32, 2, 1].map(|m| (m, n)));
    let mut chosen = vec![(0.0, "0".to_owned())];
    for (m, n) in steps {
        let multiples: Vec<_> = (0..=most as u32 + 1).map(|i| decimal(i * m, n)).collect();
        let fitting: Vec<_> = multiples.into_iter().take_while(|&(x, _)| x <= end).collect();
        if fitting.len() > most + 1 {
            break;
        }
        chosen = fitting;
    }
    chosen
}

/// `digits * 10^n` and its text.
fn decimal(digits: u32, n: i32) -> (f64, String) {
    let x = format!("{digits}e{n}").parse().unwrap_or(f64::NAN);
    (x, short(x))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn texts(end: f64, most: usize) -> Vec<String> {
        ticks(end, most).into_iter().map(|(_, text)| text).collect()
    }

    #[test]
    fn round_steps() {
        assert_eq!(texts(7.7, 8), ["0", "1", "2", "3", "4", "5", "6", "7"]);
        assert_eq!(texts(7.7, 5), ["0", "2", "4", "6"]);
        assert_eq!(texts(0.32, 4), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(texts(0.3, 3), ["0", "0.1", "0.2", "0.3"]);
        assert_eq!(texts(384.0, 10), ["0", "50", "100", "150", "200", "250", "300", "350"]);
        assert_eq!(texts(3e-9, 3), ["0", "1e-9", "2e-9", "3e-9"]);
    }

    #[test]
    fn extremes_end() {
        for end in [f64::MIN_POSITIVE, 5e-324, f64::MAX] {
            let ticks = ticks(end, 6);
            assert!(
                (1..=7).contains(&ticks.len()) && ticks.iter().all(|&(x, _)| x <= end),
                "{end}: {ticks:?}"
            );
        }
        assert_eq!(texts(7.7, 0), ["0"]);
    }
}
