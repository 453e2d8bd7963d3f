//! Rooms, and their bounds.

use mean_information::limit::{Weight, bounds, closed_form};
use mean_information::room::{CartesianRoom, PolarRoom, Sampling};
use mean_information::sensor::GaussianSensor;
use mean_information::{Error, Real, Tally};

/// Checks rooms of any size in either grid and format. The bytes are the format and how the rest is meant, the sampling, and the
/// range, sigma, resolution and offsets: as bits, or so that the room is of a size that can be counted.
pub fn room(bytes: &[u8]) {
    let Some((&[mode, per_side], rest)) = bytes.split_first_chunk() else {
        return;
    };
    let sampling = if per_side == 0 { Sampling::Centre } else { Sampling::Averaged(per_side.into()) };
    if mode & 1 == 0 {
        check_room(&numbers(rest, f64::from_le_bytes), mode & 2 != 0, sampling);
    } else {
        check_room(&numbers(rest, f32::from_le_bytes), mode & 2 != 0, sampling);
    }
}

/// The first five numbers, 0 where there are none.
fn numbers<T: Real, const N: usize>(bytes: &[u8], number: fn([u8; N]) -> T) -> [T; 5] {
    let mut numbers = bytes.as_chunks().0.iter().map(|&bytes| number(bytes));
    [(); 5].map(|()| numbers.next().unwrap_or(T::zero()))
}

/// A room is refused in words, or its tally is that of its map, in any mirror image, and within its bounds of the limit.
fn check_room<T: Real>(&[z, sigma, h, x, y]: &[T; 5], countable: bool, sampling: Sampling) {
    let (sigma, h) = if countable { (near(z, sigma, 9), near(z, h, 5)) } else { (sigma, h) };
    let Some(sensor) = accepted(GaussianSensor::new(z, sigma)) else {
        return;
    };
    let polar = accepted(PolarRoom::new(sensor, h).and_then(|room| room.with_sampling(sampling)));
    if let Some(room) = polar.map(|room| room.with_limit(MAX_SAMPLES))
        && let Some(tally) = accepted(room.tally())
    {
        let map = room.map(1, 1 << 16).expect("a map of a room that can be counted");
        assert_eq!(tally, map.tally());
        let count = tally.observed();
        let bounds = [bounds::polar(&sensor, h), bounds::polar_with_count(&sensor, h, count)];
        check_limit(&tally, sampling, closed_form(&sensor, Weight::Radial), bounds);
    }
    let cartesian =
        |offsets| CartesianRoom::new(sensor, h, offsets).and_then(|room| room.with_sampling(sampling));
    if let Some(room) = accepted(cartesian([x, y])).map(|room| room.with_limit(MAX_SAMPLES))
        && let Some(tally) = accepted(room.tally())
    {
        match room.map(1 << 16) {
            Ok(map) => assert_eq!(tally, map.tally()),
            // What can be counted may begin beyond the largest float.
            Err(error) => assert!(
                matches!(error, Error::OutOfRange { what: "origin", value, .. } if value.is_infinite())
            ),
        }
        let turned = cartesian([y, -x]).expect("as good as the other").tally();
        assert_eq!(turned.as_ref(), Ok(&tally));
        let count = tally.observed();
        let bounds = [bounds::cartesian(&sensor, h), bounds::cartesian_with_count(&sensor, h, count)];
        check_limit(&tally, sampling, closed_form(&sensor, Weight::Area), bounds);
    }
}

/// Few, so that a run is quick, and refusals are met.
const MAX_SAMPLES: u64 = 1 << 12;

/// `z` scaled by a power of two of up to `2^-bits` or `2^bits`, and by up to 2, both from the bits of `x`.
fn near<T: Real>(z: T, x: T, bits: i32) -> T {
    let (m, e) = x.parts();
    z * T::from_parts(m | 1 << (T::PRECISION - 1), e.rem_euclid(2 * bits + 1) - bits - T::PRECISION as i32)
}

/// What was built, or nothing if it was refused, in words.
fn accepted<T>(built: Result<T, Error>) -> Option<T> {
    built.inspect_err(|error| assert!(!error.to_string().is_empty())).ok()
}

fn check_limit<T: Real>(tally: &Tally<T>, sampling: Sampling, limit: T, bounds: [Result<T, Error>; 2]) {
    let mean = tally.mean_information();
    assert!(mean >= T::zero() && mean <= T::one());
    for bound in bounds {
        let bound = bound.expect("a bound of a room that can be counted");
        assert!(bound > T::zero() && bound <= T::one());
        // The limit is itself rounded, and the difference: an ulp of 1.
        let error = (mean - limit).abs();
        assert!(
            sampling != Sampling::Centre || error <= bound + T::epsilon(),
            "{mean} is {error} from {limit}"
        );
    }
}
