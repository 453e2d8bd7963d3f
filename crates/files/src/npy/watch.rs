//! What makes an array mean less than it seems: numbers that are states, sums that were rounded, greys.

use crate::cells::Readable;
use crate::warning::{SAVED_UNKNOWN, Warning};
use mean_information::map::encoding::Probability;
use mean_information::map::{Encoding, Grid, Histogram};

/// Returns the warning of percentages of which none is above 1, and some are 1: ROS 2's message once said 0, 1 and -1 for
/// free, occupied and unknown.
pub(super) fn of_percentages(counts: &Histogram) -> Vec<Warning> {
    let above = (2..=100_i8).any(|percent| counts.count(percent) > 0);
    let count = counts.count(1_i8);
    (count > 0 && !above).then_some(Warning::NoPercentageAbove1 { count }).into_iter().collect()
}

/// The greys of 255 that often mean unknown: those around 1/2, and the savers', as brightness and as occupancy.
const OFTEN_UNKNOWN: [u8; 4] = [127, 128, SAVED_UNKNOWN, 255 - SAVED_UNKNOWN];
/// How far their fractions of 255 are from 1/2, which two of them share.
const FROM_HALF: [f64; 2] = [0.5 / 255.0, (SAVED_UNKNOWN as f64 - 127.5) / 255.0];
/// Fractions of 255 in single and in double precision are nearer than this to each other.
const SAME: f64 = 1e-7;

/// Counts of suspect floats.
pub(super) struct FloatWatch {
    /// The value of unknown.
    unknown: f64,
    /// The distance from it up to which sums of rounded numbers end beside it, and that of sums in single precision, which the
    /// numbers may have been before.
    beside: [f64; 2],
    /// True if the numbers are probabilities, which may be greys.
    is_probability: bool,
    cells: u64,
    beside_unknown: u64,
    /// For each of [`OFTEN_UNKNOWN`], how many cells have it, and as what number.
    greys: [(u64, f64); OFTEN_UNKNOWN.len()],
}

impl FloatWatch {
    /// Creates counts of 0.
    pub(super) fn new<E: Encoding>() -> Self {
        // Some units in the last place of 1/2: the rounding of some dozens of sums.
        let single = size_of::<E::Stored>() == 4;
        let coarse = 8.0 * f64::from(f32::EPSILON);
        let beside = [if single { coarse } else { 8.0 * f64::EPSILON }, coarse];
        Self {
            unknown: E::value(E::unknown()),
            beside,
            is_probability: E::ALLOWED == Probability::<f64>::ALLOWED,
            cells: 0,
            beside_unknown: 0,
            greys: [(0, 0.0); OFTEN_UNKNOWN.len()],
        }
    }

    /// Watches a whole map.
    pub(super) fn of<E: Readable>(grid: &Grid<E>) -> Self {
        let mut watch = Self::new::<E>();
        watch.see::<E>(grid.cells());
        watch
    }

    /// Watches some cells.
    pub(super) fn see<E: Encoding>(&mut self, cells: &[E::Stored]) {
        self.cells += cells.len() as u64;
        for &cell in cells {
            let value = E::value(cell);
            let distance = (value - self.unknown).abs();
            let [own, coarse] = self.beside;
            if distance <= coarse {
                let is_beside = distance <= own || f64::from(value as f32) == value;
                self.beside_unknown += u64::from(is_beside && distance > 0.0);
            }
            // Few cells are asked for each grey.
            if self.is_probability && FROM_HALF.iter().any(|grey| (distance - grey).abs() < 2.0 * SAME) {
                for (grey, (count, seen)) in OFTEN_UNKNOWN.into_iter().zip(&mut self.greys) {
                    if (value - f64::from(grey) / 255.0).abs() < SAME {
                        *count += 1;
                        *seen = value;
                    }
                }
            }
        }
    }

    /// Returns what there is to say: of rounded sums if they are over a hundredth of the cells, of a grey if it is over a
    /// fifth.
    pub(super) fn warnings(&self) -> Vec<Warning> {
        let count = self.beside_unknown;
        let beside = (count.saturating_mul(100) > self.cells).then_some(Warning::BesideUnknown { count });
        let greys = OFTEN_UNKNOWN.into_iter().zip(self.greys);
        let much = greys.filter(|&(_, (count, _))| count.saturating_mul(5) > self.cells);
        let of = |(grey, (count, value))| Warning::OftenUnknownValue { grey, value, count };
        beside.into_iter().chain(much.map(of)).collect()
    }
}
