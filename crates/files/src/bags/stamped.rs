//! The messages of poses: `nav_msgs/Odometry`, `geometry_msgs/PoseStamped` and `PoseWithCovarianceStamped`.

use super::delivery::Message;
use super::fields::{Fields, Header};
use crate::error::Error;
use crate::trajectory::Rigid;

/// The types of messages that have a pose at a time.
pub(super) const POSE_KINDS: [&str; 3] =
    [ODOMETRY, "geometry_msgs/PoseStamped", "geometry_msgs/PoseWithCovarianceStamped"];
const ODOMETRY: &str = "nav_msgs/Odometry";

/// A message of one of these types.
pub(super) struct PoseMessage<'a> {
    /// The time, and the frame in which the pose is.
    pub(super) header: Header<'a>,
    /// The frame of which the pose is, where an odometry names it.
    pub(super) child: Option<&'a str>,
    /// The pose.
    pub(super) pose: Rigid,
}

impl<'a> PoseMessage<'a> {
    /// Reads a message. What follows its pose, covariances and velocities, is not asked for.
    ///
    /// # Errors
    /// An [`Error`] with the byte in the message at which it is not one, or its pose is none.
    pub(super) fn read(message: &Message<'a>) -> Result<Self, Error> {
        let mut fields = Fields::new(message)?;
        let header = fields.header()?;
        let child = if message.topic.kind == ODOMETRY { Some(fields.frame()?) } else { None };
        let place = fields.place(8);
        let pose = fields.pose()?;
        if !pose.is_sound() {
            let what = "the pose, of which the quaternion has the length";
            let allowed =
                "a finite position, and a quaternion whose squared length is 1, within 0.01, as in tf2";
            return Err(Error::out_of_range(what, pose.turn.norm(), allowed).at(place));
        }
        Ok(Self { header, child: child.filter(|name| !name.is_empty()), pose })
    }
}
