//! Bags and saved states: each is read or refused, and a bag that was cut is read up to the cut.

use super::scans::{check_scan, check_trajectory};
use crate::formats::{Folder, bag::mcap_of};
use mean_information_files::bags::{
    MapSeries, MapTopic, Message, Topic, Visitor, bag_files, octree_of, read_bag, read_stream, scans_of,
};
use mean_information_files::octree::{Leaf, Octant, OctreeVisitor};
use mean_information_files::scans::{ScanLog, ScanOptions, Selection};
use mean_information_files::{Error, Options, pbstream as states};
use std::fs;

/// Small, so that a claim is soon above it.
const MAX_CELLS: u64 = 1 << 16;

/// The most bytes of a message beside its cells, and of a row of SQLite beside its message.
const MOST_BESIDE: u64 = (1 << 20) + (1 << 10);

/// A message: its topic, its number, its time, its bytes.
type Taken = (String, u64, u64, Vec<u8>);

/// Takes the messages of all topics.
#[derive(Default)]
struct All(Vec<Taken>);

impl Visitor for All {
    fn wants(&mut self, _: &Topic) -> bool {
        true
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        let Message { topic, number, time_ns, bytes } = *message;
        self.0.push((topic.name.clone(), number, time_ns, bytes.to_vec()));
        Ok(())
    }
}

fn options() -> Options {
    Options { max_cells: Some(MAX_CELLS), ..Options::default() }
}

/// Returns the messages of a bag.
fn messages(bytes: &[u8]) -> Vec<Taken> {
    let mut all = All::default();
    match read_stream(bytes, bytes.len() as u64, &options(), &mut all) {
        Ok(warnings) => assert!(warnings.len() <= 1),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    all.0
}

/// Reads a bag, whole and cut in the middle: all messages before the cut are the same. Then the maps of a topic, its scans
/// with their trajectories, and its octree.
pub fn bag(bytes: &[u8]) {
    let whole = messages(bytes);
    let cut = messages(&bytes[..bytes.len() - bytes.len() / 3]);
    assert!(cut.len() <= whole.len() && cut == whole[..cut.len()]);
    let mut series = MapSeries::new(&MapTopic::named("/map"), &options(), |map| {
        assert_eq!(map.cells.len(), map.width * map.height);
        assert!(map.cells.len() as u64 <= MAX_CELLS);
        assert!(map.cells.iter().all(|cell| (-1..=100).contains(cell)));
        assert!(map.geometry.resolution() > 0.0 && map.geometry.resolution().is_finite());
    });
    if let Err(error) = read_stream(bytes, bytes.len() as u64, &options(), &mut series) {
        assert!(!error.to_string().is_empty());
    }
    let read = |visitor: &mut dyn Visitor| read_stream(bytes, bytes.len() as u64, &options(), visitor);
    let topics = ["/odom", "/pose", "/amcl_pose"].map(str::to_owned).to_vec();
    for pose_topics in [Vec::new(), topics] {
        let frames = (!pose_topics.is_empty()).then(|| vec!["odom".to_owned()]);
        let selection = Selection { frames, pose_topics, ..Selection::default() };
        check_log(scans_of(read, &ScanOptions::default(), &selection));
    }
    let mut leaves = Leaves(0);
    match octree_of(read, "/octomap", &mut leaves) {
        Ok(tree) => assert!(tree.leaves == leaves.0 && tree.leaves <= tree.nodes && tree.resolution > 0.0),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Counts messages, and holds them to the limit.
struct Bounded(u64);

impl Visitor for Bounded {
    fn wants(&mut self, _: &Topic) -> bool {
        true
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        assert!(message.bytes.len() as u64 <= MAX_CELLS + MOST_BESIDE);
        self.0 += 1;
        Ok(())
    }
}

/// Reads a bag of rosbag2 in SQLite: it is read or refused, nothing in it is changed, and nothing is written beside it.
pub fn db3(bytes: &[u8]) {
    let folder = Folder::new();
    let path = folder.write("run.db3", bytes);
    let mut messages = Bounded(0);
    match read_bag(&path, &options(), &mut messages) {
        // Of a bag that was cut there is a message.
        Ok(warnings) => assert!(warnings.len() <= 1 && (warnings.is_empty() || messages.0 > 0)),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    assert_eq!(folder.names(), ["run.db3"]);
    assert_eq!(fs::read(path).unwrap(), bytes);
}

/// Reads the folder of a bag by a `metadata.yaml`: it is refused, or lists files that are there, which are read or refused.
pub fn bag_folder(bytes: &[u8]) {
    let folder = Folder::new();
    folder.write(
        "run_0.mcap",
        mcap_of("cdr", &[(1, "/map", "nav_msgs/msg/OccupancyGrid")], &[(1, vec![0; 8])]),
    );
    folder.write("metadata.yaml", bytes);
    let path = folder.path("");
    match bag_files(&path) {
        Ok(files) => assert!(!files.is_empty() && files.iter().all(|file| file.is_file())),
        Err(error) => assert!(!error.to_string().is_empty()),
    }
    if let Err(error) = read_bag(&path, &options(), &mut Bounded(0)) {
        assert!(!error.to_string().is_empty());
    }
}

/// Counts the leaves of a tree.
struct Leaves(u64);

impl OctreeVisitor for Leaves {
    fn leaf(&mut self, _: Octant, _: Leaf) {
        self.0 += 1;
    }
}

/// Checks the scans and the trajectories of a log, if there is one.
fn check_log(log: Result<ScanLog, Error>) {
    match log {
        Ok(log) => {
            assert!(!log.scans.is_empty() && log.times().is_sorted_by(|before, after| before < after));
            log.scans.iter().for_each(check_scan);
            for held in &log.trajectories {
                check_trajectory(&held.trajectory);
                assert!(!held.name.is_empty());
            }
            assert!(log.warnings.iter().all(|warning| !warning.to_string().is_empty()));
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}

/// Reads a saved state: it is refused, or every cell of its submaps is counted once and is a probability, and its scans and
/// their poses are what scans and poses are.
pub fn pbstream(bytes: &[u8]) {
    for trajectory in [None, Some(2)] {
        let selection = Selection { trajectory, ..Selection::default() };
        check_log(states::read_scans(bytes, bytes.len() as u64, &ScanOptions::default(), &selection));
    }
    match states::read(bytes, bytes.len() as u64, &options()) {
        Ok(submaps) => {
            for submap in submaps {
                let counts = submap.counts;
                let cells: u64 = counts.values.iter().map(|&(_, count)| count).sum();
                assert!(cells <= MAX_CELLS && cells == (counts.width * counts.height) as u64);
                assert!(counts.values.iter().all(|(p, _)| (0.0..=1.0).contains(p)));
                assert!(submap.resolution > 0.0 && submap.clamp[0] < submap.clamp[1]);
            }
        }
        Err(error) => assert!(!error.to_string().is_empty()),
    }
}
