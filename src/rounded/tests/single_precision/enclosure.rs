//! Enclosures of entropy, information and occupancy of an `f32`, in `f64`.
//!
//! They share nothing with the library: the formulas are sums and products of positive terms (no digits cancel), and
//! the elementary functions are CORE-MATH's, which are correctly rounded. With `u = 2^-53` each function and each
//! operation adds at most `u` to the relative error; the comments count them, and no count reaches 16.
//! [`Bounds::around`] allows 32.

use core::f64::consts::LOG2_E;

/// `lo <= exact value <= hi`.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Bounds {
    lo: f64,
    hi: f64,
}

impl Bounds {
    /// Allows a relative error of 32 u, of which two roundings of its own take 2.
    fn around(value: f64) -> Self {
        let error = 16.0 * f64::EPSILON;
        Self { lo: value * (1.0 - error), hi: value * (1.0 + error) }
    }

    /// Below half of the smallest positive `f32`, `2^-150`.
    fn negligible() -> Self {
        Self { lo: 0.0, hi: f64::from(f32::from_bits(1)) / 4.0 }
    }

    fn complement(self) -> Self {
        Self { lo: (1.0 - self.hi).next_down(), hi: (1.0 - self.lo).next_up() }
    }

    /// The `f32` nearest to every number in the interval, if it is one: rounding is monotone.
    pub(crate) fn nearest(self) -> Option<f32> {
        let nearest = self.lo as f32;
        (nearest == self.hi as f32).then_some(nearest)
    }
}

/// `H(p)` and `I(p)`.
pub(crate) fn from_occupancy(p: f32) -> [Bounds; 2] {
    let p = f64::from(p);
    // Exact: an f32 in [1/2, 1] is a multiple of 2^-24.
    let q = if p > 0.5 { 1.0 - p } else { p };
    if q == 0.0 {
        let zero = Bounds { lo: 0.0, hi: 0.0 };
        return [zero, Bounds { lo: 1.0, hi: 1.0 }];
    }
    // The first product has 2 u, the second 3 (1 - q is rounded), the sum 4.
    let entropy = Bounds::around(q * -core_math::log2(q) + (1.0 - q) * -core_math::log2p1(-q));
    // Exact where it is used: q is then a multiple of 2^-26.
    let d = 1.0 - 2.0 * q;
    [entropy, if d < 0.25 { Bounds::around(series(d)) } else { entropy.complement() }]
}

/// `H`, `I` and the occupancy at log-odds `l`, and the occupancy at `-l`, for `l >= 0`.
pub(crate) fn from_log_odds(l: f32) -> [Bounds; 4] {
    let l = f64::from(l);
    if l >= 128.0 {
        // H < 2 (l + 1) e^-l < 2^-175.
        let (none, all) = (Bounds::negligible(), Bounds::negligible().complement());
        return [none, all, all, none];
    }
    // 1 u in x; 3 in the quotient; 2 in log2 (1 + x), 2 in l LOG2_E, 6 in the product, 7 in the sum.
    let x = core_math::exp(-l);
    let minor = x / (1.0 + x);
    let entropy = Bounds::around(core_math::log2p1(x) + l * LOG2_E * minor);
    let information = if l <= 0.5 {
        // d = tanh(l/2) = t / (t + 2): 3 u; d < 1/4.
        let t = core_math::expm1(l);
        Bounds::around(series(t / (t + 2.0)))
    } else {
        entropy.complement()
    };
    [entropy, information, Bounds::around(1.0 / (1.0 + x)), Bounds::around(minor)]
}

/// `I = (1 / ln 2) sum_{k >= 1} v^k / (2k (2k-1))`, `v = d^2`, for `0 <= d < 1/4`.
///
/// The terms after `k = 12` are below `2^-55` of the sum. If `d` has `e u`, `v` has `2e + 1`, Horner's rule at most
/// `2 + (ε + 2e + 2) / 16 = ε`, the result `2e + 4 + ε + 1/4`: below 7 for the exact `d`, below 14 for `e = 3`.
fn series(d: f64) -> f64 {
    let v = d * d;
    let sum = (1..=12).rev().map(f64::from).fold(0.0, |sum, k| sum * v + 1.0 / (2.0 * k * (2.0 * k - 1.0)));
    v * sum * LOG2_E
}
