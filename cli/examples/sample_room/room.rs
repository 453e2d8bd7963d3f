//! The room: straight walls, a round pillar, an alcove, a cupboard and an open door. Lengths in metres.

/// A point, or a direction.
pub(crate) type Point = [f64; 2];

/// The walls, as segments. The room is 8 m by 6 m with its lower left corner at the origin.
const WALLS: [[Point; 2]; 20] = [
    // The outline, counter-clockwise from the lower left, with a door in the right wall ...
    [[0.0, 0.0], [8.0, 0.0]],
    [[8.0, 0.0], [8.0, 1.1]],
    [[8.0, 2.1], [8.0, 6.0]],
    // ... and an alcove in the upper one.
    [[8.0, 6.0], [4.6, 6.0]],
    [[4.6, 6.0], [4.6, 6.9]],
    [[4.6, 6.9], [2.6, 6.9]],
    [[2.6, 6.9], [2.6, 6.0]],
    [[2.6, 6.0], [0.0, 6.0]],
    [[0.0, 6.0], [0.0, 0.0]],
    // The corridor behind the door.
    [[8.0, 1.1], [9.4, 1.1]],
    [[8.0, 2.1], [8.4, 2.1]],
    [[8.4, 2.1], [8.4, 4.3]],
    [[9.4, 1.1], [9.4, 4.3]],
    // A cupboard against the left wall.
    [[0.0, 3.4], [0.6, 3.4]],
    [[0.6, 3.4], [0.6, 4.9]],
    [[0.6, 4.9], [0.0, 4.9]],
    // A screen in the room, and a table turned against the walls, of which a sensor near the ground sees two boards.
    [[3.1, 1.3], [3.1, 2.6]],
    [[3.1, 2.6], [3.9, 2.6]],
    [[6.2, 3.9], [7.1, 4.4]],
    [[5.8, 4.6], [6.7, 5.1]],
];

/// Walls reach this part of their length over their ends, so that no ray slips through a corner by a rounding error.
const CAULK: f64 = 1e-9;

/// The pillar: centre and radius.
const PILLAR: (Point, f64) = ([5.5, 2.4], 0.3);

/// The distance from `from` to the first wall in a `direction` of length 1; infinite if there is none.
///
/// Only `+ - * /` and square roots, which IEEE 754 rounds in one way: the same bits everywhere.
pub(crate) fn range(from: Point, direction: Point) -> f64 {
    let walls = WALLS.iter().filter_map(|&wall| to_segment(from, direction, wall));
    walls.chain(to_pillar(from, direction)).fold(f64::INFINITY, f64::min)
}

fn to_segment(from: Point, direction: Point, [start, end]: [Point; 2]) -> Option<f64> {
    let along = minus(end, start);
    let offset = minus(start, from);
    let slope = cross(direction, along);
    let (distance, place) = (cross(offset, along) / slope, cross(offset, direction) / slope);
    (slope != 0.0 && distance >= 0.0 && (-CAULK..=1.0 + CAULK).contains(&place)).then_some(distance)
}

fn to_pillar(from: Point, direction: Point) -> Option<f64> {
    let (centre, radius) = PILLAR;
    let to_centre = minus(centre, from);
    let nearest = to_centre[0] * direction[0] + to_centre[1] * direction[1];
    let miss = cross(direction, to_centre);
    let half_chord = (radius * radius - miss * miss).sqrt();
    // Not a number where the ray misses.
    (nearest - half_chord >= 0.0).then_some(nearest - half_chord)
}

/// `a - b`.
pub(crate) fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

fn cross(a: Point, b: Point) -> f64 {
    a[0] * b[1] - a[1] * b[0]
}
