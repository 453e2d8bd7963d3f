//! The maps of a bag, measured one after the other.

use crate::errors::of_file;
use crate::long_work::watched;
use crate::pickled::{Made, made};
use crate::scans::words;
use crate::tally::PyTally;
use mean_information::Tally;
use mean_information::map::Encoding;
use mean_information::map::encoding::Percent;
use mean_information_files::Options;
use mean_information_files::bags::{Change, MapSeries, MapTopic, Snapshot, read_bag as read};
use mean_information_files::trajectory::seconds;
use pyo3::prelude::*;
use std::path::PathBuf;

/// A map of a bag as it stands after a message, measured.
///
/// Attributes
/// ----------
/// time : float
///     When the message was recorded, in seconds.
/// time_ns : int
///     The same in nanoseconds.
/// topic : str
///     The topic of the map.
/// shape : tuple of int
///     Rows and columns.
/// resolution : float
///     The side of a cell in metres.
/// origin : tuple of float
///     x and y of the lower left corner in metres.
/// tally : Tally
///     The measures of the map.
/// changed_cells : int or None
///     The cells that differ from the map before, 0 for a message that says the same again; None for the first map and after a
///     change of size, resolution or place.
/// warnings : list of str
///     On the first map: signs that the bag holds less than it seems, as one that was cut short does.
#[pyclass(frozen, get_all, name = "BagMap", module = "mean_information")]
pub(crate) struct PyBagMap {
    time_ns: u64,
    topic: String,
    shape: (usize, usize),
    resolution: f64,
    origin: (f64, f64),
    tally: Py<PyTally>,
    changed_cells: Option<u64>,
    warnings: Vec<String>,
}

/// What pickle keeps of a map of a bag.
type State = (u64, String, (usize, usize), f64, (f64, f64), Py<PyTally>, Option<u64>, Vec<String>);

#[pymethods]
impl PyBagMap {
    #[getter]
    fn time(&self) -> f64 {
        seconds(self.time_ns)
    }

    /// Mean information of the map, in bits per observed cell.
    #[getter]
    fn mean_information(&self) -> f64 {
        self.tally.get().mean_information()
    }

    fn __repr__(&self, py: Python<'_>) -> PyResult<String> {
        let Self { topic, shape: (rows, columns), .. } = self;
        let (time, tally) = (self.time(), self.tally.bind(py).repr()?);
        Ok(format!("<BagMap of {topic} at {time:?} s, shape ({rows}, {columns}): {tally}>"))
    }

    fn __reduce__<'py>(&self, py: Python<'py>) -> PyResult<Made<'py, (State,)>> {
        let Self { time_ns, topic, shape, resolution, origin, tally, changed_cells, warnings } = self;
        let (tally, warnings) = (tally.clone_ref(py), warnings.clone());
        let state = (*time_ns, topic.clone(), *shape, *resolution, *origin, tally, *changed_cells, warnings);
        made(py, "_bag_map", (state,))
    }
}

/// Makes a map of a bag of what pickle has kept.
#[pyfunction]
pub(crate) fn _bag_map(state: State) -> PyBagMap {
    let (time_ns, topic, shape, resolution, origin, tally, changed_cells, warnings) = state;
    PyBagMap { time_ns, topic, shape, resolution, origin, tally, changed_cells, warnings }
}

/// A map of a bag, before it is Python's.
type Measured = (u64, (usize, usize), f64, (f64, f64), Tally<f64>, Option<u64>);

/// Measure the maps of a bag, one for each message, as the command ``meaninfo bag`` does.
///
/// Messages are `nav_msgs/OccupancyGrid`; updates of rectangles (`map_msgs/OccupancyGridUpdate` on ``TOPIC_updates``) are
/// applied. Memory holds one map.
///
/// Parameters
/// ----------
/// path : path-like
///     `.mcap`, `.db3`, `.bag`, or the folder of a bag.
/// topic : str, optional
///     The topic of the maps; by default the only one that is no costmap.
/// costmaps : bool
///     Whether `topic` may be one of costmaps, whose cells are costs of driving, not percentages.
/// max_cells : int, optional
///     Larger maps are refused before any cell is read; 2**28 by default.
///
/// Returns
/// -------
/// list of BagMap
///     In the order of the bag.
///
/// Raises
/// ------
/// FileNotFoundError, OSError, MemoryError, ValueError
///     As `read_map`; ValueError, which lists the topics of maps, if none or several may be meant.
#[pyfunction]
#[pyo3(signature = (path, *, topic=None, costmaps=false, max_cells=None))]
pub(crate) fn read_bag(
    py: Python<'_>,
    path: PathBuf,
    topic: Option<String>,
    costmaps: bool,
    max_cells: Option<u64>,
) -> PyResult<Vec<PyBagMap>> {
    let (topic, options) = (MapTopic { name: topic, costmaps }, Options { max_cells, ..Options::default() });
    let (topic, maps, warnings) = watched(py, move || {
        let mut maps: Vec<Measured> = Vec::new();
        let mut series = MapSeries::new(&topic, &options, |map| maps.push(measured(&map)));
        let mut warnings = read(&path, &options, &mut series)?;
        warnings.extend(series.warnings());
        let topic = series.topic().map_err(|error| error.in_file(&path))?.to_owned();
        drop(series);
        Ok((topic, maps, warnings))
    })?
    .map_err(of_file)?;
    let mut warnings = words(&warnings);
    let of_python = |(time_ns, shape, resolution, origin, tally, changed_cells)| {
        let (topic, tally) = (topic.clone(), Py::new(py, PyTally::from(tally))?);
        let warnings = std::mem::take(&mut warnings);
        Ok(PyBagMap { time_ns, topic, shape, resolution, origin, tally, changed_cells, warnings })
    };
    maps.into_iter().map(of_python).collect()
}

/// Measures a map as it stands.
fn measured(map: &Snapshot<'_>) -> Measured {
    let changed_cells = match map.change {
        Change::Cells(count) => Some(count),
        Change::First | Change::Frame => None,
    };
    let (shape, geometry) = ((map.height, map.width), map.geometry);
    (
        map.time_ns,
        shape,
        geometry.resolution(),
        geometry.origin().into(),
        Percent::tally(map.cells),
        changed_cells,
    )
}
