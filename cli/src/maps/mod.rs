//! Map files: what they are, and reading them into grids without taking memory that their contents do not fill.

pub mod gridmap;
mod image;
pub mod npy;
mod problem;
pub mod ros;
mod size;

pub(crate) use problem::one_line;
pub use problem::{Fault, Problem};

use clap::ValueEnum;
use mean_information::map::Grid;
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

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

/// How to read a map file.
#[derive(Clone, Debug)]
pub struct Options {
    /// Whose rules for ROS maps.
    pub semantics: Semantics,
    /// The mode of ROS maps; the file's own if `None`.
    pub mode: Option<Mode>,
    /// In probability mode, the grey level (of the image's own depth) that means unknown.
    pub unknown: Option<u16>,
    /// What `.npy` numbers are; by type if `None`: floats are probabilities, int8 percentages.
    pub encoding: Option<ArrayEncoding>,
    /// The resolution of an `.npy` map in metres.
    pub resolution: Option<f64>,
    /// The most cells a map may have.
    pub max_cells: u64,
}

/// Runs the same code on a reference to the grid of `$cells`, whatever its encoding.
///
/// ```
/// # use mean_information_cli::maps::{Cells, with_grid};
/// fn width(cells: &Cells) -> usize {
///     with_grid!(cells, grid => grid.width())
/// }
/// ```
#[macro_export]
#[doc(hidden)]
macro_rules! with_grid {
    ($cells:expr, $grid:ident => $body:expr) => {
        match $cells {
            $crate::maps::Cells::Percent($grid) => $body,
            $crate::maps::Cells::Mrpt($grid) => $body,
            $crate::maps::Cells::Probability32($grid) => $body,
            $crate::maps::Cells::Probability64($grid) => $body,
            $crate::maps::Cells::LogOdds32($grid) => $body,
            $crate::maps::Cells::LogOdds64($grid) => $body,
        }
    };
}
#[doc(inline)]
pub use with_grid;
impl Default for Options {
    /// nav2's rules, everything else as the file says, and at most [`MAX_CELLS`] cells.
    fn default() -> Self {
        Self {
            semantics: Semantics::default(),
            mode: None,
            unknown: None,
            encoding: None,
            resolution: None,
            max_cells: MAX_CELLS,
        }
    }
}

/// The most cells a map may have unless the caller says otherwise: 32768 x 32768.
pub const MAX_CELLS: u64 = 1 << 30;

/// A map's cells in the encoding they were stored in.
#[derive(Clone, Debug)]
pub enum Cells {
    /// ROS percentages.
    Percent(Grid<Percent>),
    /// MRPT bytes.
    Mrpt(Grid<MrptLogOdds>),
    /// Probabilities in single precision.
    Probability32(Grid<Probability<f32>>),
    /// Probabilities in double precision.
    Probability64(Grid<Probability<f64>>),
    /// Log-odds in single precision.
    LogOdds32(Grid<LogOdds<f32>>),
    /// Log-odds in double precision.
    LogOdds64(Grid<LogOdds<f64>>),
}

/// A map read from a file.
#[derive(Clone, Debug)]
pub struct Map {
    /// Its cells.
    pub cells: Cells,
    /// The side of a cell in metres; `None` if the file does not say.
    pub resolution: Option<f64>,
    /// What the reader noticed that makes the map mean less than it seems.
    pub warnings: Vec<String>,
    /// Every file it was read from, so that no output overwrites one.
    pub files: Vec<PathBuf>,
}

/// Reads the map at `path`, by its file name ending: `.yaml`/`.yml`, `.npy`, `.gridmap`, `.gridmap.gz`.
///
/// # Errors
/// A [`Problem`] naming the file, what is wrong and what is allowed.
pub fn read(path: &Path, options: &Options) -> Result<Map, Problem> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let is = |endings: &[&str]| endings.iter().any(|&ending| name.ends_with(ending));
    let file = open(path)?;
    let mut map = if is(&[".yaml", ".yml"]) {
        ros::read(path, file, options)?
    } else if is(&[".npy"]) {
        let length = file.metadata().map_err(|error| Fault::from(error).in_file(path))?.len();
        npy::read(file, length, options).map_err(|fault| fault.in_file(path))?
    } else if is(&[".gridmap", ".gridmap.gz"]) {
        let input = BufReader::with_capacity(size::CHUNK, file);
        gridmap::read(input, options).map_err(|fault| fault.in_file(path))?
    } else if is(&[".pgm", ".png"]) {
        return Err(Problem::new(
            path,
            "is only the image of a ROS map; give the yaml file that describes it",
        ));
    } else {
        return Err(Problem::new(path, format!("is no map file by its name; allowed are {ENDINGS}")));
    };
    map.files.push(path.to_owned());
    Ok(map)
}

/// The endings of map files, for messages.
const ENDINGS: &str = ".yaml, .yml, .npy, .gridmap and .gridmap.gz";

/// Opens a regular file; a pipe could hang, a directory reads as nonsense.
fn open(path: &Path) -> Result<File, Problem> {
    let fault = |error| Fault::from(error).in_file(path);
    let kind = fs::metadata(path).map_err(fault)?;
    if kind.is_dir() {
        return Err(Problem::new(path, format!("is a directory; allowed are map files: {ENDINGS}")));
    }
    if !kind.is_file() {
        return Err(Problem::new(path, "is not a regular file; allowed are files on disk"));
    }
    File::open(path).map_err(fault)
}
