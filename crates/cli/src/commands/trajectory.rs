//! `meaninfo trajectory`: which trajectory makes the most consistent map of the scans of a log.

use super::Status;
use super::sensor::{Sensor, mount};
use crate::failure::Failure;
use crate::metres::positive;
use crate::output::{Files, PAGE, Writing};
use crate::plots::{self, Picture};
use crate::progress::Progress;
use crate::trajectory::{
    Candidate, Common, Comparison, Laser, Measured, Pictures, Recorded, Refused, Setup, Used, Wanted,
    far_pose, measure_all,
};
use clap::Args;
use mean_information::Error;
use mean_information::scan::{Pose, ScanMap};
use mean_information_files::scans::{Frame, ScanLog, ScanOptions, Selection, TimeField};
use mean_information_files::{bags, read_selected_scans, read_trajectory};
use mean_information_report::submaps::is_state;
use mean_information_report::words::in_words;
use std::num::NonZero;
use std::path::PathBuf;
use std::thread;

/// The arguments of `meaninfo trajectory`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The scans: a CARMEN log, .log or .clf, with FLASER or ROBOTLASER1; a bag, .mcap, .db3, .bag or the folder of one, with
    /// LaserScan; or Cartographer's saved state, .pbstream.
    #[arg(value_name = "SCANS")]
    scans: PathBuf,
    /// The trajectories: TUM text, `time x y z qx qy qz qw` a line, on the clock of the scans. If none is given, those that
    /// SCANS holds: of a log "laser", the poses of the laser as a SLAM program may have corrected them, and "odometry"; of a
    /// bag those of its frames; of a saved state "local", as scans were matched, and "global", after loops were closed. Beside
    /// POSES those of --frames and --pose-topics are compared, too.
    #[arg(value_name = "POSES")]
    poses: Vec<PathBuf>,
    /// Draw the mean information against time, one curve a trajectory, to this SVG or PNG file.
    #[arg(long, value_name = "FILE.svg|png")]
    series: Option<PathBuf>,
    /// Draw the map of each trajectory, with the path of the laser, all on one scale, to this SVG file.
    #[arg(long, value_name = "FILE.svg")]
    maps: Option<PathBuf>,
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
    /// Refuse a map of more cells than this: two poses some hundred metres apart make a large one of any log, 2.7 GB for each
    /// thread at the default.
    #[arg(long, value_name = "N", default_value_t = ScanMap::<f64>::MAX_CELLS)]
    max_cells: u64,
    #[command(flatten)]
    sensor: Sensor,
    #[command(flatten)]
    association: Association,
    #[command(flatten)]
    recorded: Recorded,
    #[command(flatten)]
    writing: Writing,
}

/// Where the laser was.
#[derive(Args, Debug)]
#[command(next_help_heading = "Poses")]
struct Association {
    /// The pose of the laser on the robot whose poses POSES are, in metres and radians; if absent, as the log or /tf_static
    /// has it, or else 0,0,0: POSES are those of the laser. Of a saved state, the laser in the tracking frame.
    #[arg(long, value_name = "X,Y,YAW", value_parser = mount)]
    mount: Option<Pose>,
    /// The longest time between two poses that are interpolated; what is interpolated is a worse pose than one of POSES.
    #[arg(long, value_name = "SECONDS", default_value_t = Common::GAP, value_parser = seconds)]
    max_gap: f64,
    /// The laser is mounted upside down, so that its bearings turn clockwise; of a bag, also where TF says so.
    #[arg(long)]
    upside_down: bool,
    /// The field of a CARMEN message that has its time; if absent, sent.
    #[arg(long, value_enum)]
    time: Option<TimeField>,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let setup = self.sensor.setup(self.resolution, self.max_cells)?;
        let series = self.series.as_deref().map(Picture::by_name).transpose()?;
        for picture in [&self.heat_map, &self.conflicts].into_iter().flatten() {
            plots::require_png(picture)?;
        }
        if let Some(path) = &self.maps {
            plots::require_svg(path)?;
        }
        let mut files = Files::new();
        if let Some(folder) = &self.out {
            files.make_folder(folder)?;
        }
        files.read(self.poses.iter().chain([&self.scans]).cloned());
        let page = self.out.as_ref().map(|folder| folder.join(PAGE));
        let pictures = [&self.series, &self.maps, &self.heat_map, &self.conflicts, &page];
        self.writing.check(&files, pictures.into_iter().filter_map(|file| file.as_deref()))?;
        let log = self.log()?;
        let mount = self.mount(&log)?;
        let candidates = self.candidates(&log, &mount.0)?;
        let common = Common::of(&log.scans, &candidates, self.association.max_gap, setup.no_return)?;
        if common.scans.is_empty() {
            return Err(self.nothing_in_common(&log, &candidates));
        }
        files.read(log.files.iter().cloned());
        let is_page = self.out.is_some();
        let wanted = Wanted {
            series: is_page || series.is_some(),
            pictures: is_page
                || [&self.maps, &self.heat_map, &self.conflicts].iter().any(|file| file.is_some()),
        };
        let measured = self.measured(&setup, &candidates, &common, wanted)?;
        let used = Used {
            log: self.scans.display().to_string(),
            scans: log.scans.len(),
            scans_used: common.scans.len(),
            beams: common.beams,
            setup,
            laser: Laser::new(mount, common.scans.iter().copied()),
            warnings: in_words(&log.warnings),
        };
        let comparison = Comparison::new(used, &candidates, &common, &measured);
        let pictures = Pictures { comparison: &comparison, common: &common, measured: &measured };
        if let (Some(path), Some(picture)) = (&self.series, series) {
            files.add(path, pictures.series(picture)?);
        }
        if let Some(path) = &self.maps {
            files.add(path, pictures.maps()?);
        }
        if let Some(path) = &self.heat_map {
            files.add(path, pictures.heat_maps()?);
        }
        if let Some(path) = &self.conflicts {
            files.add(path, pictures.conflicts()?);
        }
        if let Some(page) = &page {
            files.add(page, pictures.page()?.into_bytes());
        }
        self.writing.write(&comparison, files)?;
        Ok(Status::Done)
    }

    /// Reads the scans.
    fn log(&self) -> Result<ScanLog, Failure> {
        let Association { mount, max_gap, upside_down, time } = self.association;
        let is_log = !bags::is_bag(&self.scans) && !is_state(&self.scans);
        if time.is_some() && !is_log {
            return Err(Failure::file(&self.scans, "is no CARMEN log; --time needs one, leave it out"));
        }
        if upside_down && is_state(&self.scans) {
            let words =
                "is a saved state, whose points were turned when it was made; leave --upside-down out";
            return Err(Failure::file(&self.scans, words));
        }
        let options = ScanOptions { maximum_range: self.sensor.max_range, time: time.unwrap_or_default() };
        let selection = self.recorded.selection(&self.scans, self.poses.is_empty())?;
        let selection = Selection { mount, max_gap, upside_down, ..selection };
        Ok(read_selected_scans(&self.scans, &options, &selection)?)
    }

    /// Returns the pose of the laser on the robot, also in words.
    fn mount(&self, log: &ScanLog) -> Result<(Pose, String), Failure> {
        let in_words = |pose: &Pose| {
            let ([x, y], yaw) = (pose.position(), pose.theta());
            // A quaternion rounds.
            let [x, y, yaw] = [x, y, yaw].map(|number| (number * 1e9).round() / 1e9);
            format!("{x}, {y} m and {yaw} rad on the robot")
        };
        let nowhere = Pose::new(0.0, 0.0, 0.0)?;
        Ok(match (self.association.mount, log.mount) {
            (Some(mount), _) => (mount, format!("the laser at {}, by --mount", in_words(&mount))),
            (None, Some(mount)) if mount != nowhere => {
                let advice = if self.poses.is_empty() { "" } else { "; --mount 0,0,0 if POSES are its own" };
                let words = format!("the laser at {}, by the log{advice}", in_words(&mount));
                (mount, words)
            }
            (None, _) if is_state(&self.scans) => {
                (nowhere, "beams are taken from the origin of the tracking frame".to_owned())
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
                warnings: in_words(&held.warnings),
            })
        });
        // Of a bag and of a state there are those that were asked for, of a log all that it holds.
        let is_asked_for = self.poses.is_empty() || bags::is_bag(&self.scans) || is_state(&self.scans);
        let held = held.filter(|_| is_asked_for);
        let all: Vec<_> = held.chain(self.poses.iter().map(read)).collect::<Result<_, Failure>>()?;
        if all.is_empty() {
            return Err(Failure::file(&self.scans, "holds no trajectory; give one, as TUM text, after it"));
        }
        Ok(all)
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

/// Reads a time, 0 or more.
fn seconds(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(number) if number >= 0.0 && f64::is_finite(number) => Ok(number),
        _ => Err("not a finite number of seconds, 0 or more".to_owned()),
    }
}
