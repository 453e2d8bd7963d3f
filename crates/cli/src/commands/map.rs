//! `meaninfo map`: the measures of maps, and a picture of where the information is.

use super::Status;
use crate::failure::Failure;
use crate::measures::{Measures, NotMeaningful, Sums};
use crate::octree::MeasuredTree;
use crate::output::{Files, Number, Record, Report, Value, Writing, short, table, with_notes, wrapped};
use crate::plots::{self, HeatMap};
use crate::progress::Progress;
use crate::reading::{ReadingArguments, in_words};
use crate::submaps;
use clap::Args;
use mean_information_files::bags::{self, AnyMapTopic, MapTopic, any_map_topic, last_map};
use mean_information_files::{Map, Options, octree, read_map, read_map_contents};
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
    /// The topic of a bag that is measured, of OccupancyGrid or of Octomap; if absent, the only one of OccupancyGrid that is
    /// no costmap, or else the only one of Octomap.
    #[arg(long)]
    topic: Option<String>,
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
        if let Some(path) = self.maps.iter().find(|path| self.topic.is_some() && !bags::is_bag(path)) {
            return Err(Failure::file(path, "is no bag; --topic needs bags, leave it out"));
        }
        let progress = Progress::new(self.maps.len());
        // Threads share the files; the results stay in order.
        let results: Vec<_> = self
            .maps
            .par_iter()
            .map(|path| {
                progress.begin(&path.display().to_string());
                let measured = self.measure(path);
                progress.done();
                measured
            })
            .collect();
        drop(progress);

        let mut files = Files::new();
        let (mut measured, mut failures) = (Vec::with_capacity(results.len()), Vec::new());
        for result in results {
            match result {
                Ok(rows) => {
                    for mut map in rows {
                        files.read(std::mem::take(&mut map.files));
                        if let (Some(path), Some(picture)) = (&self.heat_map, map.picture.take()) {
                            files.add(path, picture);
                        }
                        measured.push(map);
                    }
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
    fn measure(&self, path: &Path) -> Result<Vec<MeasuredMap>, Failure> {
        let options = self.reading.options();
        if bags::is_bag(path) {
            return self.measure_bag(path, &options).map(|map| vec![map]);
        }
        // Only a picture needs the cells themselves.
        if self.heat_map.is_some() {
            let map = read_map(path, &options)?;
            let measures = Measures::of(&map.cells).noticing(&map.warnings);
            let picture = drawn(path, &map, &measures)?;
            return Ok(vec![MeasuredMap::new(path, map, measures, Some(picture))]);
        }
        if submaps::is_state(path) {
            let measured = |(name, map): (String, Map<_>)| {
                let measures = Measures::of_counts(&map.cells).noticing(&map.warnings);
                let row = MeasuredMap::new(path, map, measures, None);
                MeasuredMap { name, is_rectangle: self.submaps, ..row }
            };
            return Ok(submaps::read(path, self.submaps, &options)?.into_iter().map(measured).collect());
        }
        if octree::has_name(path) {
            return Ok(vec![MeasuredMap::of_tree(path, MeasuredTree::read(path, self.reading.clamp())?)]);
        }
        let mut sums = Sums::default();
        let map = read_map_contents(path, &options, &mut sums)?;
        let measures = Measures::of_contents(&map.cells, &sums).noticing(&map.warnings);
        Ok(vec![MeasuredMap::new(path, map, measures, None)])
    }

    /// Measures the last map of a bag, and draws it if a picture is wanted.
    fn measure_bag(&self, path: &Path, options: &Options) -> Result<MeasuredMap, Failure> {
        let wanted = MapTopic { name: self.topic.clone(), costmaps: false };
        match any_map_topic(path, &wanted)? {
            AnyMapTopic::Octrees(topic) if self.heat_map.is_some() => Err(Failure::file(
                path,
                format!("{topic} is of octrees, which have no picture; leave out --heat-map"),
            )),
            AnyMapTopic::Octrees(topic) => {
                let tree = MeasuredTree::read_last(path, &topic, options, self.reading.clamp())?;
                Ok(MeasuredMap::of_tree(path, tree))
            }
            AnyMapTopic::Grids(topic) => {
                let map = last_map(path, &topic, options)?;
                let measures = Measures::of(&map.cells).noticing(&map.warnings);
                let picture = self.heat_map.as_ref().map(|_| drawn(path, &map, &measures)).transpose()?;
                Ok(MeasuredMap::new(path, map, measures, picture))
            }
        }
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
    /// Leaves and volume, if the map is an octree.
    tree: Option<MeasuredTree>,
    warnings: Vec<String>,
    /// The files that it was read from.
    files: Vec<PathBuf>,
    picture: Option<Vec<u8>>,
}

impl MeasuredMap {
    fn new<C>(path: &Path, map: Map<C>, measures: Measures, picture: Option<Vec<u8>>) -> Self {
        let mut warnings = in_words(&map.warnings);
        warnings.extend(measures.not_meaningful.map(|why| why.warning().to_owned()));
        let Map { resolution, files, .. } = map;
        let name = path.display().to_string();
        Self { name, resolution, measures, is_rectangle: true, tree: None, warnings, files, picture }
    }

    fn of_tree(path: &Path, tree: MeasuredTree) -> Self {
        let files = vec![path.to_owned()];
        let (warnings, resolution) = (tree.warnings.clone(), Some(tree.resolution));
        let measures = tree.measures.clone();
        let name = path.display().to_string();
        Self {
            name,
            resolution,
            measures,
            is_rectangle: false,
            tree: Some(tree),
            warnings,
            files,
            picture: None,
        }
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

    fn cells(&self) -> [String; 8] {
        let m = &self.measures;
        let tree = self.tree.as_ref();
        let number = m.mean_information.map_or("none".to_owned(), |x| x.to_string());
        let extent = match tree {
            Some(tree) => tree.volume().map(|volume| format!("\n{} m³", short(volume))),
            None => m.observed_area(self.resolution).map(|area| format!("\n{} m²", short(area))),
        };
        let size = tree
            .map(|tree| format!("{} leaves", tree.leaves))
            .or_else(|| (!self.is_rectangle).then(|| "submaps".to_owned()))
            .unwrap_or_else(|| format!("{} × {}", m.width, m.height));
        let side = self.resolution.map(|side| format!("\nof {} m", Number::given(side)));
        [
            wrapped(&self.name),
            size + &side.unwrap_or_default(),
            number
                + &m.not_meaningful
                    .map(|why| format!("\nnot meaningful:\n{}", why.reason()))
                    .unwrap_or_default(),
            format!("{:.3}", m.information.widen()),
            format!("{:.3}", m.entropy.widen()),
            format!("{}{}", m.observed(), extent.unwrap_or_default()),
            format!("{} / {}", m.free, m.occupied),
            tree.map_or_else(|| m.unknown.to_string(), |_| "–".to_owned()),
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
        let with_trees = self.0.iter().any(|map| map.tree.is_some());
        self.0.iter().map(|map| map.record(with_trees)).collect()
    }
}
