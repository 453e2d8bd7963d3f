//! Public laser logs, where they are there: the least of CARMEN's format that tests need.

pub use crate::real_data::shared;

/// One scan of a log: ranges in metres, and two poses of the laser, x, y (metres) and heading (radians).
#[derive(Clone, Debug)]
pub struct LaserScan {
    /// The ranges, from -90 degrees on, counter-clockwise over half a turn.
    pub ranges: Vec<f64>,
    /// The pose as the log has it corrected by a SLAM program.
    pub corrected: [f64; 3],
    /// The pose by odometry.
    pub odometry: [f64; 3],
}

impl LaserScan {
    /// Returns the beams whose range is below 50 m, each as its bearing (radians from the heading) and its range.
    pub fn beams(&self) -> impl Iterator<Item = (f64, f64)> {
        let step = std::f64::consts::PI / self.ranges.len() as f64;
        let bearing = move |k: usize| k as f64 * step - std::f64::consts::FRAC_PI_2;
        self.ranges
            .iter()
            .enumerate()
            .filter(|&(_, &range)| range < 50.0)
            .map(move |(k, &range)| (bearing(k), range))
    }
}

/// Reads the `FLASER` lines of a log: a count, as many ranges, the corrected pose, the pose by odometry, and what tests do not
/// need.
///
/// # Panics
/// If such a line is cut or holds something that is no number.
pub fn flaser(text: &str) -> Vec<LaserScan> {
    let scan = |line: &str| {
        let mut words = line.split_whitespace().skip(1);
        let count = words.next().expect("a count").parse().expect("a count");
        let mut number = || words.next().expect("a number").parse::<f64>().expect("a number");
        let ranges = (0..count).map(|_| number()).collect();
        LaserScan {
            ranges,
            corrected: [number(), number(), number()],
            odometry: [number(), number(), number()],
        }
    };
    text.lines().filter(|line| line.starts_with("FLASER ")).map(scan).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_read() {
        let scans =
            flaser("# CARMEN\nODOM 1 2 3\nFLASER 4 2.5 81.91 0.75 50 1 -2 0.5 3 4 -0.25 99.5 host 0.125\n");
        assert_eq!(
            (scans.len(), scans[0].corrected, scans[0].odometry),
            (1, [1.0, -2.0, 0.5], [3.0, 4.0, -0.25])
        );
        let quarter = std::f64::consts::FRAC_PI_4;
        assert_eq!(scans[0].beams().collect::<Vec<_>>(), [(-2.0 * quarter, 2.5), (0.0, 0.75)]);
    }
}
