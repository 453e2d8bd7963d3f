//! The last map of a bag: of a topic of grids, with its updates, or of one of octrees.

use super::delivery::{Message, Topic, Visitor};
use super::folder::bag_files;
use super::octomap::{OCTOMAP, OctreeMessage};
use super::read::read_bag;
use super::series::{MapSeries, Snapshot};
use super::topics::{AnyMapTopic, MapTopic};
use crate::error::{Error, ErrorKind};
use crate::map::Map;
use crate::octree::{Octree, OctreeVisitor};
use crate::options::Options;
use crate::warning::Warning;
use std::path::Path;

/// The last map of a bag, of either kind.
#[derive(Clone, Debug)]
pub enum AnyMap {
    /// A map of cells in a plane.
    Grid(Map),
    /// An octree.
    Octree(OctreeMessage),
}

/// Reads the last map of a topic of type `nav_msgs/OccupancyGrid` of the bag at `path` on the disk, with all its updates.
///
/// # Errors
/// An [`Error`] as [`MapSeries::topic`], [`read_bag`] and [`GridMessage::read`](super::GridMessage::read).
pub fn last_map(path: &Path, topic: &MapTopic, options: &Options) -> Result<Map, Error> {
    let mut series = MapSeries::new(topic, options, |_| {});
    let warnings = read_bag(path, options, &mut series)?;
    series.topic().map_err(|error| error.in_file(path))?;
    with(series.into_last(), path, warnings)
}

/// Reads the last map of a topic of either kind of the bag at `path` on the disk: of octrees if that is named, or the only
/// one where there is none of grids that are no costmaps; else as [`last_map`].
///
/// # Errors
/// As [`last_map`].
pub fn last_map_of_any_kind(path: &Path, topic: &MapTopic, options: &Options) -> Result<AnyMap, Error> {
    let mut last = LastMap::new(topic, options);
    let warnings = read_bag(path, options, &mut last)?;
    match last.grids.topics().chosen().map_err(|error| error.in_file(path))? {
        AnyMapTopic::Grids(_) => with(last.grids.into_last(), path, warnings).map(AnyMap::Grid),
        AnyMapTopic::Octrees(topic) => {
            let mut tree = last.into_octree(&topic).map_err(|error| error.in_file(path))?;
            (tree.warnings, tree.files) = (warnings, bag_files(path)?);
            Ok(AnyMap::Octree(tree))
        }
    }
}

/// Reads the last octree of `topic` of a bag, whose messages `read` hands to a visitor, and has `visitor` visit its nodes.
///
/// # Errors
/// An [`Error`] if the topic has no message; with the byte in the last one, which breaks the rules of [`octree::read`](crate::octree::read); or
/// as `read`.
pub fn octree_of(
    read: impl FnOnce(&mut dyn Visitor) -> Result<Vec<Warning>, Error>,
    topic: &str,
    visitor: &mut impl OctreeVisitor,
) -> Result<Octree, Error> {
    let mut last = LastMap::new(&MapTopic::named(topic), &Options::default());
    let warnings = read(&mut last)?;
    let mut tree = last.into_octree(topic)?.read(visitor)?;
    tree.warnings.extend(warnings);
    Ok(tree)
}

/// Adds to a map what was noticed of the bag at `path`.
fn with(map: Result<Map, Error>, path: &Path, noticed: Vec<Warning>) -> Result<Map, Error> {
    let Map { cells, resolution, warnings, .. } = map.map_err(|error| error.in_file(path))?;
    let warnings = noticed.into_iter().chain(warnings).collect();
    Ok(Map { cells, resolution, warnings, files: bag_files(path)? })
}

/// Keeps the last map of the topic of grids that may be meant, and the last message of that of octrees.
pub(super) struct LastMap {
    grids: MapSeries<fn(Snapshot<'_>)>,
    octree: Option<OctreeMessage>,
}

impl LastMap {
    /// Creates a visitor that keeps nothing yet.
    pub(super) fn new(topic: &MapTopic, options: &Options) -> Self {
        Self { grids: MapSeries::new(topic, options, |_| {}), octree: None }
    }

    /// Returns the last octree, of this topic.
    pub(super) fn into_octree(self, topic: &str) -> Result<OctreeMessage, Error> {
        self.octree.ok_or_else(|| {
            Error::new(ErrorKind::Format, format!("has no message of topic {topic}")).with_value(topic)
        })
    }
}

impl Visitor for LastMap {
    fn wants(&mut self, topic: &Topic) -> bool {
        if topic.kind == OCTOMAP { self.grids.topics_mut().follows(topic) } else { self.grids.wants(topic) }
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        if message.topic.kind == OCTOMAP {
            self.octree = Some(OctreeMessage::keep(message, self.octree.take()));
            return Ok(());
        }
        self.grids.take(message)
    }
}
