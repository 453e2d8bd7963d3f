//! The mean information of grids of a circular room against the size of their cells, and the limit they tend to.

use crate::output::{Number, Record, Report, Value, short, table};
use crate::progress::Progress;
use clap::ValueEnum;
use mean_information::Error;
use mean_information::limit::{Weight, bounds, closed_form};
use mean_information::room::{CartesianRoom, PolarRoom};
use mean_information::sensor::GaussianSensor;
use mean_information_report::measures::Measures;

/// The way a room is cut into cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum GridKind {
    /// Rings of equal width about the robot.
    #[default]
    Polar,
    /// Squares, the robot at a corner of four.
    Cartesian,
}

impl GridKind {
    /// The two kinds.
    pub const ALL: [Self; 2] = [Self::Polar, Self::Cartesian];

    /// Returns its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Polar => "polar",
            Self::Cartesian => "cartesian",
        }
    }

    /// Returns its name in prose.
    pub fn adjective(self) -> &'static str {
        match self {
            Self::Polar => "polar",
            Self::Cartesian => "Cartesian",
        }
    }

    /// Returns the weight of the integral that its cells tend to.
    fn weight(self) -> Weight {
        match self {
            Self::Polar => Weight::Radial,
            Self::Cartesian => Weight::Area,
        }
    }

    /// Returns the proved bound on the distance of a grid of cells of this size from the limit.
    fn bound(self, sensor: &GaussianSensor<f64>, resolution: f64) -> Result<f64, Error> {
        match self {
            Self::Polar => bounds::polar(sensor, resolution),
            Self::Cartesian => bounds::cartesian(sensor, resolution),
        }
    }
}

/// Grids of one room.
#[derive(Debug)]
pub struct Convergence {
    /// `z`, in metres.
    pub range: f64,
    /// `σ`, in metres.
    pub sigma: f64,
    /// The first is the one that was asked for; others are drawn with it.
    pub series: Vec<Series>,
}

/// The grids of one kind, from coarse to fine.
#[derive(Debug)]
pub struct Series {
    /// The way the room is cut.
    pub kind: GridKind,
    /// The limit of the mean information, in bits per cell.
    pub limit: f64,
    /// The grids, in the order in which their cell sizes were given.
    pub rows: Vec<Row>,
    /// The proved band: the decimal logarithm of a cell size, and how far a grid of it can be from the limit; from the smallest
    /// size of the rows to the largest.
    pub band: Vec<(f64, f64)>,
}

/// The steps of a band.
const STEPS: u32 = 100;

/// A grid of one cell size.
#[derive(Debug)]
pub struct Row {
    /// The side of a cell, or the width of a ring, in metres.
    pub resolution: f64,
    /// The mean information, in bits per observed cell.
    pub mean_information: f64,
    /// Observed cells; of a polar map, rings.
    pub observed: u64,
    /// Mean information less the limit.
    pub error: f64,
    /// The proved bound on the magnitude of the error, before a cell is counted.
    pub bound: f64,
    /// The same, once the observed cells are counted.
    pub bound_of_count: f64,
}

impl Row {
    /// Returns whether the error is within both bounds.
    pub fn holds(&self) -> bool {
        self.error.abs() <= self.bound.min(self.bound_of_count)
    }
}

impl Series {
    /// Measures grids of one kind.
    ///
    /// # Errors
    /// A resolution that is not positive and finite, or so fine that the count would not end.
    pub fn of(kind: GridKind, sensor: GaussianSensor<f64>, resolutions: &[f64]) -> Result<Self, Error> {
        let limit = closed_form(&sensor, kind.weight());
        let progress = Progress::new(resolutions.len());
        let mut rows = Vec::new();
        for &resolution in resolutions {
            progress.begin(&format!("{} grid of {} m", kind.name(), short(resolution)));
            let (tally, bound_of_count) = match kind {
                GridKind::Polar => {
                    let tally = PolarRoom::new(sensor, resolution)?.tally()?;
                    let of_count = bounds::polar_with_count(&sensor, resolution, tally.observed())?;
                    (tally, of_count)
                }
                GridKind::Cartesian => {
                    let tally = CartesianRoom::new(sensor, resolution, [0.5, 0.5])?.tally()?;
                    let of_count = bounds::cartesian_with_count(&sensor, resolution, tally.observed())?;
                    (tally, of_count)
                }
            };
            let bound = kind.bound(&sensor, resolution)?;
            let mean_information = tally.mean_information();
            let (observed, error) = (tally.observed(), mean_information - limit);
            rows.push(Row { resolution, mean_information, observed, error, bound, bound_of_count });
            progress.done();
        }
        let band = Self::band(kind, &sensor, resolutions)?;
        Ok(Self { kind, limit, rows, band })
    }

    /// Returns the band from the smallest of these sizes to the largest.
    fn band(
        kind: GridKind,
        sensor: &GaussianSensor<f64>,
        resolutions: &[f64],
    ) -> Result<Vec<(f64, f64)>, Error> {
        let smallest = resolutions.iter().copied().fold(f64::INFINITY, f64::min);
        let largest = resolutions.iter().copied().fold(0.0, f64::max);
        let [first, last] = [smallest, largest].map(libm::log10);
        let step = (last - first) / f64::from(STEPS);
        (0..=STEPS)
            .map(|k| {
                let logarithm = first + f64::from(k) * step;
                // Roundings of the logarithm must not lead beyond the sizes that the bounds allow.
                let size = libm::exp10(logarithm).clamp(smallest, largest);
                Ok((logarithm, kind.bound(sensor, size)?))
            })
            .collect()
    }
}

impl Convergence {
    fn asked(&self) -> &Series {
        &self.series[0]
    }

    /// Returns whether every error is within its bound.
    pub fn holds(&self) -> bool {
        self.series.iter().flat_map(|series| &series.rows).all(Row::holds)
    }
}

impl Row {
    fn record(&self) -> Record {
        let computed = |x| Value::Computed(Some(Number::Double(x)));
        Record(vec![
            ("resolution_m", Value::Given(Some(self.resolution))),
            ("mean_information", computed(self.mean_information)),
            ("observed", Value::Count(self.observed)),
            ("error", computed(self.error)),
            ("bound", computed(self.bound)),
            ("bound_of_count", computed(self.bound_of_count)),
        ])
    }
}

impl Report for Convergence {
    fn table(&self) -> String {
        let header = [
            "cell size\n(m)",
            "observed\ncells",
            Measures::MEAN_INFORMATION_HEAD,
            "error\n(bits / cell)",
            "proved bound\n(bits / cell)",
            "bound given\nthe count",
        ];
        let rows = self.asked().rows.iter().map(|row| {
            [
                short(row.resolution),
                row.observed.to_string(),
                format!("{:?}", row.mean_information),
                format!("{:+.3e}", row.error),
                format!("{:.3e}", row.bound),
                format!("{:.3e}", row.bound_of_count),
            ]
        });
        let note =
            format!("limit of {} grids: {:?} bits / cell", self.asked().kind.adjective(), self.asked().limit);
        table(header, rows) + &note + "\n"
    }

    /// The limit stands in every row.
    fn rows(&self) -> Vec<Record> {
        let of_row = |row: &Row| {
            let mut record = row.record();
            record.0.push(("limit", Value::Computed(Some(Number::Double(self.asked().limit)))));
            record
        };
        self.asked().rows.iter().map(of_row).collect()
    }

    fn json(&self) -> Value {
        Value::Record(Record(vec![
            ("grid", Value::Text(self.asked().kind.name().to_owned())),
            ("range_m", Value::Given(Some(self.range))),
            ("sigma_m", Value::Given(Some(self.sigma))),
            ("limit", Value::Computed(Some(Number::Double(self.asked().limit)))),
            ("rows", Value::Records(self.asked().rows.iter().map(Row::record).collect())),
        ]))
    }
}
