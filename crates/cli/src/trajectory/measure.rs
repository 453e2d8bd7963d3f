//! What is measured of the map of one trajectory, and of those of several, by several threads.

use super::contradictions::{Contradiction, contradictions};
use super::setup::{Refused, Setup};
use mean_information::map::Grid;
use mean_information::map::encoding::LogOdds;
use mean_information::scan::{Layer, Pose, ScanMap, TalliedMap, blocks};
use mean_information::{Error, Tally};
use mean_information_files::scans::RangeScan;
use std::panic::resume_unwind;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;

/// The number of blocks of consecutive scans of the jackknife: of 10 to 20 the intervals hold what they promise
/// (`docs/evidence.md`, "Coverage").
pub const BLOCKS: usize = 20;

/// The parts that are measured beside the row of a trajectory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Wanted {
    /// The mean information after each scan.
    pub series: bool,
    /// The map, and where scans contradict one another.
    pub pictures: bool,
}

/// The measures of the map of one trajectory.
#[derive(Clone, Debug)]
pub struct Measured {
    /// The number of columns and rows.
    pub size: [usize; 2],
    /// The tally of the map.
    pub tally: Tally<f64>,
    /// The agreement of the scans.
    pub agreement: f64,
    /// The places where scans contradict one another most, the worst first.
    pub contradictions: Vec<Contradiction>,
    /// The tallies without one block of scans each: [`BLOCKS`] of them, or as many as scans.
    pub without: Vec<Tally<f64>>,
    /// The mean information after each scan, in bits per observed cell; empty unless wanted.
    pub series: Vec<f64>,
    /// The map, and where scans contradict one another; `None` unless wanted.
    pub pictures: Option<(Grid<LogOdds<f64>>, Layer<f64>)>,
}

impl Measured {
    /// Counts the observed cells that were seen in more than one block of scans: the others vanish with their block.
    pub fn revisited(&self) -> u64 {
        let all = self.tally.observed();
        let once: u64 = self.without.iter().map(|rest| all.saturating_sub(rest.observed())).sum();
        all.saturating_sub(once)
    }
}

/// Measures the map of records, each from its pose of the laser: once whole, and without each of [`BLOCKS`] blocks of
/// scans, which are removed and inserted again. Calls `step` twice for each scan.
///
/// # Errors
/// The first scan that the map refuses.
pub fn measure(
    setup: &Setup,
    records: &[&RangeScan],
    poses: &[Pose],
    wanted: Wanted,
    step: &(dyn Fn() + Sync),
) -> Result<Measured, Refused> {
    let at = |scan| move |error| Refused { scan, error };
    let (mut map, series) = inserted(setup, records, poses, wanted.series, step)?;
    let tally = map.tally();
    // A map of ScanMap::with_agreement has both.
    let layer = map.contradictions().map_err(at(0))?;
    let size = layer.as_ref().map_or([0; 2], |layer| [layer.width(), layer.height()]);
    let agreement = map.agreement().unwrap_or(1.0);
    let worst = layer.as_ref().map(|layer| contradictions(setup, records, poses, layer, BLOCKS));
    let contradictions = worst.transpose().map_err(at(0))?.unwrap_or_default();
    let layer = layer.filter(|_| wanted.pictures);
    let pictures = layer.map(|layer| Ok((map.log_odds()?, layer))).transpose().map_err(at(0))?;
    let mut without = Vec::with_capacity(BLOCKS);
    for block in blocks(records.len(), BLOCKS) {
        for scan in block.clone() {
            setup.remove(&mut map, records[scan], poses[scan]).map_err(at(scan))?;
        }
        without.push(map.tally());
        // The bits of the whole map again: sums of integers.
        for scan in block {
            setup.insert(&mut map, records[scan], poses[scan]).map_err(at(scan))?;
            step();
        }
    }
    Ok(Measured { size, tally, agreement, contradictions, without, series, pictures })
}

/// Inserts the records into a map; with the mean information after each if `series`.
fn inserted(
    setup: &Setup,
    records: &[&RangeScan],
    poses: &[Pose],
    series: bool,
    step: &(dyn Fn() + Sync),
) -> Result<(ScanMap<f64>, Vec<f64>), Refused> {
    let mut map = setup.map().map_err(|error| Refused { scan: 0, error })?;
    let pairs = || records.iter().zip(poses).enumerate();
    if !series {
        for (scan, (record, &pose)) in pairs() {
            setup.insert(&mut map, record, pose).map_err(|error| Refused { scan, error })?;
            step();
        }
        return Ok((map, Vec::new()));
    }
    let mut tallied = TalliedMap::new(map);
    let mut values = Vec::with_capacity(records.len());
    for (scan, (record, &pose)) in pairs() {
        let mut insert = || -> Result<f64, Error> {
            if let Some(beams) = setup.scan(record, pose)? {
                tallied.insert(&beams, |range| setup.sensor.of_range(range))?;
            }
            Ok(tallied.tally().mean_information())
        };
        values.push(insert().map_err(|error| Refused { scan, error })?);
        step();
    }
    Ok((tallied.into_map(), values))
}

/// Measures the maps of several trajectories, each by [`measure`], by `threads` threads: the same bits for any number
/// of them. A thread holds one map at a time.
///
/// # Errors
/// The refusal of the first trajectory that has one, with its number.
pub fn measure_all(
    setup: &Setup,
    records: &[&RangeScan],
    trajectories: &[Vec<Pose>],
    wanted: Wanted,
    threads: usize,
    step: &(dyn Fn() + Sync),
) -> Result<Vec<Measured>, (usize, Refused)> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut done = Vec::new();
        loop {
            let index = next.fetch_add(1, Ordering::Relaxed);
            let Some(poses) = trajectories.get(index) else { break done };
            done.push((index, measure(setup, records, poses, wanted, step)));
        }
    };
    let mut all: Vec<_> = thread::scope(|scope| {
        let started: Vec<_> =
            (0..threads.clamp(1, trajectories.len().max(1))).map(|_| scope.spawn(work)).collect();
        // A panic there is one here.
        let ended =
            started.into_iter().map(|thread| thread.join().unwrap_or_else(|panic| resume_unwind(panic)));
        ended.flatten().collect()
    });
    all.sort_by_key(|&(index, _)| index);
    all.into_iter().map(|(index, measured)| measured.map_err(|refused| (index, refused))).collect()
}
