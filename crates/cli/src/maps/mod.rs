//! Map files: what they are, reading them into grids without taking memory that their contents do not fill, and writing
//! them.

mod cells;
pub mod gridmap;
mod image;
pub mod npy;
mod options;
mod problem;
pub mod ros;
mod size;

pub use cells::{Cells, Contents, Counted, Readable, with_grid};
pub use options::{ArrayEncoding, MAX_CELLS, MAX_COUNTED, Mode, Options, Semantics};
pub(crate) use problem::one_line;
pub use problem::{Fault, Problem};

use std::fs::{self, File};
use std::io::BufReader;
use std::path::{Path, PathBuf};

/// A map read from a file.
#[derive(Clone, Debug)]
pub struct Map<C = Cells> {
    /// Its cells.
    pub cells: C,
    /// The side of a cell in metres; `None` if the file does not say.
    pub resolution: Option<f64>,
    /// What the reader noticed that makes the map mean less than it seems.
    pub warnings: Vec<String>,
    /// Every file it was read from, so that no output overwrites one.
    pub files: Vec<PathBuf>,
}

impl Map {
    /// With its cells as they are asked for.
    fn with<C: From<Cells>>(self) -> Map<C> {
        let Self { cells, resolution, warnings, files } = self;
        Map { cells: cells.into(), resolution, warnings, files }
    }
}

/// Reads the map at `path`, by its file name ending: `.yaml`/`.yml`, `.npy`, `.gridmap`, `.gridmap.gz`.
///
/// # Errors
/// A [`Problem`] naming the file, what is wrong and what is allowed; also for a grey level for unknown outside
/// probability mode.
pub fn read(path: &Path, options: &Options) -> Result<Map, Problem> {
    read_as(path, options)
}

/// Reads the map at `path` to measure it: as [`read`], but the cells of images are counted and not kept.
///
/// # Errors
/// As [`read`].
pub fn read_contents(path: &Path, options: &Options) -> Result<Map<Contents>, Problem> {
    read_as(path, options)
}

fn read_as<C: From<Cells> + ros::Keep>(path: &Path, options: &Options) -> Result<Map<C>, Problem> {
    if options.unknown.is_some() && options.mode != Some(Mode::Probability) {
        return Err(Problem::new(path, "--unknown needs --mode probability; give both or neither"));
    }
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let is = |endings: &[&str]| endings.iter().any(|&ending| name.ends_with(ending));
    let (file, length) = open(path)?;
    let mut map = if is(&[".yaml", ".yml"]) {
        ros::read(path, file, options)?
    } else if is(&[".npy"]) {
        npy::read(file, length, options).map_err(|fault| fault.in_file(path))?.with()
    } else if is(&[".gridmap", ".gridmap.gz"]) {
        let input = BufReader::with_capacity(size::CHUNK, file);
        gridmap::read(input, options).map_err(|fault| fault.in_file(path))?.with()
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

/// Reads the maps of a filter's particles from the `.npy` array at `path`, and does with them what is to be done.
///
/// # Errors
/// As [`read`].
pub fn read_particles<W: npy::WithMaps>(
    path: &Path,
    options: &Options,
    what: W,
) -> Result<W::Output, Problem> {
    let (file, length) = open(path)?;
    npy::read_stack(file, length, options, what).map_err(|fault| fault.in_file(path))
}

/// Reads the weights of particles from the `.npy` array at `path`.
///
/// # Errors
/// As [`read`].
pub fn read_weights(path: &Path, options: &Options) -> Result<Vec<f64>, Problem> {
    let (file, length) = open(path)?;
    npy::read_weights(file, length, options).map_err(|fault| fault.in_file(path))
}

/// The endings of map files, for messages.
const ENDINGS: &str = ".yaml, .yml, .npy, .gridmap and .gridmap.gz";

/// Opens a regular file, of the length given; a pipe could hang, a directory reads as nonsense.
fn open(path: &Path) -> Result<(File, u64), Problem> {
    let fault = |error| Fault::from(error).in_file(path);
    let kind = fs::metadata(path).map_err(fault)?;
    if kind.is_dir() {
        return Err(Problem::new(path, format!("is a directory; allowed are map files: {ENDINGS}")));
    }
    if !kind.is_file() {
        return Err(Problem::new(path, "is not a regular file; allowed are files on disk"));
    }
    let file = File::open(path).map_err(fault)?;
    let length = file.metadata().map_err(fault)?.len();
    Ok((file, length))
}
