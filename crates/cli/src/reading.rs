//! How map files are read, as the command line says it.

use crate::metres::positive;
use clap::Args;
use mean_information_files::{ArrayEncoding, Mode, Options, Semantics};
use mean_information_report::Clamp;

/// The options for reading map files.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Reading")]
pub struct ReadingArguments {
    /// Whose rules turn the grey levels of a ROS map into percentages: nav2 of Kilted and Rolling, nav2 of Humble, Iron and
    /// Jazzy (before pull request 5071 of April 2025: thresholds compared strictly, colours and alpha averaged), or ROS 1.
    #[arg(long, value_enum, default_value_t)]
    semantics: Semantics,
    /// How the grey levels of a ROS map are meant; the file's own mode if absent.
    #[arg(long, value_enum)]
    mode: Option<Mode>,
    /// The value that means unknown: with --mode probability a grey level (of the image's own depth), in an array of
    /// floats any number, or nan.
    #[arg(long, value_name = "GREY|NUMBER|nan")]
    unknown: Option<f64>,
    /// What the numbers of an .npy array are; if absent, floats are probabilities, int8 and uint8 percentages, and bool
    /// free or occupied.
    #[arg(long, value_enum)]
    encoding: Option<ArrayEncoding>,
    /// The side of a cell of an .npy array in metres.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    resolution: Option<f64>,
    /// The occupancies of free and of occupied leaves of an octree in a .bt file, which only tells them apart: OctoMap's
    /// clamping limits are 0.1192,0.971. If absent, 0 and 1.
    #[arg(long, value_name = "MIN,MAX")]
    clamp: Option<Clamp>,
    /// Refuse a map of more cells than this before any is read; if absent, of more than 268435456 where cells are kept:
    /// 1 byte a cell, 8 in --mode probability, and as many in .npy arrays as the file has. Where `meaninfo map` only
    /// counts cells, which takes no memory, the limit is 17179869184 for PNG and .npz, and none for PGM and .npy.
    #[arg(long, value_name = "N")]
    max_cells: Option<u64>,
}

impl ReadingArguments {
    /// Returns the occupancies of the leaves of a `.bt` file.
    pub(crate) fn clamp(&self) -> Clamp {
        self.clamp.unwrap_or_default()
    }

    /// Returns the options of the readers.
    pub fn options(&self) -> Options {
        Options {
            semantics: self.semantics,
            mode: self.mode,
            unknown: self.unknown,
            encoding: self.encoding,
            resolution: self.resolution,
            max_cells: self.max_cells,
        }
    }
}
