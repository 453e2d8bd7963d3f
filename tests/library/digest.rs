//! A digest of a million results in both formats: the same number on every platform and in every build.

use mean_information::cell::{
    entropy, entropy_from_log_odds, information, information_from_log_odds, occupancy_from_log_odds,
};
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::limit::{Weight, closed_form};
use mean_information::map::{Geometry, Grid, encoding::Probability};
use mean_information::sensor::{GaussianSensor, InverseSensorModel};
use mean_information::{Real, Tally, cell::Cell};

/// The digest, everywhere. If it changes and what is digested did not, results changed: say so in CHANGELOG.md.
pub(crate) const DIGEST: u64 = 0x3e0b_a3be_7730_d1b9;

/// FNV-1a over the bits of every result.
struct Digest(u64);

impl Digest {
    fn update<T: Real>(&mut self, result: T) {
        for byte in result.widen().to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

/// Xorshift: 64 fresh bits.
fn next(state: &mut u64) -> u64 {
    *state ^= *state << 13;
    *state ^= *state >> 7;
    *state ^= *state << 17;
    *state
}

/// The digest of about a million and a quarter results.
pub(crate) fn digest() -> u64 {
    let (mut digest, mut tally) = (Digest(0xcbf2_9ce4_8422_2325), Tally::new());
    let mut state = 0x9e37_79b9_7f4a_7c15;
    for _ in 0..50_000 {
        let bits = next(&mut state);
        let uniform = (bits >> 11) as f64 / (1_u64 << 53) as f64;
        // Evenly over the exponents: from the smallest subnormal to 1.
        let tiny = f64::from_bits(bits % (1.0_f64.to_bits() + 1));
        for p in [uniform, tiny] {
            digest.update(entropy(p));
            digest.update(information(p));
            digest.update(entropy(p as f32));
            digest.update(information(p as f32));
            tally.add(Cell::from_occupancy(p).expect("in [0, 1]"));
        }
        // Both tails of the log-odds, and evenly over the exponents up to 2^10.
        for l in [100.0 * (uniform - 0.5), f64::from_bits(bits % 1024.0_f64.to_bits())] {
            digest.update(entropy_from_log_odds(l));
            digest.update(information_from_log_odds(l));
            digest.update(occupancy_from_log_odds(l));
            digest.update(entropy_from_log_odds(l as f32));
            digest.update(information_from_log_odds(l as f32));
            digest.update(occupancy_from_log_odds(l as f32));
        }
        // Rooms, and quotients of every size.
        let sigma = ((bits & 0xffff) + 1) as f64 / 65536.0;
        for range in [10.0 * uniform + sigma, tiny.max(f64::MIN_POSITIVE) * 1e18] {
            let double = GaussianSensor::new(range, sigma).expect("positive and finite");
            let single = GaussianSensor::new((range as f32).max(f32::MIN_POSITIVE), sigma as f32);
            let single = single.expect("positive and finite");
            for weight in [Weight::Radial, Weight::Area] {
                digest.update(closed_form(&double, weight));
                digest.update(closed_form(&single, weight));
            }
        }
    }
    digest.update(tally.mean_information());
    digest.update(tally.entropy());
    for _ in 0..25_000 {
        let bits = next(&mut state);
        let x = f64::from_bits(bits % f64::INFINITY.to_bits());
        let [rho, range, sigma] = [0, 20, 40].map(|shift| 0.01 + 1e-4 * ((bits >> shift) % (1 << 20)) as f64);
        let sensor = GaussianSensor::new(range, sigma / 8.0).expect("positive");
        let single = GaussianSensor::new(range as f32, sigma as f32 / 8.0).expect("positive");
        for result in [exp(range - rho), ln(x), sqrt(x), sensor.occupancy(rho), sensor.reach()] {
            digest.update(result);
        }
        for result in
            [exp((range - rho) as f32), ln(rho as f32), sqrt(rho as f32), single.occupancy(rho as f32)]
        {
            digest.update(result);
        }
        let cells = [x.min(1.0), 1.0 / (1.0 + rho), sensor.occupancy(rho), 0.5].to_vec();
        let geometry = Geometry::new(0.05, [0.0, 0.0]).expect("positive");
        let map = Grid::<Probability<f64>>::new(2, 2, geometry, cells).expect("probabilities");
        digest.update(map.pooled(2).expect("a finite cell").tally().information());
    }
    digest.0
}

#[test]
fn a_million_results_have_not_changed() {
    assert_eq!(digest(), DIGEST);
}
