//! Fig. 3: the inverse sensor model, Eq. 5.

use super::{Claim, Figure, Section, Theory};
use crate::failure::Failure;
use crate::output::formulas;
use crate::plots::{Chart, ChartPanel, Colour, Curve, Marks, Scale, Sheet, Svg};
use mean_information::Real;
use mean_information::sensor::{GaussianSensor, InverseSensorModel};

/// The reading, and the standard deviation of a laser range finder, in metres.
const RANGE: f64 = 0.5;
const SIGMA: f64 = 0.01;

pub(super) fn section() -> Result<Section, Failure> {
    let sensor = GaussianSensor::new(RANGE, SIGMA)?;
    // Every half millimetre up to 70 cm.
    let points = (0..=1400).map(|k| f64::from(k) / 2000.0);
    let points: Vec<_> = points.map(|rho| (rho, sensor.occupancy(rho))).collect();
    let chart = Chart {
        title: format!("Occupancy along a beam that read {RANGE} m, σ = {SIGMA} m"),
        horizontal: "distance from the sensor (m)",
        scale: Scale::Linear,
        panels: [ChartPanel {
            vertical: "occupancy",
            scale: Scale::Linear,
            curves: vec![Curve {
                name: "inverse sensor model, Eq. 5".to_owned(),
                colour: Colour::Blue,
                marks: Marks::None,
                points,
            }],
            marks: Vec::new(),
        }],
    };
    let reach = sensor.reach();
    let (m, e) = reach.parts();
    let beyond = f64::from_parts(m + 1, e);
    let figure = Figure {
        file: "figure-3.svg",
        title: "Fig. 3: the inverse sensor model",
        should: "Free before the obstacle, a narrow peak of occupancy at the range read, unknown behind it.",
        shows: format!(
            "0 in free space, 1 at the {RANGE} m read, and 1/2 from {reach:.6} m on. The peak is {:.1} cm wide at half its \
             height.",
            200.0 * (reach - RANGE)
        ),
        theory: &[Theory {
            words: "What a reading z says of a place at the distance ρ, if its noise has the standard deviation σ. The report \
                    calls it a density, which it is not: it is 1 at z whatever σ is. Nor is it the occupancy that Bayes' rule \
                    finds from such noise: it is a model, taken as the report has it",
            formula: formulas::SENSOR,
            chapter: ["sensor", "The inverse sensor model"],
        }],
        picture: Sheet::new(
            vec![vec![Svg::of_plot(&chart)?]],
            "Occupancy against the distance: 0 up to 47 cm, a peak of 1 at 50 cm, down to one half at 51.2 cm, and one half \
             beyond."
                .to_owned(),
        ),
    };
    let edge = sensor.occupancy(reach);
    let claims = vec![Claim::new(
        "Eq. 5, Fig. 3",
        "The model is 1 at the range read and 1/2 beyond z + σ √(ln 4), without a step there.",
        sensor.occupancy(RANGE) == 1.0 && (edge - 0.5).abs() < 1e-12 && sensor.occupancy(beyond) == 0.5,
        format!(
            "1 at {RANGE} m, {edge} at {reach} m, and 0.5 at the next float; asked for: 1/2 within 1e-12 at the edge"
        ),
    )];
    Ok(Section { figures: vec![figure], claims })
}
