//! `meaninfo converge`: grids of a circular room against the limit as their cells shrink.

use super::Status;
use crate::convergence::{Convergence, GridKind, Series};
use crate::failure::Failure;
use crate::metres::positive;
use crate::output::{Files, Writing};
use crate::plots::{ConvergencePlot, Drawing, Picture};
use clap::Args;
use mean_information::sensor::GaussianSensor;
use std::path::PathBuf;

/// The arguments of `meaninfo converge`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The radius of the room, which the sensor reads from its centre, in metres.
    #[arg(long, value_name = "Z", value_parser = positive::<f64>)]
    range: f64,
    /// The standard deviation of the sensor, in metres.
    #[arg(long, value_name = "S", value_parser = positive::<f64>)]
    sigma: f64,
    /// How the room is cut into cells.
    #[arg(long, value_enum, default_value_t)]
    grid: GridKind,
    /// Cell sizes in metres, separated by commas; if absent, eight from a quarter of the range down.
    #[arg(long, value_name = "A,B,..", value_delimiter = ',', value_parser = positive::<f64>)]
    resolutions: Vec<f64>,
    /// Draw both kinds of grid (so that both are counted), their limits and the proved bands to this SVG or PNG file.
    #[arg(long, value_name = "FILE.svg|png")]
    plot: Option<PathBuf>,
    #[command(flatten)]
    writing: Writing,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let picture = self.plot.as_deref().map(Picture::by_name).transpose()?;
        let mut files = Files::new();
        self.writing.check(&files, self.plot.as_deref())?;
        let refused = |error: mean_information::Error| Failure::Usage(error.to_string());
        let sensor = GaussianSensor::new(self.range, self.sigma).map_err(refused)?;
        let resolutions = if self.resolutions.is_empty() {
            usual_resolutions(self.range)
        } else {
            self.resolutions.clone()
        };
        let mut kinds = vec![self.grid];
        if picture.is_some() {
            kinds.extend(GridKind::ALL.into_iter().filter(|kind| *kind != self.grid));
        }
        let series = kinds.into_iter().map(|kind| Series::of(kind, sensor, &resolutions));
        let series = series.collect::<Result<_, _>>().map_err(refused)?;
        let convergence = Convergence { range: self.range, sigma: self.sigma, series };
        if let (Some(path), Some(picture)) = (&self.plot, picture) {
            files.add(path, ConvergencePlot::new(&convergence).draw(picture)?);
        }
        self.writing.write(&convergence, files)?;
        Ok(if convergence.holds() { Status::Done } else { Status::CheckFailed })
    }
}

/// Returns eight cell sizes of 1, 2 and 5 times powers of ten, the largest at most a quarter of the range.
fn usual_resolutions(range: f64) -> Vec<f64> {
    let top = format!("{range:e}").split_once('e').and_then(|(_, n)| n.parse().ok()).unwrap_or(0);
    let sizes = (0..12_i32)
        .flat_map(|k| [5, 2, 1].map(|digit| format!("{digit}e{}", top - k).parse().unwrap_or(range)));
    sizes.filter(|size| *size <= range / 4.0).take(8).collect()
}
