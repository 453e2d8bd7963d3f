//! How map files are read, as the command line says it.

use crate::failure::Failure;
use crate::metres::positive;
use clap::Args;
use mean_information_files::{ARRAY_NUMBERS, ArrayEncoding, Mode, Options, Semantics};
use mean_information_report::uses::no_use;
use mean_information_report::{Clamp, Reading};
use std::path::PathBuf;

/// The options for reading map files.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Reading")]
pub struct ReadingArguments {
    /// Whose rules turn the grey levels of a ROS map into percentages: nav2 of Kilted and Rolling, nav2 of Humble, Iron and
    /// Jazzy (before pull request 5071 of April 2025: thresholds compared strictly, colours and alpha averaged), or ROS 1;
    /// nav2 if absent.
    #[arg(long, value_enum)]
    semantics: Option<Semantics>,
    /// How the grey levels of a ROS map are meant; the file's own mode if absent.
    #[arg(long, value_enum)]
    mode: Option<Mode>,
    /// The value that means unknown: with --mode probability a grey level (of the image's own depth), in an array of
    /// floats any number, or nan.
    #[arg(long, value_name = "GREY|NUMBER|nan")]
    unknown: Option<f64>,
    #[arg(long, value_enum, help = format!("What the numbers of an .npy array are; {ARRAY_NUMBERS}"))]
    encoding: Option<ArrayEncoding>,
    /// The side of a cell of an .npy array in metres.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    resolution: Option<f64>,
    /// The occupancies of free and of occupied leaves of an octree that only tells them apart, in a .bt file or a bag: OctoMap's
    /// clamping limits are 0.1192,0.971. If absent, 0 and 1.
    #[arg(long, value_name = "MIN,MAX")]
    clamp: Option<Clamp>,
    /// The topic of a bag that is measured, of OccupancyGrid or of Octomap; if absent, the only one of OccupancyGrid that is
    /// no costmap, or else the only one of Octomap.
    #[arg(long)]
    topic: Option<String>,
    /// Refuse a map of more cells than this before any is read; if absent, of more than 268435456 where cells are kept:
    /// 1 byte a cell, 8 in --mode probability, and as many in .npy arrays as the file has. Where `meaninfo map` only
    /// counts cells, which takes no memory, the limit is 17179869184 for PNG and .npz, and none for PGM and .npy.
    #[arg(long, value_name = "N")]
    max_cells: Option<u64>,
}

impl ReadingArguments {
    /// Returns how maps are read and measured; each submap of a saved state for itself if `submaps`.
    ///
    /// # Errors
    /// An option that none of the `files` has a use for.
    pub fn of(&self, files: &[PathBuf], submaps: bool) -> Result<Reading, Failure> {
        let Self { semantics, mode, unknown, encoding, resolution, clamp, ref topic, max_cells } = *self;
        let given = [
            ("semantics", semantics.is_some()),
            ("mode", mode.is_some()),
            ("unknown", unknown.is_some()),
            ("encoding", encoding.is_some()),
            ("resolution", resolution.is_some()),
            ("clamp", clamp.is_some()),
            ("topic", topic.is_some()),
            ("submaps", submaps),
        ];
        for (option, _) in given.into_iter().filter(|&(_, is_given)| is_given) {
            let without_use: Option<Vec<_>> = files.iter().map(|file| no_use(option, file)).collect();
            if let ([file, ..], Some([its_files, ..])) = (files, without_use.as_deref()) {
                return Err(Failure::file(file, format!("--{option} is for {its_files}; leave it out")));
            }
        }
        let semantics = semantics.unwrap_or_default();
        let options = Options { semantics, mode, unknown, encoding, resolution, max_cells };
        Ok(Reading { options, clamp: clamp.unwrap_or_default(), submaps, topic: topic.clone() })
    }
}
