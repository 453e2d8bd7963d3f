//! One scan that a filter took in.

use crate::scans::RangeScan;
use mean_information::elementary::exp;
use mean_information::scan::Pose;

/// A scan that a filter took in: where each particle matched it, and how it weighs them then.
#[derive(Clone, Debug, PartialEq)]
pub struct FilterStep {
    /// The scan, with the robot's pose by odometry.
    pub scan: RangeScan,
    /// The pose of each particle.
    pub poses: Vec<Pose>,
    /// The logarithm of each particle's weight, since the last resampling.
    pub log_weights: Vec<f64>,
    /// The number of particles that count, as the log states it.
    pub stated_effective: Option<f64>,
    /// After this step, the particle that each particle of the next one continues; `None` if each continues itself.
    pub resampled: Option<Vec<usize>>,
}

impl FilterStep {
    /// Returns the weights, the greatest of which is 1: `exp((w - max w) / (gain n))` for `n` particles, correctly rounded but
    /// for the exponent, which is within 2 ulp. A weight below the least float is 0.
    pub fn weights(&self, gain: f64) -> Vec<f64> {
        let greatest = self.log_weights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        // Not infinite, as a difference may be.
        let divisor = (gain * self.log_weights.len() as f64).min(f64::MAX);
        self.log_weights.iter().map(|w| exp((w - greatest) / divisor)).collect()
    }

    /// Returns the number of particles that count, `(sum w)^2 / sum w^2`, between 1 and their number.
    pub fn effective(&self, gain: f64) -> f64 {
        let weights = self.weights(gain);
        let [sum, squares] = weights.iter().fold([0.0, 0.0], |[sum, squares], w| [sum + w, squares + w * w]);
        sum * sum / squares
    }
}
