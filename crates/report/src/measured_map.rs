//! A map of any kind, measured: one row, or one for each submap of a saved state.

use crate::clamp::Clamp;
use crate::measures::{Measures, Sums};
use crate::octree::MeasuredTree;
use crate::record::{Record, Value};
use crate::submaps;
use crate::words::{Refused, in_words};
use mean_information_files::bags::{self, AnyMap, MapTopic, last_map_of_any_kind};
use mean_information_files::{
    Contents, Disk, Error, Map, Options, Source, octree, read_map, read_map_contents_from,
};
use std::path::{Path, PathBuf};

/// The way a map is read and measured.
#[derive(Clone, Debug, Default)]
pub struct Reading {
    /// The options of the readers.
    pub options: Options,
    /// The occupancies of the leaves of an octree that only tells free from occupied.
    pub clamp: Clamp,
    /// True if each submap of a saved state is to have a row, in place of one for all.
    pub submaps: bool,
    /// The topic of a bag; if absent, the only one of maps that is no costmap, or else the only one of octrees.
    pub topic: Option<String>,
}

impl Reading {
    /// Reads the map at `path` on the disk with its cells; of a bag, its last one, of the topic wanted. An octree that is a
    /// file has none.
    ///
    /// # Errors
    /// As [`read_map`] and [`last_map_of_any_kind`].
    pub fn map(&self, path: &Path) -> Result<AnyMap, Error> {
        if !bags::is_bag(path) {
            return read_map(path, &self.options).map(AnyMap::Grid);
        }
        let wanted = MapTopic { name: self.topic.clone(), costmaps: false };
        last_map_of_any_kind(path, &wanted, &self.options)
    }
}

/// A map measured: one row of the result.
#[derive(Clone, Debug)]
pub struct MeasuredMap {
    /// The name of the map in the result.
    pub name: String,
    /// The side of a cell in metres.
    pub resolution: Option<f64>,
    /// The measures.
    pub measures: Measures,
    /// True if its cells lie in one rectangle: submaps together do not.
    pub is_rectangle: bool,
    /// Leaves and volume, if the map is an octree.
    pub tree: Option<MeasuredTree>,
    /// The signs that the map means less than it seems, in words.
    pub warnings: Vec<String>,
    /// The files that it was read from.
    pub files: Vec<PathBuf>,
}

impl MeasuredMap {
    /// Reads and measures the map at `path` on the disk: as [`MeasuredMap::read_from`]; of a bag, its last map.
    ///
    /// # Errors
    /// A file that is no map, in one line that names it.
    pub fn read(path: &Path, reading: &Reading) -> Result<Vec<Self>, Refused> {
        if !bags::is_bag(path) {
            return Self::read_from(&Disk, path, reading);
        }
        Ok(vec![match reading.map(path)? {
            AnyMap::Octree(message) => {
                Self::of_tree(path, MeasuredTree::of_message(path, &message, reading.clamp)?)
            }
            AnyMap::Grid(map) => Self::of_map(path, map),
        }])
    }

    /// Reads and measures the map at `path` of `source`, which keeps no cells of an image or an array.
    ///
    /// # Errors
    /// A file that is no map, in one line that names it.
    pub fn read_from(source: &impl Source, path: &Path, reading: &Reading) -> Result<Vec<Self>, Refused> {
        let options = &reading.options;
        if submaps::is_state(path) {
            let measured = |(name, map): (String, Map<_>)| {
                let measures = Measures::of_counts(&map.cells).noticing(&map.warnings);
                Self { name, is_rectangle: reading.submaps, ..Self::new(path, map, measures) }
            };
            let submaps = submaps::read(source, path, reading.submaps, options)?;
            return Ok(submaps.into_iter().map(measured).collect());
        }
        if octree::has_name(path) {
            return Ok(vec![Self::of_tree(path, MeasuredTree::read(source, path, reading.clamp)?)]);
        }
        let mut sums = Sums::default();
        let map = read_map_contents_from(source, path, options, &mut sums)?;
        Ok(vec![Self::of_contents(path, map, &sums)])
    }

    fn of_map(path: &Path, map: Map) -> Self {
        let measures = Measures::of(&map.cells).noticing(&map.warnings);
        Self::new(path, map, measures)
    }

    fn of_contents(path: &Path, map: Map<Contents>, sums: &Sums) -> Self {
        let measures = Measures::of_contents(&map.cells, sums).noticing(&map.warnings);
        Self::new(path, map, measures)
    }

    /// Creates the row of a map that was measured.
    pub fn new<C>(path: &Path, map: Map<C>, measures: Measures) -> Self {
        let mut warnings = in_words(&map.warnings);
        warnings.extend(measures.warning());
        let Map { resolution, files, .. } = map;
        let name = path.display().to_string();
        Self { name, resolution, measures, is_rectangle: true, tree: None, warnings, files }
    }

    fn of_tree(path: &Path, tree: MeasuredTree) -> Self {
        let (name, files) = (path.display().to_string(), tree.files.clone());
        let (warnings, resolution) = (tree.warnings.clone(), Some(tree.resolution));
        let measures = tree.measures.clone();
        Self { name, resolution, measures, is_rectangle: false, tree: Some(tree), warnings, files }
    }

    /// Returns the record; `with_trees` if a row is an octree's, so that all have its keys.
    fn record(&self, with_trees: bool) -> Record {
        let mut entries = vec![("map", Value::Text(self.name.clone()))];
        if let Some(tree) = &self.tree {
            entries.extend(tree.entries());
        } else {
            entries.extend(self.measures.entries(self.resolution));
            entries.extend(with_trees.then(MeasuredTree::no_entries).into_iter().flatten());
            if !self.is_rectangle {
                for (_, size) in entries.iter_mut().filter(|(key, _)| matches!(*key, "width" | "height")) {
                    *size = Value::Given(None);
                }
            }
        }
        entries.push(("meaningful", Value::Flag(self.measures.not_meaningful.is_none())));
        entries.push(("warnings", Value::Texts(self.warnings.clone())));
        Record(entries)
    }
}

/// Returns the records of maps, all with the same keys.
pub fn records<'a>(maps: impl IntoIterator<Item = &'a MeasuredMap> + Clone) -> Vec<Record> {
    let with_trees = maps.clone().into_iter().any(|map| map.tree.is_some());
    maps.into_iter().map(|map| map.record(with_trees)).collect()
}
