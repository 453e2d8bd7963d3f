//! Fig. 4: two grids of the circular room.

use super::{Claim, Figure, Section, Theory};
use crate::failure::Failure;
use crate::output::formulas;
use crate::plots::{MapPanel, Sheet, panels};
use mean_information::map::Grid;
use mean_information::room::CartesianRoom;
use mean_information::sensor::GaussianSensor;

/// `R` and `σ` of the report, in metres.
const RANGE: f64 = 2.0;
const SIGMA: f64 = 0.2;
const RESOLUTIONS: [f64; 2] = [0.16, 0.01];

pub(super) fn section() -> Result<Section, Failure> {
    let sensor = GaussianSensor::new(RANGE, SIGMA)?;
    let grid = |size: f64| CartesianRoom::new(sensor, size, [0.5, 0.5])?.map(1 << 20);
    let [coarse, fine] = RESOLUTIONS.map(grid);
    let (coarse, fine) = (coarse?, fine?);
    let [a, b] = [&coarse, &fine].map(Grid::tally);
    let rows = panels(
        &[
            MapPanel::new(&coarse, "(a) cells of 16 cm", format!("{:.6} bits/cell", a.mean_information()))?
                .with_places(vec![[0.0, 0.0]]),
            MapPanel::new(&fine, "(b) cells of 1 cm", format!("{:.6} bits/cell", b.mean_information()))?
                .with_places(vec![[0.0, 0.0]]),
        ],
        2,
    );
    let (a_mean, b_mean) = (a.mean_information(), b.mean_information());
    let figure = Figure {
        file: "figure-4.svg",
        title: "Fig. 4: grids of the circular room",
        should: "The circular room of R = 2 and σ = 0.20 in cells of 16 cm and of 1 cm.",
        shows: format!(
            "{} observed cells with {a_mean:.6} bits each, and {} with {b_mean:.6}.",
            a.observed(),
            b.observed()
        ),
        theory: &[Theory {
            words: "The occupancy of each cell is that of Eq. 5 at its centre, and the mean over the observed cells is Eq. 4",
            formula: formulas::MEAN_INFORMATION,
            chapter: ["grids", "The two grids of the circular room"],
        }],
        picture: Sheet::new(
            rows,
            format!(
                "The circular room in coarse and in fine cells: free within, a ring of occupied cells at 2 metres that fades \
             on either side, unknown outside. {a_mean:.6} and {b_mean:.6} bits per cell."
            ),
        ),
    };
    let claims = vec![Claim::new(
        "Section II, Fig. 4",
        "The mean information depends little on the size of the cells.",
        (a_mean - b_mean).abs() < 0.02 && b.observed() > 200 * a.observed(),
        format!(
            "{a_mean:.6} at 16 cm, {b_mean:.6} at 1 cm, with {:.1} times as many observed cells; asked for: within 0.02",
            b.observed() as f64 / a.observed() as f64
        ),
    )];
    Ok(Section { figures: vec![figure], claims })
}
