//! The kernel: entropy and information of a block of cells, stored and then summed up, exactly.
//!
//! `V(c + h) = V(c) + h V'(c) + h y E(b, y)` about the centre `c` of a cell of the table, and a rounding test. The bounds
//! are those of theorem (blocks) in the chapter [`sums`](crate::book::sums), whose paragraphs the comments name.

use super::format::{BLOCK, Lane};
use super::sum::{self, Parts};
use super::table::{self, Rows, Table};

/// Holds the entropies of a block, then its information.
pub(crate) type Results<T> = [T; 2 * BLOCK];

/// Splits the results of a block into entropies and information.
#[inline(always)]
pub(super) fn halves<T>(results: &mut Results<T>) -> (&mut [T; BLOCK], &mut [T; BLOCK]) {
    let (entropies, informations) = results.split_first_chunk_mut().expect("two blocks have one");
    (entropies, informations.first_chunk_mut().expect("and another"))
}

/// Marks what became of a cell: each mark but [`OPEN`](mark::OPEN) is a bit of its own, so that bits are counted.
pub(super) mod mark {
    /// Marks a cell that is in no sum yet: not decided, or beyond the table.
    pub(in super::super) const OPEN: u8 = 0;
    /// Marks a cell in the sums, below 1/2; without entropies, or above.
    pub(in super::super) const FREE: u8 = 1;
    pub(in super::super) const OCCUPIED: u8 = 2;
    pub(in super::super) const UNKNOWN: u8 = 4;
    /// Marks what is no cell.
    pub(in super::super) const NONE: u8 = 8;
}

/// Holds what a block of cells adds to a tally, except for those that are left open.
#[derive(Debug)]
pub(crate) struct Block {
    /// Holds the exact sum of the rounded entropies, or 0 without them.
    pub(crate) entropy: Parts,
    /// Holds the exact sum of the rounded information.
    pub(crate) information: Parts,
    pub(crate) unknown: u64,
    pub(crate) free: u64,
    /// Counts the occupied cells; 0 without entropies, where they are among the free ones.
    pub(crate) occupied: u64,
    pub(super) marks: [u8; BLOCK],
    /// Whether there are small entropies, and information, that are in no sum yet.
    pub(super) has_small: [bool; 2],
}

/// Counts the marks of one kind, eight bytes at a time.
#[inline(always)]
fn count(marks: &[u8; BLOCK], of: u8) -> u64 {
    let these = u64::from_ne_bytes([of; 8]);
    let eights = marks.as_chunks::<8>().0.iter();
    eights.map(|&marks| u64::from((u64::from_ne_bytes(marks) & these).count_ones())).sum()
}

impl Block {
    /// Returns the cells of the block that are in no sum.
    pub(crate) fn open<T: Copy>(&self, cells: &[T]) -> impl Iterator<Item = T> {
        // Eight at a time, since there are few: of eight marks, one bit each, some are open if there are fewer bits.
        let eights = self.marks.as_chunks::<8>().0.iter().zip(cells.chunks(8));
        let some_open = |marks: &[u8; 8]| u64::from_ne_bytes(*marks).count_ones() < 8;
        eights.filter(move |(marks, _)| some_open(marks)).flat_map(|(marks, cells)| {
            marks.iter().zip(cells).filter(|(mark, _)| **mark == mark::OPEN).map(|(_, &p)| p)
        })
    }

    /// Computes the sums over the cells of the given occupancies, with their entropies or without.
    ///
    /// With `FUSED`, some products and sums are rounded at once, which only pays where the target has an
    /// instruction for it. Loops without branches over arrays of fixed size: that is what compilers make vectors
    /// of.
    #[inline(always)]
    pub(crate) fn of<T: Lane, const FUSED: bool, const ENTROPY: bool>(
        table: &Table<T>,
        cells: &[T; BLOCK],
        results: &mut Results<T>,
    ) -> Self {
        let rows = table.rows::<ENTROPY>();
        let (zero, one) = (T::zero(), T::one());
        let least = T::from_parts(1, -T::BINADES);
        let mut marks = [mark::OPEN; BLOCK];
        let (entropies, informations) = halves(results);
        let places = entropies.iter_mut().zip(&mut *informations).zip(&mut marks);
        for (&p, ((entropy, information), mark)) in cells.iter().zip(places) {
            let (x, near) = distance(p);
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
                *entropy = if near { other } else { value };
                *information = if near { value } else { other };
            } else {
                let value = if done { value } else { zero };
                *information = if edge & !near { one } else { value };
            }
            done |= edge;
            let observed = if ENTROPY & (p > T::HALF) { mark::OCCUPIED } else { mark::FREE };
            let seen = if edge & near { mark::UNKNOWN } else { observed };
            // Domain: what is no probability has a distance that is negative or NaN.
            let left = if x >= zero { mark::OPEN } else { mark::NONE };
            *mark = if done { seen } else { left };
        }
        Self::new::<T, ENTROPY>(entropies, informations, marks)
    }

    /// Creates a block from the results of its cells, 0 where they are left open, and what became of each.
    #[inline(always)]
    pub(super) fn new<T: Lane, const ENTROPY: bool>(
        entropies: &[T; BLOCK],
        informations: &[T; BLOCK],
        marks: [u8; BLOCK],
    ) -> Self {
        let (entropy, small_entropies) =
            if ENTROPY { sum::large(entropies) } else { (Parts::default(), false) };
        let (information, small_information) = sum::large(informations);
        Self {
            entropy,
            information,
            unknown: count(&marks, mark::UNKNOWN),
            free: count(&marks, mark::FREE),
            occupied: count(&marks, mark::OCCUPIED),
            marks,
            has_small: [small_entropies, small_information],
        }
    }

    /// Adds to the sums what small results of the block are not in them.
    #[inline(always)]
    pub(super) fn add_small<T: Lane>(&mut self, results: &Results<T>) {
        let sums = [&mut self.entropy, &mut self.information];
        let small = core::mem::take(&mut self.has_small);
        for ((parts, results), _) in
            sums.into_iter().zip(results.as_chunks().0).zip(small).filter(|(_, small)| *small)
        {
            sum::add_small(parts, results);
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
