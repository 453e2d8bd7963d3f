//! The row of a trajectory, and the scans that all rows share.

use super::contradictions::Contradiction;
use super::laser::Laser;
use super::parting::Parting;
use super::setup::Setup;
use mean_information::scan::Difference;
use mean_information_report::measures::Measures;

/// The scans that the rows were measured of, and how.
#[derive(Clone, Debug)]
pub struct Used {
    /// The name of the log.
    pub log: String,
    /// The number of its scans.
    pub scans: usize,
    /// The number of scans for which every trajectory has a pose.
    pub scans_used: usize,
    /// The number of their beams that say something.
    pub beams: u64,
    /// The setup of the maps.
    pub setup: Setup,
    /// The laser.
    pub laser: Laser,
    /// The warnings of the log.
    pub warnings: Vec<String>,
}

/// The row of a trajectory.
#[derive(Clone, Debug)]
pub struct Row {
    /// The name of the trajectory.
    pub name: String,
    /// The number of scans for which it has no pose.
    pub scans_without_pose: usize,
    /// The measures of its map.
    pub measures: Measures,
    /// The agreement of the scans.
    pub agreement: f64,
    /// The number of observed cells that were seen in more than one block of scans.
    pub revisited: u64,
    /// The difference from the first row; `None` of the first, and where there is one scan alone.
    pub difference: Option<Difference>,
    /// The parts of the log where it parts from the best one, of a row that is not the best.
    pub parting: Option<Parting>,
    /// The places where its scans contradict one another most, the worst first.
    pub contradictions: Vec<Contradiction>,
    /// The signs that the row means less than it seems.
    pub warnings: Vec<String>,
}
