//! The sums of entropy and information over a block of cells.

use super::format::Lane;
use super::table::{self, Rows, Table};
use crate::rounded::beyond_float::Fixed;

/// The cells that are summed up at once: so few that no sum of bits overflows.
pub(crate) const BLOCK: usize = 256;

/// What became of a cell.
mod mark {
    /// In no sum: not decided, beyond the table, or no probability.
    pub(super) const OPEN: u8 = 0;
    /// In the sums, below 1/2; without entropies, or above.
    pub(super) const FREE: u8 = 1;
    pub(super) const OCCUPIED: u8 = 2;
    pub(super) const UNKNOWN: u8 = 3;
}

/// What a block of cells adds to a tally, but for those that are left open.
#[derive(Debug)]
pub(crate) struct Block {
    /// The exact sum of the rounded entropies, or 0 without them.
    pub(crate) entropy: Fixed,
    /// The exact sum of the rounded information.
    pub(crate) information: Fixed,
    pub(crate) unknown: u64,
    pub(crate) free: u64,
    /// Without entropies 0: they are among the free ones.
    pub(crate) occupied: u64,
    marks: [u8; BLOCK],
}

/// A sum of numbers in `[0, 1]` in integers: units of `2^(2 - PRECISION)`, and what is left, in as many bits below.
#[derive(Clone, Copy)]
struct Sum<T: Lane> {
    high: T::Word,
    low: T::Word,
}

impl<T: Lane> Sum<T> {
    /// Its ulp is `2^(2 - PRECISION)`, also above it, up to 4.
    #[inline(always)]
    fn high_origin() -> T {
        T::one() + T::one() + T::one()
    }

    /// 3/2 ulps of [`Sum::high_origin`]: its own ulp is as far below as that is below 1.
    #[inline(always)]
    fn low_origin() -> T {
        (Self::high_origin() + Self::high_origin()) * T::epsilon()
    }

    fn new() -> Self {
        Self { high: T::Word::default(), low: T::Word::default() }
    }

    #[inline(always)]
    fn add(&mut self, x: T) {
        let high = x + Self::high_origin();
        // What `high` has lost, from the low origin on: every step is exact.
        let low = x - (high - (Self::high_origin() + Self::low_origin()));
        self.high = T::add_bits(self.high, high);
        self.low = T::add_bits(self.low, low);
    }

    fn fixed(self) -> Fixed {
        let high = i128::from(T::ulps(self.high, Self::high_origin(), BLOCK));
        let low = i128::from(T::ulps(self.low, Self::low_origin(), BLOCK));
        let places = T::PRECISION as i32 - 2;
        Fixed { value: ((high << places) + low) as u128, exponent: -2 * places }
    }
}

impl Block {
    /// Those of its cells that are in no sum.
    pub(crate) fn open<T: Copy>(&self, cells: &[T]) -> impl Iterator<Item = T> {
        // Eight at a time, since there are few.
        let eights = self.marks.as_chunks::<8>().0.iter().zip(cells.chunks(8));
        let some_open = |marks: &[u8; 8]| marks.contains(&mark::OPEN);
        eights.filter(move |(marks, _)| some_open(marks)).flat_map(|(marks, cells)| {
            marks.iter().zip(cells).filter(|(mark, _)| **mark == mark::OPEN).map(|(_, &p)| p)
        })
    }

    /// Of the cells of the given occupancies, with their entropies or without.
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
        let [nearest, least] = [T::NEAREST, T::BINADES].map(|binades| T::from_parts(1, -binades));
        // What is below the precision of `1 - V`.
        let tiny = T::epsilon() * T::epsilon();
        let mut marks = [mark::OPEN; BLOCK];
        let (mut entropy, mut information) = (Sum::new(), Sum::new());
        for (&p, mark) in cells.iter().zip(&mut marks) {
            let rest = one - p;
            let q = if p < rest { p } else { rest };
            let double = q + q;
            let near = double > T::HALF;
            // The distance from unknown, or twice that from certain; both exact.
            let x = if near { one - double } else { double };
            let least = if near { nearest } else { least };
            // Not 0 itself: subnormal numbers are slow.
            let inside = if x > least { x } else { least };
            let (head, tail) = value::<T, FUSED, ENTROPY>(&rows, inside, near);
            let (below, above) =
                (fused::<T, FUSED>(head, -T::ERROR, tail), fused::<T, FUSED>(head, T::ERROR, tail));
            let (value, value_above) = (head + below, head + above);
            let mut done = (x >= least) & (value == value_above);
            // Certain or unknown, where the distance is 0.
            let edge = x.is_zero();
            if ENTROPY {
                let complement = one - head;
                let rest = (one - complement) - head;
                let (other, other_above) =
                    (complement + (rest - (above + tiny)), complement + (rest - (below - tiny)));
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
            *mark = if done { seen } else { mark::OPEN };
        }
        let count = |of: u8| marks.iter().map(|&mark| u32::from(mark == of)).sum::<u32>().into();
        Self {
            entropy: if ENTROPY { entropy.fixed() } else { Fixed { value: 0, exponent: 0 } },
            information: information.fixed(),
            unknown: count(mark::UNKNOWN),
            free: count(mark::FREE),
            occupied: count(mark::OCCUPIED),
            marks,
        }
    }
}

/// `a b + c`, in one step or in two.
#[inline(always)]
fn fused<T: Lane, const FUSED: bool>(a: T, b: T, c: T) -> T {
    if FUSED { T::fused(a, b, c) } else { a * b + c }
}

/// `V` at the distance `x`, as a float and a rest of at most `2^-15` of it.
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
    let h = x - c;
    let y = h * inverse;
    let b = if near {
        -c
    } else if ENTROPY {
        c - T::one()
    } else {
        T::one() - c
    };
    let series = series::<T, FUSED>(b, y);
    // The product of slope and h, exactly.
    let (first, second) = if FUSED {
        let first = slope * h;
        (first, T::fused(slope, h, -first))
    } else {
        (slope.head() * h, (slope - slope.head()) * h)
    };
    let head = value + first;
    let lost = (value - head) + first;
    (head, fused(h * y, series, fused(slope_low, h, second)) + (lost + value_low))
}

/// `E(b, y)`, see [`value`].
#[inline(always)]
pub(super) fn series<T: Lane, const FUSED: bool>(b: T, y: T) -> T {
    let fused = fused::<T, FUSED>;
    // 1/(2 ln 2) times 1/2, -1/6 and so on.
    let unit = |numerator: f64, denominator: f64| {
        T::nearest(numerator / denominator / (2.0 * core::f64::consts::LN_2))
    };
    let (bb, yy, by) = (b * b, y * y, b * y);
    let mut even = fused(bb, unit(3.0, 48.0), unit(1.0, 48.0));
    let mut odd = unit(-1.0, 6.0);
    if T::TERMS > 3 {
        let e3 = fused(bb, unit(-1.0, 40.0), unit(-1.0, 40.0));
        let e4 = fused(bb, fused(bb, unit(5.0, 480.0), unit(10.0, 480.0)), unit(1.0, 480.0));
        let e5 = fused(bb, fused(bb, unit(-3.0, 672.0), unit(-10.0, 672.0)), unit(-3.0, 672.0));
        even = fused(yy, e4, even);
        odd = fused(yy, fused(yy, e5, e3), odd);
    }
    fused(by, odd, fused(yy, even, unit(1.0, 2.0)))
}
