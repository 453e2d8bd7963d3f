//! What is measured after each scan of a filter's log.

use crate::output::Number;
use crate::trajectory::Setup;
use mean_information::Error;
use mean_information::scan::ParticleMaps;
use mean_information_files::particles::{FilterLog, FilterStep};
use mean_information_report::measures::Measures;
use std::collections::BTreeSet;
use std::num::NonZero;

/// The measures of a filter after a scan: every particle's map has it, and none was drawn anew since.
#[derive(Clone, Debug)]
pub struct Row {
    /// The number of the step, from 0.
    pub step: usize,
    /// The time of its scan, in seconds, on the clock of the log.
    pub time: f64,
    /// The number of particles that count.
    pub effective: f64,
    /// The number of particles that the resampling after this step leaves, the least of those since the row before; `None`
    /// without one.
    pub left: Option<usize>,
    /// The measures of the expected map. Its width and height are not kept.
    pub expected: Measures,
    /// The weighted mean of the particles' own mean information; `None` if nothing is observed in any.
    pub mean_of_particles: Option<Number>,
}

/// Why a step could not be measured.
#[derive(Clone, Debug, PartialEq)]
pub struct Refused {
    /// The step, from 0.
    pub step: usize,
    /// The reason.
    pub error: Error,
}

/// Measures a log at each `every`-th step from the first on, and at its last. Calls `done` after each step.
///
/// # Errors
/// The first step whose scans do not fit the maps.
pub fn measure(
    log: &FilterLog,
    setup: &Setup,
    every: NonZero<usize>,
    done: impl Fn(),
) -> Result<Vec<Row>, Refused> {
    let at = |step| move |error| Refused { step, error };
    let empty = setup.map().map_err(at(0))?;
    let mut maps = ParticleMaps::new(empty, log.particles()).map_err(at(0))?;
    let (mut rows, mut left) = (Vec::new(), None);
    for (index, step) in log.steps.iter().enumerate() {
        insert(&mut maps, setup, step).map_err(at(index))?;
        let drawn = step.resampled.as_ref().map(|drawn| drawn.iter().collect::<BTreeSet<_>>().len());
        left = [left, drawn].into_iter().flatten().min();
        if index % every == 0 || index + 1 == log.steps.len() {
            let row = row(&maps, log, index, left.take());
            rows.push(row.map_err(at(index))?);
        }
        if let Some(drawn) = &step.resampled {
            maps.resample(drawn).map_err(at(index))?;
        }
        done();
    }
    Ok(rows)
}

/// Inserts the scan of a step into the map of each particle, from its pose.
fn insert(maps: &mut ParticleMaps<f64>, setup: &Setup, step: &FilterStep) -> Result<(), Error> {
    let scans = step.poses.iter().map(|&pose| setup.scan(&step.scan, pose));
    // A scan that says nothing says so from every pose.
    let scans: Option<Vec<_>> = scans.collect::<Result<_, _>>()?;
    scans.map_or(Ok(()), |scans| maps.par_insert(&scans, |range| setup.sensor.of_range(range)))
}

/// Measures the maps after a step.
fn row(maps: &ParticleMaps<f64>, log: &FilterLog, index: usize, left: Option<usize>) -> Result<Row, Error> {
    let (step, weights) = (&log.steps[index], log.weights(index));
    let expected = Measures::of_tally([0; 2], &maps.par_expected_tally(&weights)?);
    let observed =
        (0..maps.particles()).filter_map(|particle| maps.tally(particle)).any(|own| own.observed() > 0);
    let mean = Number::new(maps.mean_of_mean_information(&weights)?);
    Ok(Row {
        step: index,
        time: step.scan.time(),
        effective: step.effective(log.gain),
        left,
        expected,
        mean_of_particles: observed.then_some(mean),
    })
}
