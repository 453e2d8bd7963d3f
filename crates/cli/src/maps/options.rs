//! How map files are read, as the command line says it.

use clap::{Args, ValueEnum};

/// The most cells that are kept of a map unless the caller says otherwise: 16384 x 16384, which take 2 GiB at
/// 8 bytes each.
pub const MAX_CELLS: u64 = 1 << 28;

/// The most pixels of a compressed image that are counted unless the caller says otherwise: 131072 x 131072. They take
/// no memory, but time, and a small file can hold a thousand times as many pixels as bytes.
pub const MAX_COUNTED: u64 = 1 << 34;

/// Whose rules turn grey levels into percentages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Semantics {
    /// `nav2_map_server`.
    #[default]
    Nav2,
    /// ROS 1's `map_server`.
    Ros1,
}

/// How a ROS map's grey levels are meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Mode {
    /// Free, occupied or unknown by two thresholds.
    Trinary,
    /// Percentages between the thresholds.
    Scale,
    /// The grey level is the percentage.
    Raw,
    /// The occupancy of the grey level, unquantised.
    Probability,
}

/// What the numbers of an `.npy` array are.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum ArrayEncoding {
    /// Occupancy probabilities (f32 or f64).
    Probability,
    /// ROS percentages (i8).
    Percent,
    /// Log-odds in nats (f32 or f64).
    LogOdds,
    /// MRPT's int8 log-odds of free (i8).
    Mrpt,
}

/// How to read map files.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Reading")]
pub struct Options {
    /// Whose rules turn the grey levels of a ROS map into percentages.
    #[arg(long, value_enum, default_value_t)]
    pub semantics: Semantics,
    /// How the grey levels of a ROS map are meant; the file's own mode if absent.
    #[arg(long, value_enum)]
    pub mode: Option<Mode>,
    /// With --mode probability, the grey level (of the image's own depth) that means unknown.
    #[arg(long, value_name = "GREY")]
    pub unknown: Option<u16>,
    /// What the numbers of an .npy array are; if absent, floats are probabilities and int8 are percentages.
    #[arg(long, value_enum)]
    pub encoding: Option<ArrayEncoding>,
    /// The side of a cell of an .npy array in metres.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    pub resolution: Option<f64>,
    /// Refuse a map of more cells than this before any is read; if absent, of more than 268435456 where cells are kept:
    /// 1 byte a cell, 8 in --mode probability, and as many in .npy arrays as the file has. Where `meaninfo map` only
    /// counts the pixels of an image, which takes no memory, the limit is 17179869184 for PNG, and none for PGM.
    #[arg(long, value_name = "N")]
    pub max_cells: Option<u64>,
}

impl Default for Options {
    /// nav2's rules, and everything else as the file says.
    fn default() -> Self {
        Self {
            semantics: Semantics::default(),
            mode: None,
            unknown: None,
            encoding: None,
            resolution: None,
            max_cells: None,
        }
    }
}

impl Options {
    /// The most cells of a map whose cells are kept.
    pub(crate) fn max_kept(&self) -> u64 {
        self.max_cells.unwrap_or(MAX_CELLS)
    }
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if x > 0.0 && x < f64::INFINITY => Ok(x),
        _ => Err("allowed is a positive, finite number of metres".to_owned()),
    }
}
