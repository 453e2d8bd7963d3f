//! How files are read.

/// The most cells that are kept of a map unless the caller says otherwise: 16384 x 16384, which take 2 GiB at
/// 8 bytes each.
pub const MAX_CELLS: u64 = 1 << 28;

/// The most pixels of a compressed image that are counted unless the caller says otherwise: 131072 x 131072. They take
/// no memory, but time, and a small file can hold a thousand times as many pixels as bytes.
pub const MAX_COUNTED: u64 = 1 << 34;

/// The meaning of the numbers of an `.npy` array without an [`ArrayEncoding`], and what one can make of them, in words.
pub const ARRAY_NUMBERS: &str = "if absent, floats are probabilities, int8 and uint8 percentages, and bool free or occupied; \
     with it floats may be log-odds, and integers of any width percentages or MRPT's bytes";

/// The loader whose rules turn grey levels into percentages.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[non_exhaustive]
pub enum Semantics {
    /// `nav2_map_server` since pull request 5071 of April 2025: Kilted, Rolling.
    #[default]
    Nav2,
    /// `nav2_map_server` before it: Humble, Iron, Jazzy. Thresholds are compared strictly, colours and alpha averaged.
    Nav2Humble,
    /// ROS 1's `map_server`.
    Ros1,
}

/// The meaning of a ROS map's grey levels.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[non_exhaustive]
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

/// The meaning of the numbers of an `.npy` array.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[cfg_attr(feature = "clap", derive(clap::ValueEnum))]
#[non_exhaustive]
pub enum ArrayEncoding {
    /// Occupancy probabilities (floats).
    Probability,
    /// ROS percentages (integers), or free and occupied (bool).
    Percent,
    /// Log-odds in nats (floats).
    LogOdds,
    /// MRPT's log-odds of free in bytes (integers).
    Mrpt,
}

/// The options of the readers. The default is nav2's rules, and everything else as the file says. A release may add fields: what
/// begins with `..Options::default()` stays as it is.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// The loader whose rules turn the grey levels of a ROS map into percentages.
    pub semantics: Semantics,
    /// The meaning of the grey levels of a ROS map; the file's own mode if absent.
    pub mode: Option<Mode>,
    /// The value that means unknown: the grey level, of the image's own depth, in [`Mode::Probability`], or a number of an
    /// array of floats, NaN for every NaN.
    pub unknown: Option<f64>,
    /// The meaning of the numbers of an `.npy` array; [`ARRAY_NUMBERS`] says which types can mean what.
    pub encoding: Option<ArrayEncoding>,
    /// The side of a cell of an `.npy` array in metres.
    pub resolution: Option<f64>,
    /// The most cells of a map, refused before any is read; if absent, [`MAX_CELLS`] where cells are kept, and where they
    /// are only counted [`MAX_COUNTED`] for what is compressed (PNG, `.npz`) and none for PGM and `.npy`, which are at
    /// least as long. The pixels of other images, which are decoded whole, may also take 4 bytes for each of these cells.
    pub max_cells: Option<u64>,
}

impl Options {
    /// Returns the most cells of a map whose cells are kept.
    pub(crate) fn max_kept(&self) -> u64 {
        self.max_cells.unwrap_or(MAX_CELLS)
    }
}
