//! The maps of a bag, one after the other: messages with whole maps, and updates of rectangles of them.

use super::delivery::{Message, Topic, Visitor};
use super::grid::{GridMessage, GridUpdate};
use super::topics::{MapTopic, MapTopics};
use crate::cells::Cells;
use crate::error::{Error, ErrorKind};
use crate::map::Map;
use crate::options::Options;
use crate::size::reserve;
use crate::warning::Warning;
use mean_information::map::encoding::Percent;
use mean_information::map::{Geometry, Grid};
use std::collections::BTreeMap;

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

/// The end of the name of the topic of a map's updates.
const UPDATES: &str = "_updates";

/// A [`Visitor`] that makes maps of the messages of a topic and of its updates, whose topic has the same name with
/// `_updates` behind it. Of a topic that is not named the first that may be meant is followed as the bag is read, and
/// [`Self::topic`] tells whether it was the only one.
pub struct MapSeries<F> {
    topics: MapTopics,
    max_cells: u64,
    each: F,
    now: Option<(usize, usize, Geometry)>,
    cells: Vec<i8>,
    /// The number of updates before the first map, by the topics that may be meant.
    early_updates: BTreeMap<String, u64>,
}

impl<F: FnMut(Snapshot<'_>)> MapSeries<F> {
    /// Creates a series of the maps of a topic, of at most as many cells as `options` allow, each of which `each` takes.
    pub fn new(topic: &MapTopic, options: &Options, each: F) -> Self {
        let (topics, early_updates) = (MapTopics::new(topic), BTreeMap::new());
        Self { topics, max_cells: options.max_kept(), each, now: None, cells: Vec::new(), early_updates }
    }

    /// Returns the topic whose maps these are, once the bag is read.
    ///
    /// # Errors
    /// An [`Error`] of kind [`ErrorKind::Choice`] that lists the topics of maps if none or several may be meant, or the one
    /// named carries costmaps and these are not allowed; or if the topic has no message.
    pub fn topic(&self) -> Result<&str, Error> {
        let topic = self.topics.chosen_grid()?;
        self.last().map(|_| topic)
    }

    /// Returns the topics of the bag.
    pub(super) fn topics(&self) -> &MapTopics {
        &self.topics
    }

    /// Returns the topics of the bag, to take in those of other kinds of maps.
    pub(super) fn topics_mut(&mut self) -> &mut MapTopics {
        &mut self.topics
    }

    /// Returns the size and the place of the last map.
    ///
    /// # Errors
    /// An [`Error`] if there is none.
    fn last(&self) -> Result<(usize, usize, Geometry), Error> {
        self.now.ok_or_else(|| {
            let topic = self.topics.grid().unwrap_or_default();
            Error::new(ErrorKind::Format, format!("has no message of topic {topic}")).with_value(topic)
        })
    }

    /// Returns what was noticed.
    pub fn warnings(&self) -> Vec<Warning> {
        let early = self.topics.grid().and_then(|topic| self.early_updates.get(topic));
        early.map(|&count| Warning::UpdatesBeforeMap { count }).into_iter().collect()
    }

    /// Returns the last map, with all its updates.
    ///
    /// # Errors
    /// An [`Error`] if there is none.
    pub(super) fn into_last(self) -> Result<Map, Error> {
        let ((width, height, geometry), warnings) = (self.last()?, self.warnings());
        let cells = Cells::Percent(Grid::<Percent>::new(width, height, geometry, self.cells)?);
        Ok(Map { cells, resolution: Some(geometry.resolution()), warnings, files: Vec::new() })
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
        let topic = message.topic.name.strip_suffix(UPDATES).unwrap_or_default();
        let (Some((width, height, _)), true) = (self.now, self.topics.grid() == Some(topic)) else {
            // Of a topic that is passed over nobody asks.
            *self.early_updates.entry(topic.to_owned()).or_default() += u64::from(self.now.is_none());
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
        if topic.kind == GridUpdate::KIND {
            return topic.name.strip_suffix(UPDATES).is_some_and(|map| self.topics.may_update(map));
        }
        topic.kind == GridMessage::KIND && self.topics.follows(topic)
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        if message.topic.kind == GridUpdate::KIND { self.update(message) } else { self.map(message) }
    }
}

impl<F> std::fmt::Debug for MapSeries<F> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("MapSeries")
            .field("topics", &self.topics)
            .field("now", &self.now)
            .finish_non_exhaustive()
    }
}

/// Counts the cells that differ.
fn differing(old: &[i8], new: &[u8]) -> u64 {
    old.iter().zip(new).filter(|&(&old, &new)| old != new.cast_signed()).count() as u64
}
