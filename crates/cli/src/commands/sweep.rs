//! `meaninfo sweep`: the measures of a map as its cells are averaged into larger ones.

use super::Status;
use crate::failure::Failure;
use crate::output::{Files, Writing};
use crate::plots::{self, Drawing, Picture, SweepPlot};
use crate::progress::Progress;
use crate::reading::ReadingArguments;
use clap::Args;
use mean_information_files::bags::AnyMap;
use mean_information_files::{Disk, Map, file_of, octree};
use mean_information_report::octree::MeasuredDepths;
use mean_information_report::sweep::Sweep;
use std::path::PathBuf;
use std::slice;

/// The arguments of `meaninfo sweep`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// A map, as for `meaninfo map`; but no saved state, .pbstream, whose submaps are several grids.
    #[arg(value_name = "FILE")]
    map: PathBuf,
    /// Draw mean information and total entropy against cell size to this SVG or PNG file.
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    reading: ReadingArguments,
    #[command(flatten)]
    writing: Writing,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let picture = self.plot.as_deref().map(Picture::by_name).transpose()?;
        let reading = self.reading.of(slice::from_ref(&self.map), false)?;
        let mut files = Files::new();
        files.read([file_of(&self.map).to_owned()]);
        self.writing.check(&files, self.plot.as_deref())?;
        let mut of_depths = |depths: MeasuredDepths| {
            files.read(depths.files.iter().cloned());
            Sweep::of_depths(self.map.display().to_string(), depths)
        };
        let sweep = if octree::has_name(&self.map) {
            of_depths(MeasuredDepths::read(&Disk, &self.map, reading.clamp)?)
        } else {
            match reading.map(&self.map)? {
                AnyMap::Octree(message) => {
                    of_depths(MeasuredDepths::of_message(&self.map, &message, reading.clamp)?)
                }
                AnyMap::Grid(map) => {
                    files.read(map.files.iter().cloned());
                    self.of_cells(&map)?
                }
            }
        };
        if let (Some(path), Some(picture)) = (&self.plot, picture) {
            files.add(path, SweepPlot::new(&sweep, &plots::title(&self.map)).draw(picture)?);
        }
        self.writing.write(&sweep, files)?;
        Ok(Status::Done)
    }

    /// Measures a map of cells in a plane.
    fn of_cells(&self, map: &Map) -> Result<Sweep, Failure> {
        let mut progress = None;
        let begin = |[done, all, k]: [usize; 3]| {
            let progress = progress.get_or_insert_with(|| Progress::new(all));
            if done > 0 {
                progress.done();
            }
            progress.begin(&format!("{} by {k} x {k} cells", self.map.display()));
        };
        Sweep::of(self.map.display().to_string(), map, begin)
            .map_err(|error| Failure::file(&self.map, format!("{error}; give the map a smaller resolution")))
    }
}
