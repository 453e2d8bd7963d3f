//! Rank correlations, and how far they would move with other trajectories.

use mean_information_cli::simulation::Random;

/// Bootstrap samples of an interval.
const SAMPLES: usize = 2000;

/// Spearman's rank correlation with an interval.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Correlation {
    /// The correlation.
    pub(crate) value: f64,
    /// The 2.5 % and 97.5 % quantiles of bootstrap samples of the trajectories.
    pub(crate) interval: [f64; 2],
}

impl Correlation {
    /// Correlates the ranks of numbers; the interval is always by the same random samples.
    pub(crate) fn new(x: &[f64], y: &[f64]) -> Self {
        let mut random = Random::new(20_261_130);
        let count = x.len();
        let mut values: Vec<f64> = (0..SAMPLES)
            .map(|_| {
                let chosen: Vec<usize> =
                    (0..count).map(|_| (random.bits() % count as u64) as usize).collect();
                let [x, y] = [x, y].map(|from| chosen.iter().map(|&k| from[k]).collect::<Vec<_>>());
                spearman(&x, &y)
            })
            .collect();
        values.sort_by(f64::total_cmp);
        let quantile = |part: f64| values[(part * (SAMPLES - 1) as f64).round() as usize];
        Self { value: spearman(x, y), interval: [quantile(0.025), quantile(0.975)] }
    }
}

/// Returns Spearman's correlation: Pearson's of the ranks.
pub(crate) fn spearman(x: &[f64], y: &[f64]) -> f64 {
    let [x, y] = [ranks(x), ranks(y)];
    // The mean of ranks, with ties or without.
    let mean = (x.len() as f64 - 1.0) / 2.0;
    let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - mean) * (b - mean)).sum::<f64>();
    product(&x, &y) / mean_information::elementary::sqrt(product(&x, &x) * product(&y, &y))
}

/// Returns the ranks from 0 on; equal numbers share their mean rank.
fn ranks(numbers: &[f64]) -> Vec<f64> {
    let mut order: Vec<usize> = (0..numbers.len()).collect();
    order.sort_by(|&a, &b| numbers[a].total_cmp(&numbers[b]));
    let mut ranks = vec![0.0; numbers.len()];
    let mut first = 0;
    for group in order.chunk_by(|&a, &b| numbers[a] == numbers[b]) {
        for &k in group {
            ranks[k] = first as f64 + (group.len() as f64 - 1.0) / 2.0;
        }
        first += group.len();
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;

    /// By hand: ranks 0, 1.5, 1.5, 3 and 1, 0, 2, 3 have sums of products 3, 4.5 and 5.
    #[test]
    fn ties_share_their_rank() {
        assert_eq!(ranks(&[0.25, 7.0, 7.0, 9.5]), [0.0, 1.5, 1.5, 3.0]);
        let found = spearman(&[0.25, 7.0, 7.0, 9.5], &[3.0, -1.0, 4.0, 4.5]);
        assert!((found - 3.0 / 22.5_f64.sqrt()).abs() < 1e-15, "{found}");
    }

    /// Any increasing function keeps it; a decreasing one turns it round; the interval holds it.
    #[test]
    fn only_the_order_counts() {
        let mut random = Random::new(7);
        let x: Vec<f64> = (0..40).map(|_| random.normal()).collect();
        let y: Vec<f64> = x.iter().map(|x| x + random.normal()).collect();
        let cubes: Vec<f64> = y.iter().map(|y| -y * y * y).collect();
        let found = Correlation::new(&x, &y);
        assert_eq!(spearman(&x, &cubes), -found.value);
        assert!(found.interval[0] < found.value && found.value < found.interval[1], "{found:?}");
    }
}
