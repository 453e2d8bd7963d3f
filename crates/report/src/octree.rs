//! Octrees: their finest cells measured leaf by leaf, and their cells averaged depth by depth.

use crate::clamp::Clamp;
use crate::measures::Measures;
use crate::number::Number;
use crate::record::Value;
use crate::words::{Refused, in_words};
use mean_information::cell::Cell;
use mean_information::map::Encoding;
use mean_information::map::encoding::LogOdds;
use mean_information::{ExactSum, Tally};
use mean_information_files::bags::OctreeMessage;
use mean_information_files::octree::{DEPTH, Leaf, Octant, Octree, OctreeVisitor};
use mean_information_files::{Error, Source, read_octree_from};
use std::path::{Path, PathBuf};

/// The number of depths, that of the root included.
const DEPTHS: usize = DEPTH as usize + 1;

/// The meaning of leaves, and how many different ones there are.
#[derive(Debug, Default)]
struct Values {
    clamp: Clamp,
    /// The first free leaf, the first occupied one.
    first: [Option<Leaf>; 2],
    /// True if another leaf is free or occupied by another value.
    has_more: bool,
}

impl Values {
    /// Returns a leaf as a cell, and its occupancy. Single precision is widened, which is exact.
    fn of(&mut self, leaf: Leaf) -> (Cell<f64>, f64) {
        let (cell, p) = match leaf {
            Leaf::LogOdds(l) => (LogOdds::cell(f64::from(l)), LogOdds::<f64>::occupancy(f64::from(l))),
            Leaf::Free => (Cell::from_occupancy(self.clamp.free()).ok(), Some(self.clamp.free())),
            Leaf::Occupied => (Cell::from_occupancy(self.clamp.occupied()).ok(), Some(self.clamp.occupied())),
        };
        let side = match leaf {
            Leaf::LogOdds(0.0) => None,
            Leaf::LogOdds(l) => Some(usize::from(l > 0.0)),
            Leaf::Free => Some(0),
            Leaf::Occupied => Some(1),
        };
        if let Some(side) = side {
            self.has_more |= *self.first[side].get_or_insert(leaf) != leaf;
        }
        // The reader lets no NaN pass.
        (cell.unwrap_or_else(Cell::unknown), p.unwrap_or(0.5))
    }
}

/// The measures of an octree's finest cells.
#[derive(Clone, Debug)]
pub struct MeasuredTree {
    /// The side of a finest cell, in metres.
    pub resolution: f64,
    /// The number of leaves.
    pub leaves: u64,
    /// The measures; their width and height are 0.
    pub measures: Measures,
    /// The signs that the tree means less than it seems, in words.
    pub warnings: Vec<String>,
    /// The files that it was read from.
    pub files: Vec<PathBuf>,
}

/// The finest cells measured.
struct FinestCells {
    values: Values,
    tally: Tally<f64>,
}

impl OctreeVisitor for FinestCells {
    fn leaf(&mut self, octant: Octant, leaf: Leaf) {
        self.tally.add_many(self.values.of(leaf).0, octant.finest_cells());
    }
}

impl MeasuredTree {
    /// Reads and measures the tree at `path` of `source`.
    ///
    /// # Errors
    /// A file that is no octree.
    pub fn read(source: &impl Source, path: &Path, clamp: Clamp) -> Result<Self, Refused> {
        Self::measured(clamp, |cells| read_octree_from(source, path, cells))
    }

    /// Reads and measures the tree of a message of the bag at `path`.
    ///
    /// # Errors
    /// As [`OctreeMessage::read`].
    pub fn of_message(path: &Path, message: &OctreeMessage, clamp: Clamp) -> Result<Self, Refused> {
        Self::measured(clamp, |cells| message.read(cells).map_err(|error| error.in_file(path)))
    }

    /// Measures a tree as it is read.
    fn measured(
        clamp: Clamp,
        read: impl FnOnce(&mut FinestCells) -> Result<Octree, Error>,
    ) -> Result<Self, Refused> {
        let values = Values { clamp, ..Values::default() };
        let mut cells = FinestCells { values, tally: Tally::new() };
        let tree = read(&mut cells)?;
        let measures = Measures::of_octree(&cells.tally, !cells.values.has_more);
        let mut warnings = in_words(&tree.warnings);
        warnings.extend(measures.warning());
        Ok(Self { resolution: tree.resolution, leaves: tree.leaves, measures, warnings, files: tree.files })
    }

    /// Returns the volume of the observed cells in cubic metres, within 2 ulp, if it is a number.
    pub fn volume(&self) -> Option<f64> {
        let side = self.resolution;
        Some(side * side * side * self.measures.observed() as f64).filter(|volume| volume.is_finite())
    }

    /// Returns the entries of a record: as of a map, without what a space without walls has not.
    pub fn entries(&self) -> Vec<(&'static str, Value)> {
        let entries =
            self.measures.entries(Some(self.resolution)).into_iter().map(|(key, value)| match key {
                "width" | "height" | "unknown" => (key, Value::Given(None)),
                "observed_area_m2" => (key, Value::Computed(None)),
                _ => (key, value),
            });
        let volume = Value::Computed(self.volume().map(Number::Double));
        entries.chain([("leaves", Value::Count(self.leaves)), ("observed_volume_m3", volume)]).collect()
    }

    /// Returns the entries that only octrees have, of a map that is none.
    pub fn no_entries() -> [(&'static str, Value); 2] {
        [("leaves", Value::Given(None)), ("observed_volume_m3", Value::Computed(None))]
    }
}

/// The measures of an octree's cells at each depth.
#[derive(Clone, Debug)]
pub struct MeasuredDepths {
    /// The side of a finest cell, in metres.
    pub resolution: f64,
    /// The measures from depth 16 to 0, the root.
    pub measures: Vec<Measures>,
    /// The signs that the tree means less than it seems, in words.
    pub warnings: Vec<String>,
    /// The files that it was read from.
    pub files: Vec<PathBuf>,
}

impl MeasuredDepths {
    /// Reads the tree at `path` of `source` and measures it at each depth: a cell has the mean occupancy of its finest cells,
    /// of which those in no leaf are unknown.
    ///
    /// # Errors
    /// A file that is no octree.
    pub fn read(source: &impl Source, path: &Path, clamp: Clamp) -> Result<Self, Refused> {
        Self::measured(clamp, |depths| read_octree_from(source, path, depths))
    }

    /// Reads the tree of a message of the bag at `path` and measures it at each depth, as [`MeasuredDepths::read`] does.
    ///
    /// # Errors
    /// As [`OctreeMessage::read`].
    pub fn of_message(path: &Path, message: &OctreeMessage, clamp: Clamp) -> Result<Self, Refused> {
        Self::measured(clamp, |depths| message.read(depths).map_err(|error| error.in_file(path)))
    }

    /// Measures a tree as it is read.
    fn measured(
        clamp: Clamp,
        read: impl FnOnce(&mut Depths) -> Result<Octree, Error>,
    ) -> Result<Self, Refused> {
        let mut depths = Depths { values: Values { clamp, ..Values::default() }, ..Depths::default() };
        let tree = read(&mut depths)?;
        let has_two_values = !depths.values.has_more;
        let finest_first = depths.tallies.iter().rev();
        let measures: Vec<_> = finest_first.map(|tally| Measures::of_octree(tally, has_two_values)).collect();
        let mut warnings = in_words(&tree.warnings);
        warnings.extend(measures[0].warning());
        Ok(Self { resolution: tree.resolution, measures, warnings, files: tree.files })
    }
}

/// The cells of every depth: tallies of those that are done, sums of those whose children are being visited.
#[derive(Debug, Default)]
struct Depths {
    values: Values,
    tallies: [Tally<f64>; DEPTHS],
    /// The occupancies of the finest cells in leaves below the open node at each depth, and the number of these cells.
    open: [(ExactSum, u64); DEPTHS],
}

impl OctreeVisitor for Depths {
    fn leaf(&mut self, octant: Octant, leaf: Leaf) {
        let (cell, p) = self.values.of(leaf);
        let depth = octant.depth as usize;
        // Finest cells by what the leaf holds; larger ones by their occupancy, which the mean of eight equal ones is too.
        let larger = Cell::from_occupancy(p).unwrap_or_else(|_| Cell::unknown());
        let depths = self.tallies.iter_mut().zip(0..=DEPTH).skip(depth);
        for (tally, at) in depths {
            let cell = if at == DEPTH { cell } else { larger };
            tally.add_many(cell, 1 << (3 * (at - octant.depth)));
        }
        if let Some((sum, cells)) = self.open[..depth].last_mut() {
            sum.add_many(p, octant.finest_cells());
            *cells += octant.finest_cells();
        }
    }

    fn inner(&mut self, octant: Octant) {
        let depth = octant.depth as usize;
        let (mut sum, cells) = std::mem::take(&mut self.open[depth]);
        if let Some((parent, parent_cells)) = self.open[..depth].last_mut() {
            parent.merge(&sum);
            *parent_cells += cells;
        }
        let all = octant.finest_cells();
        sum.add_many(0.5, all - cells);
        // The exact mean, rounded once: a mean of occupancies is one.
        let cell = Cell::from_occupancy(sum.mean(all)).unwrap_or_else(|_| Cell::unknown());
        self.tallies[depth].add(cell);
    }
}
