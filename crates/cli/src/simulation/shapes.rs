//! What rooms are made of, and where a ray meets it. Only `+ - * /` and square roots, which IEEE 754 rounds in one way.

use mean_information::scan::Direction;

/// x and y, in metres.
pub type Point = [f64; 2];

/// A part of a room.
#[derive(Clone, Debug, PartialEq)]
pub enum Shape {
    /// Straight walls from point to point. Closed, a polygon, if the last point is the first.
    Walls(Vec<Point>),
    /// A round pillar; from within, a round wall.
    Disc {
        /// The centre.
        centre: Point,
        /// The radius, in metres.
        radius: f64,
    },
}

impl Shape {
    /// Creates the polygon with these corners.
    pub fn polygon(corners: &[Point]) -> Self {
        Self::Walls(corners.iter().chain(corners.first()).copied().collect())
    }

    /// Returns the distance along a ray to this shape, in metres; `None` if the ray misses it.
    pub fn distance(&self, from: Point, direction: Direction) -> Option<f64> {
        match self {
            Self::Walls(points) => {
                let seen: Vec<_> = points.iter().map(|&point| Seen::new(point, from, direction)).collect();
                seen.windows(2).filter_map(|ends| Seen::crossing(&ends[0], &ends[1])).reduce(f64::min)
            }
            Self::Disc { centre, radius } => {
                let Seen { ahead, aside } = Seen::new(*centre, from, direction);
                // Not a number if the ray misses.
                let half_chord = ((radius - aside) * (radius + aside)).sqrt();
                [ahead - half_chord, ahead + half_chord].into_iter().find(|&distance| distance >= 0.0)
            }
        }
    }
}

/// A point as it is seen along a ray: how far ahead, and how far to the left.
struct Seen {
    ahead: f64,
    aside: f64,
}

impl Seen {
    fn new(point: Point, from: Point, direction: Direction) -> Self {
        let (x, y) = (point[0] - from[0], point[1] - from[1]);
        let (cos, sin) = (direction.cos(), direction.sin());
        Self { ahead: x * cos + y * sin, aside: y * cos - x * sin }
    }

    /// Returns the distance at which the ray crosses the wall between two points.
    ///
    /// It does if they lie on different sides of it, and a point is on the same side for both walls that end in it: no ray
    /// slips through a corner, and what is ahead is a mean of two numbers, without cancellation.
    fn crossing(a: &Self, b: &Self) -> Option<f64> {
        if (a.aside >= 0.0) == (b.aside >= 0.0) {
            return None;
        }
        let part = a.aside / (a.aside - b.aside);
        let ahead = a.ahead + part * (b.ahead - a.ahead);
        (ahead >= 0.0).then_some(ahead)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::simulation::Random;

    fn towards(angle: f64) -> Direction {
        Direction::new(&[angle]).unwrap()
    }

    /// The other way: the two linear equations of line and wall by Cramer's rule, and the quadratic one of line and
    /// circle by Vieta's.
    #[test]
    fn two_ways_to_the_same_place() {
        let mut random = Random::new(81);
        let mut hits = 0;
        for _ in 0..4000 {
            let mut point = || [random.between(-4.0, 4.0), random.between(-3.0, 5.0)];
            let [from, a, b] = [point(), point(), point()];
            let direction = towards(random.between(-4.0, 4.0));
            let (cos, sin) = (direction.cos(), direction.sin());
            let along = [b[0] - a[0], b[1] - a[1]];
            let to_a = [a[0] - from[0], a[1] - from[1]];
            let determinant = cos * along[1] - sin * along[0];
            let distance = (to_a[0] * along[1] - to_a[1] * along[0]) / determinant;
            let place = (to_a[0] * sin - to_a[1] * cos) / determinant;
            let expected = ((0.0..=1.0).contains(&place) && distance >= 0.0).then_some(distance);
            let found = Shape::Walls(vec![a, b]).distance(from, direction);
            // Products below 64, so errors below 2^-45, over the determinant; nearer than that to an edge, either will do.
            let tolerance = 3e-14 / determinant.abs();
            match (found, expected) {
                (Some(found), Some(expected)) => {
                    assert!((found - expected).abs() <= tolerance, "{found} {expected}");
                    hits += 1;
                }
                (None, None) => {}
                _ => assert!([distance, place, place - 1.0].iter().any(|x| x.abs() <= tolerance)),
            }
            let radius = random.between(0.25, 3.0);
            let found = Shape::Disc { centre: a, radius }.distance(from, direction);
            let half = to_a[0] * cos + to_a[1] * sin;
            let product = to_a[0] * to_a[0] + to_a[1] * to_a[1] - radius * radius;
            let discriminant = half * half - product;
            let first = half + if half < 0.0 { -discriminant.sqrt() } else { discriminant.sqrt() };
            let roots = [first, product / first];
            let expected = roots.into_iter().filter(|&root| root >= 0.0).reduce(f64::min);
            match (found, expected) {
                // Two roots that are near each other are ill-conditioned.
                _ if discriminant.abs() < 1e-9 || product.abs() < 1e-9 => {}
                (Some(found), Some(expected)) => {
                    assert!((found - expected).abs() <= 1e-9, "{found} {expected}");
                }
                (found, expected) => assert_eq!(found, expected),
            }
        }
        assert!(hits > 400, "{hits}");
    }

    /// Rays from within a polygon at its very corners, and a ulp beside them, are all stopped.
    #[test]
    fn no_ray_slips_through_a_corner() {
        let mut random = Random::new(56);
        for _ in 0..200 {
            let corners: Vec<Point> = (0..7)
                .map(|k| {
                    let direction = towards(f64::from(k) * 0.9 + random.between(-0.2, 0.2));
                    let radius = random.between(1.5, 4.0);
                    [radius * direction.cos(), radius * direction.sin()]
                })
                .collect();
            let polygon = Shape::polygon(&corners);
            let from = [random.between(-0.3, 0.3), random.between(-0.3, 0.3)];
            for corner in corners {
                let angle = libm::atan2(corner[1] - from[1], corner[0] - from[0]);
                for angle in [angle.next_down(), angle, angle.next_up()] {
                    // A wall ends within 4 m of the centre.
                    let distance = polygon.distance(from, towards(angle)).unwrap();
                    assert!(distance < 4.5, "{distance}");
                }
            }
        }
    }

    #[test]
    fn a_room_seen_from_known_places() {
        let square = Shape::polygon(&[[-3.0, -2.0], [5.0, -2.0], [5.0, 2.0], [-3.0, 2.0]]);
        let quarter = std::f64::consts::FRAC_PI_2;
        for (turns, distance) in [(0.0, 4.5), (1.0, 1.25), (2.0, 3.5), (3.0, 2.75)] {
            let found = square.distance([0.5, 0.75], towards(turns * quarter)).unwrap();
            assert!((found - distance).abs() < 1e-14, "{found}");
        }
        let disc = Shape::Disc { centre: [2.5, 0.75], radius: 0.5 };
        assert_eq!(disc.distance([0.5, 0.75], towards(0.0)), Some(1.5));
        assert_eq!(disc.distance([0.5, 0.75], towards(2.0 * quarter)), None);
        assert_eq!(disc.distance([2.5, 0.75], towards(0.0)), Some(0.5));
        assert_eq!(Shape::Walls(vec![[1.0, 2.0]]).distance([0.5, 0.75], towards(0.7)), None);
    }
}
