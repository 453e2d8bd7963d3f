//! The encodings of cells: probabilities, log-odds, ROS's percent and MRPT's bytes.
//!
//! An encoding gives every stored value its exact meaning. Unknown is exact in all of them: `p = 1/2`, `l = 0`.

use super::histogram::Histogram;
use super::repeated;
pub use super::stored::Encoding;
use crate::cell::{self, Cell};
use crate::real::Real;
use crate::tally::{InformationSum, Tally};
use core::marker::PhantomData;
use core::ops::AddAssign;
#[cfg(feature = "std")]
use std::sync::LazyLock;

/// The encoding of cells as occupancy probabilities `p` in `[0, 1]`; unknown is 1/2.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Probability<T>(PhantomData<T>);

impl<T: Real> Encoding for Probability<T> {
    type Stored = T;
    type Float = T;
    const ALLOWED: &'static str = "a probability from 0 to 1";

    fn unknown() -> T {
        T::HALF
    }

    fn value(p: T) -> f64 {
        p.widen()
    }

    fn cell(p: T) -> Option<Cell<T>> {
        Cell::from_occupancy(p).ok()
    }

    fn occupancy(p: T) -> Option<T> {
        cell::in_unit_interval(p).then_some(p)
    }

    fn tally(cells: &[T]) -> Tally<T> {
        Tally::from_occupancies(cells)
    }

    fn information_sum(cells: &[T]) -> InformationSum<T> {
        InformationSum::from_occupancies(cells)
    }
}

/// The encoding of cells as log-odds `l = ln(p / (1-p))` in nats; unknown is 0.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct LogOdds<T>(PhantomData<T>);

impl<T: Real> Encoding for LogOdds<T> {
    type Stored = T;
    type Float = T;
    const ALLOWED: &'static str = "log-odds in nats, infinities included, not NaN";

    fn unknown() -> T {
        T::zero()
    }

    fn value(l: T) -> f64 {
        l.widen()
    }

    fn cell(l: T) -> Option<Cell<T>> {
        Cell::from_log_odds(l).ok()
    }

    fn occupancy(l: T) -> Option<T> {
        (!l.is_nan()).then(|| cell::occupancy_from_log_odds(l))
    }

    fn log_odds(l: T) -> Option<T> {
        (!l.is_nan()).then_some(l)
    }

    fn is_valid(l: T) -> bool {
        !l.is_nan()
    }

    fn tally(cells: &[T]) -> Tally<T> {
        summed(cells, Tally::add_many, Tally::from_log_odds)
    }

    fn information_sum(cells: &[T]) -> InformationSum<T> {
        summed(cells, InformationSum::add_many, InformationSum::from_log_odds)
    }
}

/// Sums up cells of log-odds: those that recur by their counts, the others many at once.
fn summed<T: Real, S: Default + AddAssign>(
    cells: &[T],
    add_many: fn(&mut S, Cell<T>, u64),
    many: fn(&[T]) -> S,
) -> S {
    let (mut recurring, mut others) = (S::default(), S::default());
    let count =
        |l, count| LogOdds::cell(l).into_iter().for_each(|cell| add_many(&mut recurring, cell, count));
    repeated::each(cells, count, |cells| others += many(cells));
    recurring += others;
    recurring
}

/// Evaluates a function of a byte from a table that is made on first use.
macro_rules! tabulated {
    ($byte:ident, $result:ty, $function:expr) => {{
        #[cfg(feature = "std")]
        {
            static TABLE: LazyLock<[$result; 256]> =
                LazyLock::new(|| core::array::from_fn(|byte| ($function)(byte as u8 as i8)));
            TABLE[usize::from($byte as u8)]
        }
        #[cfg(not(feature = "std"))]
        ($function)($byte)
    }};
}

/// The encoding of ROS's `nav_msgs/OccupancyGrid`: a percentage 0..=100, or -1 for unknown; 50 is `p = 1/2`, hence
/// unknown too.
///
/// `p` is the `f64` nearest to `percent / 100`.
///
/// ```
/// use mean_information::map::encoding::{Encoding, Percent};
/// assert_eq!(Percent::occupancy(29), Some(0.29));
/// assert_eq!(Percent::occupancy(-1), Some(0.5));
/// assert_eq!(Percent::occupancy(101), None);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Percent;

/// The occupancies at the percentages from -1 to 100: a table takes half the time of a division.
static FROM_PERCENT: [f64; 102] = {
    let mut table = [0.5; 102];
    let mut percent = 0;
    while percent <= 100 {
        table[percent + 1] = percent as f64 / 100.0;
        percent += 1;
    }
    table
};

impl Encoding for Percent {
    type Stored = i8;
    type Float = f64;
    const ALLOWED: &'static str = "a percentage from 0 to 100, or -1 for unknown";

    fn unknown() -> i8 {
        -1
    }

    fn value(percent: i8) -> f64 {
        f64::from(percent)
    }

    fn cell(percent: i8) -> Option<Cell<f64>> {
        tabulated!(percent, Option<Cell<f64>>, |percent| Percent::occupancy(percent)
            .and_then(|p| Cell::from_occupancy(p).ok()))
    }

    fn occupancy(percent: i8) -> Option<f64> {
        FROM_PERCENT.get(usize::from((percent as u8).wrapping_add(1))).copied()
    }

    fn is_valid(percent: i8) -> bool {
        (-1..=100).contains(&percent)
    }

    fn tally(cells: &[i8]) -> Tally<f64> {
        Histogram::from_cells(cells).tally::<Self>()
    }
}

/// The encoding of MRPT's `COccupancyGridMap2D` with 8-bit cells: 16 times the log-odds of being **free**, in nats; 0 is
/// unknown.
///
/// -128 reads as -127, as in MRPT, so that the scale is symmetric.
///
/// ```
/// use mean_information::map::encoding::{Encoding, MrptLogOdds};
/// assert_eq!(MrptLogOdds::occupancy(-32), Some(0.8807970779778824));
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct MrptLogOdds;

/// Decodes MRPT's byte to the log-odds of being occupied, in nats; exact.
fn log_odds(stored: i8) -> f64 {
    f64::from(stored.max(-127)) / -16.0
}

impl Encoding for MrptLogOdds {
    type Stored = i8;
    type Float = f64;
    const ALLOWED: &'static str = "a byte, from -128 to 127";

    fn unknown() -> i8 {
        0
    }

    fn value(stored: i8) -> f64 {
        f64::from(stored)
    }

    fn cell(stored: i8) -> Option<Cell<f64>> {
        tabulated!(stored, Option<Cell<f64>>, |stored| Cell::from_log_odds(log_odds(stored)).ok())
    }

    fn occupancy(stored: i8) -> Option<f64> {
        Some(tabulated!(stored, f64, |stored| cell::occupancy_from_log_odds(log_odds(stored))))
    }

    fn is_valid(_: i8) -> bool {
        true
    }

    fn log_odds(stored: i8) -> Option<f64> {
        Some(log_odds(stored))
    }

    fn tally(cells: &[i8]) -> Tally<f64> {
        Histogram::from_cells(cells).tally::<Self>()
    }
}
