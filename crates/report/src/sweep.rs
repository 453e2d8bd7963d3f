//! The measures of a map against the size of its cells.

use crate::measures::Measures;
use crate::octree::MeasuredDepths;
use crate::record::{Record, Value};
use crate::words::in_words;
use mean_information::map::Grid;
use mean_information::map::encoding::{LogOdds, Probability};
use mean_information::{Real, elementwise};
use mean_information_files::{Cells, Map, octree, with_grid};

/// The measures of a map at cells 1, 2, 4, ... times as wide, until one cell holds it all.
#[derive(Debug)]
pub struct Sweep {
    /// The name of the map in the result.
    pub name: String,
    /// The side of a cell of the map itself, in metres.
    pub resolution: Option<f64>,
    /// The steps, from the map itself to the coarsest.
    pub steps: Vec<Step>,
    /// True of an octree, whose cells lie in no rectangle.
    pub has_depths: bool,
    /// The signs that the map means less than it seems, in words.
    pub warnings: Vec<String>,
}

/// The measures at one cell size.
#[derive(Debug)]
pub struct Step {
    /// The number of cells of the map along the side of one cell.
    pub k: usize,
    /// The measures of the pooled map.
    pub measures: Measures,
}

impl Sweep {
    /// Measures `map`, called `name` in the result. Before it averages `k` x `k` cells it calls `begin` with the number of
    /// averages that are done, of all there will be, and `k`.
    ///
    /// # Errors
    /// A cell size that is not finite.
    pub fn of(
        name: String,
        map: &Map,
        mut begin: impl FnMut([usize; 3]),
    ) -> Result<Self, mean_information::Error> {
        let mut steps = vec![Step { k: 1, measures: Measures::of(&map.cells).noticing(&map.warnings) }];
        let (width, height) = (steps[0].measures.width, steps[0].measures.height);
        let covering = width.max(height).checked_next_power_of_two().unwrap_or(usize::MAX);
        let all = covering.ilog2() as usize;
        // The first power of two that covers both sides makes the map one cell; a map without cells stays as it is.
        let powers = std::iter::successors(Some(2_usize), |k| k.checked_mul(2));
        let occupancies = occupancies(&map.cells)?;
        let cells = occupancies.as_ref().unwrap_or(&map.cells);
        for k in powers.take_while(|k| k / 2 < width.max(height) && width.min(height) > 0) {
            begin([steps.len() - 1, all, k]);
            let measures = with_grid!(cells, grid => Measures::of_grid(&grid.pooled(k)?));
            steps.push(Step { k, measures });
        }
        let mut warnings = in_words(&map.warnings);
        warnings.extend(steps[0].measures.warning());
        Ok(Self { name, resolution: map.resolution, steps, has_depths: false, warnings })
    }

    /// Takes the measures of an octree at each depth, from that of the finest cells to the root.
    pub fn of_depths(name: String, depths: MeasuredDepths) -> Self {
        let MeasuredDepths { resolution, measures, warnings, .. } = depths;
        let steps = measures.into_iter().enumerate().map(|(up, measures)| Step { k: 1 << up, measures });
        Self { name, resolution: Some(resolution), steps: steps.collect(), has_depths: true, warnings }
    }

    /// Returns the side of a cell at a step, in metres.
    pub fn cell_size(&self, step: &Step) -> Option<f64> {
        self.resolution.map(|side| side * step.k as f64)
    }

    fn record(&self, step: &Step) -> Record {
        let m = &step.measures;
        let [width, height] = match self.depth(step) {
            Some(_) => [Value::Given(None), Value::Given(None)],
            None => [m.width, m.height].map(|side| Value::Count(side as u64)),
        };
        let depth = self.depth(step).map(|depth| ("depth", Value::Count(depth)));
        let mut entries = vec![
            ("k", Value::Count(step.k as u64)),
            ("resolution_m", Value::Given(self.cell_size(step))),
            ("width", width),
            ("height", height),
            ("observed", Value::Count(m.observed())),
            ("mean_information", Value::Computed(m.mean_information)),
            ("information_bits", Value::Computed(Some(m.information))),
            ("entropy_bits", Value::Computed(Some(m.entropy))),
        ];
        entries.extend(depth);
        Record(entries)
    }

    /// Returns the depth of a step in the octree, if it is one.
    pub fn depth(&self, step: &Step) -> Option<u64> {
        self.has_depths.then(|| u64::from(octree::DEPTH - step.k.ilog2()))
    }

    /// Returns a record for each step, with the map's name and its warnings in every one.
    pub fn rows(&self) -> Vec<Record> {
        let of_step = |step| {
            let mut record = self.record(step);
            record.0.insert(0, ("map", Value::Text(self.name.clone())));
            record.0.push(("warnings", Value::Texts(self.warnings.clone())));
            record
        };
        self.steps.iter().map(of_step).collect()
    }

    /// Returns one record, with the steps in a list.
    pub fn json(&self) -> Value {
        Value::Record(Record(vec![
            ("map", Value::Text(self.name.clone())),
            ("rows", Value::Records(self.steps.iter().map(|step| self.record(step)).collect())),
            ("warnings", Value::Texts(self.warnings.clone())),
        ]))
    }
}

/// Returns the occupancies of log-odds, so that they are computed once and not for each size of cells; `None` of other cells.
fn occupancies(cells: &Cells) -> Result<Option<Cells>, mean_information::Error> {
    Ok(match cells {
        Cells::LogOdds32(grid) => Some(Cells::Probability32(of_log_odds(grid)?)),
        Cells::LogOdds64(grid) => Some(Cells::Probability64(of_log_odds(grid)?)),
        _ => None,
    })
}

fn of_log_odds<T: Real>(grid: &Grid<LogOdds<T>>) -> Result<Grid<Probability<T>>, mean_information::Error> {
    let mut cells = vec![T::zero(); grid.cells().len()];
    elementwise::occupancy_from_log_odds(grid.cells(), &mut cells);
    Grid::new(grid.width(), grid.height(), *grid.geometry(), cells)
}
