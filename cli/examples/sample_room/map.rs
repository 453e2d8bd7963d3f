//! The map that a range sensor makes of the room, as a ROS map in mode `scale`.
//!
//! At each pose the sensor sees the exact distance z to the wall in the direction of every cell. The paper's inverse
//! sensor model (Eq. 5) gives the cell's occupancy from z and the cell's own distance; the observations are fused by
//! adding their log-odds to those of the prior 1/2, which are 0.

use super::room::{Point, minus, range};

const WIDTH: usize = 200;
const HEIGHT: usize = 156;
/// The side of a cell, and the lower left corner of the map, in metres.
const RESOLUTION: f64 = 0.05;
const ORIGIN: Point = [-0.4, -0.4];
/// Where the sensor looked round, and how far it sees, in metres.
const POSES: [Point; 7] =
    [[1.3, 1.1], [1.6, 3.0], [3.6, 4.6], [4.6, 3.6], [5.1, 1.1], [6.9, 1.5], [7.2, 3.2]];
const MAXIMUM_RANGE: f64 = 4.5;
/// The standard deviation of the sensor, in metres.
const SIGMA: f64 = 0.05;
/// sqrt(ln 4): how far behind the wall Eq. 5 says something, in units of sigma.
const EDGE: f64 = 1.177_410_022_515_474_7;
/// One look makes no cell certain, and neither do many: limits of the log-odds, in nats.
const ONE_LOOK: [f64; 2] = [-1.0, 1.8];
const ALL_LOOKS: [f64; 2] = [-4.5, 4.5];
/// The grey of unknown cells: occupancy 128/255, which is 50 percent under both `nav2` (the nearest percent) and ROS 1
/// (1 + 98 * 128/255 = 50.19, cut off).
const UNKNOWN: u8 = 127;

/// The description beside the image.
pub(crate) const YAML: &str = "\
# A room, made by this project's own code: cargo run --example sample_room
# Grey v is occupancy (255 - v) / 255. Grey 127 is 50 percent, which means unknown.
image: room.pgm
resolution: 0.05
origin: [-0.4, -0.4, 0.0]
mode: scale
negate: 0
free_thresh: 0.0
occupied_thresh: 1.0
";

/// The image: binary grey PGM, the upper row first.
pub(crate) fn pgm() -> Vec<u8> {
    let mut image = format!("P5\n{WIDTH} {HEIGHT}\n255\n").into_bytes();
    image.extend((0..HEIGHT).rev().flat_map(|row| (0..WIDTH).map(move |column| grey(log_odds(row, column)))));
    image
}

/// The fused log-odds of a cell, in nats; `None` if no observation reaches it.
fn log_odds(row: usize, column: usize) -> Option<f64> {
    let centre = |origin: f64, index: usize| origin + (index as f64 + 0.5) * RESOLUTION;
    let cell = [centre(ORIGIN[0], column), centre(ORIGIN[1], row)];
    let looks = POSES.iter().filter_map(|&pose| look(pose, cell));
    let sum = looks.reduce(|sum, l| sum + l)?;
    Some(sum.clamp(ALL_LOOKS[0], ALL_LOOKS[1]))
}

/// The log-odds of a cell seen from one pose; `None` out of range or behind the wall.
fn look(pose: Point, cell: Point) -> Option<f64> {
    let [dx, dy] = minus(cell, pose);
    let rho = (dx * dx + dy * dy).sqrt();
    let z = range(pose, [dx / rho, dy / rho]);
    if rho > MAXIMUM_RANGE || rho > z + SIGMA * EDGE {
        return None;
    }
    // Eq. 5; its log-odds are ln p - ln(1 - p), infinite at the wall itself and so limited.
    let t = (rho - z) / (SIGMA * std::f64::consts::SQRT_2);
    let p = libm::exp(-t * t);
    Some((libm::log(p) - libm::log1p(-p)).clamp(ONE_LOOK[0], ONE_LOOK[1]))
}

/// The grey level nearest to 255 (1 - p).
///
/// `libm`'s functions have the same bits on every machine. A last bit could matter only to a level within 1e-9 of the
/// border between two greys; there is none in this room, and this function sees to it.
fn grey(log_odds: Option<f64>) -> u8 {
    let Some(l) = log_odds else { return UNKNOWN };
    let level = 255.0 / (1.0 + libm::exp(l));
    assert!((level.fract() - 0.5).abs() > 1e-9, "level {level} lies between two greys: move a pose a little");
    level.round() as u8
}
