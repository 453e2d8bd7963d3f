//! `meaninfo map`: the measures of maps, and a picture of where the information is.

use super::Status;
use crate::failure::Failure;
use crate::measures::{Measures, NotMeaningful};
use crate::output::{Files, Number, Record, Report, Value, Writing, short, table, with_notes, wrapped};
use crate::plots::{self, HeatMap};
use crate::progress::Progress;
use crate::reading::{Reading, in_words};
use crate::submaps;
use clap::Args;
use mean_information_files::{Map, read_map, read_map_contents};
use std::path::{Path, PathBuf};

/// The arguments of `meaninfo map`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Maps: ROS .yaml (with its .pgm or .png), .npy, MRPT .gridmap or .gridmap.gz; or bags, .mcap, .db3, .bag or the
    /// folder of one, whose last map is measured; or Cartographer's saved states, .pbstream.
    #[arg(value_name = "FILE", required = true)]
    maps: Vec<PathBuf>,
    /// Draw the information of every cell of the one map given to this PNG file.
    #[arg(long, value_name = "FILE.png")]
    heat_map: Option<PathBuf>,
    /// Give each submap of a saved state a row, in place of one for all.
    #[arg(long)]
    submaps: bool,
    #[command(flatten)]
    reading: Reading,
    #[command(flatten)]
    writing: Writing,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        if let Some(path) = &self.heat_map {
            plots::require_png(path)?;
            if self.maps.len() > 1 {
                return Err(Failure::Usage(format!(
                    "--heat-map draws one map, but {} were given",
                    self.maps.len()
                )));
            }
        }
        let mut files = Files::new();
        let mut measured = Vec::with_capacity(self.maps.len());
        let options = self.reading.options();
        let progress = Progress::new(self.maps.len());
        for path in &self.maps {
            progress.begin(&path.display().to_string());
            // Only a picture needs the cells themselves.
            if self.heat_map.is_none() && submaps::is_state(path) {
                for (name, map) in submaps::read(path, self.submaps, &options)? {
                    let measures = Measures::of_counts(&map.cells);
                    let row = MeasuredMap::new(path, map, measures, &mut files);
                    measured.push(MeasuredMap { name, is_rectangle: self.submaps, ..row });
                }
                progress.done();
                continue;
            }
            let row = if let Some(picture) = &self.heat_map {
                let map = read_map(path, &options)?;
                let measures = Measures::of(&map.cells);
                files.add(picture, drawn(path, &map, &measures)?);
                MeasuredMap::new(path, map, measures, &mut files)
            } else {
                let map = read_map_contents(path, &options)?;
                let measures = Measures::of_contents(&map.cells);
                MeasuredMap::new(path, map, measures, &mut files)
            };
            measured.push(row);
            progress.done();
        }
        drop(progress);
        self.writing.write(&MeasuredMaps(measured), files)?;
        Ok(Status::Done)
    }
}

/// The heat map of a map.
fn drawn(path: &Path, map: &Map, measures: &Measures) -> Result<Vec<u8>, Failure> {
    if measures.not_meaningful == Some(NotMeaningful::NoCells) {
        return Err(Failure::file(path, "the map has no cells to draw; leave out --heat-map"));
    }
    HeatMap::new(map).to_png(&[plots::title(path), measures.summary()])
}

/// One row of the result.
struct MeasuredMap {
    name: String,
    resolution: Option<f64>,
    measures: Measures,
    /// Whether its cells lie in one rectangle: submaps together do not.
    is_rectangle: bool,
    warnings: Vec<String>,
}

impl MeasuredMap {
    fn new<C>(path: &Path, map: Map<C>, measures: Measures, files: &mut Files) -> Self {
        files.read(map.files);
        let mut warnings = in_words(&map.warnings);
        warnings.extend(measures.not_meaningful.map(|why| why.warning().to_owned()));
        let (name, resolution) = (path.display().to_string(), map.resolution);
        Self { name, resolution, measures, is_rectangle: true, warnings }
    }

    fn record(&self) -> Record {
        let mut entries = vec![("map", Value::Text(self.name.clone()))];
        entries.extend(self.measures.entries(self.resolution));
        if !self.is_rectangle {
            for (_, size) in entries.iter_mut().filter(|(key, _)| matches!(*key, "width" | "height")) {
                *size = Value::Given(None);
            }
        }
        entries.push(("meaningful", Value::Flag(self.measures.not_meaningful.is_none())));
        entries.push(("warnings", Value::Texts(self.warnings.clone())));
        Record(entries)
    }

    fn cells(&self) -> [String; 8] {
        let m = &self.measures;
        let number = m.mean_information.map_or("none".to_owned(), |x| x.to_string());
        let area = m.observed_area(self.resolution).map(|area| format!("\n{} m²", short(area)));
        let side = self.resolution.map(|side| format!("\nof {} m", Number::given(side)));
        [
            wrapped(&self.name),
            if self.is_rectangle { format!("{} × {}", m.width, m.height) } else { "submaps".to_owned() }
                + &side.unwrap_or_default(),
            number
                + &m.not_meaningful
                    .map(|why| format!("\nnot meaningful:\n{}", why.reason()))
                    .unwrap_or_default(),
            format!("{:.3}", m.information.widen()),
            format!("{:.3}", m.entropy.widen()),
            format!("{}{}", m.observed(), area.unwrap_or_default()),
            format!("{} / {}", m.free, m.occupied),
            m.unknown.to_string(),
        ]
    }
}

struct MeasuredMaps(Vec<MeasuredMap>);

impl Report for MeasuredMaps {
    fn table(&self) -> String {
        let header = [
            "map",
            "cells",
            "mean information\n(bits / cell)",
            "information\n(bits)",
            "entropy\n(bits)",
            "observed",
            "free / occupied",
            "unknown",
        ];
        let notes = self.0.iter().flat_map(|map| map.warnings.iter().map(|note| (&*map.name, &**note)));
        with_notes(table(header, self.0.iter().map(MeasuredMap::cells)), notes)
    }

    fn rows(&self) -> Vec<Record> {
        self.0.iter().map(MeasuredMap::record).collect()
    }
}
