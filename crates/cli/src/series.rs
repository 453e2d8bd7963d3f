//! The maps of a bag, measured one after the other.

use crate::failure::Failure;
use mean_information::map::Histogram;
use mean_information::map::encoding::Percent;
use mean_information_files::bags::{Change, MapSeries, MapTopic, Snapshot, read_bag};
use mean_information_files::trajectory::seconds;
use mean_information_files::{Counts, Options};
use mean_information_report::measures::Measures;
use mean_information_report::words::in_words;
use std::path::Path;

/// A map of a bag, and the messages that repeat it.
#[derive(Clone, Debug)]
pub struct Row {
    /// The time at which it was recorded, in nanoseconds.
    pub time_ns: u64,
    /// The side of a cell in metres.
    pub resolution: f64,
    /// The measures.
    pub measures: Measures,
    /// The number of messages that follow and say the same.
    pub repeats: u64,
    /// The number of cells that changed since the map before in the bag; `None` if that has another frame, or is none.
    pub changed: Option<u64>,
    /// The signs that it means less than it seems.
    pub warnings: Vec<String>,
}

/// The maps of a topic of a bag.
#[derive(Clone, Debug)]
pub struct Series {
    /// The topic.
    pub topic: String,
    /// The maps, in the order in which they stand in the bag.
    pub rows: Vec<Row>,
    /// The signs that the bag holds less than it seems.
    pub warnings: Vec<String>,
}

impl Series {
    /// Measures the maps of a topic of the bag at `path`, which is read once. With `every`, in nanoseconds, a map that comes sooner after the
    /// one measured last is left out.
    ///
    /// # Errors
    /// As the bag cannot be read, does not say which topic is meant, or has no message of it.
    pub fn read(
        path: &Path,
        topic: &MapTopic,
        every: Option<u64>,
        options: &Options,
    ) -> Result<Self, Failure> {
        let mut chosen = Chosen { rows: Vec::new(), every, is_last_kept: false, last_time: None };
        let mut series = MapSeries::new(topic, options, |map| chosen.add(&map));
        let mut warnings = read_bag(path, options, &mut series)?;
        warnings.extend(series.warnings());
        let topic = series.topic().map_err(|error| error.in_file(path))?.to_owned();
        drop(series);
        Ok(Self { topic, rows: chosen.rows, warnings: in_words(&warnings) })
    }
}

/// The rows so far, of the maps that are wanted.
struct Chosen {
    rows: Vec<Row>,
    every: Option<u64>,
    /// Whether the map before is the last row, so that its repetitions are that row's.
    is_last_kept: bool,
    last_time: Option<u64>,
}

impl Chosen {
    /// Takes the next map.
    fn add(&mut self, map: &Snapshot<'_>) {
        let jump = self.last_time.filter(|&before| map.time_ns < before).map(|before| before - map.time_ns);
        self.last_time = Some(map.time_ns);
        let is_repeated = map.change == Change::Cells(0) && jump.is_none() && self.is_last_kept;
        if let Some(row) = self.rows.last_mut().filter(|_| is_repeated) {
            row.repeats += 1;
            return;
        }
        // A clock that was set back begins anew.
        let is_due = |row: &Row| {
            map.time_ns.checked_sub(row.time_ns).is_none_or(|passed| passed >= self.every.unwrap_or(0))
        };
        self.is_last_kept = self.rows.last().is_none_or(is_due);
        if self.is_last_kept {
            self.rows.push(row(map, jump));
        }
    }
}

/// Measures a map.
fn row(map: &Snapshot<'_>, jump: Option<u64>) -> Row {
    let histogram = Histogram::from_cells(map.cells);
    let values = (i8::MIN..=i8::MAX).map(|value| (value, histogram.count(value)));
    let values = values.filter(|&(_, count)| count > 0).collect();
    let measures = Measures::of_counts::<Percent>(&Counts { width: map.width, height: map.height, values });
    let mut warnings: Vec<String> = measures.warning().into_iter().collect();
    if map.change == Change::Frame {
        warnings.push("size, resolution or place differ from the map before".to_owned());
    }
    if let Some(jump) = jump {
        warnings.push(format!("the clock jumps back by {} s", seconds(jump)));
    }
    let changed = match map.change {
        Change::Cells(count) => Some(count),
        Change::First | Change::Frame => None,
    };
    Row {
        time_ns: map.time_ns,
        resolution: map.geometry.resolution(),
        measures,
        repeats: 0,
        changed,
        warnings,
    }
}
