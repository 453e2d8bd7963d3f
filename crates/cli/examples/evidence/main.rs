//! Does the mean information of the map tell which trajectory is right? The evidence of `docs/evidence.md`, made again.
//!
//! Of the Intel Research Lab's log (910 scans, recorded by D. Hähnel, from Radish) more than a hundred trajectories are made that
//! are worse on purpose, in six ways. Each is measured by what needs no ground truth, and its error by what people verified: the
//! relations of the SLAM benchmark (Kümmerle et al. 2009). Ranks are correlated.
//!
//! ```sh
//! cargo run --release -p mean-information-cli --example evidence -- FOLDER --out DIR
//! ```
//!
//! `FOLDER` has `intel.log`, `intel.slam.tum`, `intel.odometry.tum` and `intel.relations`. `DIR` gets the scatter plots.

mod measured;
mod perturbed;
mod picture;
mod plane;
mod points;
mod ranks;
mod relations;
mod report;
mod row;
mod rule;

use clap::Parser;
use mean_information_cli::Failure;
use mean_information_cli::output::{Files, Report, Writing};
use mean_information_cli::plots::{Sheet, Svg};
use mean_information_files::scans::{NoReturn, ScanOptions};
use mean_information_files::{read_scans, read_trajectory};
use measured::{Beams, MAXIMUM_RANGE, Measured, measured};
use perturbed::Perturbed;
use plane::{Place, place};
use relations::Errors;
use report::Evidence;
use row::Row;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::sync::Mutex;
use std::thread;

/// How far the poses of a scan may be apart in time, in seconds, to be interpolated: not at all, each scan has its own.
const MAX_GAP: f64 = 0.0;

/// The evidence that mean information tells which trajectory is right, from the Intel Research Lab's log.
#[derive(Parser, Debug)]
struct Arguments {
    /// The folder of intel.log, intel.slam.tum, intel.odometry.tum and intel.relations.
    folder: PathBuf,
    /// Write the scatter plots, as SVG, to this folder; it is made if there is none.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Take every so many of the trajectories, for a trial.
    #[arg(long, default_value_t = 1)]
    every: usize,
    /// Threads; the numbers do not depend on them.
    #[arg(long, default_value_t = thread::available_parallelism().map_or(1, std::num::NonZero::get))]
    threads: usize,
    #[command(flatten)]
    writing: Writing,
}

fn main() -> ExitCode {
    match Arguments::parse().run() {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            eprintln!("evidence: {failure}");
            ExitCode::from(2)
        }
    }
}

impl Arguments {
    fn run(&self) -> Result<(), Failure> {
        let mut files = Files::new();
        if let Some(folder) = &self.out {
            files.make_folder(folder)?;
        }
        let options = ScanOptions { maximum_range: Some(MAXIMUM_RANGE), ..ScanOptions::default() };
        let log = read_scans(&self.folder.join("intel.log"), &options)?;
        let times = log.times();
        let origin = mean_information::scan::Pose::new(0.0, 0.0, 0.0)?;
        let beams = |scan: &mean_information_files::scans::RangeScan| {
            let scan = scan.scan_from(origin, NoReturn::LeftOut)?;
            Ok(scan.map_or_else(Beams::new, |scan| scan.beams().to_vec()))
        };
        let beams = log.scans.iter().map(beams).collect::<Result<Vec<_>, mean_information::Error>>()?;
        let [corrected, odometry] =
            ["intel.slam.tum", "intel.odometry.tum"].map(|name| poses(&self.folder.join(name), &times));
        let relations = relations::read(&self.folder.join("intel.relations"), &times)?;
        let made: Vec<_> =
            perturbed::all(&corrected?, &odometry?)?.into_iter().step_by(self.every.max(1)).collect();
        let measured = each(&made, self.threads, |made| measured(made, &beams))?;
        let row = |(made, measured): (Perturbed, Measured)| {
            Ok(Row { errors: Errors::new(&made.places, &relations)?, made, measured })
        };
        let rows = made.into_iter().zip(measured).map(row).collect::<Result<Vec<_>, Failure>>()?;
        let evidence = Evidence::new(rows, relations.len())?;
        if let Some(folder) = &self.out {
            for (name, plots, description) in evidence.scatters() {
                let drawn = plots.iter().map(|plot| Ok(vec![Svg::of_plot(plot)?]));
                let sheet = Sheet::new(drawn.collect::<Result<_, Failure>>()?, description.to_owned());
                files.add(&folder.join(name), sheet.file().into_bytes());
            }
            files.add(
                &folder.join("evidence.json"),
                evidence.text(mean_information_cli::output::Format::Json).into_bytes(),
            );
        }
        self.writing.write(&evidence, files)
    }
}

/// Reads the poses of a trajectory at the times of the scans.
fn poses(path: &Path, times: &[f64]) -> Result<Vec<Place>, Failure> {
    let (trajectory, _) = read_trajectory(path)?;
    let poses = trajectory.at_times(times, MAX_GAP)?.poses;
    let refused = || Failure::File { path: path.to_owned(), message: "lacks the pose of a scan".to_owned() };
    poses.iter().map(|pose| pose.as_ref().map(place).ok_or_else(refused)).collect()
}

/// Measures each, by several threads; the results are in order.
fn each<T: Sync, R: Send>(
    items: &[T],
    threads: usize,
    work: impl Fn(&T) -> Result<R, mean_information::Error> + Sync,
) -> Result<Vec<R>, mean_information::Error> {
    let results: Mutex<Vec<Option<Result<R, _>>>> = Mutex::new(items.iter().map(|_| None).collect());
    let next = std::sync::atomic::AtomicUsize::new(0);
    thread::scope(|scope| {
        for _ in 0..threads.max(1) {
            scope.spawn(|| {
                loop {
                    let k = next.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
                    let Some(item) = items.get(k) else { break };
                    let result = work(item);
                    eprintln!("{} of {}", k + 1, items.len());
                    results.lock().expect("no thread panics with it")[k] = Some(result);
                }
            });
        }
    });
    let results = results.into_inner().expect("no thread panics with it");
    results.into_iter().flatten().collect()
}
