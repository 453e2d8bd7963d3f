//! Random numbers with the same bits everywhere.
//!
//! Own code, since crates leave open which bits a seed gives: `rand` may change its generators with any release, and
//! `rand_distr` calls the platform's elementary functions. The generator is SplitMix64 (Steele, Lea and Flood, *Fast
//! splittable pseudorandom number generators*, OOPSLA 2014), the normal deviate Marsaglia's polar method with this
//! project's correctly rounded logarithm and square root.

use mean_information::elementary::{ln, sqrt};

/// A seeded generator.
#[derive(Clone, Debug)]
pub struct Random {
    state: u64,
}

impl Random {
    /// Creates the generator of a seed.
    pub fn new(seed: u64) -> Self {
        Self { state: seed }
    }

    /// Draws 64 random bits.
    pub fn bits(&mut self) -> u64 {
        self.state = self.state.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let z = self.state;
        let z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Creates another generator, whose numbers do not depend on how many are yet taken from this one.
    #[must_use]
    pub fn fork(&mut self) -> Self {
        Self::new(self.bits())
    }

    /// Draws uniformly from `[low, high)`, up to the rounding of the sum.
    pub fn between(&mut self, low: f64, high: f64) -> f64 {
        let unit = (self.bits() >> 11) as f64 / (1_u64 << 53) as f64;
        low + (high - low) * unit
    }

    /// Draws from the normal distribution of mean 0 and standard deviation 1.
    pub fn normal(&mut self) -> f64 {
        loop {
            let [x, y] = [self.between(-1.0, 1.0), self.between(-1.0, 1.0)];
            let square = x * x + y * y;
            if square > 0.0 && square < 1.0 {
                return x * sqrt(-2.0 * ln(square) / square);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The first numbers of the generator's published test, seed 1234567.
    #[test]
    fn it_is_splitmix64() {
        let mut random = Random::new(1_234_567);
        let first = [6_457_827_717_110_365_317, 3_203_168_211_198_807_973, 9_817_491_932_198_370_423_u64];
        assert_eq!(first.map(|_| random.bits()), first);
    }

    /// Mean, variance and part beyond one standard deviation, each within six standard deviations of its estimate.
    #[test]
    fn the_deviates_are_normal() {
        let (mut random, count) = (Random::new(20_061_015), 40_000);
        let deviates: Vec<f64> = (0..count).map(|_| random.normal()).collect();
        let n = f64::from(count);
        let mean = deviates.iter().sum::<f64>() / n;
        let variance = deviates.iter().map(|x| x * x).sum::<f64>() / n;
        let beyond = deviates.iter().filter(|x| x.abs() > 1.0).count() as f64 / n;
        // 1 - erf(1 / sqrt 2).
        let q = 0.317_310_507_862_914_1;
        assert!(mean.abs() < 6.0 / n.sqrt(), "{mean}");
        assert!((variance - 1.0).abs() < 6.0 * (2.0 / n).sqrt(), "{variance}");
        assert!((beyond - q).abs() < 6.0 * (q * (1.0 - q) / n).sqrt(), "{beyond}");
    }

    #[test]
    fn a_fork_is_another_generator() {
        let mut seeds = Random::new(7);
        let [mut a, mut b] = [seeds.fork(), seeds.fork()];
        assert!((0..100).all(|_| a.bits() != b.bits()));
    }
}
