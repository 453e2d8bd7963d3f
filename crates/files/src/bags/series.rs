//! The maps of a bag, one after the other: messages with whole maps, and updates of rectangles of them.

use super::delivery::{Message, Topic, Visitor};
use super::grid::{GridMessage, GridUpdate};
use super::read::read_bag;
use crate::cells::Cells;
use crate::error::{Error, ErrorKind};
use crate::map::Map;
use crate::options::Options;
use crate::size::reserve;
use crate::warning::Warning;
use mean_information::map::encoding::Percent;
use mean_information::map::{Geometry, Grid};
use std::path::Path;

/// A map of a bag, as it stands after a message.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    /// The time at which the message was recorded, in nanoseconds.
    pub time_ns: u64,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The place of the map, and the side of its cells.
    pub geometry: Geometry,
    /// The percentages, row by row from the lowest.
    pub cells: &'a [i8],
    /// The difference to the map before.
    pub change: Change,
}

/// The difference of a map to the one before it on its topic.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Change {
    /// There is none before it.
    First,
    /// Another size, resolution or place.
    Frame,
    /// The number of cells that have another value; 0 for a message that was sent again.
    Cells(u64),
}

/// A [`Visitor`] that makes maps of the messages of a topic and of its updates, whose topic has the same name with
/// `_updates` behind it.
pub struct MapSeries<F> {
    topic: String,
    max_cells: u64,
    each: F,
    now: Option<(usize, usize, Geometry)>,
    cells: Vec<i8>,
    early_updates: u64,
}

impl<F: FnMut(Snapshot<'_>)> MapSeries<F> {
    /// Creates a series of the maps of `topic`, of at most as many cells as `options` allow, each of which `each` takes.
    pub fn new(topic: &str, options: &Options, each: F) -> Self {
        let topic = topic.to_owned();
        Self { topic, max_cells: options.max_kept(), each, now: None, cells: Vec::new(), early_updates: 0 }
    }

    /// Returns what was noticed.
    pub fn warnings(&self) -> Vec<Warning> {
        let early = Warning::UpdatesBeforeMap { count: self.early_updates };
        if self.early_updates > 0 { vec![early] } else { Vec::new() }
    }

    /// Takes a whole map.
    fn map(&mut self, message: &Message<'_>) -> Result<(), Error> {
        let map = GridMessage::read(message, self.max_cells)?;
        let frame = (map.width, map.height, map.geometry);
        let change = match self.now {
            None => Change::First,
            Some(now) if now != frame => Change::Frame,
            Some(_) => Change::Cells(differing(&self.cells, map.cells)),
        };
        self.now = Some(frame);
        self.cells.clear();
        reserve(&mut self.cells, map.cells.len(), map.cells.len())?;
        self.cells.extend(map.cells.iter().map(|cell| cell.cast_signed()));
        self.show(message.time_ns, change);
        Ok(())
    }

    /// Takes an update.
    fn update(&mut self, message: &Message<'_>) -> Result<(), Error> {
        let Some((width, height, _)) = self.now else {
            self.early_updates += 1;
            return Ok(());
        };
        let update = GridUpdate::read(message, [width, height])?;
        let mut changed = 0;
        if update.width > 0 {
            let rows = self.cells.chunks_exact_mut(width).skip(update.row).take(update.height);
            for (row, new) in rows.zip(update.cells.chunks_exact(update.width)) {
                let old = &mut row[update.column..update.column + update.width];
                changed += differing(old, new);
                old.iter_mut().zip(new).for_each(|(old, &new)| *old = new.cast_signed());
            }
        }
        self.show(message.time_ns, Change::Cells(changed));
        Ok(())
    }

    /// Shows the map as it stands.
    fn show(&mut self, time_ns: u64, change: Change) {
        if let Some((width, height, geometry)) = self.now {
            (self.each)(Snapshot { time_ns, width, height, geometry, cells: &self.cells, change });
        }
    }
}

impl<F: FnMut(Snapshot<'_>)> Visitor for MapSeries<F> {
    fn wants(&mut self, topic: &Topic) -> bool {
        match topic.name.strip_prefix(&*self.topic) {
            Some("") => topic.kind == GridMessage::KIND,
            Some("_updates") => topic.kind == GridUpdate::KIND,
            _ => false,
        }
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        if message.topic.kind == GridUpdate::KIND { self.update(message) } else { self.map(message) }
    }
}

impl<F> std::fmt::Debug for MapSeries<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MapSeries")
            .field("topic", &self.topic)
            .field("now", &self.now)
            .finish_non_exhaustive()
    }
}

/// Counts the cells that differ.
fn differing(old: &[i8], new: &[u8]) -> u64 {
    old.iter().zip(new).filter(|&(&old, &new)| old != new.cast_signed()).count() as u64
}

/// Reads the last map of `topic` of the bag at `path`, with all its updates.
///
/// # Errors
/// An [`Error`] if the topic has no message; or as [`read_bag`] and [`GridMessage::read`].
pub fn last_map(path: &Path, topic: &str, options: &Options) -> Result<Map, Error> {
    let mut series = MapSeries::new(topic, options, |_| {});
    let mut warnings = read_bag(path, options, &mut series)?;
    warnings.extend(series.warnings());
    let MapSeries { now, cells, .. } = series;
    let Some((width, height, geometry)) = now else {
        let refused = Error::new(ErrorKind::Format, format!("has no message of topic {topic}"));
        return Err(refused.with_value(topic).in_file(path));
    };
    let grid = Grid::<Percent>::new(width, height, geometry, cells)?;
    let files = vec![path.to_owned()];
    Ok(Map { cells: Cells::Percent(grid), resolution: Some(geometry.resolution()), warnings, files })
}
