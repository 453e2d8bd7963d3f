//! What is measured of the map, or of the points, that a trajectory makes of the scans of a log.

use crate::perturbed::Perturbed;
use crate::picture::Picture;
use crate::plane::Place;
use crate::points::mean_map_entropy;
use mean_information::scan::{Beam, Direction, Pose, Scan, ScanMap, TalliedMap, blocks};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Error, Tally};

/// Blocks of the jackknife.
const BLOCKS: usize = 20;
/// The greatest range, in metres; beams from there on are left out.
pub(crate) const MAXIMUM_RANGE: f64 = 50.0;

/// The sensor model that a map is made by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Model {
    /// Steps: occupancies of free space and of a wall, and the wall's thickness in cells.
    Steps { free: f64, occupied: f64, cells: f64 },
    /// Eq. 5 with its standard deviation, in metres.
    Gaussian { sigma: f64 },
}

/// The model that the others are compared with.
pub(crate) const DEFAULT: Model = Model::Steps { free: 0.4, occupied: 0.7, cells: 1.0 };
/// The resolution at which most is measured, in metres.
pub(crate) const MIDDLE: f64 = 0.1;
/// The resolutions, in metres.
const RESOLUTIONS: [f64; 3] = [0.05, MIDDLE, 0.2];
/// Other models, at the middle resolution.
const OTHERS: [Model; 5] = [
    Model::Steps { free: 0.48, occupied: 0.55, cells: 1.0 },
    Model::Steps { free: 0.3, occupied: 0.8, cells: 1.0 },
    Model::Steps { free: 0.1, occupied: 0.9, cells: 1.0 },
    Model::Steps { free: 0.4, occupied: 0.7, cells: 3.0 },
    Model::Gaussian { sigma: 0.2 },
];
/// Eq. 5 at all resolutions.
pub(crate) const GAUSSIAN: Model = Model::Gaussian { sigma: 0.05 };
/// Radii of the mean map entropy, in metres.
const RADII: [f64; 2] = [0.3, 1.0];

impl Model {
    /// Returns the parameters in words.
    pub(crate) fn name(self) -> String {
        match self {
            Self::Steps { free, occupied, cells: 1.0 } => format!("steps {free}, {occupied}"),
            Self::Steps { free, occupied, cells } => format!("steps {free}, {occupied}, {cells} cells thick"),
            Self::Gaussian { sigma } => format!("Eq. 5, {} cm", 100.0 * sigma),
        }
    }
}

/// The names of measures that others refer to.
pub(crate) const MEAN_INFORMATION: &str = "mean information";

/// A number with what it is.
#[derive(Clone, Debug)]
pub(crate) struct Measure {
    /// The name.
    pub(crate) name: &'static str,
    /// The model, or the radius.
    pub(crate) by: String,
    /// The side of a cell, in metres, where there are cells.
    pub(crate) resolution: Option<f64>,
    /// True if the greater number is to be the better.
    pub(crate) is_gain: bool,
    /// The number.
    pub(crate) value: f64,
}

/// All that is measured of a trajectory.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    /// In the same order for each trajectory.
    pub(crate) measures: Vec<Measure>,
    /// The tally by the default model at the middle resolution.
    pub(crate) tally: Tally<f64>,
    /// The tallies without one block of scans.
    pub(crate) without: Vec<Tally<f64>>,
}

/// The beams of a scan.
pub(crate) type Beams = Vec<Beam<f64>>;

/// Measures a trajectory.
pub(crate) fn measured(trajectory: &Perturbed, log: &[Beams]) -> Result<Measured, Error> {
    let scan = |(&[x, y, theta], beams): (&Place, &Beams)| {
        Scan::new(Pose::new(x, y, theta)?, MAXIMUM_RANGE, beams.clone())
    };
    let scans = trajectory.places.iter().zip(log).map(scan).collect::<Result<Vec<_>, Error>>()?;
    let mut measures = Vec::new();
    let mut middle = None;
    for resolution in RESOLUTIONS {
        let map = built(&scans, DEFAULT, resolution)?;
        by_default(&map, resolution, &mut measures)?;
        if resolution == MIDDLE {
            middle = Some(TalliedMap::new(map));
        }
    }
    let gaussian = RESOLUTIONS.map(|resolution| (GAUSSIAN, resolution));
    for (model, resolution) in gaussian.into_iter().chain(OTHERS.map(|model| (model, MIDDLE))) {
        let map = built(&scans, model, resolution)?;
        measures.extend(of_model(&map, &map.tally(), model, resolution));
    }
    let points = end_points(&scans)?;
    for radius in RADII {
        measures.push(Measure {
            name: "mean map entropy",
            by: format!("{radius} m around"),
            resolution: None,
            is_gain: false,
            value: mean_map_entropy(&points, radius),
        });
    }
    let map = middle.expect("it is one of the resolutions");
    let steps = stepped(DEFAULT, MIDDLE);
    let without = blocks(scans.len(), BLOCKS).map(|block| map.without(&scans[block], &steps));
    let without = without.collect::<Result<Vec<_>, Error>>()?;
    Ok(Measured { measures, tally: map.tally().clone(), without })
}

/// Adds all measures of the map of one resolution by the default model.
fn by_default(map: &ScanMap<f64>, resolution: f64, measures: &mut Vec<Measure>) -> Result<(), Error> {
    let tally = map.tally();
    measures.extend(of_model(map, &tally, DEFAULT, resolution));
    let picture = Picture::new(&map.log_odds()?);
    let losses = [
        ("entropy, all cells", tally.entropy()),
        // An unknown cell has one bit.
        ("entropy, observed cells", tally.entropy() - tally.unknown() as f64),
        ("observed cells", tally.observed() as f64),
        ("occupied per free", picture.occupied_share),
        ("corners", picture.corners as f64),
        ("enclosed areas", picture.enclosed_areas as f64),
    ];
    measures.extend(losses.map(|(name, value)| Measure {
        name,
        by: DEFAULT.name(),
        resolution: Some(resolution),
        is_gain: false,
        value,
    }));
    Ok(())
}

/// What is measured of the map of every model.
fn of_model(map: &ScanMap<f64>, tally: &Tally<f64>, model: Model, resolution: f64) -> [Measure; 2] {
    let agreement = map.agreement().unwrap_or(f64::NAN);
    [(MEAN_INFORMATION, tally.mean_information()), ("agreement", agreement)].map(|(name, value)| Measure {
        name,
        by: model.name(),
        resolution: Some(resolution),
        is_gain: true,
        value,
    })
}

/// Makes a map with agreement.
fn built(scans: &[Scan<f64>], model: Model, resolution: f64) -> Result<ScanMap<f64>, Error> {
    let mut map = ScanMap::new(resolution)?.with_agreement()?;
    for scan in scans {
        match model {
            Model::Steps { .. } => map.insert(scan, stepped(model, resolution))?,
            Model::Gaussian { sigma } => map.insert(scan, |range| Limited::new(range, sigma))?,
        }
    }
    Ok(map)
}

/// The stepped model of a range.
fn stepped(model: Model, resolution: f64) -> impl Fn(f64) -> Result<SteppedSensor<f64>, Error> {
    let (free, occupied, cells) = match model {
        Model::Steps { free, occupied, cells } => (free, occupied, cells),
        Model::Gaussian { .. } => (0.5, 0.5, 1.0),
    };
    move |range| SteppedSensor::new(range, cells * resolution, free, occupied)
}

/// Eq. 5, in little time: three standard deviations before the obstacle its log-odds are below the limit of a reading, and it
/// is asked no more. It goes on to 1.2 standard deviations behind it, where [`GaussianSensor`] stops at `√(ln 4)`: beams cross a
/// cell more there now and then, which moves the fourth digit of a mean information.
struct Limited {
    sensor: GaussianSensor<f64>,
}

impl Limited {
    fn new(range: f64, sigma: f64) -> Result<Self, Error> {
        Ok(Self { sensor: GaussianSensor::new(range, sigma)? })
    }
}

impl InverseSensorModel for Limited {
    type Float = f64;

    fn occupancy(&self, rho: f64) -> f64 {
        let plateau = self.plateau();
        if plateau > 0.0 && rho <= plateau { 0.0 } else { self.sensor.occupancy(rho) }
    }

    fn reach(&self) -> f64 {
        // Beyond `√(ln 4)` it is 1/2.
        self.sensor.range() + 1.2 * self.sensor.sigma()
    }

    fn plateau(&self) -> f64 {
        (self.sensor.range() - 3.0 * self.sensor.sigma()).max(0.0)
    }
}

/// The points where beams ended.
fn end_points(scans: &[Scan<f64>]) -> Result<Vec<[f64; 2]>, Error> {
    let mut points = Vec::new();
    for scan in scans {
        let [x, y] = scan.pose().position();
        for beam in scan.beams() {
            if let Some(range) = beam.range {
                let direction = Direction::new(&[scan.pose().theta(), beam.bearing])?;
                points.push([x + range * direction.cos(), y + range * direction.sin()]);
            }
        }
    }
    Ok(points)
}
