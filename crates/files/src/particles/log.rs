//! A filter's whole log, and the ancestry of its particles.

use super::reader::Reader;
use super::step::FilterStep;
use crate::error::{Error, ErrorKind, Place};
use crate::scans::ScanOptions;
use crate::trajectory::compose;
use crate::warning::Warning;
use mean_information::elementary::exp;
use mean_information::scan::Pose;
use std::io::BufRead;
use std::path::PathBuf;

/// The unit of the last of the six decimals that GMapping writes.
const UNIT: f64 = 1e-6;

/// The steps of a particle filter.
///
/// ```
/// use mean_information_files::{particles::FilterLog, scans::ScanOptions};
///
/// let scan = |time| format!("LASER_READING 180{} 0 0 0 {time}\n", " 2.5".repeat(180));
/// let log = ["PARAM ogain 3\n", &scan(1.5), "SM_UPDATE 2 0 0 0 -10 0.25 0 0 -16\nNEFF 1.600000\nRESAMPLE 2 0 0\n",
///            &scan(2.5), "SM_UPDATE 2 1 0 0 -20 1.25 0 0 -20\n"].concat();
/// let log = FilterLog::read(log.as_bytes(), &ScanOptions::default())?;
/// // exp(-6 / (3 * 2)) = 1/e
/// assert_eq!(format!("{:.4?} {:.4}", log.weights(0), log.steps[0].effective(log.gain)), "[1.0000, 0.3679] 1.6481");
/// // Particle 1 continues particle 0.
/// assert_eq!(log.lineage(1, 1), [0, 1]);
/// assert_eq!(log.trajectory(1, 1).map(|pose| pose.position()[0]).collect::<Vec<_>>(), [0.0, 1.25]);
/// # Ok::<(), mean_information_files::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct FilterLog {
    /// The steps: one or more, their times ascend, all of one number of particles.
    pub steps: Vec<FilterStep>,
    /// The gain of the weights: `PARAM ogain`, or else [`Self::GAIN`].
    pub gain: f64,
    /// The signs that the log means less than it seems.
    pub warnings: Vec<Warning>,
    /// The files it was read from.
    pub files: Vec<PathBuf>,
}

/// Bounds how far decimals move the number of particles that count, `(sum w)^2 / sum w^2`, from the stated one.
fn stated_within(step: &FilterStep, gain: f64) -> f64 {
    // A logarithm is off by half a unit, its distance from the greatest by one: a weight by the factor e^±x, and the quotient of
    // squares of weights by e^±4x. The stated number is off by half a unit itself; floats add less than another tenth.
    let x = UNIT / (gain * step.log_weights.len() as f64);
    0.6 * UNIT + step.effective(gain) * (exp(4.0 * x) - 1.0)
}

impl FilterLog {
    /// The gain of the weights unless a log states it, as in GMapping's programs.
    pub const GAIN: f64 = 3.0;

    /// Reads a log.
    ///
    /// # Errors
    /// An [`Error`] with the line if a line of a known first word lacks a field or has one that cannot be meant: another
    /// number of particles than before, a resampled particle that there is not, weights that are not finite, a scan of no
    /// known bearings, an update or a resampling without its scan, times that do not ascend; or if there is no step.
    pub fn read(input: impl BufRead, options: &ScanOptions) -> Result<Self, Error> {
        let mut reader = Reader::new(options);
        let mut warnings = reader.read(input)?;
        let (steps, stated_gain) = (reader.steps, reader.gain);
        let gain = stated_gain.unwrap_or(Self::GAIN);
        if steps.is_empty() {
            let refused = Error::new(ErrorKind::Format, "holds no scan with its particles");
            return Err(refused.allowing("; allowed are ", "logs of LASER_READING and SM_UPDATE"));
        }
        let underflows = |step: &FilterStep| step.weights(gain).iter().filter(|&&w| w == 0.0).count() as u64;
        let weights: u64 = steps.iter().map(underflows).sum();
        if weights > 0 {
            warnings.push(Warning::WeightsUnderflow { weights });
        }
        let differs = |step: &FilterStep| {
            let (effective, within) = (step.effective(gain), stated_within(step, gain));
            step.stated_effective.is_some_and(|stated| (effective - stated).abs() > within)
        };
        if stated_gain.is_none() && steps.iter().all(|step| step.stated_effective.is_none()) {
            warnings.push(Warning::GainNotStated { gain });
        }
        let differing = steps.iter().filter(|step| differs(step)).count() as u64;
        if differing > 0 {
            warnings.push(Warning::OtherWeightsStated { steps: differing, gain });
        }
        Ok(Self { steps, gain, warnings, files: Vec::new() })
    }

    /// Returns the log with the poses of a laser that is mounted on the robots whose poses it has.
    ///
    /// # Errors
    /// An [`Error`] with the number of the step if a pose is not finite.
    pub fn mounted(mut self, mount: &Pose) -> Result<Self, Error> {
        for (index, step) in self.steps.iter_mut().enumerate() {
            for pose in &mut step.poses {
                *pose = compose(pose, mount).map_err(|error| Error::from(error).at(Place::Item(index)))?;
            }
        }
        Ok(self)
    }

    /// Returns the number of particles.
    pub fn particles(&self) -> usize {
        self.steps[0].poses.len()
    }

    /// Returns the weights of the particles at a step, the greatest of which is 1.
    ///
    /// # Panics
    /// If there is no such step.
    pub fn weights(&self, step: usize) -> Vec<f64> {
        self.steps[step].weights(self.gain)
    }

    /// Returns which particle it was that a particle of `step` continues, at each step up to this one.
    ///
    /// # Panics
    /// If there is no such step or particle.
    pub fn lineage(&self, step: usize, particle: usize) -> Vec<usize> {
        let mut lineage = vec![particle; step + 1];
        for at in (0..step).rev() {
            let next = lineage[at + 1];
            lineage[at] = self.steps[at].resampled.as_ref().map_or(next, |resampled| resampled[next]);
        }
        lineage
    }

    /// Returns the poses of a particle of `step`, at each step up to this one.
    ///
    /// # Panics
    /// If there is no such step or particle.
    pub fn trajectory(&self, step: usize, particle: usize) -> impl Iterator<Item = Pose> {
        let lineage = self.lineage(step, particle);
        self.steps.iter().zip(lineage).map(|(step, particle)| step.poses[particle])
    }
}
