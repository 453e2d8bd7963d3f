//! Where the robot stops, and where it believes to be.

use super::{Point, Random};
use mean_information::Error;
use mean_information::elementary::sqrt;
use mean_information::scan::{Direction, Pose};

/// Returns `count` poses along a route, at equal distances from its first point to its last, each heading along it;
/// one alone is at the first point.
///
/// # Errors
/// A point of the route that is not finite.
pub fn along(route: &[Point], count: usize) -> Result<Vec<Pose>, Error> {
    let legs: Vec<Leg> = route.windows(2).map(|ends| Leg::between(ends[0], ends[1])).collect();
    let length: f64 = legs.iter().map(|leg| leg.length).sum();
    let place = |k: usize| {
        let mut left = length * k as f64 / count.saturating_sub(1).max(1) as f64;
        for (index, leg) in legs.iter().enumerate() {
            if left < leg.length || index + 1 == legs.len() {
                let [x, y] = leg.at(left.min(leg.length));
                return Pose::new(x, y, leg.heading);
            }
            left -= leg.length;
        }
        let [x, y] = route.first().copied().unwrap_or_default();
        Pose::new(x, y, 0.0)
    };
    (0..count).map(place).collect()
}

/// A straight part of a route.
struct Leg {
    start: Point,
    end: Point,
    length: f64,
    heading: f64,
}

impl Leg {
    fn between(start: Point, end: Point) -> Self {
        let [x, y] = [end[0] - start[0], end[1] - start[1]];
        Self { start, end, length: sqrt(x * x + y * y), heading: libm::atan2(y, x) }
    }

    fn at(&self, distance: f64) -> Point {
        let part = if self.length > 0.0 { distance / self.length } else { 0.0 };
        [0, 1].map(|k| self.start[k] + part * (self.end[k] - self.start[k]))
    }
}

/// Returns the poses in which a robot that was at `poses` believes to be by its odometry: the first pose is known, and
/// each way from one to the next is [measured](Motion::measured). Without drift the poses are as they are.
///
/// # Errors
/// A drift that is negative or not finite.
pub fn drifted(poses: &[Pose], drift: f64, random: &mut Random) -> Result<Vec<Pose>, Error> {
    if !(drift >= 0.0 && drift.is_finite()) {
        return Err(Error::out_of_range("drift", drift, "0 or more, and finite"));
    }
    let mut believed: Vec<Pose> = poses.iter().take(1).copied().collect();
    for ends in poses.windows(2) {
        if drift == 0.0 {
            believed.push(ends[1]);
        } else if let Some(last) = believed.last() {
            let motion = Motion::between(&ends[0], &ends[1])?;
            believed.push(motion.measured(drift, random).from(last)?);
        }
    }
    Ok(believed)
}

/// The way from one pose to the next, in the robot's own frame at the first.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    ahead: f64,
    aside: f64,
    turn: f64,
}

impl Motion {
    /// Returns the way between two poses.
    ///
    /// # Errors
    /// Never for poses, whose numbers are finite.
    pub fn between(start: &Pose, end: &Pose) -> Result<Self, Error> {
        let ([x0, y0], [x1, y1]) = (start.position(), end.position());
        let (dx, dy) = (x1 - x0, y1 - y0);
        let heading = Direction::new(&[start.theta()])?;
        Ok(Self {
            ahead: dx * heading.cos() + dy * heading.sin(),
            aside: dy * heading.cos() - dx * heading.sin(),
            turn: end.theta() - start.theta(),
        })
    }

    /// Returns the way as odometry measures it.
    ///
    /// On `d` metres, the errors ahead and aside are normal with standard deviation `drift √d` metres, and that of the
    /// turn with `drift √d` radians: a random walk, which adds up by composing the poses.
    #[must_use]
    pub fn measured(&self, drift: f64, random: &mut Random) -> Self {
        let deviation = drift * sqrt(sqrt(self.ahead * self.ahead + self.aside * self.aside));
        let mut measured = |exact: f64| exact + deviation * random.normal();
        Self { ahead: measured(self.ahead), aside: measured(self.aside), turn: measured(self.turn) }
    }

    /// Returns the pose to which it leads from a pose.
    ///
    /// # Errors
    /// A place or heading that is not finite.
    pub fn from(&self, start: &Pose) -> Result<Pose, Error> {
        let heading = Direction::new(&[start.theta()])?;
        let [x, y] = start.position();
        Pose::new(
            x + self.ahead * heading.cos() - self.aside * heading.sin(),
            y + self.ahead * heading.sin() + self.aside * heading.cos(),
            start.theta() + self.turn,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn poses_at_equal_distances_along_a_bent_route() {
        let route = [[0.5, 0.25], [3.5, 0.25], [3.5, 1.75]];
        let poses = along(&route, 4).unwrap();
        let places: Vec<_> = poses.iter().map(Pose::position).collect();
        assert_eq!(places, [[0.5, 0.25], [2.0, 0.25], [3.5, 0.25], [3.5, 1.75]]);
        let headings: Vec<_> = poses.iter().map(Pose::theta).collect();
        let quarter = std::f64::consts::FRAC_PI_2;
        assert_eq!(headings, [0.0, 0.0, quarter, quarter]);
        assert_eq!(along(&route, 1).unwrap(), poses[..1]);
        assert_eq!(along(&route[..1], 3).unwrap(), [Pose::new(0.5, 0.25, 0.0).unwrap(); 3]);
        assert!(along(&route, 0).unwrap().is_empty());
    }

    /// After 9 m in 30 steps the variance of a component is that of the walk, within what 600 robots can tell.
    #[test]
    fn the_drift_has_the_variance_it_says() {
        let poses = along(&[[2.0, 1.0], [11.0, 1.0]], 31).unwrap();
        let (drift, robots) = (0.001, 600);
        let mut random = Random::new(3);
        let (mut ahead, mut heading) = (0.0, 0.0);
        for _ in 0..robots {
            let last = drifted(&poses, drift, &mut random).unwrap()[30];
            ahead += (last.position()[0] - 11.0) * (last.position()[0] - 11.0);
            heading += last.theta() * last.theta();
        }
        // The variance of a variance of n normal deviates is 2 / n of its square; six deviations.
        let tolerance = 6.0 * (2.0 / f64::from(robots)).sqrt();
        for variance in [ahead, heading] {
            let part = variance / f64::from(robots) / (drift * drift * 9.0);
            assert!((part - 1.0).abs() < tolerance, "{part}");
        }
    }

    /// Without an error the way leads from the first pose to the second, up to rounding: numbers up to 16, and the
    /// squares of a cosine and a sine, each within an ulp.
    #[test]
    fn the_way_between_two_poses_leads_to_the_second() {
        let mut random = Random::new(13);
        for _ in 0..100 {
            let mut pose = || {
                let [x, y] = [random.between(-6.0, 9.0), random.between(-8.0, 3.0)];
                Pose::new(x, y, random.between(-7.0, 7.0)).unwrap()
            };
            let [start, end] = [pose(), pose()];
            let there = Motion::between(&start, &end).unwrap().from(&start).unwrap();
            let off = |a: f64, b: f64| (a - b).abs() > 16.0 * 16.0 * f64::EPSILON;
            assert!(!off(there.theta(), end.theta()));
            assert!((0..2).all(|k| !off(there.position()[k], end.position()[k])), "{there:?} {end:?}");
        }
    }

    #[test]
    fn without_drift_the_poses_are_known() {
        let poses = along(&[[2.0, 1.0], [11.0, 1.5], [3.0, -4.0]], 17).unwrap();
        assert_eq!(drifted(&poses, 0.0, &mut Random::new(5)).unwrap(), poses);
        assert_eq!(drifted(&poses, 0.1, &mut Random::new(5)).unwrap()[0], poses[0]);
        for bad in [-0.1, f64::NAN, f64::INFINITY] {
            assert!(drifted(&poses, bad, &mut Random::new(5)).is_err());
        }
    }
}
