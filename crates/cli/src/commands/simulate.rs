//! `meaninfo simulate`: a robot with a range sensor in a room, and the map it makes.

use super::Status;
use crate::failure::Failure;
use crate::metres::positive;
use crate::output::{Files, Number, Record, Report, Value, Writing, short, table, wrapped};
use crate::progress::Progress;
use crate::simulation::{self, Journey, Recording, Room, RoomName, Scanner};
use clap::Args;
use mean_information::map::Grid;
use mean_information::map::encoding::Probability;
use mean_information::scan::{Pose, ScanMap};
use mean_information_files::scans::carmen;
use mean_information_files::{Map, Options, Semantics, npy, ros, tum};
use mean_information_report::measures::Measures;
use std::ffi::OsString;
use std::io::Cursor;
use std::path::{Path, PathBuf};

/// The most readings of cells: a quarter of an hour's work.
const MOST_READINGS: f64 = (1_u64 << 32) as f64;

/// The arguments of `meaninfo simulate`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Write the map to PREFIX.yaml and PREFIX.pgm (ROS, mode scale) and to PREFIX.npy (probabilities, float64), what the
    /// robot recorded on a longer drive to PREFIX.log (CARMEN), and its trajectories to PREFIX.true.tum and
    /// PREFIX.odometry.tum.
    #[arg(long, value_name = "PREFIX")]
    out: PathBuf,
    /// Where the robot is.
    #[arg(long, value_enum, default_value_t)]
    room: RoomName,
    /// How often it stops to look round, at equal distances along its way; if absent, as often as the room needs.
    #[arg(long, value_name = "N", value_parser = clap::value_parser!(u32).range(1..=1 << 16))]
    poses: Option<u32>,
    /// The drift of its odometry: after d metres the pose it believes in is off by about D sqrt(d) metres either way, and
    /// as many radians.
    #[arg(long, value_name = "D", default_value_t = 0.0, value_parser = not_negative)]
    drift: f64,
    /// The seed of the noise and of the drift.
    #[arg(long, value_name = "N", default_value_t = 0)]
    seed: u64,
    #[command(flatten)]
    sensor: Sensor,
    #[command(flatten)]
    log: Log,
    /// The side of a cell in metres.
    #[arg(long, value_name = "METRES", default_value_t = 0.05, value_parser = positive::<f64>)]
    resolution: f64,
    /// Refuse a map of more cells than this; it takes up to 60 bytes for each.
    #[arg(long, value_name = "N", default_value_t = ScanMap::<f64>::MAX_CELLS)]
    max_cells: u64,
    #[command(flatten)]
    writing: Writing,
}

#[derive(Args, Debug)]
#[command(next_help_heading = "Sensor")]
struct Sensor {
    /// How many beams it has, all round.
    #[arg(long, value_name = "N", default_value_t = 720, value_parser = clap::value_parser!(u32).range(1..=1 << 16))]
    beams: u32,
    /// How far it sees.
    #[arg(long, value_name = "METRES", default_value_t = 4.5, value_parser = positive::<f64>)]
    range_max: f64,
    /// The standard deviation that the inverse sensor model (Eq. 5) takes its ranges to have.
    #[arg(long, value_name = "METRES", default_value_t = 0.05, value_parser = positive::<f64>)]
    sigma: f64,
    /// The standard deviation that its ranges have; if absent, that of --sigma.
    #[arg(long, value_name = "METRES", value_parser = not_negative)]
    noise: Option<f64>,
}

#[derive(Args, Debug)]
#[command(next_help_heading = "Log")]
struct Log {
    /// How many scans it has, at equal distances along the robot's way to its end and back.
    #[arg(long, value_name = "N", default_value_t = 150, value_parser = clap::value_parser!(u32).range(1..=1 << 16))]
    scans: u32,
    /// How many beams each has, all round.
    #[arg(long, value_name = "N", default_value_t = 180, value_parser = clap::value_parser!(u32).range(1..=1 << 16))]
    scan_beams: u32,
    /// The drift of the odometry in it, as of --drift.
    #[arg(long, value_name = "D", default_value_t = 0.02, value_parser = not_negative)]
    odometry_drift: f64,
}

/// The most ranges of a log: half a gigabyte of text.
const MOST_RANGES: u64 = 1 << 26;

fn not_negative(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if (0.0..f64::INFINITY).contains(&x) => Ok(x),
        _ => Err("allowed is 0 or a positive, finite number".to_owned()),
    }
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let [yaml, image, array] = [".yaml", ".pgm", ".npy"].map(|ending| self.file(ending));
        let (yaml, image, array) = (yaml?, image?, array?);
        let [log, truth, odometry] = [".log", ".true.tum", ".odometry.tum"].map(|ending| self.file(ending));
        let recorded = [log?, truth?, odometry?];
        let mut outputs = Files::new();
        let made = [&yaml, &image, &array].into_iter().chain(&recorded).map(PathBuf::as_path);
        self.writing.check(&outputs, made)?;
        let room = self.room.room();
        let poses = self.poses.map_or(room.poses, |poses| poses as usize);
        self.check_work(poses)?;
        let scanner =
            Scanner { beams: self.sensor.beams, maximum_range: self.sensor.range_max, noise: self.noise() };
        let journey = Journey::through(&room, &scanner, poses, self.drift, self.seed)?;
        let recording = self.record(&room)?;
        let map = self.map(&journey)?;
        let files = Named { yaml: &yaml, image: &image, array: &array, recorded: &recorded };
        let (saved, read) = files.save(&map, &self.comment())?;

        let report = Simulated {
            arguments: self,
            files,
            poses: journey.poses.iter().zip(&journey.believed).map(|(&p, &q)| [p, q]).collect(),
            measures: Measures::of_grid(&map),
            read: Measures::of(&read.cells),
        };
        outputs.add(&yaml, saved.yaml);
        outputs.add(&image, saved.image);
        let mut cells = Vec::new();
        npy::write(&map, &mut cells).map_err(|error| error.in_file(&array))?;
        outputs.add(&array, cells);
        for (path, text) in recorded.iter().zip(self.texts(&recording)?) {
            outputs.add(path, text);
        }
        self.writing.write(&report, outputs)?;
        Ok(Status::Done)
    }

    /// Records the drive of the log.
    fn record(&self, room: &Room) -> Result<Recording, Failure> {
        let Log { scans, scan_beams, odometry_drift } = self.log;
        let ranges = u64::from(scans) * u64::from(scan_beams);
        if ranges > MOST_RANGES {
            return Err(Failure::Usage(format!(
                "{scans} scans of {scan_beams} beams have {ranges} ranges, allowed are {MOST_RANGES}; give fewer --scans or \
                 --scan-beams"
            )));
        }
        let scanner =
            Scanner { beams: scan_beams, maximum_range: self.sensor.range_max, noise: self.noise() };
        let recording = Recording::through(room, &scanner, scans as usize, odometry_drift, self.seed);
        recording.map_err(|error| Failure::Usage(format!("{error}; give a smaller --odometry-drift")))
    }

    /// Returns the texts of a recording: its log, the true poses, those by odometry.
    fn texts(&self, recording: &Recording) -> Result<[Vec<u8>; 3], Failure> {
        let mut texts: [Vec<u8>; 3] = Default::default();
        let [log, truth, odometry] = &mut texts;
        let made = self.log_comment();
        carmen::write(&recording.scans, &format!("{made}\nlaser: true poses; robot: by odometry"), log)
            .and_then(|()| tum::write(&recording.truth, &format!("{made}\ntrue poses"), truth))
            .and_then(|()| tum::write(&recording.odometry, &format!("{made}\nposes by odometry"), odometry))
            .map_err(|error| Failure::Usage(error.to_string()))?;
        Ok(texts)
    }

    /// The map of the scans at the believed poses.
    fn map(&self, journey: &Journey) -> Result<Grid<Probability<f64>>, Failure> {
        let refused = |error: mean_information::Error| match error {
            mean_information::Error::TooManyCells { .. } => Failure::Usage(format!(
                "{error}; give a larger --resolution, a smaller --range-max, or raise --max-cells"
            )),
            error => error.into(),
        };
        let mut map = ScanMap::new(self.resolution)?.with_max_cells(self.max_cells);
        let progress = Progress::new(journey.poses.len());
        for (index, scan) in journey.scans().enumerate() {
            progress.begin(&format!("scan {index}"));
            simulation::insert(&mut map, &scan?, self.sensor.sigma).map_err(refused)?;
            progress.done();
        }
        Ok(map.probabilities()?)
    }

    fn noise(&self) -> f64 {
        self.sensor.noise.unwrap_or(self.sensor.sigma)
    }

    /// Refuses work that would not end.
    fn check_work(&self, poses: usize) -> Result<(), Failure> {
        // A beam crosses a cell per step along x and along y.
        let per_beam = 2.0 * self.sensor.range_max / self.resolution + 1.0;
        let readings = poses as f64 * f64::from(self.sensor.beams) * per_beam;
        if readings <= MOST_READINGS {
            return Ok(());
        }
        Err(Failure::Usage(format!(
            "{poses} poses of {} beams over {} cells each take up to {readings:.3e} readings of cells, allowed are \
             {MOST_READINGS:.3e}; give fewer beams or poses, a larger --resolution or a smaller --range-max",
            self.sensor.beams,
            short(per_beam)
        )))
    }

    /// Returns the prefix with an ending.
    fn file(&self, ending: &str) -> Result<PathBuf, Failure> {
        let whole = self.out.as_os_str().as_encoded_bytes();
        if self.out.file_name().is_none_or(|name| !whole.ends_with(name.as_encoded_bytes())) {
            return Err(Failure::Usage(format!(
                "--out {}: names a folder; give the beginning of the files' names, as in maps/room",
                self.out.display()
            )));
        }
        let mut path = OsString::from(&self.out);
        path.push(ending);
        Ok(path.into())
    }

    /// Returns a comment with the command that makes the map again.
    fn comment(&self) -> String {
        let poses = self.poses.map_or(String::new(), |poses| format!(" --poses {poses}"));
        let noise = self.sensor.noise.map_or(String::new(), |noise| format!(" --noise {noise}"));
        format!(
            "Made by: meaninfo simulate --room {}{poses} --drift {} --seed {} --beams {} --range-max {} --sigma {}{noise} \
             --resolution {}",
            self.room.name(),
            self.drift,
            self.seed,
            self.sensor.beams,
            self.sensor.range_max,
            self.sensor.sigma,
            self.resolution
        )
    }

    /// Returns a comment with the command that makes the recording again.
    fn log_comment(&self) -> String {
        let Log { scans, scan_beams, odometry_drift } = self.log;
        format!(
            "Made by: meaninfo simulate --room {} --seed {} --range-max {} --noise {} --scans {scans} --scan-beams \
             {scan_beams} --odometry-drift {odometry_drift}",
            self.room.name(),
            self.seed,
            self.sensor.range_max,
            self.noise()
        )
    }
}

/// The files of a map and of a recording.
#[derive(Clone, Copy)]
struct Named<'a> {
    yaml: &'a Path,
    image: &'a Path,
    array: &'a Path,
    /// The log, the true trajectory, the one by odometry.
    recorded: &'a [PathBuf; 3],
}

/// The bytes of the two files of a ROS map.
struct Saved {
    yaml: Vec<u8>,
    image: Vec<u8>,
}

impl Named<'_> {
    /// Returns the ROS files of a map, and the map that is read from them.
    fn save(&self, map: &Grid<Probability<f64>>, comment: &str) -> Result<(Saved, Map), Failure> {
        let name = self.image.file_name().and_then(|name| name.to_str());
        let name = name.ok_or_else(|| Failure::file(self.image, "has a name that is not UTF-8 text"))?;
        let mut saved = Saved { yaml: Vec::new(), image: Vec::new() };
        ros::write_description(map.geometry(), name, comment, &mut saved.yaml)
            .and_then(|()| ros::write_image(map, &mut saved.image))
            .map_err(|error| error.in_file(self.image))?;
        let options = Options { max_cells: Some(u64::MAX), ..Options::default() };
        let description = ros::Description::read(&saved.yaml[..], Semantics::Nav2)
            .map_err(|error| error.in_file(self.yaml))?;
        let read = ros::read_image(Cursor::new(&saved.image), &description, &options)
            .map_err(|error| error.in_file(self.image))?;
        Ok((saved, read))
    }
}

/// The result.
struct Simulated<'a> {
    arguments: &'a Arguments,
    files: Named<'a>,
    /// The true poses, each with the one that the robot believed in.
    poses: Vec<[Pose; 2]>,
    measures: Measures,
    /// The measures of the image, as nav2 reads it.
    read: Measures,
}

impl Simulated<'_> {
    fn record(&self) -> Record {
        let Arguments { room, drift, seed, sensor, log: recorded, resolution, .. } = self.arguments;
        let [log, truth, odometry] = self.files.recorded;
        let text = |path: &Path| Value::Text(path.display().to_string());
        let mut entries = vec![
            ("map", text(self.files.yaml)),
            ("image", text(self.files.image)),
            ("array", text(self.files.array)),
            ("log", text(log)),
            ("true_trajectory", text(truth)),
            ("odometry_trajectory", text(odometry)),
            ("room", Value::Text(room.name().to_owned())),
            ("drift", Value::Given(Some(*drift))),
            ("seed", Value::Count(*seed)),
            ("beams", Value::Count(sensor.beams.into())),
            ("range_max_m", Value::Given(Some(sensor.range_max))),
            ("sigma_m", Value::Given(Some(sensor.sigma))),
            ("noise_m", Value::Given(Some(self.arguments.noise()))),
            ("scans", Value::Count(recorded.scans.into())),
            ("scan_beams", Value::Count(recorded.scan_beams.into())),
            ("odometry_drift", Value::Given(Some(recorded.odometry_drift))),
        ];
        entries.extend(self.measures.entries(Some(*resolution)));
        entries.extend([
            ("quantisation", Value::Given(Some(ros::QUANTISATION))),
            ("mean_information_of_image", Value::Computed(self.read.mean_information)),
            ("poses", Value::Records(self.poses.iter().map(pose_record).collect())),
        ]);
        Record(entries)
    }
}

fn pose_record([pose, believed]: &[Pose; 2]) -> Record {
    let given = |x| Value::Given(Some(x));
    let ([x, y], [believed_x, believed_y]) = (pose.position(), believed.position());
    Record(vec![
        ("x_m", given(x)),
        ("y_m", given(y)),
        ("theta_rad", given(pose.theta())),
        ("believed_x_m", given(believed_x)),
        ("believed_y_m", given(believed_y)),
        ("believed_theta_rad", given(believed.theta())),
    ])
}

impl Report for Simulated<'_> {
    fn table(&self) -> String {
        let m = &self.measures;
        let header = [
            "map",
            "poses",
            "cells",
            Measures::MEAN_INFORMATION_HEAD,
            "the same, read\nfrom the image",
            "observed",
            "free / occupied",
            "unknown",
        ];
        let number = |x: Option<Number>| x.map_or("none".to_owned(), |x| x.to_string());
        table(
            header,
            [[
                wrapped(&self.files.yaml.display().to_string()),
                self.poses.len().to_string(),
                format!("{} × {}", m.width, m.height),
                number(m.mean_information),
                number(self.read.mean_information),
                m.observed().to_string(),
                format!("{} / {}", m.free, m.occupied),
                m.unknown.to_string(),
            ]],
        )
    }

    fn rows(&self) -> Vec<Record> {
        vec![self.record()]
    }

    fn json(&self) -> Value {
        Value::Record(self.record())
    }
}
