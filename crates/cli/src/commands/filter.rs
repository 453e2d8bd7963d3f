//! `meaninfo emmi --filter`: EMMI over the steps of a particle filter's log.

use super::Status;
use super::sensor::{Sensor, mount};
use crate::failure::Failure;
use crate::filter::{FilterReport, Made, Refused, chart, measure};
use crate::output::{Files, Writing};
use crate::plots::{self, Drawing, Picture};
use crate::progress::Progress;
use crate::trajectory::{Laser, far_pose};
use clap::Args;
use mean_information::Error;
use mean_information::scan::{Pose, ScanMap};
use mean_information_files::particles::FilterLog;
use mean_information_files::read_filter_log;
use mean_information_files::scans::ScanOptions;
use mean_information_report::words::in_words;
use std::num::NonZero;
use std::path::{Path, PathBuf};

/// The side of a cell in metres, if none is given: that of GMapping.
const RESOLUTION: f64 = 0.05;

/// The arguments that go with `--filter`.
#[derive(Args, Debug)]
pub(super) struct Filter {
    /// A log that GMapping wrote of its particles, instead of maps: a row after each scan. Each particle's map is made of the
    /// scans on its way.
    #[arg(long = "filter", value_name = "LOG.gfs", conflicts_with_all = ["particles", "weights"])]
    pub(super) log: Option<PathBuf>,
    /// Measure after every N-th scan from the first on, and after the last; no number of a row changes.
    #[arg(long, value_name = "N", requires = "log", default_value = "1")]
    every: NonZero<usize>,
    /// Draw EMMI, the particles' own mean information, the entropy of the expected map and the particles that count against
    /// time to this SVG or PNG file.
    #[arg(long, value_name = "FILE.svg|png", requires = "log")]
    plot: Option<PathBuf>,
    /// The pose of the laser on the robot, in metres and radians, if the log's poses are those of a robot that has it
    /// elsewhere; 0,0,0 if absent.
    #[arg(long, value_name = "X,Y,YAW", requires = "log", value_parser = mount)]
    mount: Option<Pose>,
    #[command(flatten)]
    sensor: Sensor,
}

impl Filter {
    /// Refuses arguments that go with a log, where there is none.
    ///
    /// # Errors
    /// If one was given.
    pub(super) fn refuse(&self) -> Result<(), Failure> {
        if self.sensor.is_given() {
            let words = "the arguments of the sensor need --filter: maps of --particles are made already";
            return Err(Failure::Usage(words.to_owned()));
        }
        Ok(())
    }

    /// Measures a log.
    pub(super) fn run(
        &self,
        path: &Path,
        resolution: Option<f64>,
        max_cells: Option<u64>,
        writing: &Writing,
    ) -> Result<Status, Failure> {
        let max_cells = max_cells.unwrap_or(ScanMap::<f64>::MAX_CELLS);
        let setup = self.sensor.setup(resolution.unwrap_or(RESOLUTION), max_cells)?;
        let picture = self.plot.as_deref().map(Picture::by_name).transpose()?;
        let mut files = Files::new();
        files.read([path.to_owned()]);
        writing.check(&files, self.plot.as_deref())?;
        let options = ScanOptions { maximum_range: self.sensor.max_range, ..ScanOptions::default() };
        let log = read_filter_log(path, &options)?;
        let (log, mount) = if let Some(mount) = self.mount {
            let [x, y] = mount.position();
            let words = format!("the laser at {x}, {y} m and {} rad on the robot", mount.theta());
            (log.mounted(&mount).map_err(|error| error.in_file(path))?, (mount, words))
        } else {
            // GMapping writes the robot's poses, and not where its laser is.
            let words = "poses are taken for those of the laser; --mount X,Y,YAW says where it is";
            (log, (Pose::new(0.0, 0.0, 0.0)?, words.to_owned()))
        };
        let progress = Progress::new(log.steps.len());
        progress.begin(&format!("scans of {} particles", log.particles()));
        let rows = measure(&log, &setup, self.every, || progress.done());
        let rows = rows.map_err(|refused| unmapped(path, &log, refused))?;
        let made = Made {
            log: path.display().to_string(),
            steps: log.steps.len(),
            resamplings: log.steps.iter().filter(|step| step.resampled.is_some()).count(),
            particles: log.particles(),
            gain: log.gain,
            setup,
            laser: Laser::new(mount, log.steps.iter().map(|step| &step.scan)),
            warnings: in_words(&log.warnings),
        };
        files.read(log.files.iter().cloned());
        if let (Some(path), Some(picture)) = (&self.plot, picture) {
            let title = format!("{}: {} particles", plots::title(Path::new(&made.log)), made.particles);
            files.add(path, chart(&rows, made.particles, title).draw(picture)?);
        }
        writing.write(&FilterReport { made, rows }, files)?;
        Ok(Status::Done)
    }
}

/// Says why the maps of a log cannot be made, and what to do.
fn unmapped(path: &Path, log: &FilterLog, refused: Refused) -> Failure {
    let Refused { step, error } = refused;
    let time = log.steps[step].scan.time();
    let message = match error {
        Error::TooManyCells { count, limit, .. } => {
            let poses: Vec<_> = log.steps[..=step].iter().flat_map(|step| step.poses.clone()).collect();
            let (far, distance) = far_pose(&poses);
            let [x, y] = poses[far].position();
            let far = log.steps[far / log.particles()].scan.time();
            format!(
                "the maps would have {count:.3e} cells at {time} s, allowed are {limit}; a pose at {far} s, {x} {y}, is \
                 {distance:.0} m from the middle of the others: correct it, or give a larger --resolution or --max-cells"
            )
        }
        error => format!("the scan at {time} s: {error}"),
    };
    Failure::file(path, message)
}
