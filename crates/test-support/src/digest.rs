//! Digests of a million results in both formats, of integrals and of maps from scans: the same numbers on every platform and in every build.

mod scans;

use mean_information::cell::{
    entropy, entropy_from_log_odds, information, information_from_log_odds, occupancy_from_log_odds,
};
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::limit::{RadialModel, RepeatedScans, Weight, adaptive, closed_form, rigorous};
use mean_information::map::{Geometry, Grid, encoding::Probability};
use mean_information::quadrature::{adaptive::GaussKronrod, rigorous::Rigorous};
use mean_information::sensor::{GaussianSensor, InverseSensorModel};
use mean_information::{Real, Tally, cell::Cell};

/// The digests of results, of integrals and of scans, everywhere. If one changes and what is digested did not, results changed: say so
/// in CHANGELOG.md.
pub const DIGESTS: [u64; 3] = [0x3e0b_a3be_7730_d1b9, 0x0bcb_7b16_92a6_e692, 0x5ea4_4124_ff78_873b];

/// FNV-1a over the bits of every result.
struct Digest(u64);

impl Digest {
    fn new() -> Self {
        Self(0xcbf2_9ce4_8422_2325)
    }

    fn update<T: Real>(&mut self, result: T) {
        for byte in result.widen().to_bits().to_le_bytes() {
            self.0 = (self.0 ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3);
        }
    }
}

impl Digest {
    /// Both limits of a model, with all that is said of them.
    fn update_with_limits<M: RadialModel>(&mut self, model: &M, relative: f64) {
        let settings = GaussKronrod::new().relative(M::Float::nearest(relative));
        for weight in [Weight::Radial, Weight::Area] {
            let estimate = adaptive(model, weight, &settings).expect("a room");
            let enclosure = rigorous(model, weight, &Rigorous::default()).expect("a room");
            for result in [estimate.value, estimate.error, enclosure.lower, enclosure.upper] {
                self.update(result);
            }
            for evaluations in [estimate.evaluations, enclosure.evaluations] {
                self.update(evaluations as f64);
            }
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

/// Computes the digests.
pub fn digests() -> [u64; 3] {
    [results(), integrals(), scans::digest()]
}

/// The digest of about a million and a quarter results.
fn results() -> u64 {
    let (mut digest, mut tally, mut cells) = (Digest::new(), Tally::new(), Vec::new());
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
            cells.push(p);
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
    assert_eq!(tally, Tally::from_occupancies(&cells), "by the vector unit");
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

/// The digest of the limits of three dozen rooms, `z / σ` from `2^-20` to `2^30`, by both integrals.
fn integrals() -> u64 {
    let mut digest = Digest::new();
    let mut state = 0x9e37_79b9_7f4a_7c15;
    for _ in 0..36 {
        let bits = next(&mut state);
        let ratio = f64::from_parts((1 << 20) + (bits & 0xf_ffff), ((bits >> 20) % 50) as i32 - 40);
        let sigma = 0.01 + 1e-4 * ((bits >> 50) as f64);
        let double = GaussianSensor::new(ratio * sigma, sigma).expect("positive");
        digest.update_with_limits(&double, 1e-12);
        let single = GaussianSensor::new((ratio * sigma) as f32, sigma as f32).expect("positive");
        digest.update_with_limits(&single, 1e-5);
        digest.update_with_limits(&RepeatedScans::new(double, 3).expect("positive"), 1e-9);
    }
    digest.0
}

#[test]
fn a_million_results_have_not_changed() {
    assert_eq!(digests(), DIGESTS);
}
