//! `meaninfo map`: the measures of maps, and a picture of where the information is.

use super::Status;
use crate::failure::Failure;
use crate::output::{Files, Number, Record, Report, Writing, short, table, with_notes, wrapped};
use crate::plots::{self, HeatMap};
use crate::progress::Progress;
use crate::reading::ReadingArguments;
use clap::Args;
use mean_information_files::bags::AnyMap;
use mean_information_files::{Map, file_of};
use mean_information_report::{MeasuredMap, Measures, NotMeaningful, Reading, records};
use rayon::prelude::*;
use std::path::{Path, PathBuf};

/// The arguments of `meaninfo map`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Maps: ROS .yaml (with its image), .npy, FILE.npz:KEY, MRPT .gridmap or .gridmap.gz, OctoMap .ot or .bt; or bags,
    /// .mcap, .db3, .bag or the folder of one, whose last map is measured; or Cartographer's saved states, .pbstream.
    #[arg(value_name = "FILE", required = true)]
    maps: Vec<PathBuf>,
    /// Draw the information of every cell of the one map given to this PNG file.
    #[arg(long, value_name = "FILE.png")]
    heat_map: Option<PathBuf>,
    /// Give each submap of a saved state a row, in place of one for all.
    #[arg(long)]
    submaps: bool,
    /// Measure the maps that can be read even if others cannot; the exit status is 2 still.
    #[arg(long)]
    keep_going: bool,
    #[command(flatten)]
    reading: ReadingArguments,
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
        let reading = self.reading.of(&self.maps, self.submaps)?;
        let mut files = Files::new();
        files.read(self.maps.iter().map(|map| file_of(map).to_owned()));
        self.writing.check(&files, self.heat_map.as_deref())?;
        let progress = Progress::new(self.maps.len());
        // Threads share the files; the results stay in order.
        let results: Vec<_> = self
            .maps
            .par_iter()
            .map(|path| {
                progress.begin(&path.display().to_string());
                let measured = self.measure(path, &reading);
                progress.done();
                measured
            })
            .collect();
        drop(progress);

        let (mut measured, mut failures) = (Vec::with_capacity(results.len()), Vec::new());
        for result in results {
            match result {
                Ok((rows, picture)) => {
                    files.read(rows.iter().flat_map(|map| map.files.iter().cloned()));
                    if let (Some(path), Some(picture)) = (&self.heat_map, picture) {
                        files.add(path, picture);
                    }
                    measured.extend(rows);
                }
                Err(failure) => failures.push(failure),
            }
        }
        if failures.is_empty() || (self.keep_going && !measured.is_empty()) {
            self.writing.write(&MeasuredMaps(measured), files)?;
        }
        match failures.len() {
            0 => Ok(Status::Done),
            1 => Err(failures.remove(0)),
            _ => Err(Failure::Several(failures)),
        }
    }

    /// Measures one map, or each submap of a saved state, and draws it if a picture is wanted.
    fn measure(&self, path: &Path, reading: &Reading) -> Result<Measured, Failure> {
        // Only a picture needs the cells themselves.
        if self.heat_map.is_none() {
            return Ok((MeasuredMap::read(path, reading)?, None));
        }
        let map = drawable(path, reading)?;
        let measures = Measures::of(&map.cells).noticing(&map.warnings);
        let picture = drawn(path, &map, &measures)?;
        Ok((vec![MeasuredMap::new(path, map, measures)], Some(picture)))
    }
}

/// The rows of a file, and its picture.
type Measured = (Vec<MeasuredMap>, Option<Vec<u8>>);

/// Reads a map with its cells, of a bag the last one.
fn drawable(path: &Path, reading: &Reading) -> Result<Map, Failure> {
    match reading.map(path)? {
        AnyMap::Octree(message) => Err(Failure::file(
            path,
            format!("{} is of octrees, which have no picture; leave out --heat-map", message.topic()),
        )),
        AnyMap::Grid(map) => Ok(map),
    }
}

/// The heat map of a map.
fn drawn(path: &Path, map: &Map, measures: &Measures) -> Result<Vec<u8>, Failure> {
    if measures.not_meaningful == Some(NotMeaningful::NoCells) {
        return Err(Failure::file(path, "the map has no cells to draw; leave out --heat-map"));
    }
    HeatMap::new(map).to_png(&[plots::title(path), measures.summary()])
}

/// Returns the row of the table.
fn cells(map: &MeasuredMap) -> [String; 8] {
    let m = &map.measures;
    let tree = map.tree.as_ref();
    let number = m.mean_information.map_or("none".to_owned(), |x| x.to_string());
    let extent = match tree {
        Some(tree) => tree.volume().map(|volume| format!("\n{} m³", short(volume))),
        None => m.observed_area(map.resolution).map(|area| format!("\n{} m²", short(area))),
    };
    let size = tree
        .map(|tree| format!("{} leaves", tree.leaves))
        .or_else(|| (!map.is_rectangle).then(|| "submaps".to_owned()))
        .unwrap_or_else(|| format!("{} × {}", m.width, m.height));
    let side = map.resolution.map(|side| format!("\nof {} m", Number::given(side)));
    [
        wrapped(&map.name),
        size + &side.unwrap_or_default(),
        number
            + &m.not_meaningful.map(|why| format!("\nnot meaningful:\n{}", why.reason())).unwrap_or_default(),
        format!("{:.3}", m.information.widen()),
        format!("{:.3}", m.entropy.widen()),
        format!("{}{}", m.observed(), extent.unwrap_or_default()),
        format!("{} / {}", m.free, m.occupied),
        tree.map_or_else(|| m.unknown.to_string(), |_| "–".to_owned()),
    ]
}

struct MeasuredMaps(Vec<MeasuredMap>);

impl MeasuredMaps {
    /// Says that maps of cells of several sizes are not to be compared.
    fn cell_sizes(&self) -> Option<String> {
        let mut sides: Vec<_> = self.0.iter().filter_map(|map| map.resolution).collect();
        sides.sort_by(f64::total_cmp);
        sides.dedup();
        let [least, .., most] = sides[..] else { return None };
        let [least, most] = [least, most].map(|side| Number::given(side).to_string());
        Some(format!(
            "cells of {least} to {most} m: compare maps at one resolution, which meaninfo sweep shows for each"
        ))
    }
}

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
        let sizes = self.cell_sizes();
        let notes = notes.chain(sizes.as_deref().map(|note| ("these maps", note)));
        with_notes(table(header, self.0.iter().map(cells)), notes)
    }

    fn rows(&self) -> Vec<Record> {
        records(&self.0)
    }
}
