//! Cells and maps: convexity and what follows from it, sums and means.

use super::search::{IN_F64, dyadic, in_ulps, inequalities, occupancy};
use crate::common::power;
use mean_information::cell::{Cell, entropy, information};
use mean_information::expected::Hypotheses;
use mean_information::fusion::fuse;
use mean_information::map::{Geometry, Grid, encoding::Probability};
use mean_information::{Real, Tally};

type Map<T> = Grid<Probability<T>>;

fn map<T: Real>(width: usize, height: usize, cells: Vec<T>) -> Map<T> {
    Map::new(width, height, Geometry::new(0.25, [0.0, 0.0]).unwrap(), cells).unwrap()
}

/// A map of two blocks, its means by blocks of 2, and whether a block with an observed cell becomes unknown.
pub(super) fn pooled<T: Real>(cells: &[T]) -> (Tally<T>, Tally<T>, bool) {
    let fine = map(4, 2, cells.to_vec());
    let coarse = fine.pooled(2).unwrap();
    let half = T::nearest(0.5);
    let lost = (0..2).any(|block| {
        let seen = [0, 1, 4, 5].iter().any(|k| cells[2 * block + k] != half);
        seen && coarse.cells()[block] == half
    });
    (fine.tally(), coarse.tally(), lost)
}

/// Multiples of `2^-40`, whose means of four are exact.
fn exact_cells(u: &[f64]) -> Vec<f64> {
    u.iter().map(|&u| dyadic(u, 40)).collect()
}

/// `a / b`, where there is a `b`.
fn over(a: f64, b: f64) -> Option<f64> {
    (b > 0.0).then(|| a / b)
}

/// Two cells in each of three particles, with their weights.
struct Particles {
    maps: Vec<Map<f64>>,
    weights: [f64; 3],
}

impl Particles {
    fn new(u: &[f64]) -> Option<Self> {
        let maps = u[3..].chunks(2).map(|cells| map(2, 1, cells.iter().map(|&u| dyadic(u, 20)).collect()));
        let weights = [u[0], u[1], u[2]].map(|u| dyadic(u, 10));
        (weights != [0.0; 3]).then(|| Self { maps: maps.collect(), weights })
    }

    fn expected(&self) -> Tally<f64> {
        Hypotheses::new(&self.maps, &self.weights).unwrap().expected_tally().unwrap()
    }

    /// The weighted mean of a measure of the particles.
    fn mean(&self, measure: fn(&Tally<f64>) -> f64) -> f64 {
        let measured = self.maps.iter().map(|map| measure(&map.tally()));
        let sum: f64 = measured.zip(self.weights).map(|(measure, weight)| weight * measure).sum();
        sum / self.weights.iter().sum::<f64>()
    }

    /// How many cells are observed in a particle of positive weight.
    fn observed(&self) -> u64 {
        let seen = |cell: usize| {
            let mut weighted = self.maps.iter().zip(self.weights);
            weighted.any(|(map, weight)| weight > 0.0 && map.cells()[cell] != 0.5)
        };
        (0..2).filter(|&cell| seen(cell)).count() as u64
    }
}

/// A measure of cells in `f32`, beside that of the same cells in `f64`, which is `2^29` times as near to the exact one.
fn result(u: &[f64], measure: fn(&Tally<f32>) -> f32, wide: fn(&Tally<f64>) -> f64) -> f64 {
    let cells: Vec<f32> = u.iter().map(|&u| occupancy(u)).collect();
    let single: Tally<f32> = cells.iter().flat_map(|&p| Cell::from_occupancy(p)).collect();
    let double: Tally<f64> = cells.iter().flat_map(|&p| Cell::from_occupancy(f64::from(p))).collect();
    in_ulps(measure(&single), wide(&double), 1.5)
}

/// Observations on one side of 1/2.
fn agreeing(u: &[f64]) -> Vec<f64> {
    let occupied = u[0] < 0.5;
    let side = |u: &f64| {
        let p: f64 = occupancy(*u);
        if (p > 0.5) == occupied { p } else { 1.0 - p }
    };
    u[1..].iter().map(side).collect()
}

inequalities! {
    convexity: "cell", "Lemma (convexity)", 3, 8.0 * f64::EPSILON, |u| {
        let (p, q, share) = (dyadic(u[0], 20), dyadic(u[1], 20), dyadic(u[2], 10));
        let mean = share * p + (1.0 - share) * q;
        over(information(mean), share * information(p) + (1.0 - share) * information(q))
    };
    coarser_cells_information: "map", "Theorem (coarser cells)", 8, 4.0 * f64::EPSILON, |u| {
        let (fine, coarse, _) = pooled(&exact_cells(u));
        over(4.0 * coarse.information(), fine.information())
    };
    coarser_cells_entropy: "map", "Theorem (coarser cells)", 8, 4.0 * f64::EPSILON, |u| {
        let (fine, coarse, _) = pooled(&exact_cells(u));
        over(fine.entropy(), 4.0 * coarse.entropy())
    };
    coarser_cells_mean: "map", "Theorem (coarser cells)", 8, 4.0 * f64::EPSILON, |u| {
        let (fine, coarse, lost) = pooled(&exact_cells(u));
        if lost { None } else { over(coarse.mean_information(), fine.mean_information()) }
    };
    // The section "Rounding": each of two coarse cells moved by (P + 2.5) u / 2.
    coarser_cells_rounded: "map", "Theorem (coarser cells)", 8, 8.0 * f32::EPSILON as f64, |u| {
        let (fine, coarse, _) = pooled::<f32>(&u.iter().map(|&u| occupancy(u)).collect::<Vec<_>>());
        let moved = 2.0 * (24.0 + 2.5) * power(-25);
        over(4.0 * f64::from(coarse.information()), f64::from(fine.information()) + 4.0 * moved)
    };
    coarser_cells_rounded_mean: "map", "Theorem (coarser cells)", 8, 0.0, |u| {
        let (fine, coarse, lost) = pooled::<f32>(&u.iter().map(|&u| occupancy(u)).collect::<Vec<_>>());
        let epsilon = (24.0 + 5.0) * power(-25);
        if lost { return None; }
        over(coarse.mean_information().into(), f64::from(fine.mean_information()) + 2.0 * epsilon)
    };
    // Floats and their order are kept by rounding once, so nothing is lost here.
    agreement: "fusion", "Proposition (agreement)", 5, 0.0, |u| {
        let observations = agreeing(u);
        let most = observations.iter().map(|&p| information(p)).fold(0.0, f64::max);
        over(most, information(fuse(&observations).unwrap()))
    };
    // Each cell of the expected map is within 2^-63 bits.
    disagreement: "expected", "Theorem (disagreement)", 9, 8.0 * f64::EPSILON, |u| {
        let particles = Particles::new(u)?;
        let right = particles.mean(Tally::information) + 2.0 * power(-63);
        over(particles.expected().information(), right)
    };
    disagreement_mean: "expected", "Theorem (disagreement)", 9, 8.0 * f64::EPSILON, |u| {
        let particles = Particles::new(u)?;
        let expected = particles.expected();
        if expected.observed() < particles.observed() { return None; }
        over(expected.mean_information(), particles.mean(Tally::mean_information) + power(-63))
    };
    results_entropy: "sums", "Theorem (results)", 5, IN_F64, |u| {
        Some(result(u, Tally::entropy, Tally::entropy))
    };
    results_information: "sums", "Theorem (results)", 5, IN_F64, |u| {
        Some(result(u, Tally::information, Tally::information))
    };
    results_mean: "sums", "Theorem (results)", 5, IN_F64, |u| {
        Some(result(u, Tally::mean_information, Tally::mean_information))
    };
    differences: "convergence", "Lemma (differences)", 2, 4.0 * f64::EPSILON, |u| {
        let (p, q) = (dyadic(u[0], 40), dyadic(u[1], 40));
        // Differences of entropies near 1 are rounded by their ulp.
        over((entropy(p) - entropy(q)).abs() - f64::EPSILON, entropy((p - q).abs()))
    };
}
