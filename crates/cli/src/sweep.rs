//! The measures of a map against the size of its cells.

use crate::measures::Measures;
use crate::octree::MeasuredDepths;
use crate::output::{Number, Record, Report, Value, table, with_notes};
use crate::progress::Progress;
use crate::reading::in_words;
use mean_information_files::{Map, octree, with_grid};

/// The measures of a map at cells 1, 2, 4, ... times as wide, until one cell holds it all.
#[derive(Debug)]
pub struct Sweep {
    name: String,
    /// The side of a cell of the map itself, in metres.
    pub resolution: Option<f64>,
    /// The steps, from the map itself to the coarsest.
    pub steps: Vec<Step>,
    /// True of an octree, whose cells lie in no rectangle.
    has_depths: bool,
    warnings: Vec<String>,
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
    /// Measures `map`, called `name` in the result.
    ///
    /// # Errors
    /// A cell size that is not finite.
    pub fn of(name: String, map: &Map) -> Result<Self, mean_information::Error> {
        let mut steps = vec![Step { k: 1, measures: Measures::of(&map.cells).noticing(&map.warnings) }];
        let (width, height) = (steps[0].measures.width, steps[0].measures.height);
        let covering = width.max(height).checked_next_power_of_two().unwrap_or(usize::MAX);
        let progress = Progress::new(covering.ilog2() as usize);
        // The first power of two that covers both sides makes the map one cell; a map without cells stays as it is.
        let powers = std::iter::successors(Some(2_usize), |k| k.checked_mul(2));
        for k in powers.take_while(|k| k / 2 < width.max(height) && width.min(height) > 0) {
            progress.begin(&format!("{name} by {k} x {k} cells"));
            let measures = with_grid!(&map.cells, grid => Measures::of_grid(&grid.pooled(k)?));
            steps.push(Step { k, measures });
            progress.done();
        }
        let mut warnings = in_words(&map.warnings);
        warnings.extend(steps[0].measures.not_meaningful.map(|why| why.warning().to_owned()));
        Ok(Self { name, resolution: map.resolution, steps, has_depths: false, warnings })
    }

    /// Takes the measures of an octree at each depth, from that of the finest cells to the root.
    pub fn of_depths(name: String, depths: MeasuredDepths) -> Self {
        let MeasuredDepths { resolution, measures, warnings } = depths;
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

    /// Returns the depth in the octree.
    fn depth(&self, step: &Step) -> Option<u64> {
        self.has_depths.then(|| u64::from(octree::DEPTH - step.k.ilog2()))
    }
}

impl Report for Sweep {
    fn table(&self) -> String {
        let header = [
            "cells\naveraged",
            "cell size\n(m)",
            "cells",
            "observed",
            "mean information\n(bits / cell)",
            "information\n(bits)",
            "entropy\n(bits)",
        ];
        let rows = self.steps.iter().map(|step| {
            let m = &step.measures;
            [
                self.depth(step)
                    .map_or_else(|| format!("{0} × {0}", step.k), |depth| format!("depth {depth}")),
                self.cell_size(step).map_or("unknown".to_owned(), |side| Number::given(side).to_string()),
                if self.has_depths {
                    (m.observed() + m.unknown).to_string()
                } else {
                    format!("{} × {}", m.width, m.height)
                },
                m.observed().to_string(),
                m.mean_information.map_or("none".to_owned(), |x| x.to_string()),
                format!("{:.3}", m.information.widen()),
                format!("{:.3}", m.entropy.widen()),
            ]
        });
        let notes = self.warnings.iter().map(|note| (&*self.name, &**note));
        with_notes(table(header, rows), notes)
    }

    /// The map's name and its warnings stand in every row.
    fn rows(&self) -> Vec<Record> {
        let of_step = |step| {
            let mut record = self.record(step);
            record.0.insert(0, ("map", Value::Text(self.name.clone())));
            record.0.push(("warnings", Value::Texts(self.warnings.clone())));
            record
        };
        self.steps.iter().map(of_step).collect()
    }

    fn json(&self) -> Value {
        Value::Record(Record(vec![
            ("map", Value::Text(self.name.clone())),
            ("rows", Value::Records(self.steps.iter().map(|step| self.record(step)).collect())),
            ("warnings", Value::Texts(self.warnings.clone())),
        ]))
    }
}
