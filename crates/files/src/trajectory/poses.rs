//! A trajectory: poses at times that ascend.

use crate::error::{Error, Place};
use mean_information::scan::{Direction, Pose};

/// The poses of a robot, or of its laser, by their times: one pose or more, at times that ascend.
///
/// ```
/// use mean_information::scan::Pose;
/// use mean_information_files::Trajectory;
///
/// let poses = vec![Pose::new(1.0, 0.5, 3.0)?, Pose::new(2.0, 0.0, -3.0)?];
/// let trajectory = Trajectory::new(vec![10.0, 10.4], poses)?;
/// assert_eq!(trajectory.span(), [10.0, 10.4]);
/// let between = trajectory.pose_at(10.1, 0.5).unwrap();
/// assert_eq!(format!("{:.3?}", between.position()), "[1.250, 0.375]");
/// assert_eq!(format!("{:.3}", between.theta()), "3.071"); // the shorter way round
/// assert_eq!(trajectory.pose_at(10.5, 0.5), None); // never beyond the ends
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Trajectory {
    times: Vec<f64>,
    poses: Vec<Pose>,
}

impl Trajectory {
    /// Creates a trajectory of poses at their times, in seconds.
    ///
    /// # Errors
    /// An [`Error`] if there is no pose, another number of times than of poses, or a time that is not finite or not
    /// above the one before; [`Place::Item`] has its index.
    pub fn new(times: Vec<f64>, poses: Vec<Pose>) -> Result<Self, Error> {
        if times.len() != poses.len() || times.is_empty() {
            let what = format!("number of times for {} poses", poses.len());
            return Err(Error::out_of_range(what, times.len(), "that of the poses, 1 or more"));
        }
        for (index, &time) in times.iter().enumerate() {
            let before = index.checked_sub(1).map(|before| times[before]);
            check_time(time, before).map_err(|error| error.at(Place::Item(index)))?;
        }
        Ok(Self { times, poses })
    }

    /// Returns the number of poses, which is not 0.
    #[expect(clippy::len_without_is_empty, reason = "it is never empty")]
    pub fn len(&self) -> usize {
        self.times.len()
    }

    /// Returns the times, ascending, in seconds.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// Returns the poses.
    pub fn poses(&self) -> &[Pose] {
        &self.poses
    }

    /// Returns the first and the last time, in seconds.
    pub fn span(&self) -> [f64; 2] {
        [self.times[0], self.times[self.len() - 1]]
    }

    /// Returns the trajectory of a laser that is mounted at `mount` in the frame of the robot, whose trajectory this is.
    ///
    /// # Errors
    /// An [`Error`] if a number overflows; [`Place::Item`] has the index of the pose.
    ///
    /// ```
    /// use mean_information::scan::Pose;
    /// use mean_information_files::Trajectory;
    /// let robot = Trajectory::new(vec![7.0], vec![Pose::new(2.0, 3.0, 0.0)?])?;
    /// let laser = robot.mounted(&Pose::new(0.25, -0.5, 0.125)?)?;
    /// assert_eq!(laser.poses(), [Pose::new(2.25, 2.5, 0.125)?]);
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn mounted(mut self, mount: &Pose) -> Result<Self, Error> {
        for (index, pose) in self.poses.iter_mut().enumerate() {
            *pose = compose(pose, mount).map_err(|error| Error::from(error).at(Place::Item(index)))?;
        }
        Ok(self)
    }
}

/// Returns nanoseconds in seconds, rounded once: the nearest float.
///
/// ```
/// use mean_information_files::trajectory::seconds;
/// assert_eq!(seconds(1_700_000_000_250_000_001_i64), 1_700_000_000.25);
/// ```
pub fn seconds(nanoseconds: impl Into<i128>) -> f64 {
    format!("{}e-9", nanoseconds.into()).parse().unwrap_or(f64::NAN)
}

/// Refuses a time, in seconds, that is not finite or not after the one before.
pub(crate) fn check_time(time: f64, before: Option<f64>) -> Result<(), Error> {
    if !time.is_finite() {
        return Err(Error::out_of_range("time", time, "a finite number of seconds"));
    }
    match before {
        Some(before) if time <= before => {
            let allowed = format!("a time above the one before, {before} s: times ascend");
            Err(Error::out_of_range("time", time, allowed))
        }
        _ => Ok(()),
    }
}

/// Returns the pose in the world of what is at `part` in the frame of `whole`.
pub(crate) fn compose(whole: &Pose, part: &Pose) -> Result<Pose, mean_information::Error> {
    let heading = Direction::new(&[whole.theta()])?;
    let ([x, y], [ahead, aside]) = (whole.position(), part.position());
    Pose::new(
        x + ahead * heading.cos() - aside * heading.sin(),
        y + ahead * heading.sin() + aside * heading.cos(),
        whole.theta() + part.theta(),
    )
}
