//! The ends of beams on the lattice: in floats where those decide the nearest place, else by exact quotients.

use super::direction::Direction;
use super::lattice::{Lattice, Point};
use crate::rounded::{short_cos_sin, short_turns, turns};

/// Where beams of one scan begin, and the heading, in turns modulo 1 in units of `2^-128`.
pub(super) struct Ends {
    lattice: Lattice,
    /// The number of units of a metre.
    units: f64,
    start: Point,
    heading: u128,
}

impl Ends {
    /// Begins at a place with a heading in radians.
    pub(super) fn new(lattice: Lattice, start: Point, heading: f64) -> Self {
        Self { lattice, units: lattice.units(), start, heading: turns(heading) }
    }

    /// Finds where a beam of so many metres ends whose bearing (radians) is measured from the heading; `None` beyond the lattice.
    /// Returns, too, how much of the beam lies along the axis along which it goes further, within `2^-51`.
    #[inline]
    pub(super) fn end(&self, bearing: f64, length: f64) -> Option<(Point, f64)> {
        let [cos, sin] = short_cos_sin(((self.heading >> 64) as u64).wrapping_add(short_turns(bearing)));
        let scale = length * self.units;
        let end = match [cos, sin].map(|part| decided(scale * part, scale)) {
            [Some(x), Some(y)] => Lattice::moved(self.start, [x, y]),
            _ => self.exactly(bearing, length),
        }?;
        Some((end, cos.abs().max(sin.abs())))
    }

    /// Finds what [`end`](Self::end) does by the direction of the exact sum of heading and bearing.
    #[cold]
    fn exactly(&self, bearing: f64, length: f64) -> Option<Point> {
        let direction = Direction::of_turns(self.heading.wrapping_add(turns(bearing)));
        self.lattice.along(self.start, direction, length)
    }
}

/// Rounds a coordinate of the end of a beam of `scale` units to nearest; `None` if its bits do not decide it (`scan.md`, Theorem
/// (ends in floats)).
#[inline]
fn decided(x: f64, scale: f64) -> Option<i64> {
    // Floats from here on are integers, and a sum is rounded to one.
    const INTEGERS: f64 = 1.5 * (1_u64 << 52) as f64;
    let nearest = (x + INTEGERS).to_bits().wrapping_sub(INTEGERS.to_bits()) as i64;
    let error = scale * (1.0 / (1_u64 << 49) as f64) + 1.0 / 1024.0;
    // An error of less than 1/8 where it is true; not so for NaN. Compared with the integer, as units of more bits round no sum to one.
    let is_decided = scale < (1_u64 << 45) as f64 && (x - nearest as f64).abs() < 0.5 - error;
    is_decided.then_some(nearest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::real::Real;
    use proptest::prelude::*;

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        /// The bits of the exact direction and quotient, of beams along the axes and those that end in the middle of two places, too.
        #[test]
        fn ends_are_those_of_exact_quotients(
            heading in prop_oneof![-9.0_f64..9.0, Just(0.0), -1e18_f64..1e18],
            bearing in prop_oneof![-9.0_f64..9.0, Just(0.0), (-8_i32..9).prop_map(|k| f64::from(k) * std::f64::consts::FRAC_PI_4), -1e300_f64..1e300, Just(f64::from_bits(3))],
            length in prop_oneof![0.0_f64..100.0, (0_u32..1 << 20).prop_map(|k| f64::from(k) * f64::from_parts(1, -31)), (-1074_i32..40).prop_map(|e| f64::from_parts(1, e)), 0.0_f64..1e7],
            resolution in prop_oneof![0.001_f64..10.0, Just(0.25), Just(0.05), Just(1e-300), Just(f64::from_bits(77)), Just(1e300)],
            start in [-1_i64 << 61..1 << 61, -1_i64 << 50..1 << 50],
        ) {
            let lattice = Lattice::new(resolution);
            let ends = Ends::new(lattice, start, heading);
            let direction = Direction::new(&[heading, bearing]).unwrap();
            let exact = lattice.along_exactly(start, direction, length);
            let found = ends.end(bearing, length);
            prop_assert_eq!(found.map(|(end, _)| end), exact);
            if let Some((_, part)) = found {
                prop_assert!((part - direction.cos().abs().max(direction.sin().abs())).abs() < f64::from_parts(1, -51));
            }
        }
    }

    /// Nearly all ends are decided in floats, and not those half-way.
    #[test]
    fn floats_decide_what_is_not_half_way() {
        let units = (1_u64 << 34) as f64;
        assert_eq!(
            [0.25, 0.75, -0.25, -0.75].map(|part| decided(units + part, units)),
            [0, 1, 0, -1].map(|k| Some((1 << 34) + k))
        );
        assert_eq!(
            [0.25, 0.75, -0.25, -0.75].map(|part| decided(part - units, units)),
            [0, 1, 0, -1].map(|k| Some(k - (1 << 34)))
        );
        for (x, scale) in [
            (0.5, 1.0),
            (-2.5, 4.0),
            (0.4995, 1.0),
            (f64::NAN, 1.0),
            (1.0, f64::INFINITY),
            (7.0, (1_u64 << 45) as f64),
        ] {
            assert_eq!(decided(x, scale), None, "{x}");
        }
    }
}
