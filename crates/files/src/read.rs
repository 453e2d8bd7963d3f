//! Files by the ending of their names.

use crate::bags::{self, MapTopic};
use crate::cells::{Cells, CellsVisitor, Contents};
use crate::error::{Error, ErrorKind, Place};
use crate::kind::FileKind;
use crate::map::Map;
use crate::names::{file_of, has_ending, is_array, is_description};
use crate::npy::{self, MapsVisitor};
use crate::octree::{self, Octree, OctreeVisitor};
use crate::options::{MAX_COUNTED, Mode, Options};
use crate::particles::FilterLog;
use crate::pbstream::{self, Submap};
use crate::ros::{self, Sink};
use crate::scans::{RangeScan, ScanLog, ScanOptions, Selection};
use crate::source::{Disk, Opened, Source, open};
use crate::trajectory::{Trajectory, tum};
use crate::warning::Warning;
use crate::{gridmap, npz};
use std::io::Read;
use std::path::Path;

/// Reads the map at `path` on the disk: as [`read_map_from`]; of a bag, [its last](bags::last_map) of the only topic of
/// maps that is no costmap.
///
/// # Errors
/// As [`read_map_from`].
pub fn read_map(path: &Path, options: &Options) -> Result<Map, Error> {
    if bags::is_bag(path) {
        return last_map(path, options);
    }
    read_map_from(&Disk, path, options)
}

/// Reads the map at `path` of `source`, by its file name ending: `.yaml`/`.yml`, `.npy`, `.gridmap`, `.gridmap.gz`; and
/// `FILE.npz:KEY`, or `FILE.npz` if it holds one array.
///
/// # Errors
/// An [`Error`] naming the file, what is wrong and what is allowed; [`ErrorKind::Options`] for a grey level for unknown
/// outside [`Mode::Probability`].
pub fn read_map_from(source: &impl Source, path: &Path, options: &Options) -> Result<Map, Error> {
    read_as(source, path, options, Keeping).map_err(|error| error.in_file(path))
}

/// Reads the map at `path` on the disk to measure it: as [`read_map_contents_from`].
///
/// # Errors
/// As [`read_map_from`].
pub fn read_map_contents(
    path: &Path,
    options: &Options,
    visitor: &mut impl CellsVisitor,
) -> Result<Map<Contents>, Error> {
    if bags::is_bag(path) {
        return last_map(path, options).map(Map::with);
    }
    read_map_contents_from(&Disk, path, options, visitor)
}

/// Reads the map at `path` of `source` to measure it: as [`read_map_from`], but the cells of images and of arrays of
/// integers are counted, those of arrays of floats given to `visitor`, and neither kept.
///
/// # Errors
/// As [`read_map_from`].
pub fn read_map_contents_from(
    source: &impl Source,
    path: &Path,
    options: &Options,
    visitor: &mut impl CellsVisitor,
) -> Result<Map<Contents>, Error> {
    read_as(source, path, options, Visiting(visitor)).map_err(|error| error.in_file(path))
}

/// Reads the last map of a bag.
fn last_map(path: &Path, options: &Options) -> Result<Map, Error> {
    bags::last_map(path, &MapTopic::default(), options)
}

/// What becomes of the cells of a map.
trait Target {
    /// The form they take.
    type Cells: Sink + From<Cells>;

    /// Reads an array, compressed or not.
    fn array(self, array: &mut Array<'_>, options: &Options) -> Result<Map<Self::Cells>, Error>;
}

/// Cells that are kept.
struct Keeping;

impl Target for Keeping {
    type Cells = Cells;

    fn array(self, array: &mut Array<'_>, options: &Options) -> Result<Map, Error> {
        npy::read(&mut array.input, array.length, options)
    }
}

/// Cells that are counted, or given to a visitor.
struct Visiting<'a, V>(&'a mut V);

impl<V: CellsVisitor> Target for Visiting<'_, V> {
    type Cells = Contents;

    fn array(self, array: &mut Array<'_>, options: &Options) -> Result<Map<Contents>, Error> {
        let most = options.max_cells.unwrap_or(if array.compressed { MAX_COUNTED } else { u64::MAX });
        npy::read_contents(&mut array.input, array.length, options, most, self.0)
    }
}

/// The bytes of an `.npy` file, on its own or in an archive.
struct Array<'a> {
    input: &'a mut dyn Read,
    length: u64,
    compressed: bool,
}

/// Opens the array at `path` of `source`, and has it read.
fn with_array<T>(
    source: &impl Source,
    path: &Path,
    read: impl FnOnce(&mut Array<'_>) -> Result<T, Error>,
) -> Result<T, Error> {
    let Opened { mut input, length } = open(source, file_of(path))?;
    let Some((_, key)) = npz::split(path) else {
        return read(&mut Array { input: &mut input, length, compressed: false });
    };
    let mut archive = npz::archive(input)?;
    let mut file = npz::open(&mut archive, key)?;
    let length = file.size();
    let result = read(&mut Array { input: &mut file, length, compressed: true })?;
    npz::check(&mut file)?;
    Ok(result)
}

/// Reads the type of the elements of the array at `path` of `source`, as NumPy names it; `None` for the name of another file.
///
/// # Errors
/// As [`npy::read_type`].
pub fn read_array_type_from(source: &impl Source, path: &Path) -> Result<Option<String>, Error> {
    let read = || with_array(source, path, |array| npy::read_type(&mut array.input));
    is_array(path).then(read).transpose().map_err(|error| error.in_file(path))
}

/// Reads a map whose cells go where `target` puts them.
fn read_as<T: Target>(
    source: &impl Source,
    path: &Path,
    options: &Options,
    target: T,
) -> Result<Map<T::Cells>, Error> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let is = |endings: &[&str]| has_ending(path, endings);
    let mut map = if is_description(path) {
        if options.unknown.is_some() && options.mode != Some(Mode::Probability) {
            let message = "a grey level for unknown needs mode probability; give both or neither";
            return Err(Error::new(ErrorKind::Options, message).at(Place::Option("unknown")));
        }
        ros::read(source, path, open(source, path)?.input, options)?
    } else if is_array(path) {
        with_array(source, path, |array| target.array(array, options))?
    } else if is(&[".gridmap", ".gridmap.gz"]) {
        if options.unknown.is_some() {
            let message = "is an MRPT map, where no value can be given for unknown";
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        gridmap::read(open(source, path)?.input, options)?.with()
    } else if octree::has_name(path) {
        source.open(path)?;
        return Err(Error::new(ErrorKind::Unsupported, "is an octree, which has no grid of cells"));
    } else {
        source.open(path)?;
        if FileKind::of(path) == Some(FileKind::Image) {
            let message = "is only the image of a ROS map; give the yaml file that describes it";
            return Err(Error::new(ErrorKind::Unsupported, message).with_value(name));
        }
        if is(&[".mcap", ".db3", ".bag"]) {
            let message = "is a bag, whose last map is read from a disk only";
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        if is(&[".pbstream"]) {
            let message = "is a saved state of Cartographer, whose submaps are several grids, not one";
            return Err(Error::new(ErrorKind::Unsupported, message));
        }
        let unknown = Error::new(ErrorKind::Unsupported, "is no map file by its name");
        let unknown = unknown.with_value(name).allowing("; allowed are ", ENDINGS);
        return Err(FileKind::refused(path, FileKind::Map).unwrap_or(unknown));
    };
    map.files.push(file_of(path).to_owned());
    Ok(map)
}

/// The endings of map files, for messages.
const ENDINGS: &str =
    ".yaml, .yml, .npy, .npz, .gridmap, .gridmap.gz, .ot, .bt, .mcap, .db3, .bag and .pbstream";

/// Reads the submaps of Cartographer's saved state at `path` on the disk: as [`read_submaps_from`].
///
/// # Errors
/// As [`read_submaps_from`].
pub fn read_submaps(path: &Path, options: &Options) -> Result<Vec<Submap>, Error> {
    read_submaps_from(&Disk, path, options)
}

/// Reads the submaps of Cartographer's saved state at `path` of `source`, whatever the file's name.
///
/// # Errors
/// An [`Error`] naming the file: as [`pbstream::read`].
pub fn read_submaps_from(source: &impl Source, path: &Path, options: &Options) -> Result<Vec<Submap>, Error> {
    let read = |file: Opened<_>| pbstream::read(file.input, file.length, options);
    source.open(path).and_then(read).map_err(|error| error.in_file(path))
}

/// Reads the octree at `path` on the disk, and has `visitor` visit its nodes: as [`read_octree_from`].
///
/// # Errors
/// As [`read_octree_from`].
pub fn read_octree(path: &Path, visitor: &mut impl OctreeVisitor) -> Result<Octree, Error> {
    read_octree_from(&Disk, path, visitor)
}

/// Reads the octree at `path` of `source`, whatever the file's name, and has `visitor` visit its nodes.
///
/// # Errors
/// An [`Error`] naming the file: as [`octree::read`].
pub fn read_octree_from(
    source: &impl Source,
    path: &Path,
    visitor: &mut impl OctreeVisitor,
) -> Result<Octree, Error> {
    let read = |file: Opened<_>| octree::read(file.input, visitor);
    let mut tree = source.open(path).and_then(read).map_err(|error| error.in_file(path))?;
    tree.files.push(path.to_owned());
    Ok(tree)
}

/// Reads the maps of a filter's particles from the `.npy` array at `path` on the disk, and has `visitor` visit them.
///
/// # Errors
/// As [`npy::read_stack`].
pub fn read_particles<V: MapsVisitor>(
    path: &Path,
    options: &Options,
    visitor: V,
) -> Result<V::Output, Error> {
    read_particles_from(&Disk, path, options, visitor)
}

/// Reads the maps of a filter's particles from the `.npy` array at `path` of `source`, and has `visitor` visit them.
///
/// # Errors
/// As [`npy::read_stack`].
pub fn read_particles_from<V: MapsVisitor>(
    source: &impl Source,
    path: &Path,
    options: &Options,
    visitor: V,
) -> Result<V::Output, Error> {
    with_array(source, path, |array| npy::read_stack(&mut array.input, array.length, options, visitor))
        .map_err(|error| error.in_file(path))
}

/// Reads the weights of particles from the `.npy` array at `path` on the disk.
///
/// # Errors
/// As [`npy::read_weights`].
pub fn read_weights(path: &Path, options: &Options) -> Result<Vec<f64>, Error> {
    read_weights_from(&Disk, path, options)
}

/// Reads the weights of particles from the `.npy` array at `path` of `source`.
///
/// # Errors
/// As [`npy::read_weights`].
pub fn read_weights_from(source: &impl Source, path: &Path, options: &Options) -> Result<Vec<f64>, Error> {
    with_array(source, path, |array| npy::read_weights(&mut array.input, array.length, options))
        .map_err(|error| error.in_file(path))
}

/// Reads the log of range scans at `path` on the disk: as [`read_selected_scans`], the only ones that it holds.
///
/// # Errors
/// As [`read_selected_scans`].
pub fn read_scans(path: &Path, options: &ScanOptions) -> Result<ScanLog, Error> {
    read_selected_scans(path, options, &Selection::default())
}

/// Reads the log of range scans at `path` of `source`, by its file name ending: a CARMEN log, `.log` or `.clf`, or the nodes
/// of Cartographer's saved state, `.pbstream`.
///
/// # Errors
/// An [`Error`] naming the file, the place, what is wrong and what is allowed: as [`ScanLog::read_carmen`] and
/// [`pbstream::read_scans`].
pub fn read_scans_from(source: &impl Source, path: &Path, options: &ScanOptions) -> Result<ScanLog, Error> {
    scans(source, path, options, &Selection::default())
}

/// Reads those scans at `path` on the disk that `selection` names: of a log or a saved state, as [`read_scans_from`], or of a
/// bag, as [`bags::read_scans`].
///
/// # Errors
/// As [`read_scans_from`] and [`bags::read_scans`].
pub fn read_selected_scans(
    path: &Path,
    options: &ScanOptions,
    selection: &Selection,
) -> Result<ScanLog, Error> {
    if bags::is_bag(path) {
        bags::read_scans(path, options, selection)
    } else {
        scans(&Disk, path, options, selection)
    }
}

/// Reads the scans of a file.
fn scans(
    source: &impl Source,
    path: &Path,
    options: &ScanOptions,
    selection: &Selection,
) -> Result<ScanLog, Error> {
    let read = || {
        let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
        let is = |endings: &[&str]| has_ending(path, endings);
        if is(&[".pbstream"]) {
            let Opened { input, length } = open(source, path)?;
            return pbstream::read_scans(input, length, options, selection);
        }
        if is(&[".mcap", ".db3", ".bag"]) {
            return Err(Error::new(ErrorKind::Unsupported, "is a bag, which is read from a disk only"));
        }
        if !is(&[".log", ".clf"]) {
            let unknown = Error::new(ErrorKind::Unsupported, "is no log of scans by its name");
            let allowed =
                "CARMEN logs, .log and .clf, bags, .mcap, .db3, .bag and their folders, and .pbstream";
            let unknown = unknown.with_value(name).allowing("; allowed are ", allowed);
            return Err(FileKind::refused(path, FileKind::Scans).unwrap_or(unknown));
        }
        ScanLog::read_carmen(source.open(path)?.input, options)
    };
    let mut log = read().map_err(|error: Error| error.in_file(path))?;
    if selection.upside_down {
        log.scans = log.scans.into_iter().map(RangeScan::upside_down).collect();
    }
    log.files.push(path.to_owned());
    Ok(log)
}

/// Reads the log of a particle filter at `path` on the disk: as [`read_filter_log_from`].
///
/// # Errors
/// As [`read_filter_log_from`].
pub fn read_filter_log(path: &Path, options: &ScanOptions) -> Result<FilterLog, Error> {
    read_filter_log_from(&Disk, path, options)
}

/// Reads the log of a particle filter at `path` of `source`: GMapping's, whatever the file's name.
///
/// # Errors
/// An [`Error`] naming the file: as [`FilterLog::read`].
pub fn read_filter_log_from(
    source: &impl Source,
    path: &Path,
    options: &ScanOptions,
) -> Result<FilterLog, Error> {
    let read = |file: Opened<_>| FilterLog::read(file.input, options);
    let mut log = source.open(path).and_then(read).map_err(|error| error.in_file(path))?;
    log.files.push(path.to_owned());
    Ok(log)
}

/// Reads the trajectory at `path` on the disk: as [`read_trajectory_from`].
///
/// # Errors
/// As [`read_trajectory_from`].
pub fn read_trajectory(path: &Path) -> Result<(Trajectory, Vec<Warning>), Error> {
    read_trajectory_from(&Disk, path)
}

/// Reads the trajectory at `path` of `source`: TUM text, whatever the file's name.
///
/// # Errors
/// An [`Error`] naming the file: as [`tum::read`].
pub fn read_trajectory_from(source: &impl Source, path: &Path) -> Result<(Trajectory, Vec<Warning>), Error> {
    let read = source.open(path).and_then(|file| tum::read(file.input));
    // Any name may be that of a trajectory: only where it holds none, its name tells what it is.
    let other = |error: Error| match error.kind() {
        ErrorKind::Format => FileKind::refused(path, FileKind::Trajectory).unwrap_or(error),
        _ => error,
    };
    read.map_err(|error| other(error).in_file(path))
}
