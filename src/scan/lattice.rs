//! Places in the plane as integers: the lattice of `2^-28` of a cell, on which everything is exact.

use super::direction::Direction;
use crate::real::Real;
use crate::rounded::{Coordinate, distance, distance_by_square, normalised};

/// The number of units of a cell's side, as an exponent of two.
pub(super) const FRACTION: u32 = 28;
/// The same as a number.
const UNITS: f64 = (1_u64 << FRACTION) as f64;
/// Places stay below this in magnitude: `2^33` cells, so that differences fit 62 bits and their products 124.
const END: u64 = 1 << (33 + FRACTION);

/// The lower half of 128 bits.
const LOW: u128 = u64::MAX as u128;

/// The lattice of a grid with cells of this side in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Lattice {
    resolution: f64,
    /// The resolution is `m 2^exponent`, `2^52 <= m < 2^53`, and this is `floor(2^179 / m)`: above `2^126`.
    inverse: u128,
    exponent: i32,
    /// The number of units of a metre, less up to a part in `2^49`, and more up to that.
    units_per_metre: [f64; 2],
}

/// A point of the lattice: x and y.
pub(super) type Point = [i64; 2];

/// Finds the cell that holds a point.
#[inline]
pub(super) fn cell_of(point: Point) -> [i64; 2] {
    point.map(|x| x >> FRACTION)
}

impl Lattice {
    /// Creates the lattice of a resolution that is positive and finite.
    pub(super) fn new(resolution: f64) -> Self {
        let (m, exponent) = normalised(resolution);
        let m = u128::from(m);
        // Long division by two digits, of 127 and of 52 bits.
        let (high, rest) = ((1 << 127) / m, (1 << 127) % m);
        // A metre has more units of the smallest resolutions than a float can say.
        let units = UNITS / resolution;
        let units_per_metre = if units.is_finite() {
            [1.0 - 6.0 * f64::EPSILON, 1.0 + 6.0 * f64::EPSILON].map(|part| units * part)
        } else {
            [0.0, f64::INFINITY]
        };
        Self { resolution, inverse: (high << 52) + (rest << 52) / m, exponent, units_per_metre }
    }

    /// Returns the side of a cell, in metres.
    pub(super) fn resolution(self) -> f64 {
        self.resolution
    }

    /// Returns the number of units of a metre, within a part in `2^52`; an infinity for the smallest resolutions.
    #[inline]
    pub(super) fn units(self) -> f64 {
        UNITS / self.resolution
    }

    /// Returns the point that is so many units away; `None` beyond [`END`].
    #[inline]
    pub(super) fn moved(start: Point, by: Point) -> Option<Point> {
        let point = [start[0] + by[0], start[1] + by[1]];
        point.iter().all(|x| x.unsigned_abs() <= END).then_some(point)
    }

    /// Finds the lattice point nearest to a coordinate in metres, ties to even; `None` beyond [`END`].
    pub(super) fn nearest(self, x: f64) -> Option<i64> {
        let (m, e) = x.parts();
        self.signed(u128::from(m), e, x < 0.0)
    }

    /// Finds the lattice point nearest to the one at `distance` metres from `start`, a positive float; `None` beyond [`END`].
    #[inline]
    pub(super) fn along(self, start: Point, direction: Direction, distance: f64) -> Option<Point> {
        let (m, e) = distance.parts();
        // The quotient by the resolution times 2^115, exponents aside, short by less than 2; and its product with a coordinate,
        // in units of 2^-(85 + exponent - e), short by less than 2: `scan.md`, Theorem (ends).
        let [high, low] = [self.inverse >> 64, self.inverse & LOW];
        let quotient = u128::from(m) * high + ((u128::from(m) * low) >> 64);
        let [high, low] = [quotient >> 64, quotient & LOW];
        let shift = self.exponent - e + (85 - 64);
        let coordinate = |start: i64, unit: i64| {
            let magnitude = u128::from(unit.unsigned_abs());
            let product = high * magnitude + ((low * magnitude) >> 64);
            let moved = match decided(product, shift) {
                Some(moved) if unit < 0 => -moved,
                Some(moved) => moved,
                // A significand below 2^53 times units of 2^-62, exactly; the one rounding is that to the lattice:
                // `scan.md`, "Which cells", 2.
                None => self.signed(u128::from(m) * magnitude, e - 62, unit < 0)?,
            };
            let moved = start + moved;
            (moved.unsigned_abs() <= END).then_some(moved)
        };
        let [cos, sin] = direction.units();
        Some([coordinate(start[0], cos)?, coordinate(start[1], sin)?])
    }

    /// Finds what [`along`](Self::along) does from the exact quotients alone.
    #[cfg(test)]
    pub(super) fn along_exactly(self, start: Point, direction: Direction, distance: f64) -> Option<Point> {
        let (m, e) = distance.parts();
        let coordinate = |start: i64, unit: i64| {
            let product = u128::from(m) * u128::from(unit.unsigned_abs());
            let moved = start + self.signed(product, e - 62, unit < 0)?;
            (moved.unsigned_abs() <= END).then_some(moved)
        };
        let [cos, sin] = direction.units();
        Some([coordinate(start[0], cos)?, coordinate(start[1], sin)?])
    }

    /// Converts `±m 2^e` metres to lattice units, rounded to nearest.
    fn signed(self, m: u128, e: i32, negative: bool) -> Option<i64> {
        let (divisor, exponent) = self.resolution.parts();
        let magnitude =
            quotient(m, e + FRACTION as i32 - exponent, divisor).filter(|&q| q <= u128::from(END))?;
        Some(if negative { -(magnitude as i64) } else { magnitude as i64 })
    }

    /// Converts metres to units, rounded down by a part in `2^49` and two units at most; 0 for NaN, at most `2^62`.
    #[inline]
    pub(super) fn units_within(self, metres: f64) -> u64 {
        // Three roundings up by half an ulp each, at most.
        ((metres * self.units_per_metre[0]) as i64).clamp(0, 2 * END as i64) as u64
    }

    /// Returns a square such that a distance is at most so many metres if its square in units, computed within a part in `2^51`, is at
    /// most that: 0 below 0, and for NaN.
    #[inline]
    pub(super) fn square_within(self, metres: f64) -> f64 {
        let units = metres.max(0.0) * self.units_per_metre[0];
        units * units
    }

    /// Returns a square such that a distance is no less than so many metres if its square in units, computed within a part in `2^51`, is
    /// no less than that. It is 4 below 0, and an infinity for NaN and where units are too many for a float.
    #[inline]
    pub(super) fn square_beyond(self, metres: f64) -> f64 {
        // Where units are below the smallest normal number, two of them make up for it.
        let units = metres.clamp(0.0, f64::INFINITY) * self.units_per_metre[1] + 2.0;
        // Of NaN and an infinity the latter.
        (units * units).min(f64::INFINITY)
    }

    /// Computes the square of the distance of a point from the centre of a cell, in units: exactly, below `2^125`.
    #[inline]
    fn square_to_centre(from: Point, cell: [i64; 2]) -> u128 {
        // Below 2^62 each: no product leaves 128 bits, and nothing is rounded.
        let [x, y] = offset_of_centre(from, cell);
        let square = |offset: i64| u128::from(offset.unsigned_abs()) * u128::from(offset.unsigned_abs());
        square(x) + square(y)
    }

    /// Computes the distance in metres of a point from the centre of a cell: the nearest float, ties to even.
    #[inline]
    pub(super) fn distance_to_centre(self, from: Point, cell: [i64; 2]) -> f64 {
        let square = Self::square_to_centre(from, cell);
        distance_by_square(self.resolution, -(FRACTION as i32), square)
            .unwrap_or_else(|| self.distance_exactly(from, cell))
    }

    /// Finds what [`distance_to_centre`](Self::distance_to_centre) does where 64 bits of the root do not decide it.
    #[cold]
    fn distance_exactly(self, from: Point, cell: [i64; 2]) -> f64 {
        let [x, y] = offset_of_centre(from, cell).map(|offset| {
            Coordinate::new(offset >> FRACTION, (offset & ((1 << FRACTION) - 1)) as f64 / UNITS)
        });
        distance(self.resolution, 0, x, y)
    }
}

/// Rounds `x 2^-(64 + shift)` to nearest, for an `x` below `2^117` that may be short by less than 2; `None` where its bits do not
/// decide it, the shift is not one of 0 to 63, or the result is not below [`END`].
#[inline]
fn decided(x: u128, shift: i32) -> Option<i64> {
    if !(0..64).contains(&shift) {
        return None;
    }
    // Short by less than 3, in units of 2^-64.
    let x = x >> shift;
    let (whole, part) = ((x >> 64) as u64, x as u64);
    let is_decided = part.wrapping_sub((1 << 63) - 3) > 3 && whole < END;
    is_decided.then_some((whole + (part >> 63)) as i64)
}

/// Returns how far the centre of a cell is from a point, in units.
#[inline]
fn offset_of_centre(from: Point, cell: [i64; 2]) -> Point {
    let offset = |k: usize| (cell[k] << FRACTION) + (1 << (FRACTION - 1)) - from[k];
    [offset(0), offset(1)]
}

/// Computes `n 2^e / divisor`, rounded to nearest, ties to even; `None` from about `2^75`. `n` below `2^127`, `divisor` below
/// `2^53`.
fn quotient(n: u128, e: i32, divisor: u64) -> Option<u128> {
    if n == 0 {
        return Some(0);
    }
    let divisor = u128::from(divisor);
    let (n, divisor) = if e >= 0 {
        if e.unsigned_abs() > n.leading_zeros() {
            return None;
        }
        (n << e, divisor)
    } else {
        if e.unsigned_abs() >= divisor.leading_zeros() {
            // The divisor is 2^127 or more times what it was, above 2 n.
            return Some(0);
        }
        (n, divisor << e.unsigned_abs())
    };
    // Up above half a unit, and from half a unit where that makes it even.
    let (whole, rest) = (n / divisor, n % divisor);
    let up = rest > divisor - rest || rest == divisor - rest && whole & 1 == 1;
    Some(whole + u128::from(up))
}

#[cfg(test)]
mod tests {
    use super::*;
    use approx::abs_diff_eq;
    use num_bigint::BigInt;
    use proptest::prelude::*;

    /// `x / resolution 2^28` twice, as a fraction: the nearest integer, ties to even.
    fn nearest(x: f64, resolution: f64) -> BigInt {
        let big = |x: f64| {
            let (m, e) = x.parts();
            BigInt::from(m) << (e + 1074)
        };
        let (n, d): (BigInt, BigInt) = (big(x) << (FRACTION + 1), big(resolution));
        let whole: BigInt = (&n + &d) / (2 * &d);
        let is_tie = (&n + &d) % (2 * &d) == BigInt::ZERO;
        let even: BigInt = if is_tie && whole.bit(0) { whole - 1 } else { whole };
        if x < 0.0 { -even } else { even }
    }

    fn small() -> impl Strategy<Value = f64> {
        prop_oneof![
            -1e4..1e4,
            (-600_i32..20).prop_map(|e| 1.7 * f64::from_parts(1, e)),
            (-64_i32..64).prop_map(|k| f64::from(k) / 64.0),
            // Half-way between two places, for the resolution 0.25.
            (-64_i32..64).prop_map(|k| f64::from(k) * f64::from_parts(1, -31))
        ]
    }

    proptest! {
        #[test]
        fn places_are_the_nearest(x in small(), resolution in prop_oneof![0.001_f64..10.0, Just(0.25), Just(3.0)]) {
            prop_assert_eq!(BigInt::from(Lattice::new(resolution).nearest(x).unwrap()), nearest(x, resolution));
        }

        /// The end of a beam is within one unit of the place computed in floats, as far as those go.
        #[test]
        fn ends_lie_along_the_direction(angle in -9.0_f64..9.0, distance in 0.0_f64..1000.0, resolution in 0.01_f64..10.0) {
            let direction = Direction::new(&[angle]).unwrap();
            let start = [12_345_678_901, -98_765_432_109];
            let end = Lattice::new(resolution).along(start, direction, distance).unwrap();
            for (k, unit) in [direction.cos(), direction.sin()].into_iter().enumerate() {
                let expected = distance * unit / resolution * f64::from_parts(1, FRACTION as i32);
                let moved = (end[k] - start[k]) as f64;
                prop_assert!(abs_diff_eq!(moved, expected, epsilon = 0.5 + expected.abs() * 4.0 * f64::EPSILON));
            }
        }

        /// `rho^2` against the integers: half an ulp of `rho`, one of the quotient below, and their squares.
        #[test]
        fn distances_are_those_of_the_centre(x in -1_i64 << 50..1 << 50, y in -1_i64 << 50..1 << 50, column in -1_i64 << 22..1 << 22, row in -1_i64 << 22..1 << 22, e in -4_i32..4) {
            let resolution = 1.5 * f64::from_parts(1, e);
            let rho = Lattice::new(resolution).distance_to_centre([x, y], [column, row]);
            let offset = |cell: i64, from: i64| BigInt::from((2 * cell + 1) * (1 << (FRACTION - 1)) - from);
            let square = offset(column, x).pow(2) + offset(row, y).pow(2);
            let (m, exponent) = (rho / resolution).parts();
            // Of the quotient, another half ulp.
            let found = BigInt::from(m).pow(2);
            let shift = -2 * (exponent + FRACTION as i32);
            let exact = if shift >= 0 { square << shift } else { square >> -shift };
            let error: BigInt = if found > exact { &found - &exact } else { &exact - &found };
            prop_assert!(error << 51 <= exact * 2_u32, "{rho}");
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10_000))]

        /// The bits of the distance by its two coordinates, of short and of long ones and of triples as 3, 4, 5, too.
        #[test]
        fn distances_are_those_by_coordinates(x in -1_i64 << 60..1 << 60, y in -1_i64 << 60..1 << 60, shift in 0_u32..61, k in 0_i64..9, resolution in prop_oneof![0.001_f64..10.0, Just(0.25), Just(0.05), Just(1e-300), Just(f64::from_bits(77))]) {
            let lattice = Lattice::new(resolution);
            let unit = 1_i64 << (shift / 2);
            let half = 1 << (FRACTION - 1);
            for from in [[x >> shift, y >> shift], [half - 3 * k * unit, half + 4 * k * unit]] {
                prop_assert_eq!(lattice.distance_to_centre(from, [0, 0]), lattice.distance_exactly(from, [0, 0]));
            }
        }
    }

    proptest! {
        /// Not more than the metres, as integers of any size, and less by two units and a part in `2^49` at most.
        #[test]
        fn units_are_within_their_metres(metres in small(), far in any::<bool>(), resolution in prop_oneof![0.1_f64..10.0, Just(0.25)]) {
            let metres = metres.abs() * if far { 1e3 } else { 1.0 };
            let units = BigInt::from(Lattice::new(resolution).units_within(metres));
            let big = |x: f64| {
                let (m, e) = x.parts();
                BigInt::from(m) << (e + 1074)
            };
            let exact = big(metres) << FRACTION;
            prop_assert!(&units * big(resolution) <= exact);
            let more: BigInt = (&units + 2) + (&units >> 49);
            prop_assert!(more * big(resolution) >= exact);
        }

        /// As the distance says, which is a float, with the square off by as much as it may be; and no further than that, two units and
        /// parts in `2^48`.
        #[test]
        fn squares_are_those_of_distances(x in -1_i64 << 40..1 << 40, y in -1_i64 << 40..1 << 40, column in -99_i64..99, row in -99_i64..99, metres in prop_oneof![0.0_f64..40.0, Just(-1.0)], is_there in any::<bool>(), step in 0_usize..3) {
            let lattice = Lattice::new(0.3);
            let rho = lattice.distance_to_centre([x, y], [column, row]);
            let metres = if is_there { [rho.next_down(), rho, rho.next_up()][step] } else { metres };
            let exact = Lattice::square_to_centre([x, y], [column, row]) as f64;
            for square in [exact * (1.0 - 2.0 * f64::EPSILON), exact, exact * (1.0 + 2.0 * f64::EPSILON)] {
                let (within, beyond) = (lattice.square_within(metres), lattice.square_beyond(metres));
                prop_assert!(square > within || rho <= metres);
                prop_assert!(square < beyond || rho >= metres);
                prop_assert!(square <= within || square >= beyond || (rho - metres.max(0.0)).abs() < 4e-9 + 1e-14 * rho);
            }
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(10_000))]

        /// The bits of the exact quotient rounded once, with directions along the axes and lengths that end in the middle of two
        /// places.
        #[test]
        fn ends_are_those_of_the_exact_quotient(
            angle in prop_oneof![-9.0_f64..9.0, Just(0.0), (0_i32..200).prop_map(|k| f64::from(k) * 0.0174)],
            distance in prop_oneof![small(), 0.0_f64..100.0].prop_map(f64::abs),
            resolution in prop_oneof![0.001_f64..10.0, Just(0.25), Just(0.05), Just(1e-300), Just(f64::from_bits(77))],
            start in [-1_i64 << 50..1 << 50, -1_i64 << 50..1 << 50],
        ) {
            let (lattice, direction) = (Lattice::new(resolution), Direction::new(&[angle]).unwrap());
            prop_assert_eq!(lattice.along(start, direction, distance), lattice.along_exactly(start, direction, distance));
        }
    }

    #[test]
    fn the_ends_of_a_length() {
        let lattice = Lattice::new(0.3);
        let units = [f64::NAN, -3.0, 0.0, f64::INFINITY, f64::MAX].map(|metres| lattice.units_within(metres));
        assert_eq!(units, [0, 0, 0, 1 << 62, 1 << 62]);
        let ends = |metres| (lattice.square_within(metres), lattice.square_beyond(metres));
        assert_eq!([-3.0, 0.0].map(ends), [(0.0, 4.0); 2]);
        assert_eq!(ends(f64::NAN), (0.0, f64::INFINITY));
        assert_eq!(ends(f64::INFINITY), (f64::INFINITY, f64::INFINITY));
        // No units, of which a square would be more than another.
        for resolution in [f64::from_bits(1), 1e-310] {
            let lattice = Lattice::new(resolution);
            for metres in [-1.0, 0.0, resolution, f64::NAN] {
                let ends = (lattice.square_within(metres), lattice.square_beyond(metres));
                assert_eq!(ends, (0.0, f64::INFINITY));
            }
        }
        assert!(Lattice::new(f64::MAX).square_beyond(f64::MAX) >= f64::from_parts(1, 2 * FRACTION as i32));
        assert_eq!(Lattice::square_to_centre([1 << 27, 1 << 27], [0, 0]), 0);
        // 3, 4, 5.
        assert_eq!(Lattice::square_to_centre([(1 << 27) - 3, (1 << 27) + 4], [0, 0]), 25);
    }

    #[test]
    fn places_beyond_the_lattice_are_none() {
        let lattice = Lattice::new(0.5);
        let end = f64::from_parts(1, 32);
        assert_eq!((lattice.nearest(end), lattice.nearest(-end)), (Some(1 << 61), Some(-1 << 61)));
        for x in [end.next_up(), 1e300, f64::MAX] {
            assert_eq!((lattice.nearest(x), lattice.nearest(-x)), (None, None));
        }
        let direction = Direction::new(&[0.0]).unwrap();
        assert_eq!(lattice.along([1 << 61, 0], direction, 0.5), None);
        assert_eq!(lattice.along([1 << 61, 0], direction, 1e-30), Some([1 << 61, 0]));
        for resolution in [f64::from_bits(1), f64::MAX] {
            let lattice = Lattice::new(resolution);
            assert_eq!(lattice.nearest(0.0), Some(0));
            assert_eq!(lattice.nearest(resolution), Some(1 << FRACTION));
        }
        assert_eq!(Lattice::new(f64::MAX).nearest(f64::from_bits(1)), Some(0));
        assert_eq!(Lattice::new(f64::from_bits(1)).nearest(f64::MAX), None);
    }
}
