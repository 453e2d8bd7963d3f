//! The tables of the kernels of log-odds in `f64`: Taylor's coefficients about the centres.
//!
//! A row has value and slope to twice the precision, and as much of the second to seventh coefficients as the sum needs.

use super::NEAR;
use crate::rounded::beyond_float::{self, Fixed};
use crate::rounded::constants::INV_LN2;
use crate::rounded::fixed::mul_high;
use crate::rounded::lanes::format::Split;
use crate::rounded::lanes::table::pair;
use crate::rounded::ziv::normalised;
use crate::rounded::{approximate, fixed, shift_right};
use alloc::boxed::Box;
use alloc::vec::Vec;
use core::f64::consts::LN_2;

/// The least magnitude of log-odds with a row.
pub(super) const FIRST: f64 = f64::from_bits((1023 - 32) << 52); // 2^-32
/// The magnitude from which on cells are equally wide, `1/64`; below, each binade has `2^7`.
pub(super) const EVEN: f64 = 4.0;
/// The magnitude from which on there are no rows.
pub(super) const LAST: f64 = 63.75;
/// The rows below [`EVEN`].
const BINADES: usize = 34 << 7;
/// The rows: a power of two, so that an index is a mask.
pub(super) const ROWS: usize = 8192;
/// The places of a column: a page more than the rows. Processors know few pages that are a power of two apart.
const PLACES: usize = ROWS + 512;

/// The significand bits below those that tell the cells of a binade apart.
const BELOW: u32 = f64::MANTISSA_DIGITS - 1 - 7;
/// `3/2 2^46`: added to a number below `2^45`, it leaves the nearest multiple of `1/64`.
const ROUND: f64 = 105553116266496.0;

/// Holds Taylor's coefficients of a function of the magnitude of log-odds about each centre.
pub(in super::super) struct Table {
    /// Holds the values, rounded.
    pub(super) value: Box<[f64; PLACES]>,
    /// Holds the slopes, rounded.
    pub(super) slope: Box<[f64; PLACES]>,
    /// Holds what rounding took from both, packed into one word.
    pub(super) low: Box<[u64; PLACES]>,
    /// Holds the second coefficients.
    pub(super) second: Box<[f64; PLACES]>,
    /// Holds the third coefficients.
    pub(super) third: Box<[f64; PLACES]>,
    /// Holds the fourth coefficients and, in the last [`SEVENTH`] bits, the seventh.
    pub(super) fourth: Box<[u64; PLACES]>,
    /// Holds the fifth coefficients and, in the last [`SIXTH`] bits, the sixth.
    pub(super) fifth: Box<[u64; PLACES]>,
}

/// The bits of a word that hold a seventh coefficient: 6 of its significand.
pub(super) const SEVENTH: u32 = 18;
/// The bits of a word that hold a sixth coefficient: 16 of its significand.
pub(super) const SIXTH: u32 = 28;

/// One row of a table.
#[derive(Clone, Copy)]
pub(in super::super) struct Row {
    pub(super) value: (f64, f64),
    pub(super) slope: (f64, f64),
    /// The second to the seventh coefficient.
    pub(super) others: [f64; 6],
}

/// Returns the centre of the cell in which `x` in `[FIRST, LAST]` lies, and its number, below [`ROWS`].
#[inline(always)]
pub(super) fn centre(x: f64) -> (f64, usize) {
    const FIRST_CELL: u64 = FIRST.to_bits() >> BELOW;
    // Series: exponent and leading bits count the cells; their half is one bit more.
    let cell = (x.to_bits() >> BELOW).wrapping_sub(FIRST_CELL);
    let middle = f64::from_bits(x.to_bits() & !((1 << BELOW) - 1) | 1 << (BELOW - 1));
    // Series: the nearest multiple of 1/64, and that multiple in the last bits; 4 comes after all binades.
    let shifted = x + ROUND;
    let even = shifted.to_bits().wrapping_add(BINADES as u64 - 256);
    let (centre, number) = if x < EVEN { (middle, cell) } else { (shifted - ROUND, even) };
    (centre, number as usize % ROWS)
}

/// Returns the centres of all cells, by number.
pub(super) fn centres() -> impl Iterator<Item = f64> {
    let below = (0..BINADES as u64).map(|k| centre(f64::from_bits(FIRST.to_bits() + (k << BELOW))).0);
    below.chain((256..=4080).map(|k| f64::from(k) / 64.0))
}

impl Table {
    /// Computes a table from a function that computes a row.
    pub(in super::super) fn new(row: fn(f64) -> Row) -> Self {
        let mut rows: Vec<Row> = centres().map(row).collect();
        let last = rows[rows.len() - 1];
        rows.resize(PLACES, last);
        let float = |of: fn(&Row) -> f64| Box::new(core::array::from_fn(|k| of(&rows[k])));
        let word = |of: fn(&Row) -> u64| Box::new(core::array::from_fn(|k| of(&rows[k])));
        Self {
            value: float(|row| row.value.0),
            slope: float(|row| row.slope.0),
            low: word(|row| f64::pack(row.value.1, row.slope.1)),
            second: float(|row| row.others[0]),
            third: float(|row| row.others[1]),
            fourth: word(|row| packed(row.others[2], row.others[5], SEVENTH)),
            fifth: word(|row| packed(row.others[3], row.others[4], SIXTH)),
        }
    }
}

/// Packs two floats into one word: the leading bits of the second into the last ones of the first.
fn packed(first: f64, second: f64, bits: u32) -> u64 {
    first.to_bits() >> bits << bits | second.to_bits() >> (u64::BITS - bits)
}

/// Computes the row of the information below [`NEAR`], of the entropy from there on.
pub(in super::super) fn of_information(c: f64) -> Row {
    let (m, e) = normalised(c);
    let (entropy, information) = approximate::from_log_odds(m, e);
    let near = c < NEAR;
    let value = beyond_float::middle(if near { information } else { entropy });
    // The slope of H is -l q (1 - q) / ln 2; of the 53 bits of `c` at most 13 are not 0.
    let (q, weight) = weight(c);
    let product = mul_high(weight.value, INV_LN2);
    let slope = Fixed { value: (product >> 23) * u128::from(m >> 40), exponent: weight.exponent + 64 + e };
    let sign = if near { 1.0 } else { -1.0 };
    // H^(n + 1) = -(l w^(n) + n w^(n - 1)) / ln 2.
    let w = derivatives(q);
    let others = core::array::from_fn(|k| {
        let n = k + 1;
        sign * (c * w[n] + n as f64 * w[n - 1]) / LN_2 / factorial(n + 1)
    });
    Row { value: pair(value), slope: signed(pair(slope), sign), others }
}

/// Computes the row of `q = 1 / (1 + e^l)`.
pub(in super::super) fn of_occupancy(c: f64) -> Row {
    let (q, weight) = weight(c);
    let (m, e) = normalised(c);
    let value = beyond_float::middle(approximate::occupancy(fixed::floor_117(m, e), true));
    let w = derivatives(q);
    let others = core::array::from_fn(|k| -w[k + 1] / factorial(k + 2));
    Row { value: pair(value), slope: signed(pair(weight), -1.0), others }
}

/// Computes `q` and `q (1 - q)`, which is minus its slope.
fn weight(c: f64) -> (f64, Fixed) {
    let (m, e) = normalised(c);
    let q = beyond_float::middle(approximate::occupancy(fixed::floor_117(m, e), true));
    let rest = (1 << 126) - shift_right(q.value, -126 - q.exponent);
    let weight = Fixed { value: mul_high(q.value << 1, rest << 1), exponent: q.exponent };
    (pair(q).0, weight)
}

/// Computes `w = q (1 - q)` and its first six derivatives in `l`, by `w' = -w t` and `t' = 2 w`, `t = 1 - 2q`.
fn derivatives(q: f64) -> [f64; 7] {
    let (w, t) = (q * (1.0 - q), 1.0 - 2.0 * q);
    let s = t * t;
    [
        w,
        -w * t,
        w * (3.0 * s - 1.0) / 2.0,
        w * t * (2.0 - 3.0 * s),
        w * ((7.5 * s - 7.5) * s + 1.0),
        -w * t * ((22.5 * s - 30.0) * s + 8.5),
        w * (((78.75 * s - 131.25) * s + 57.75) * s - 4.25),
    ]
}

/// Computes `n!`.
fn factorial(n: usize) -> f64 {
    (1..=n).map(|k| k as f64).product()
}

/// Gives both parts of a number a sign.
fn signed((high, low): (f64, f64), sign: f64) -> (f64, f64) {
    (sign * high, sign * low)
}
