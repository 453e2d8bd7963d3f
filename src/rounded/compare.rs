//! Step 3 of Ziv's strategy: on which side of a midpoint the value lies, in as many bits as it takes.
//!
//! Each function says whether the value is above the midpoint. It compares two numbers that differ only if the value
//! differs from the midpoint, with twice the bits until their balls part. For an occupancy this ends, since `H(p)` is
//! irrational for every float `p` but 0, 1/2 and 1 ([`docs/rounding.md`](crate::book::rounding)), and for `e^x`, `ln x`
//! and the Gaussian, since `e^x` is transcendental for every float `x` but 0; for log-odds it ends if Schanuel's
//! conjecture holds.
//!
//! The forms avoid every division by `ln 2` and every subtraction of near equals:
//! `H ln 2 = q (n ln 2 + y D(y) + (1-q) D(q))` for `q = (1-y) 2^-n`, and `H ln 2 = q (l + D(q))` for
//! `q = 1 / (1 + e^l)`, with `D(q) = -ln(1-q) / q = sum q^j / (j+1)`; near "unknown" `I ln 2 = d^2 T(d^2)` for
//! `d = |2p - 1|`, with `T(u) = sum u^j / ((2j+1) (2j+2))`.

use super::approximate::{distance_from_unknown, is_small, smaller_probability};
use super::fixed::{exp_neg, floor_117};
use super::integers::ball::Ball;
use super::round::Midpoint;

/// Decides a comparison, with 256 bits of fraction at first and twice as many at each further try.
pub(super) fn decide(compare: impl Fn(usize) -> Option<bool>) -> bool {
    decide_from(4, compare)
}

/// Decides a comparison, with the given number of limbs of fraction at first and twice as many at each further try.
fn decide_from(mut fraction: usize, compare: impl Fn(usize) -> Option<bool>) -> bool {
    loop {
        if let Some(above) = compare(fraction) {
            return above;
        }
        fraction *= 2;
    }
}

/// Returns the factor of `q` in `H ln 2`, that is `(n - 53) ln 2 + y D(y) + (1-q) D(q)` for `q = m 2^-n =
/// (1-y) 2^(53-n)` and `2^52 <= m < 2^53`.
fn entropy_over_occupancy(m: u64, n: i32, fraction: usize) -> Ball {
    let q = Ball::dyadic(m, -n, fraction);
    // q = (1 - y) 2^(53 - n) with y at most 1/2, where the series of D converges.
    let y = Ball::dyadic((1 << 53) - m, -53, fraction);
    // (1 - q) D(q) = -ln (1-q) (1-q) / q: the term of the other outcome.
    let of_rest = Ball::dyadic(1, 0, fraction).minus(&q).times(&q.log_series());
    Ball::ln2(fraction).scaled((n - 53) as u64, 0).plus(&y.times(&y.log_series())).plus(&of_rest)
}

/// Compares `H(p)`, for `p = m 2^e`.
pub(super) fn entropy(m: u64, e: i32, midpoint: Midpoint) -> bool {
    let (m, n) = smaller_probability(m, -e);
    decide_from(2, |fraction| {
        let factor = entropy_over_occupancy(m, n, fraction);
        // H > c as q factor > c ln 2, both sides times 2^(n - 53): q itself may be too small for the ball.
        let bound = Ball::ln2(fraction).scaled(midpoint.m, midpoint.exponent + n - 53);
        factor.scaled(m, -53).is_above(&bound)
    })
}

/// Compares `I(p)`, for `p = m 2^e`: by its series near 1/2, where `1 - H` would cancel, and else as `1 - H`.
pub(super) fn information(m: u64, e: i32, midpoint: Midpoint) -> bool {
    if let Some(d) = distance_from_unknown(m, -e) {
        // d = root 2^scale, with root in [1/2, 1).
        let shift = d.leading_zeros() as i32;
        let scale = 64 - shift + e;
        return decide_from(2, |fraction| {
            information_is_above(&Ball::dyadic(d << shift, -64, fraction), scale, midpoint)
        });
    }
    let (m, n) = smaller_probability(m, -e);
    decide_from(2, |fraction| {
        let entropy = entropy_over_occupancy(m, n, fraction).scaled(m, -n);
        complement(Ball::ln2(fraction), midpoint).is_above(&entropy)
    })
}

/// Compares `I = d^2 T(d^2) / ln 2`, for `d = root 2^scale < 2^-3`; `None` if the balls meet.
fn information_is_above(root: &Ball, scale: i32, midpoint: Midpoint) -> Option<bool> {
    let square = root.times(root);
    // I > c as root^2 T > c ln 2 2^(-2 scale): the power of two of d^2 is on the side of the bound.
    let series = square.scaled(1, 2 * scale).information_series();
    let bound = Ball::ln2(root.fraction()).scaled(midpoint.m, midpoint.exponent - 2 * scale);
    square.times(&series).is_above(&bound)
}

/// Returns `(1 - c) unit` for the midpoint `c`, so that `I > c` is `(1 - c) ln 2 > H ln 2`.
fn complement(unit: Ball, midpoint: Midpoint) -> Ball {
    let part = unit.scaled(midpoint.m, midpoint.exponent);
    unit.minus(&part)
}

/// Returns `y` and `k` with `e^-l = y 2^-k`, `y` in `(0.49, 1]`, given `t = l / ln 2` of scale 116 within `2^-8`.
pub(super) fn exp_neg_of_ball(l: Ball, t: u128) -> (Ball, i32) {
    // Less than t by 2^-6 or more, so that k ln 2 cannot exceed l.
    let k = (t.saturating_sub(1 << 110) >> 116) as u64;
    let multiple = Ball::ln2(l.fraction()).scaled(k, 0);
    (l.minus(&multiple).exp_neg(), k as i32)
}

/// Returns `y` and `k` with `e^-l = y 2^-k`, `y` in `(0.49, 1]`, for `l = m 2^e < 2^10`.
pub(super) fn exp_neg_dyadic(m: u64, e: i32, fraction: usize) -> (Ball, i32) {
    let (_, _, t) = exp_neg(floor_117(m, e));
    exp_neg_of_ball(Ball::dyadic(m, e, fraction), t)
}

/// Returns `q 2^k` and `k`, for the smaller probability `q = 1 / (1 + e^l)` and `l = m 2^e < 2^10`.
fn smaller_probability_at_log_odds(m: u64, e: i32, fraction: usize) -> (Ball, i32) {
    let (y, k) = exp_neg_dyadic(m, e, fraction);
    let one_and_x = y.scaled(1, -k).plus(&Ball::dyadic(1, 0, fraction));
    (y.divided_by(&one_and_x), k)
}

/// Returns `H 2^k ln 2` and `k`, at log-odds `l = m 2^e < 2^10`: `H ln 2 = q (l + D(q))`.
fn scaled_entropy(m: u64, e: i32, fraction: usize) -> (Ball, i32) {
    let (q, k) = smaller_probability_at_log_odds(m, e, fraction);
    let factor = q.scaled(1, -k).log_series().plus(&Ball::dyadic(m, e, fraction));
    (q.times(&factor), k)
}

/// Compares `H` at log-odds `m 2^e`.
pub(super) fn entropy_from_log_odds(m: u64, e: i32, midpoint: Midpoint) -> bool {
    decide_from(2, |fraction| {
        let (entropy, k) = scaled_entropy(m, e, fraction);
        entropy.is_above(&Ball::ln2(fraction).scaled(midpoint.m, midpoint.exponent + k))
    })
}

/// Compares `I` at log-odds `m 2^e`: by the series in `d = tanh(l/2)` near 0, and else as `1 - H`.
pub(super) fn information_from_log_odds(m: u64, e: i32, midpoint: Midpoint) -> bool {
    if is_small(e) {
        // l = m 2^-53 2^scale, and d = tanh(l/2) = (1 - x) / (1 + x) with x = e^-l, where 1 - x = l E(l).
        let scale = e + 53;
        return decide_from(2, |fraction| {
            let l = Ball::dyadic(m, e, fraction);
            let quotient = l.exp_quotient();
            let one_and_x = Ball::dyadic(2, 0, fraction).minus(&l.times(&quotient));
            let root = Ball::dyadic(m, -53, fraction).times(&quotient).divided_by(&one_and_x);
            information_is_above(&root, scale, midpoint)
        });
    }
    decide_from(2, |fraction| {
        let (entropy, k) = scaled_entropy(m, e, fraction);
        complement(Ball::ln2(fraction), midpoint).is_above(&entropy.scaled(1, -k))
    })
}

/// Compares the occupancy at log-odds `±m 2^e`: `q` below 0, `1 - q` above.
pub(super) fn occupancy(m: u64, e: i32, negative: bool, midpoint: Midpoint) -> bool {
    decide_from(2, |fraction| {
        let (q, k) = smaller_probability_at_log_odds(m, e, fraction);
        // q > c is q 2^k > c 2^k, and 1 - q > c is 1 - c > q.
        if negative {
            q.is_above(&Ball::dyadic(midpoint.m, midpoint.exponent + k, fraction))
        } else {
            complement(Ball::dyadic(1, 0, fraction), midpoint).is_above(&q.scaled(1, -k))
        }
    })
}

/// Compares `e^±l`, for `l = m 2^e < 2^10`.
pub(super) fn exp(m: u64, e: i32, negative: bool, midpoint: Midpoint) -> bool {
    decide(|fraction| {
        let (y, k) = exp_neg_dyadic(m, e, fraction);
        // e^-l > c is y > c 2^k.
        if negative {
            y.is_above(&Ball::dyadic(midpoint.m, midpoint.exponent + k, fraction))
        } else {
            // e^l > c if and only if 1 > c e^-l.
            Ball::dyadic(1, 0, fraction).is_above(&y.scaled(midpoint.m, midpoint.exponent - k))
        }
    })
}

/// Compares `|ln x|` with the midpoint `c`, for `x = m 2^e`: `e^-c > x` below 1, `x e^-c > 1` above.
pub(super) fn ln(m: u64, e: i32, below_one: bool, midpoint: Midpoint) -> bool {
    decide(|fraction| {
        // Of c, not of x: no logarithm is needed.
        let (y, k) = exp_neg_dyadic(midpoint.m, midpoint.exponent, fraction);
        if below_one {
            y.is_above(&Ball::dyadic(m, e + k, fraction))
        } else {
            y.scaled(m, e - k).is_above(&Ball::dyadic(1, 0, fraction))
        }
    })
}

/// Compares `e^-r`, for `r` half the square of 64 `distance` over `m 2^-52`, given `t = r / ln 2` of scale 116.
pub(super) fn gaussian(distance: impl Fn(usize) -> Ball, m: u64, t: u128, midpoint: Midpoint) -> bool {
    decide(|fraction| {
        let ratio = distance(fraction).divided_by(&Ball::dyadic(m, -52, fraction));
        // 64^2 / 2 = 2^11.
        let (y, k) = exp_neg_of_ball(ratio.times(&ratio).scaled(1, 11), t);
        y.is_above(&Ball::dyadic(midpoint.m, midpoint.exponent + k, fraction))
    })
}
