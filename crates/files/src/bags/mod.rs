//! Bags, read without ROS: MCAP, ROS 1's `.bag` and, by the feature `sqlite`, rosbag2's `.db3`, alone or in its folder.
//!
//! A bag is read from its first byte to its last, without its index, so that one that was cut short gives all that is
//! whole in it. Every reader hands the messages of the topics that a [`Visitor`] wants to it, in the order of the file,
//! one at a time: memory holds one message. [`MapSeries`] makes maps of them, [`read_scans`] a log of scans with
//! trajectories.

mod container;
mod delivery;
mod fields;
mod folder;
mod grid;
mod last;
mod mcap;
mod octomap;
mod read;
mod recording;
mod refusals;
mod robot;
mod rosbag;
mod scan;
mod scans;
mod series;
#[cfg(feature = "sqlite")]
mod sqlite;
mod stamped;
mod stream;
mod topics;
mod transforms;

pub use delivery::{Encoding, Message, Topic, Visitor};
pub use folder::{bag_files, is_bag};
pub use grid::{GridMessage, GridUpdate};
pub use last::{AnyMap, last_map, last_map_of_any_kind, octree_of};
pub use octomap::OctreeMessage;
pub use read::read_bag;
pub use scans::{read_scans, scans_of};
pub use series::{Change, MapSeries, Snapshot};
pub use stream::read_stream;
pub use topics::{MapTopic, is_costmap};
