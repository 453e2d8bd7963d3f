//! The error of a trajectory by verified relations of its poses (Kümmerle et al., *On measuring the accuracy of SLAM algorithms*,
//! Autonomous Robots 27, 2009).

use crate::plane::{Place, relative, turn};
use mean_information::Error;
use mean_information_cli::Failure;
use std::fs;
use std::path::Path;

/// How far the time of a relation may be from that of a scan, in seconds: files print times to different digits.
const TOLERANCE: f64 = 1e-3;

/// The way from one pose to another, as people verified it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Relation {
    scans: [usize; 2],
    way: Place,
}

/// The errors of a trajectory by its relations.
#[derive(Clone, Debug)]
pub(crate) struct Errors {
    /// The translation of each, in metres.
    pub(crate) translations: Vec<f64>,
    /// The turn of each without its sign, in radians.
    pub(crate) rotations: Vec<f64>,
}

/// Reads the relations, `t1 t2 x y z roll pitch yaw` a line, whose two times are those of scans.
pub(crate) fn read(path: &Path, times: &[f64]) -> Result<Vec<Relation>, Failure> {
    let refused = |message: String| Failure::File { path: path.to_owned(), message };
    let text = fs::read_to_string(path).map_err(|error| refused(format!("cannot be read: {error}")))?;
    let mut relations = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let numbers: Option<Vec<f64>> = line.split_whitespace().map(|word| word.parse().ok()).collect();
        let Some(&[from, to, x, y, _, _, _, yaw]) = numbers.as_deref() else {
            return Err(refused(format!("line {}: is not t1 t2 x y z roll pitch yaw", number + 1)));
        };
        if let [Some(from), Some(to)] = [from, to].map(|time| scan_at(times, time)) {
            relations.push(Relation { scans: [from, to], way: [x, y, yaw] });
        }
    }
    Ok(relations)
}

/// Finds the scan of a time.
fn scan_at(times: &[f64], time: f64) -> Option<usize> {
    let at = times.partition_point(|&own| own < time - TOLERANCE);
    let near = |&at: &usize| times.get(at).is_some_and(|&own| (own - time).abs() <= TOLERANCE);
    [at, at + 1].into_iter().find(near)
}

impl Errors {
    /// Compares a trajectory with the relations.
    pub(crate) fn new(places: &[Place], relations: &[Relation]) -> Result<Self, Error> {
        let mut errors = Self { translations: Vec::new(), rotations: Vec::new() };
        for Relation { scans: [from, to], way } in relations {
            let found = relative(places[*from], places[*to])?;
            errors.translations.push(libm::hypot(found[0] - way[0], found[1] - way[1]));
            errors.rotations.push(turn(found[2] - way[2]).abs());
        }
        Ok(errors)
    }

    /// Returns what trajectories are ranked by: the mean errors in metres and radians, and the mean squares, which the authors
    /// of the benchmark define.
    pub(crate) fn yardsticks(&self) -> [f64; 4] {
        let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len() as f64;
        let squares = |numbers: &[f64]| mean(&numbers.iter().map(|x| x * x).collect::<Vec<_>>());
        let Self { translations, rotations } = self;
        [mean(translations), mean(rotations), squares(translations), squares(rotations)]
    }
}

/// The names of [`Errors::yardsticks`].
pub(crate) const YARDSTICKS: [&str; 4] =
    ["translation", "rotation", "squared translation", "squared rotation"];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_errors_of_two_relations() {
        let places = [[2.0, 3.0, 0.0], [2.5, 3.0, 0.25], [2.5, 4.0, 3.0]];
        let relations = [
            Relation { scans: [0, 1], way: [0.5, 0.75, 0.0] },
            Relation { scans: [0, 2], way: [0.5, 1.0, -3.0] },
        ];
        let found = Errors::new(&places, &relations).unwrap();
        assert_eq!(found.translations, [0.75, 0.0]);
        let around = std::f64::consts::TAU - 6.0;
        assert!((found.rotations[0] - 0.25).abs() < 1e-15 && (found.rotations[1] - around).abs() < 1e-15);
        assert_eq!(found.yardsticks()[0], 0.375);
        assert_eq!(found.yardsticks()[2], 0.28125);
    }

    #[test]
    fn a_time_is_that_of_the_scan_within_a_millisecond() {
        let times = [10.0, 10.5, 12.25];
        assert_eq!(
            [10.5005, 10.4995, 12.2515, 9.0].map(|time| scan_at(&times, time)),
            [Some(1), Some(1), None, None]
        );
    }
}
