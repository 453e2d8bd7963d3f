//! `meaninfo bag`: the measures of the maps of a bag, against time.

use super::Status;
use crate::failure::Failure;
use crate::metres::positive;
use crate::output::{Files, Number, Record, Report, Value, Writing, short, table, with_notes};
use crate::plots::{self, Drawing, Picture, SeriesPlot};
use crate::series::{Row, Series};
use clap::Args;
use mean_information_files::Options;
use mean_information_files::bags::{MapTopic, bag_files};
use mean_information_files::trajectory::seconds;
use std::path::PathBuf;

/// The arguments of `meaninfo bag`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// A bag: MCAP (.mcap), rosbag2 (.db3, or its folder), ROS 1 (.bag).
    #[arg(value_name = "PATH")]
    bag: PathBuf,
    /// The topic of maps, with its updates on TOPIC_updates; if absent, the only one that is no costmap.
    #[arg(long)]
    topic: Option<String>,
    /// Take costmaps for maps of occupancies: their cells are costs of driving, not percentages.
    #[arg(long, requires = "topic")]
    costmaps: bool,
    /// Leave out maps that were recorded sooner than this after the one before in the result.
    #[arg(long, value_name = "SECONDS", value_parser = positive::<f64>)]
    every: Option<f64>,
    /// Draw mean information and observed area against time to this SVG or PNG file.
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    /// Refuse a map of more cells than this, before it is read; if absent, of more than 268435456.
    #[arg(long, value_name = "N")]
    max_cells: Option<u64>,
    #[command(flatten)]
    writing: Writing,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let picture = self.plot.as_deref().map(Picture::by_name).transpose()?;
        let wanted = MapTopic { name: self.topic.clone(), costmaps: self.costmaps };
        let options = Options { max_cells: self.max_cells, ..Options::default() };
        let mut files = Files::new();
        files.read(bag_files(&self.bag)?);
        self.writing.check(&files, self.plot.as_deref())?;
        // Rounded to the clock's ticks; what is longer than it counts is never over.
        let every = self.every.map(|every| (every * 1e9).round() as u64);
        let series = Series::read(&self.bag, &wanted, every, &options)?;
        if let (Some(path), Some(picture)) = (&self.plot, picture) {
            let title = format!("{}, {}", plots::title(&self.bag), series.topic);
            files.add(path, SeriesPlot::new(&series, title).draw(picture)?);
        }
        self.writing.write(&Measured { bag: self.bag.display().to_string(), series }, files)?;
        Ok(Status::Done)
    }
}

/// The result.
struct Measured {
    bag: String,
    series: Series,
}

impl Measured {
    /// Returns the record of a row; what was noticed of the bag stands in its first.
    fn record(&self, index: usize, row: &Row) -> Record {
        let of_bag = if index == 0 { &*self.series.warnings } else { &[] };
        let mut entries = vec![
            ("bag", Value::Text(self.bag.clone())),
            ("topic", Value::Text(self.series.topic.clone())),
            ("time_s", Value::Given(Some(seconds(row.time_ns)))),
            ("time_ns", Value::Count(row.time_ns)),
        ];
        entries.extend(row.measures.entries(Some(row.resolution)));
        entries.push(("repeats", Value::Count(row.repeats)));
        entries.push(("changed_cells", row.changed.map_or(Value::Given(None), Value::Count)));
        entries.push(("meaningful", Value::Flag(row.measures.not_meaningful.is_none())));
        entries.push(("warnings", Value::Texts([of_bag, &row.warnings].concat())));
        Record(entries)
    }
}

impl Report for Measured {
    fn table(&self) -> String {
        let Series { rows, warnings, .. } = &self.series;
        let header = [
            "after\n(s)",
            "cells",
            "mean information\n(bits / cell)",
            "information\n(bits)",
            "observed",
            "free / occupied",
            "changed",
            "repeats",
        ];
        let first = rows.first().map_or(0, |row| row.time_ns);
        let after = |row: &Row| match row.time_ns.checked_sub(first) {
            Some(passed) => short(seconds(passed)),
            None => format!("-{}", short(seconds(first - row.time_ns))),
        };
        let cells = |row: &Row| {
            let m = &row.measures;
            let area = m.observed_area(Some(row.resolution));
            [
                after(row),
                format!("{} × {}\nof {} m", m.width, m.height, Number::given(row.resolution)),
                m.mean_information.map_or("none".to_owned(), |x| x.to_string())
                    + &m.not_meaningful
                        .map(|why| format!("\nnot meaningful:\n{}", why.reason()))
                        .unwrap_or_default(),
                format!("{:.3}", m.information.widen()),
                format!(
                    "{}{}",
                    m.observed(),
                    area.map(|area| format!("\n{} m²", short(area))).unwrap_or_default()
                ),
                format!("{} / {}", m.free, m.occupied),
                row.changed.map_or(String::new(), |count| count.to_string()),
                row.repeats.to_string(),
            ]
        };
        let of_bag = warnings.iter().map(|note| (self.bag.clone(), &**note));
        let of_rows = rows.iter().flat_map(|row| {
            row.warnings.iter().map(move |note| (format!("{}, after {} s", self.bag, after(row)), &**note))
        });
        let notes: Vec<(String, &str)> = of_bag.chain(of_rows).collect();
        let notes = notes.iter().map(|(place, note)| (&**place, *note));
        with_notes(table(header, rows.iter().map(cells)), notes)
    }

    fn rows(&self) -> Vec<Record> {
        self.series.rows.iter().enumerate().map(|(index, row)| self.record(index, row)).collect()
    }
}
