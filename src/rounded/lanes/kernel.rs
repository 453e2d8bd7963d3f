//! The kernel: entropy and information of a block of cells, and their exact sums.
//!
//! `V(c + h) = V(c) + h V'(c) + h y E(b, y)` about the centre `c` of a cell of the table, and a rounding test. The bounds
//! are those of theorem (blocks) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::format::Lane;
use super::table::{self, Rows, Table};
use crate::rounded::beyond_float::Fixed;

/// Counts the cells that are summed up at once: so few that no sum of bits overflows.
pub(crate) const BLOCK: usize = 256;

/// Marks what became of a cell.
pub(super) mod mark {
    /// Marks a cell that is in no sum yet: not decided, or beyond the table.
    pub(in super::super) const OPEN: u8 = 0;
    /// Marks a cell in the sums, below 1/2; without entropies, or above.
    pub(in super::super) const FREE: u8 = 1;
    pub(in super::super) const OCCUPIED: u8 = 2;
    pub(in super::super) const UNKNOWN: u8 = 3;
    /// Marks what is no cell.
    pub(in super::super) const NONE: u8 = 4;
}

/// The sum of the entropies in a kernel without them.
pub(super) const NO_SUM: Fixed = Fixed { value: 0, exponent: 0 };

/// Holds what a block of cells adds to a tally, except for those that are left open.
#[derive(Debug)]
pub(crate) struct Block {
    /// Holds the exact sum of the rounded entropies, or 0 without them.
    pub(crate) entropy: Fixed,
    /// Holds the exact sum of the rounded information.
    pub(crate) information: Fixed,
    pub(crate) unknown: u64,
    pub(crate) free: u64,
    /// Counts the occupied cells; 0 without entropies, where they are among the free ones.
    pub(crate) occupied: u64,
    pub(super) marks: [u8; BLOCK],
}

/// Sums numbers in `[0, 1]` in integers: units of `2^(2 - PRECISION)`, and what is left, in as many bits below.
#[derive(Clone, Copy)]
pub(super) struct Sum<T: Lane> {
    high: T::Word,
    low: T::Word,
}

impl<T: Lane> Sum<T> {
    /// Returns 3, whose ulp is `2^(2 - PRECISION)`, as it is up to 4.
    #[inline(always)]
    fn high_origin() -> T {
        T::one() + T::one() + T::one()
    }

    /// Returns 3/2 ulps of [`Sum::high_origin`]: its own ulp is as far below as that is below 1.
    #[inline(always)]
    fn low_origin() -> T {
        (Self::high_origin() + Self::high_origin()) * T::epsilon()
    }

    /// Creates an empty sum.
    pub(super) fn new() -> Self {
        Self { high: T::Word::default(), low: T::Word::default() }
    }

    /// Adds a number in `[0, 1]`, exactly.
    #[inline(always)]
    pub(super) fn add(&mut self, x: T) {
        // Sums: to a multiple of `2^(2 - PRECISION)`, the ulp of 3, which the bits then count.
        let high = x + Self::high_origin();
        // Sums: what `high` has lost, from the low origin on: every step is exact.
        let low = x - (high - (Self::high_origin() + Self::low_origin()));
        self.high = T::add_bits(self.high, high);
        self.low = T::add_bits(self.low, low);
    }

    /// Returns the sum as an integer times a power of two.
    pub(super) fn fixed(self) -> Fixed {
        let high = i128::from(T::ulps(self.high, Self::high_origin(), BLOCK));
        let low = i128::from(T::ulps(self.low, Self::low_origin(), BLOCK));
        // Each of the two parts has units `2^-places` of the one above it.
        let places = T::PRECISION as i32 - 2;
        Fixed { value: ((high << places) + low) as u128, exponent: -2 * places }
    }
}

impl Block {
    /// Returns the cells of the block that are in no sum.
    pub(crate) fn open<T: Copy>(&self, cells: &[T]) -> impl Iterator<Item = T> {
        // Eight at a time, since there are few.
        let eights = self.marks.as_chunks::<8>().0.iter().zip(cells.chunks(8));
        let some_open = |marks: &[u8; 8]| marks.contains(&mark::OPEN);
        eights.filter(move |(marks, _)| some_open(marks)).flat_map(|(marks, cells)| {
            marks.iter().zip(cells).filter(|(mark, _)| **mark == mark::OPEN).map(|(_, &p)| p)
        })
    }

    /// Computes the sums over the cells of the given occupancies, with their entropies or without.
    ///
    /// With `FUSED`, some products and sums are rounded at once, which only pays where the target has an
    /// instruction for it. One loop without branches over arrays of fixed size: that is what compilers make vectors
    /// of.
    #[inline(always)]
    pub(crate) fn of<T: Lane, const FUSED: bool, const ENTROPY: bool>(
        table: &Table<T>,
        cells: &[T; BLOCK],
    ) -> Self {
        let rows = table.rows::<ENTROPY>();
        let (zero, one) = (T::zero(), T::one());
        let surest = if ENTROPY { T::SUREST } else { T::BINADES };
        let [nearest, least] = [T::NEAREST, surest].map(|binades| T::from_parts(1, -binades));
        let mut marks = [mark::OPEN; BLOCK];
        let (mut entropy, mut information) = (Sum::new(), Sum::new());
        for (&p, mark) in cells.iter().zip(&mut marks) {
            let (x, near) = distance(p);
            let least = if near { nearest } else { least };
            // Not 0 itself: subnormal numbers are slow.
            let inside = if x > least { x } else { least };
            let (head, tail) = value::<T, FUSED, ENTROPY>(&rows, inside, near);
            let (below, above) = bounds::<T, FUSED>(head, tail);
            let (value, value_above) = (head + below, head + above);
            // Domain: nearer to 0 there is no cell of the table.
            let mut done = (x >= least) & (value == value_above);
            // Domain: certain or unknown, where the distance is 0 and the answer exact.
            let edge = x.is_zero();
            if ENTROPY {
                let (other, other_above) = complements(head, below, above);
                done &= other == other_above;
                let value = if done { value } else { zero };
                let other = if edge {
                    one
                } else if done {
                    other
                } else {
                    zero
                };
                entropy.add(if near { other } else { value });
                information.add(if near { value } else { other });
            } else {
                let value = if done { value } else { zero };
                information.add(if edge & !near { one } else { value });
            }
            done |= edge;
            let observed = if ENTROPY & (p > T::HALF) { mark::OCCUPIED } else { mark::FREE };
            let seen = if edge & near { mark::UNKNOWN } else { observed };
            // Domain: what is no probability has a distance that is negative or NaN.
            let left = if x >= zero { mark::OPEN } else { mark::NONE };
            *mark = if done { seen } else { left };
        }
        Self::new(if ENTROPY { entropy.fixed() } else { NO_SUM }, information.fixed(), marks)
    }

    /// Creates a block from its sums and what became of its cells.
    #[inline(always)]
    pub(super) fn new(entropy: Fixed, information: Fixed, marks: [u8; BLOCK]) -> Self {
        let count = |of: u8| marks.iter().map(|&mark| u32::from(mark == of)).sum::<u32>().into();
        Self {
            entropy,
            information,
            unknown: count(mark::UNKNOWN),
            free: count(mark::FREE),
            occupied: count(mark::OCCUPIED),
            marks,
        }
    }
}

/// Returns the distance from unknown and `true`, or twice that from certain and `false` if this is at most 1/2.
#[inline(always)]
pub(super) fn distance<T: Lane>(p: T) -> (T, bool) {
    let rest = T::one() - p;
    // Distances: where `1 - p` is rounded, `p` is the lesser; the rest is exact by Sterbenz's lemma.
    let q = if p < rest { p } else { rest };
    let double = q + q;
    let near = double > T::HALF;
    (if near { T::one() - double } else { double }, near)
}

/// Returns the rest of `V = head + tail` less and more the bound on its error.
#[inline(always)]
pub(super) fn bounds<T: Lane, const FUSED: bool>(head: T, tail: T) -> (T, T) {
    let fused = fused::<T, FUSED>;
    // Rounding test: `V` is between; and if `head` plus either is rounded to the same float, so is `V`.
    (fused(head, -T::ERROR, tail), fused(head, T::ERROR, tail))
}

/// Rounds `1 - V` from both sides, where `V` is between `head + below` and `head + above`.
#[inline(always)]
pub(super) fn complements<T: Lane>(head: T, below: T, above: T) -> (T, T) {
    // Rounding test of `1 - V`: `4 u^2`, for two roundings of its rest by `u^2`.
    let tiny = T::epsilon() * T::epsilon();
    // Error, sums: Dekker's fast sum; what `1 - head` has lost goes to the rest.
    let complement = T::one() - head;
    let rest = (T::one() - complement) - head;
    let lower = rest - (above + tiny);
    let upper = rest - (below - tiny);
    (complement + lower, complement + upper)
}

/// Computes `a b + c`, in one step or in two.
#[inline(always)]
pub(super) fn fused<T: Lane, const FUSED: bool>(a: T, b: T, c: T) -> T {
    if FUSED { T::fused(a, b, c) } else { a * b + c }
}

/// Computes `V` at the distance `x`, as a float and a rest of at most `2^-14.2` of it.
///
/// With `h = x - c` the Taylor series about the centre, `V = V_c + s h + h y E(b, y)`: `y = ∓h / (2 q (1 - q))`, `b
/// = ∓(1 - 2q)`, and `E = 1/(2 ln 2) sum of e_k y^k`, whose coefficients are polynomials in `b`.
#[inline(always)]
pub(super) fn value<T: Lane, const FUSED: bool, const ENTROPY: bool>(
    rows: &Rows<'_, T>,
    x: T,
    near: bool,
) -> (T, T) {
    let fused = fused::<T, FUSED>;
    let (c, number) = T::centre(x);
    let row = table::row::<ENTROPY>(number, near);
    let (value, slope, inverse) = (rows.value[row], rows.slope[row], rows.inverse[row]);
    let (value_low, slope_low) = T::unpack(rows.low[row]);
    // Series: exact, since `x` and `c` agree in their leading bits.
    let h = x - c;
    let y = h * inverse;
    // Series: exact in `f64`, where a centre is a multiple of `2^-40`; in `f32` so far down as that is of `2^-24`.
    let b = if near {
        -c
    } else if ENTROPY {
        c - T::one()
    } else {
        T::one() - c
    };
    let series = series::<T, FUSED>(b, y);
    // Error, slope: the product of slope and `h` and what it loses; not fused, the second is rounded at `2^-14.9 V`.
    let (first, second) = if FUSED {
        let first = slope * h;
        (first, T::fused(slope, h, -first))
    } else {
        (slope.head() * h, (slope - slope.head()) * h)
    };
    // Error, sums: Dekker's fast sum, since `|first| < 2^-6.9 V`; what `head` has lost goes to the rest.
    let head = value + first;
    let lost = (value - head) + first;
    // Error, `R` and sums: from here on all is at most `2^-14.2 V`, and each operation rounds by `u` of that.
    let products = fused(h * y, series, fused(slope_low, h, second));
    (head, products + (lost + value_low))
}

/// Computes `E(b, y)`, see [`value`]: the coefficients of the chapter, even and odd ones apart.
#[inline(always)]
pub(super) fn series<T: Lane, const FUSED: bool>(b: T, y: T) -> T {
    let fused = fused::<T, FUSED>;
    // Series: 1/(2 ln 2) times 1/2, -1/6 and so on.
    let unit = |numerator: f64, denominator: f64| {
        T::nearest(numerator / denominator / (2.0 * core::f64::consts::LN_2))
    };
    let (bb, yy, by) = (b * b, y * y, b * y);
    let e1 = unit(-1.0, 6.0);
    let e2 = fused(bb, unit(3.0, 48.0), unit(1.0, 48.0));
    // Error, terms left out: the series ends with `y^5`, in `f32` with `y^2`.
    let (odd, even) = if T::TERMS > 3 {
        let e3 = fused(bb, unit(-1.0, 40.0), unit(-1.0, 40.0));
        let e4 = fused(bb, fused(bb, unit(5.0, 480.0), unit(10.0, 480.0)), unit(1.0, 480.0));
        let e5 = fused(bb, fused(bb, unit(-3.0, 672.0), unit(-10.0, 672.0)), unit(-3.0, 672.0));
        (fused(yy, fused(yy, e5, e3), e1), fused(yy, e4, e2))
    } else {
        (e1, e2)
    };
    // Error, `R`: `|y| < 2^-8` and `1/2` leads, so that only the last two operations round by `u` of the sum.
    fused(by, odd, fused(yy, even, unit(1.0, 2.0)))
}
