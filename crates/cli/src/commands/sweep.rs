//! `meaninfo sweep`: the measures of a map as its cells are averaged into larger ones.

use super::Status;
use crate::failure::Failure;
use crate::output::{Files, Writing};
use crate::plots::{self, Drawing, Picture, SweepPlot};
use crate::progress::Progress;
use crate::reading::ReadingArguments;
use clap::Args;
use mean_information_files::{Disk, octree, read_map};
use mean_information_report::octree::MeasuredDepths;
use mean_information_report::sweep::Sweep;
use std::path::PathBuf;

/// The arguments of `meaninfo sweep`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// A map, as for `meaninfo map`.
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
        let name = self.map.display().to_string();
        let mut files = Files::new();
        let sweep = if octree::has_name(&self.map) {
            files.read([self.map.clone()]);
            Sweep::of_depths(name, MeasuredDepths::read(&Disk, &self.map, self.reading.clamp())?)
        } else {
            let map = read_map(&self.map, &self.reading.options())?;
            files.read(map.files.iter().cloned());
            let mut progress = None;
            let begin = |[done, all, k]: [usize; 3]| {
                let progress = progress.get_or_insert_with(|| Progress::new(all));
                if done > 0 {
                    progress.done();
                }
                progress.begin(&format!("{} by {k} x {k} cells", self.map.display()));
            };
            Sweep::of(name, &map, begin).map_err(|error| {
                Failure::file(&self.map, format!("{error}; give the map a smaller resolution"))
            })?
        };
        if let (Some(path), Some(picture)) = (&self.plot, picture) {
            files.add(path, SweepPlot::new(&sweep, &plots::title(&self.map)).draw(picture)?);
        }
        self.writing.write(&sweep, files)?;
        Ok(Status::Done)
    }
}
