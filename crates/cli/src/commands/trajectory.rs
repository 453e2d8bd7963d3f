//! `meaninfo trajectory`: which trajectory makes the most consistent map of the scans of a log.

use super::Status;
use crate::failure::Failure;
use crate::metres::positive;
use crate::output::{Files, Writing};
use crate::plots::{self, Picture};
use crate::progress::Progress;
use crate::trajectory::{
    Candidate, Common, Comparison, Measured, Pictures, Refused, SensorModel, Setup, Used, Wanted, far_pose,
    measure_all,
};
use clap::{Args, ValueEnum};
use mean_information::Error;
use mean_information::scan::{Pose, ScanMap};
use mean_information_files::scans::{Frame, NoReturn, ScanLog, ScanOptions, TimeField};
use mean_information_files::{read_scans, read_trajectory};
use mean_information_report::words::in_words;
use std::num::NonZero;
use std::path::{Path, PathBuf};
use std::thread;

/// The arguments of `meaninfo trajectory`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The scans: a CARMEN log, .log or .clf, with FLASER or ROBOTLASER1.
    #[arg(value_name = "SCANS")]
    scans: PathBuf,
    /// The trajectories: TUM text, `time x y z qx qy qz qw` a line, on the clock of the scans. If none is given, those that
    /// SCANS holds: "laser", the poses of the laser as a SLAM program may have corrected them, and "odometry".
    #[arg(value_name = "POSES")]
    poses: Vec<PathBuf>,
    /// Draw the mean information against time, one curve a trajectory, to this SVG or PNG file.
    #[arg(long, value_name = "FILE.svg|png")]
    series: Option<PathBuf>,
    /// Draw the information of every cell of each map to this PNG file.
    #[arg(long, value_name = "FILE.png")]
    heat_map: Option<PathBuf>,
    /// Draw where the scans of each map contradict one another, with the path of the laser, to this PNG file.
    #[arg(long, value_name = "FILE.png")]
    conflicts: Option<PathBuf>,
    /// Write a page with all of it, index.html, to this folder; it is made if there is none.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// The side of a cell in metres.
    #[arg(long, value_name = "METRES", default_value_t = 0.05, value_parser = positive::<f64>)]
    resolution: f64,
    /// How many maps are made at a time, a thread each, 40 bytes a cell; if absent, as many as the machine has processors.
    /// No number changes.
    #[arg(long, value_name = "N")]
    threads: Option<NonZero<usize>>,
    /// Refuse a map of more cells than this.
    #[arg(long, value_name = "N", default_value_t = ScanMap::<f64>::MAX_CELLS)]
    max_cells: u64,
    #[command(flatten)]
    sensor: Sensor,
    #[command(flatten)]
    association: Association,
    #[command(flatten)]
    writing: Writing,
}

/// What a beam means.
#[derive(Args, Debug)]
#[command(next_help_heading = "Sensor")]
struct Sensor {
    /// The inverse sensor model of a beam.
    #[arg(long = "sensor", value_enum, default_value_t)]
    model: SensorName,
    /// Stepped: the occupancy of free space, from 0 to 1/2; 0.4 if absent.
    #[arg(long, value_name = "P")]
    free: Option<f64>,
    /// Stepped: the occupancy of an obstacle, from 1/2 to 1; 0.7 if absent.
    #[arg(long, value_name = "P")]
    occupied: Option<f64>,
    /// Stepped: the thickness of an obstacle; one cell if absent.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    thickness: Option<f64>,
    /// Gaussian: the standard deviation of a range.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    sigma: Option<f64>,
    /// The greatest log-odds of one reading of a cell, in nats.
    #[arg(long, value_name = "NATS", default_value_t = ScanMap::<f64>::READING_LIMIT)]
    reading_limit: f64,
    /// The range from which on a beam did not return; if absent, that of the log, or 50.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    max_range: Option<f64>,
    /// What a beam that did not return means: nothing, or free space up to the greatest range.
    #[arg(long, value_enum, default_value_t)]
    no_return: NoReturn,
}

/// The inverse sensor models by their names.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum SensorName {
    /// Steps: free up to an obstacle, occupied over its thickness.
    #[default]
    Stepped,
    /// Eq. 5 of the paper; it saturates, so that trajectories are told apart less well.
    Gaussian,
}

/// Where the laser was.
#[derive(Args, Debug)]
#[command(next_help_heading = "Poses")]
struct Association {
    /// The pose of the laser on the robot whose poses POSES are, in metres and radians; if absent, as the log has it, or
    /// else 0,0,0: POSES are those of the laser.
    #[arg(long, value_name = "X,Y,YAW", value_parser = mount)]
    mount: Option<Pose>,
    /// The longest time between two poses that are interpolated.
    #[arg(long, value_name = "SECONDS", default_value_t = 1.0, value_parser = seconds)]
    max_gap: f64,
    /// The field of a CARMEN message that has its time.
    #[arg(long, value_enum, default_value_t)]
    time: TimeField,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let setup = self.setup()?;
        let series = self.series.as_deref().map(Picture::by_name).transpose()?;
        for picture in [&self.heat_map, &self.conflicts].into_iter().flatten() {
            plots::require_png(picture)?;
        }
        let mut files = Files::new();
        if let Some(folder) = &self.out {
            files.make_folder(folder)?;
        }
        let log = self.log()?;
        let (mount, mount_in_words) = self.mount(&log)?;
        let candidates = self.candidates(&log, &mount)?;
        let common = Common::of(&log.scans, &candidates, self.association.max_gap, setup.no_return)?;
        if common.scans.is_empty() {
            return Err(self.nothing_in_common(&log, &candidates));
        }
        files.read(log.files.iter().cloned().chain(self.poses.iter().cloned()));
        let is_page = self.out.is_some();
        let wanted = Wanted {
            series: is_page || series.is_some(),
            pictures: is_page || self.heat_map.is_some() || self.conflicts.is_some(),
        };
        let measured = self.measured(&setup, &candidates, &common, wanted)?;
        let used = Used {
            log: self.scans.display().to_string(),
            scans: log.scans.len(),
            scans_used: common.scans.len(),
            beams: common.beams,
            setup,
            mount: mount_in_words,
            warnings: in_words(&log.warnings),
        };
        let comparison = Comparison::new(used, &candidates, &common, &measured);
        let pictures = Pictures { comparison: &comparison, common: &common, measured: &measured };
        if let (Some(path), Some(picture)) = (&self.series, series) {
            files.add(path, pictures.series(picture)?);
        }
        if let Some(path) = &self.heat_map {
            files.add(path, pictures.heat_maps()?);
        }
        if let Some(path) = &self.conflicts {
            files.add(path, pictures.conflicts()?);
        }
        if let Some(folder) = &self.out {
            files.add(&folder.join("index.html"), pictures.page()?.into_bytes());
        }
        self.writing.write(&comparison, files)?;
        Ok(Status::Done)
    }

    /// Returns how maps are made.
    fn setup(&self) -> Result<Setup, Failure> {
        let Sensor { model, free, occupied, thickness, sigma, reading_limit, no_return, .. } = self.sensor;
        let usage = |message: &str| Err(Failure::Usage(message.to_owned()));
        let sensor = match (model, sigma) {
            (SensorName::Stepped, None) => SensorModel::Stepped {
                free: free.unwrap_or(0.4),
                occupied: occupied.unwrap_or(0.7),
                thickness: thickness.unwrap_or(self.resolution),
            },
            (SensorName::Stepped, Some(_)) => {
                return usage("--sigma needs --sensor gaussian; give both or neither");
            }
            (SensorName::Gaussian, Some(sigma)) if free.or(occupied).or(thickness).is_none() => {
                SensorModel::Gaussian { sigma }
            }
            (SensorName::Gaussian, Some(_)) => {
                return usage("--free, --occupied and --thickness need --sensor stepped; leave them out");
            }
            (SensorName::Gaussian, None) => return usage("--sensor gaussian needs --sigma METRES; give it"),
        };
        let setup = Setup {
            resolution: self.resolution,
            sensor,
            reading_limit,
            no_return,
            max_cells: self.max_cells,
        };
        setup.map()?;
        Ok(setup)
    }

    /// Reads the scans.
    fn log(&self) -> Result<ScanLog, Failure> {
        refuse_bags(&self.scans)?;
        let options = ScanOptions { maximum_range: self.sensor.max_range, time: self.association.time };
        Ok(read_scans(&self.scans, &options)?)
    }

    /// Returns the pose of the laser on the robot, also in words.
    fn mount(&self, log: &ScanLog) -> Result<(Pose, String), Failure> {
        let in_words = |pose: &Pose| {
            let [x, y] = pose.position();
            format!("{x}, {y} m and {} rad on the robot", pose.theta())
        };
        let nowhere = Pose::new(0.0, 0.0, 0.0)?;
        Ok(match (self.association.mount, log.mount) {
            (Some(mount), _) => (mount, format!("the laser at {}, by --mount", in_words(&mount))),
            (None, Some(mount)) if mount != nowhere => {
                let words = format!(
                    "the laser at {}, by the log; --mount 0,0,0 if POSES are its own",
                    in_words(&mount)
                );
                (mount, words)
            }
            (None, _) => (nowhere, "poses are those of the laser".to_owned()),
        })
    }

    /// Reads the trajectories, or takes those of the log.
    fn candidates(&self, log: &ScanLog, mount: &Pose) -> Result<Vec<Candidate>, Failure> {
        let read = |file: &PathBuf| {
            if file.is_dir() {
                return Err(Failure::file(file, "is a folder; give the names of TUM files"));
            }
            let (trajectory, warnings) = read_trajectory(file)?;
            let trajectory = trajectory.mounted(mount).map_err(|error| error.in_file(file))?;
            let name = file.display().to_string();
            Ok(Candidate { name, file: file.clone(), trajectory, warnings: in_words(&warnings) })
        };
        if !self.poses.is_empty() {
            return self.poses.iter().map(read).collect();
        }
        let held = log.trajectories.iter().map(|held| {
            let trajectory = held.trajectory.clone();
            let trajectory = match held.frame {
                Frame::Laser => trajectory,
                Frame::Robot => trajectory.mounted(mount).map_err(|error| error.in_file(&self.scans))?,
            };
            Ok(Candidate {
                name: held.name.clone(),
                file: self.scans.clone(),
                trajectory,
                warnings: Vec::new(),
            })
        });
        let held: Vec<_> = held.collect::<Result<_, Failure>>()?;
        if held.is_empty() {
            return Err(Failure::file(&self.scans, "holds no trajectory; give one, as TUM text, after it"));
        }
        Ok(held)
    }

    /// Measures the map of each trajectory.
    fn measured(
        &self,
        setup: &Setup,
        candidates: &[Candidate],
        common: &Common<'_>,
        wanted: Wanted,
    ) -> Result<Vec<Measured>, Failure> {
        let progress = Progress::new(2 * common.scans.len() * candidates.len());
        let maps = if candidates.len() == 1 { "map" } else { "maps" };
        progress.begin(&format!("scans, inserted and left out, of {} {maps}", candidates.len()));
        let threads = self.threads.or_else(|| thread::available_parallelism().ok()).map_or(1, NonZero::get);
        let step = || progress.done();
        measure_all(setup, &common.scans, &common.poses, wanted, threads, &step)
            .map_err(|(index, refused)| unmapped(&candidates[index], common, &common.poses[index], refused))
    }

    /// Says that no scan has a pose of every trajectory.
    fn nothing_in_common(&self, log: &ScanLog, candidates: &[Candidate]) -> Failure {
        let (first, last) = (log.scans[0].time(), log.scans[log.scans.len() - 1].time());
        let spans = candidates.iter().map(|Candidate { name, trajectory, .. }| {
            let [start, end] = trajectory.span();
            format!("{name} spans {start} to {end} s")
        });
        let spans = spans.collect::<Vec<_>>().join(", ");
        let message = format!(
            "no scan that tells anything has a pose of every trajectory: the scans span {first} to {last} s, {spans}; give \
             trajectories of the same times, or a larger --max-gap or --max-range"
        );
        Failure::file(&self.scans, message)
    }
}

/// Says why a map cannot be made, and what to do.
fn unmapped(of: &Candidate, common: &Common<'_>, poses: &[Pose], refused: Refused) -> Failure {
    let Refused { scan, error } = refused;
    let message = match error {
        Error::TooManyCells { count, limit, .. } => {
            let (far, distance) = far_pose(poses);
            let ([x, y], time) = (poses[far].position(), common.scans[far].time());
            format!(
                "the map would have {count:.3e} cells, allowed are {limit}; the pose at {time} s, {x} {y}, is {distance:.0} m \
                 from the middle of the others: correct it, or give a larger --resolution or --max-cells"
            )
        }
        error => format!("the scan at {} s: {error}", common.scans[scan].time()),
    };
    Failure::file(&of.file, message)
}

/// Refuses by their names what holds scans and is not read yet.
fn refuse_bags(path: &Path) -> Result<(), Failure> {
    let name = path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase();
    let kinds = [
        (".mcap", "a ROS 2 bag"),
        (".db3", "a ROS 2 bag"),
        (".bag", "a ROS 1 bag"),
        (".pbstream", "a state of Cartographer"),
    ];
    let kind = kinds.iter().find(|(ending, _)| name.ends_with(ending)).map(|&(_, kind)| kind);
    match kind.or(path.is_dir().then_some("a folder")) {
        Some(kind) => {
            Err(Failure::file(path, format!("is {kind}, which is not read; give a CARMEN log, .log or .clf")))
        }
        None => Ok(()),
    }
}

/// Reads a pose, `x,y,yaw`, in metres and radians.
fn mount(text: &str) -> Result<Pose, String> {
    let numbers: Option<Vec<f64>> = text.split(',').map(|number| number.trim().parse().ok()).collect();
    match numbers.as_deref() {
        Some(&[x, y, yaw]) => Pose::new(x, y, yaw).map_err(|error| error.to_string()),
        _ => Err("not three numbers, x,y,yaw, in metres and radians".to_owned()),
    }
}

/// Reads a time, 0 or more.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if number >= 0.0 && f64::is_finite(number) => Ok(number),
        _ => Err("not a finite number of seconds, 0 or more".to_owned()),
    }
}
