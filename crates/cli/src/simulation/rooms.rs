//! The rooms. Lengths in metres.

use super::{Point, Random, Shape};
use clap::ValueEnum;
use mean_information::scan::Direction;

/// A room, and a way through it.
#[derive(Clone, Debug, PartialEq)]
pub struct Room {
    /// The walls and pillars.
    pub shapes: Vec<Shape>,
    /// The robot's way, from point to point.
    pub route: Vec<Point>,
    /// The number of times it stops to look round, unless told otherwise.
    pub poses: usize,
}

impl Room {
    /// Returns the distance to the first wall or pillar along a ray, in metres; `None` if there is none.
    pub fn range(&self, from: Point, direction: Direction) -> Option<f64> {
        self.shapes.iter().filter_map(|shape| shape.distance(from, direction)).reduce(f64::min)
    }

    /// Creates a rectangle, with pillars and boxes against its walls, that is seen from two places in it.
    pub fn random(random: &mut Random) -> Self {
        let [width, depth] = [random.between(5.0, 9.0), random.between(4.0, 7.0)];
        let mut shapes = vec![Shape::polygon(&[[0.0, 0.0], [width, 0.0], [width, depth], [0.0, depth]])];
        for _ in 0..4 {
            let (at, side) = (random.between(1.0, width - 2.0), random.between(0.3, 0.8));
            // Half of them against the upper wall.
            let [low, high] =
                if random.bits().is_multiple_of(2) { [0.0, side] } else { [depth - side, depth] };
            shapes.push(Shape::polygon(&[[at, low], [at + side, low], [at + side, high], [at, high]]));
        }
        for _ in 0..2 {
            let centre = [random.between(1.0, width - 1.0), random.between(1.2, 1.5)];
            shapes.push(Shape::Disc { centre, radius: random.between(0.1, 0.3) });
        }
        let y = depth - 1.5;
        Self { shapes, route: vec![[0.3 * width, y], [0.7 * width, y - 0.4]], poses: 2 }
    }
}

/// The rooms that can be had by name.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum RoomName {
    /// Eight metres by six, with an alcove, a pillar, some furniture and an open door.
    #[default]
    Study,
    /// Corridors about a block, twelve metres by nine; the robot goes round and comes back to where it was.
    Corridors,
    /// The report's circular room, of radius two metres, seen from its centre.
    Circle,
}

impl RoomName {
    /// Returns its name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Study => "study",
            Self::Corridors => "corridors",
            Self::Circle => "circle",
        }
    }

    /// Returns the room itself.
    pub fn room(self) -> Room {
        match self {
            Self::Study => study(),
            Self::Corridors => corridors(),
            Self::Circle => {
                let wall = Shape::Disc { centre: [0.0, 0.0], radius: 2.0 };
                Room { shapes: vec![wall], route: vec![[0.0, 0.0]], poses: 1 }
            }
        }
    }
}

fn study() -> Room {
    let walls = |points: &[Point]| Shape::Walls(points.to_vec());
    let shapes = vec![
        // The outline from the door in the right wall, clockwise, with an alcove in the upper wall ...
        walls(&[[9.4, 4.3], [9.4, 1.1], [8.0, 1.1], [8.0, 0.0], [0.0, 0.0], [0.0, 6.0]]),
        walls(&[[0.0, 6.0], [2.6, 6.0], [2.6, 6.9], [4.6, 6.9], [4.6, 6.0], [8.0, 6.0]]),
        // ... and the corridor behind the door.
        walls(&[[8.0, 6.0], [8.0, 2.1], [8.4, 2.1], [8.4, 4.3]]),
        // A cupboard against the left wall, and a screen.
        walls(&[[0.0, 3.4], [0.6, 3.4], [0.6, 4.9], [0.0, 4.9]]),
        walls(&[[3.1, 1.3], [3.1, 2.6], [3.9, 2.6]]),
        // A table turned against the walls, of which a sensor near the ground sees two boards.
        walls(&[[6.2, 3.9], [7.1, 4.4]]),
        walls(&[[5.8, 4.6], [6.7, 5.1]]),
        Shape::Disc { centre: [5.5, 2.4], radius: 0.3 },
    ];
    let route = vec![[1.3, 1.1], [1.6, 3.0], [3.6, 4.6], [4.6, 3.6], [5.1, 1.1], [6.9, 1.5], [7.2, 3.2]];
    Room { shapes, route, poses: 7 }
}

fn corridors() -> Room {
    let block = |[left, low]: Point, [right, high]: Point| {
        Shape::polygon(&[[left, low], [right, low], [right, high], [left, high]])
    };
    let pillar = |centre| Shape::Disc { centre, radius: 0.2 };
    let shapes = vec![
        // Niches in the outer wall tell one corridor from the other.
        Shape::polygon(&[
            [0.0, 0.0],
            [4.0, 0.0],
            [4.0, -0.6],
            [5.2, -0.6],
            [5.2, 0.0],
            [12.0, 0.0],
            [12.0, 5.5],
            [12.7, 5.5],
            [12.7, 6.9],
            [12.0, 6.9],
            [12.0, 9.0],
            [3.0, 9.0],
            [3.0, 9.5],
            [1.8, 9.5],
            [1.8, 9.0],
            [0.0, 9.0],
        ]),
        block([2.0, 2.0], [10.0, 7.0]),
        block([7.5, 1.6], [8.5, 2.0]),
        block([0.0, 6.0], [0.4, 6.8]),
        pillar([0.3, 2.4]),
        pillar([9.2, 0.3]),
        pillar([6.5, 8.7]),
    ];
    let route = vec![[1.0, 4.0], [1.0, 1.0], [11.0, 1.0], [11.0, 8.0], [1.0, 8.0], [1.0, 1.0], [4.0, 1.0]];
    Room { shapes, route, poses: 45 }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::scan::Pose;

    /// No wall stands in the way, and nothing is nearer than 20 cm to a place where the robot stops.
    #[test]
    fn the_routes_are_free() {
        let mut random = Random::new(40);
        let named = RoomName::value_variants().iter().map(|name| name.room());
        for room in named.chain((0..100).map(|_| Room::random(&mut random))) {
            for ends in room.route.windows(2) {
                let [dx, dy] = [0, 1].map(|k| ends[1][k] - ends[0][k]);
                let ahead = Direction::new(&[libm::atan2(dy, dx)]).unwrap();
                assert!(
                    room.range(ends[0], ahead).is_none_or(|range| range > libm::hypot(dx, dy)),
                    "{ends:?}"
                );
            }
            for place in super::super::trajectory::along(&room.route, 60).unwrap().iter().map(Pose::position)
            {
                let range = |k: u32| room.range(place, Direction::new(&[0.1 * f64::from(k)]).unwrap());
                assert!((0..63).filter_map(range).all(|range| range > 0.2), "{place:?}");
            }
        }
    }

    #[test]
    fn the_walls_are_where_the_rays_meet_them() {
        let study = RoomName::Study.room();
        for (from, [dx, dy], distance) in [
            ([1.3, 1.1], [-1.0, 0.0], 1.3),
            ([4.0, 1.5], [1.0, 0.0], 5.4),
            ([4.6, 3.6], [0.0, -1.0], 3.6),
            ([4.6, 2.4], [1.0, 0.0], 0.6),
            ([3.0, 5.0], [0.0, 1.0], 1.9),
            ([7.4, 1.5], [0.6, 0.8], 1.0),
        ] {
            let direction = Direction::new(&[libm::atan2(dy, dx)]).unwrap();
            let found = study.range(from, direction).unwrap();
            assert!((found - distance).abs() < 1e-12, "from {from:?}: {found}, not {distance}");
        }
        let upwards = Direction::new(&[std::f64::consts::FRAC_PI_2]).unwrap();
        assert_eq!(study.range([9.0, 3.0], upwards), None);
        let circle = RoomName::Circle.room();
        for angle in [0.0, 0.7, 2.5, -1.1] {
            let found = circle.range([0.0, 0.0], Direction::new(&[angle]).unwrap()).unwrap();
            assert!((found - 2.0).abs() < 1e-15, "{found}");
        }
    }
}
