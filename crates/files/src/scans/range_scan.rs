//! One record of a log: what a range sensor returned at a time.

use crate::error::{Error, Place};
use mean_information::Error as Refused;
use mean_information::scan::{Beam, Pose, Scan};
use std::f64::consts::TAU;
use std::sync::Arc;

/// The bearings of the beams, in radians from the heading of the sensor, counter-clockwise.
#[derive(Clone, Debug, PartialEq)]
pub enum Bearings {
    /// Beam `k` at `start + k increment`; a negative increment turns clockwise.
    Even {
        /// The bearing of the first beam.
        start: f64,
        /// The angle from a beam to the next.
        increment: f64,
    },
    /// One bearing for each beam, shared by the scans of a log.
    Each(Arc<[f64]>),
}

/// A number in a range's place, by the table of [`scans`](crate::scans).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Reading {
    /// A range in metres, above 0 and below the greatest.
    Return(f64),
    /// No return from within the greatest range.
    NoReturn,
    /// A number that says nothing.
    Invalid,
}

/// The meaning of a beam that did not return.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[non_exhaustive]
pub enum NoReturn {
    /// Nothing: glass, dark surfaces and errors do not return either. The beam is left out, as in GMapping.
    #[default]
    LeftOut,
    /// Space is free up to the greatest range, as for [`Beam::range`] without a value.
    Free,
}

/// One record of a log of range scans.
///
/// ```
/// use mean_information::scan::Pose;
/// use mean_information_files::scans::{Bearings, NoReturn, RangeScan, Reading};
///
/// let bearings = Bearings::Even { start: -0.5, increment: 0.25 };
/// let ranges = vec![1.75, 0.0, f64::INFINITY, f64::NAN, 2.5];
/// let record = RangeScan::new(12.5, bearings, ranges, [0.0, 8.0])?;
/// let [mut returns, mut without] = [0, 0];
/// for reading in record.readings() {
///     match reading {
///         Reading::Return(_) => returns += 1,
///         Reading::NoReturn => without += 1,
///         Reading::Invalid => {}
///     }
/// }
/// assert_eq!((returns, without), (2, 1));
///
/// let pose = Pose::new(2.0, 3.0, 0.5)?;
/// let scan = record.scan_from(pose, NoReturn::LeftOut)?.unwrap();
/// assert_eq!((scan.beams().len(), scan.beams()[1].bearing), (2, 0.5));
/// assert_eq!(record.scan_from(pose, NoReturn::Free)?.unwrap().beams().len(), 3);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct RangeScan {
    time: f64,
    bearings: Bearings,
    ranges: Vec<f64>,
    limits: [f64; 2],
    laser: Option<Pose>,
    odometry: Option<Pose>,
}

impl RangeScan {
    /// The numbers that a record takes beside its ranges, at most.
    pub(crate) const BESIDE_RANGES: usize = 24;

    /// Creates a record without poses: its time in seconds, and the ranges at their bearings, as they were recorded, by a
    /// sensor that sees from `limits[0]` to `limits[1]` metres.
    ///
    /// # Errors
    /// An [`Error`] if the time is not finite; there is no range; bearings are not finite, not as many as the ranges, or
    /// turn further than once round; or the limits are not `0 ≤ least < greatest < ∞`.
    pub fn new(time: f64, bearings: Bearings, ranges: Vec<f64>, limits: [f64; 2]) -> Result<Self, Error> {
        if !time.is_finite() {
            return Err(Error::out_of_range("time", time, "a finite number of seconds"));
        }
        if ranges.is_empty() {
            return Err(Error::out_of_range("the number of beams", 0, "1 or more"));
        }
        bearings.check(ranges.len())?;
        let [least, greatest] = limits;
        if !(0.0..f64::INFINITY).contains(&least) {
            return Err(Error::out_of_range("the least range", least, "0 or more metres, finite"));
        }
        if !(greatest > least && greatest < f64::INFINITY) {
            let allowed = "a finite number of metres above 0 and above the least range";
            return Err(Error::out_of_range("the greatest range", greatest, allowed));
        }
        Ok(Self { time, bearings, ranges, limits, laser: None, odometry: None })
    }

    /// Adds the pose of the laser as the record has it.
    #[must_use]
    pub fn with_laser(self, pose: Pose) -> Self {
        Self { laser: Some(pose), ..self }
    }

    /// Adds the pose of the robot by its odometry as the record has it.
    #[must_use]
    pub fn with_odometry(self, pose: Pose) -> Self {
        Self { odometry: Some(pose), ..self }
    }

    /// Returns the scan of a laser that is mounted upside down: its bearings turn the other way.
    pub(crate) fn upside_down(mut self) -> Self {
        self.bearings = match self.bearings {
            Bearings::Even { start, increment } => Bearings::Even { start: -start, increment: -increment },
            Bearings::Each(bearings) => Bearings::Each(bearings.iter().map(|bearing| -bearing).collect()),
        };
        self
    }

    /// Returns the time, in seconds, on the clock of the log.
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns the bearings.
    pub fn bearings(&self) -> &Bearings {
        &self.bearings
    }

    /// Returns the ranges as they were recorded, in metres: one or more, of any value.
    pub fn ranges(&self) -> &[f64] {
        &self.ranges
    }

    /// Returns the least and the greatest range of the sensor, in metres.
    pub fn limits(&self) -> [f64; 2] {
        self.limits
    }

    /// Returns the pose of the laser, where the record has one: a corrected one, or by odometry and mount.
    pub fn laser(&self) -> Option<&Pose> {
        self.laser.as_ref()
    }

    /// Returns the pose of the robot by its odometry, where the record has one.
    pub fn odometry(&self) -> Option<&Pose> {
        self.odometry.as_ref()
    }

    /// Returns the meanings of the ranges, by the table of [`scans`](crate::scans).
    pub fn readings(&self) -> impl Iterator<Item = Reading> {
        let [least, greatest] = self.limits;
        self.ranges.iter().map(move |&range| {
            if range >= greatest {
                Reading::NoReturn
            } else if range > 0.0 && range >= least {
                Reading::Return(range)
            } else {
                Reading::Invalid
            }
        })
    }

    /// Returns the beams of the scan from a pose of the laser; `None` if no beam says anything.
    ///
    /// # Errors
    /// Never for a record and a pose: [`Scan::new`].
    pub fn scan_from(&self, pose: Pose, no_return: NoReturn) -> Result<Option<Scan<f64>>, Refused> {
        let mut beams = Vec::with_capacity(self.ranges.len());
        for (index, reading) in self.readings().enumerate() {
            let range = match reading {
                Reading::Return(range) => Some(range),
                Reading::NoReturn if no_return == NoReturn::Free => None,
                Reading::NoReturn | Reading::Invalid => continue,
            };
            beams.push(Beam { bearing: self.bearings.at(index), range });
        }
        if beams.is_empty() { Ok(None) } else { Scan::new(pose, self.limits[1], beams).map(Some) }
    }
}

impl Bearings {
    /// Returns the bearing of a beam, in radians; NaN of a beam that is not there.
    pub fn at(&self, index: usize) -> f64 {
        match self {
            Self::Even { start, increment } => start + index as f64 * increment,
            Self::Each(bearings) => bearings.get(index).copied().unwrap_or(f64::NAN),
        }
    }

    /// Refuses bearings that cannot be those of `beams` beams.
    fn check(&self, beams: usize) -> Result<(), Error> {
        match self {
            Self::Even { start, increment } => {
                // From the first beam round to itself, and half an increment for angles of few digits.
                let turned = increment.abs() * (beams as f64 - 1.5);
                if !start.is_finite() || start.abs() > 2.0 * TAU {
                    return Err(Error::out_of_range(
                        "the first bearing",
                        start,
                        "within two turns, in radians",
                    ));
                }
                if !(turned <= TAU && (*increment != 0.0 || beams == 1) && increment.is_finite()) {
                    let what = format!("the angle between {beams} beams");
                    let allowed = "not 0, and at most one turn in all, in radians";
                    return Err(Error::out_of_range(what, increment, allowed));
                }
                Ok(())
            }
            Self::Each(bearings) if bearings.len() != beams => {
                let what = format!("the number of bearings for {beams} ranges");
                Err(Error::out_of_range(what, bearings.len(), "that of the ranges"))
            }
            Self::Each(bearings) => match bearings.iter().position(|bearing| !bearing.is_finite()) {
                Some(index) => {
                    let refused = Error::out_of_range("bearing", bearings[index], "finite, in radians");
                    Err(refused.at(Place::Item(index)))
                }
                None => Ok(()),
            },
        }
    }
}
