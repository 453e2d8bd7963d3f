//! An inequality as a function on the unit cube, and the search for a point at which it does not hold.

use crate::common::Random;
use mean_information::Real;
use mean_information::elementary::{exp, ln};

/// A statement of the book that says "at most": the left side over the right, at most 1.
pub(super) struct Inequality {
    pub(super) test: &'static str,
    /// The chapter, and the name that the statement has there.
    pub(super) statement: (&'static str, &'static str),
    /// How many numbers in `[0, 1)` choose the arguments.
    pub(super) dimensions: usize,
    /// By how much the rounding of both sides, as they are computed here, can raise the ratio.
    pub(super) rounding: f64,
    /// `None` where the hypotheses do not hold.
    pub(super) ratio: fn(&[f64]) -> Option<f64>,
}

/// What a search found.
pub(super) struct Found {
    pub(super) largest: f64,
    pub(super) at: Vec<f64>,
    /// At how many points the hypotheses held.
    pub(super) tried: usize,
}

/// From how many of the best random points a search goes on locally.
const STARTS: usize = 3;

impl Inequality {
    /// Looks for the largest ratio: at random points, then in steps about the best, from half of the cube down to `2^-26`
    /// of it. A step to a ratio that is no smaller is taken.
    pub(super) fn search(&self, points: usize, steps: usize) -> Found {
        let seed = self.test.bytes().fold(0x9e37_79b9_7f4a_7c15, |seed: u64, byte| {
            seed.rotate_left(7) ^ u64::from(byte).wrapping_mul(0x0100_0000_01b3)
        });
        let mut random = Random::new(seed);
        let mut tried = 0;
        let mut ratio = |point: &[f64]| {
            let ratio = (self.ratio)(point).filter(|ratio| !ratio.is_nan());
            tried += usize::from(ratio.is_some());
            ratio.unwrap_or(f64::NEG_INFINITY)
        };
        let mut best: Vec<(f64, Vec<f64>)> = Vec::new();
        for _ in 0..points {
            let point: Vec<f64> = (0..self.dimensions).map(|_| random.uniform()).collect();
            best.push((ratio(&point), point));
            best.sort_by(|a, b| b.0.total_cmp(&a.0));
            best.truncate(STARTS);
        }
        for (largest, at) in &mut best {
            for step in 0..steps {
                let radius = exp(-ln(2.0) * (1.0 + 25.0 * step as f64 / steps as f64));
                let mut point = at.clone();
                let one = (random.uniform() * self.dimensions as f64) as usize;
                for (k, x) in point.iter_mut().enumerate() {
                    if k == one || random.uniform() < 0.3 {
                        *x = (*x + radius * (2.0 * random.uniform() - 1.0)).clamp(0.0, 1.0 - f64::EPSILON);
                    }
                }
                let found = ratio(&point);
                if found >= *largest {
                    (*largest, *at) = (found, point);
                }
            }
        }
        best.sort_by(|a, b| b.0.total_cmp(&a.0));
        let (largest, at) = best.swap_remove(0);
        Found { largest, at, tried }
    }

    /// Fails with the place if a search finds a counterexample, and if the hypotheses hold almost nowhere.
    pub(super) fn assert_holds(&self, points: usize, steps: usize) -> Found {
        let found = self.search(points, steps);
        let Found { largest, at, tried } = &found;
        assert!(*largest <= 1.0 + self.rounding, "{}: {largest} at {at:?}", self.test);
        assert!(10 * tried >= points, "{}: its hypotheses hold at {tried} of {points} points", self.test);
        found
    }
}

/// A table of inequalities, and a test for each.
macro_rules! inequalities {
    ($($test:ident: $chapter:literal, $name:literal, $dimensions:literal, $rounding:expr, $ratio:expr;)*) => {
        pub(super) const ALL: &[super::search::Inequality] = &[$(super::search::Inequality {
            test: concat!(module_path!(), "::", stringify!($test)),
            statement: ($chapter, $name),
            dimensions: $dimensions,
            rounding: $rounding,
            ratio: $ratio,
        }),*];
        $(
            #[test]
            fn $test() {
                let name = concat!(module_path!(), "::", stringify!($test));
                let inequality = ALL.iter().find(|inequality| inequality.test == name).expect("its row");
                inequality.assert_holds(super::POINTS, super::STEPS);
            }
        )*
    };
}
pub(super) use inequalities;

/// From `low` to `high`, evenly.
pub(super) fn between(u: f64, low: f64, high: f64) -> f64 {
    low + u * (high - low)
}

/// From `low` to `high`, evenly in the logarithm.
pub(super) fn scaled(u: f64, low: f64, high: f64) -> f64 {
    exp(between(u, ln(low), ln(high)))
}

/// One of `0, 1, …, n - 1`.
pub(super) fn choice(u: f64, n: usize) -> usize {
    ((u * n as f64) as usize).min(n - 1)
}

/// A multiple of `2^-bits` in `[0, 1]`, 1/2 for a fifth of all.
pub(super) fn dyadic(u: f64, bits: i32) -> f64 {
    let one = crate::common::power(bits);
    if u < 0.2 { 0.5 } else { ((u - 0.2) / 0.8 * (one + 1.0)).floor() / one }
}

/// An occupancy of `T` from everywhere: evenly, next to 0, next to 1/2 on either side, and 1/2.
pub(super) fn occupancy<T: Real>(u: f64) -> T {
    let part = 5.0 * u;
    let within = part - part.floor();
    let tiny = |exponent: f64| exp(-ln(2.0) * exponent * within);
    T::nearest(match part as u32 {
        0 => within,
        1 => tiny(100.0),
        2 => 0.5 - tiny(24.0) / 2.0,
        3 => 0.5 + tiny(23.0) / 2.0,
        _ if within < 0.5 => 0.5,
        _ => 1.0 - tiny(23.0),
    })
}

/// How many of `many` ulp of `result` it is from the exact value.
pub(super) fn in_ulps(result: f32, exact: f64, many: f64) -> f64 {
    let ulp = f64::from(result.abs().next_up() - result.abs());
    (f64::from(result) - exact).abs() / (many * ulp)
}

/// What `f64` in the place of exact values can add to a ratio of `f32` results: `2^-29` of the bound of either format, and
/// some roundings of the comparison.
pub(super) const IN_F64: f64 = 1.0 / (1_u64 << 26) as f64;
