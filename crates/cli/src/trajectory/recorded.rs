//! What is taken of a bag or of a saved state, as the command line says it.

use crate::failure::Failure;
use clap::Args;
use mean_information_files::bags;
use mean_information_files::scans::Selection;
use mean_information_report::submaps::is_state;
use std::path::Path;

/// The options for files that hold more than one log.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Bags and saved states")]
pub struct Recorded {
    /// The topic of a bag's scans; if absent, the only one of type sensor_msgs/LaserScan.
    #[arg(long)]
    topic: Option<String>,
    /// Frames of a bag's TF, each of which gives a trajectory: the poses of the robot in it; of a saved state local and global.
    /// If absent, and no other trajectory is named, map and odom, where TF has them, or both of a state.
    #[arg(long, value_name = "FRAME,...", value_delimiter = ',')]
    frames: Option<Vec<String>>,
    /// Topics of a bag, each of which has a trajectory: Odometry, PoseStamped, PoseWithCovarianceStamped.
    #[arg(long, value_name = "TOPIC,...", value_delimiter = ',')]
    pose_topics: Vec<String>,
    /// The frame of a bag's robot, whose poses are taken; if absent, the last that carries the laser by /tf_static.
    #[arg(long, value_name = "FRAME")]
    base: Option<String>,
    /// The trajectory of a saved state, by its number; if absent, the only one.
    #[arg(long, value_name = "N")]
    trajectory: Option<u64>,
}

impl Recorded {
    /// Returns what is taken of the file at `path`; `alone` if no other trajectories are named.
    ///
    /// # Errors
    /// An option that the file has no use for.
    pub fn selection(&self, path: &Path, alone: bool) -> Result<Selection, Failure> {
        let Self { topic, frames, pose_topics, base, trajectory } = self.clone();
        let is_bag = bags::is_bag(path);
        let (bag, state) = ("bag", "saved state");
        let needs = [
            ("--topic", topic.is_some(), is_bag, bag),
            ("--frames", frames.is_some(), is_bag || is_state(path), "bag or saved state"),
            ("--pose-topics", !pose_topics.is_empty(), is_bag, bag),
            ("--base", base.is_some(), is_bag, bag),
            ("--trajectory", trajectory.is_some(), is_state(path), state),
        ];
        if let Some((option, .., kind)) = needs.iter().find(|(_, is_given, has, _)| *is_given && !has) {
            let words = format!("is no {kind} by its name; {option} needs one, leave it out");
            return Err(Failure::file(path, words));
        }
        let named = !alone || !pose_topics.is_empty();
        let frames = if named { frames.or_else(|| Some(Vec::new())) } else { frames };
        Ok(Selection { topic, frames, pose_topics, base, trajectory, ..Selection::default() })
    }
}
