//! The sums of entropy and information over a block of cells.

use super::format::{HALF, Lane};
use super::table::Table;
use crate::rounded::mean::Fixed;

/// The cells that are summed up at once: so few that no sum of bits overflows.
pub(crate) const BLOCK: usize = 256;

/// What a block of cells adds to a tally, but for those marked open.
#[derive(Debug)]
pub(crate) struct Block {
    /// The exact sum of the rounded entropies, and of the rounded information; without entropies the first is 0, and so is the
    /// number of occupied cells.
    pub(crate) entropy: Fixed,
    pub(crate) information: Fixed,
    pub(crate) unknown: u64,
    pub(crate) occupied: u64,
    /// 1 where the cell is in the sums, 0 where it was left out: not decided, beyond the table, or no probability.
    pub(crate) closed: [u8; BLOCK],
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
        let rest = x - (high - Self::high_origin());
        self.high = T::add_bits(self.high, high);
        self.low = T::add_bits(self.low, rest + Self::low_origin());
    }

    fn fixed(self) -> Fixed {
        let high = i128::from(T::ulps(self.high, Self::high_origin(), BLOCK));
        let low = i128::from(T::ulps(self.low, Self::low_origin(), BLOCK));
        let places = T::PRECISION as i32 - 2;
        Fixed { value: ((high << places) + low) as u128, exponent: -2 * places }
    }
}

impl Block {
    /// The number of cells in the sums.
    pub(crate) fn decided(&self) -> u64 {
        self.closed.iter().map(|&closed| u64::from(closed)).sum()
    }

    /// Those of its cells that are not.
    pub(crate) fn open<T: Copy>(&self, cells: &[T]) -> impl Iterator<Item = T> {
        self.closed.iter().zip(cells).filter(|(closed, _)| **closed == 0).map(|(_, &p)| p)
    }

    /// Of the cells of the given occupancies, with their entropies or without.
    ///
    /// With `FUSED`, some products and sums are rounded at once, which only pays where the target has an instruction for it.
    /// One loop without branches over arrays of fixed size: that is what compilers make vectors of.
    #[inline(always)]
    pub(crate) fn of<T: Lane, const FUSED: bool, const ENTROPY: bool>(
        table: &Table<T>,
        cells: &[T; BLOCK],
    ) -> Self {
        let (zero, one) = (T::zero(), T::one());
        let least = T::from_parts(1, -T::BINADES);
        let mut closed = [0; BLOCK];
        let (mut entropy, mut information) = (Sum::new(), Sum::new());
        let (mut unknown, mut occupied) = (T::Word::default(), T::Word::default());
        for (&p, closed) in cells.iter().zip(&mut closed) {
            let rest = one - p;
            let q = if p < rest { p } else { rest };
            let double = q + q;
            let near = double > T::HALF;
            // The distance from unknown, or twice that from certain; both exact.
            let x = if near { one - double } else { double };
            let (head, tail) = value::<T, FUSED, ENTROPY>(table, x, near);
            let error = head * T::ERROR;
            let (value, above) = (head + (tail - error), head + (tail + error));
            let mut done = (x >= least) & (value == above);
            // Certain or unknown, where the distance is 0.
            let edge = x.is_zero();
            if ENTROPY {
                let complement = one - head;
                let rest = ((one - complement) - head) - tail;
                let (other, above) = (complement + (rest - error), complement + (rest + error));
                done &= other == above;
                let value = if done & !edge { value } else { zero };
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
                let value = if done & !edge { value } else { zero };
                information.add(if edge & !near { one } else { value });
            }
            done |= edge;
            *closed = u8::from(done);
            unknown = T::count(unknown, edge & near);
            if ENTROPY {
                occupied = T::count(occupied, done & (p > T::HALF));
            }
        }
        Self {
            entropy: entropy.fixed(),
            information: information.fixed(),
            unknown: T::counted(unknown),
            occupied: T::counted(occupied),
            closed,
        }
    }
}

/// `V` at the distance `x`, as a float and a rest of at most `2^-15` of it.
///
/// With `h = x - c` the Taylor series about the centre, `V = V_c + s h + h y E(b, y)`: `y = ∓h / (2 q (1 - q))`, `b = ∓(1 - 2q)`,
/// and `E = 1/(2 ln 2) sum of e_k y^k`, whose coefficients are polynomials in `b`.
#[inline(always)]
pub(super) fn value<T: Lane, const FUSED: bool, const ENTROPY: bool>(
    table: &Table<T>,
    x: T,
    near: bool,
) -> (T, T) {
    let fused = |a: T, b: T, c: T| if FUSED { T::fused(a, b, c) } else { a * b + c };
    let (c, number) = T::centre(x);
    let row = (number + if near { HALF as u32 } else { 0 }) as usize % (2 * HALF);
    let (value, slope, inverse) = (table.value[row], table.slope[row], table.inverse[row]);
    let (value_low, slope_low) = T::unpack(table.low[row]);
    let h = x - c;
    let y = h * inverse;
    let b = if near {
        -c
    } else if ENTROPY {
        c - T::one()
    } else {
        T::one() - c
    };
    let square = b * b;
    // 1/(2 ln 2) times 1/2, 1/6 b, (1 + 3 b^2)/48 and so on.
    let unit = |numerator: f64, denominator: f64| {
        T::nearest(numerator / denominator / (2.0 * core::f64::consts::LN_2))
    };
    let e2 = fused(square, unit(3.0, 48.0), unit(1.0, 48.0));
    let mut sum = e2;
    if T::TERMS > 3 {
        let e3 = b * fused(square, unit(-1.0, 40.0), unit(-1.0, 40.0));
        let e4 = fused(square, fused(square, unit(5.0, 480.0), unit(10.0, 480.0)), unit(1.0, 480.0));
        let e5 = b * fused(square, fused(square, unit(-3.0, 672.0), unit(-10.0, 672.0)), unit(-3.0, 672.0));
        sum = fused(y, fused(y, fused(y, e5, e4), e3), sum);
    }
    let series = fused(y, fused(y, sum, b * unit(-1.0, 6.0)), unit(1.0, 2.0));
    let rest = (h * y) * series;
    // The product of slope and h, exactly.
    let (first, second) = if FUSED {
        let first = slope * h;
        (first, T::fused(slope, h, -first))
    } else {
        (slope.head() * h, (slope - slope.head()) * h)
    };
    let head = value + first;
    let lost = (value - head) + first;
    (head, (rest + fused(slope_low, h, second)) + (lost + value_low))
}
