//! The mean map entropy of the end points of beams (Droeschel and Behnke 2014; Razlaw et al. 2015; as PyPI's `map-metrics`), in
//! the plane: the mean of `ln det(2πe Σ) / 2` over the points, with `Σ` the covariance of the points within a radius.

use mean_information::elementary::ln;
use std::collections::HashMap;
use std::f64::consts::{E, PI};

/// The least number of points that have a covariance, as in `map-metrics`.
const LEAST: u32 = 5;

/// Of so many points one is asked for its circle, which has all of them.
const ONE_OF: usize = 4;

/// Computes the mean map entropy in nats, over every fourth point. Points with fewer than five in their circle, or all on one line, are left out, as in
/// `map-metrics`.
pub(crate) fn mean_map_entropy(points: &[[f64; 2]], radius: f64) -> f64 {
    let mut boxes: HashMap<[i64; 2], Vec<[f64; 2]>> = HashMap::new();
    let home = |point: [f64; 2]| point.map(|x| (x / radius).floor() as i64);
    for &point in points {
        boxes.entry(home(point)).or_default().push(point);
    }
    let (mut sum, mut count) = (0.0, 0_u32);
    for &point in points.iter().step_by(ONE_OF) {
        let [i, j] = home(point);
        let mut moments = [0.0; 5];
        let mut inside = 0_u32;
        for key in (i - 1..=i + 1).flat_map(|i| (j - 1..=j + 1).map(move |j| [i, j])) {
            for &[x, y] in boxes.get(&key).map_or(&[][..], Vec::as_slice) {
                // From the point itself, so that the moments lose no digits.
                let (x, y) = (x - point[0], y - point[1]);
                if x * x + y * y <= radius * radius {
                    inside += 1;
                    for (moment, term) in moments.iter_mut().zip([x, y, x * x, x * y, y * y]) {
                        *moment += term;
                    }
                }
            }
        }
        if inside < LEAST {
            continue;
        }
        let n = f64::from(inside);
        let [x, y, xx, xy, yy] = moments;
        let covariance = [xx - x * x / n, xy - x * y / n, yy - y * y / n].map(|sum| sum / (n - 1.0));
        let determinant = covariance[0] * covariance[2] - covariance[1] * covariance[1];
        // Rounding leaves some 1e-18 of points on one line.
        if determinant > 1e-16 {
            sum += 0.5 * ln(determinant) + ln(2.0 * PI * E);
            count += 1;
        }
    }
    sum / f64::from(count)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A lattice fills each circle alike: about a quarter of the squared radius of variance along both axes, which a plain sum
    /// finds, too.
    #[test]
    fn of_a_lattice() {
        let (side, radius) = (0.125, 1.5);
        let points: Vec<_> =
            (0..200).flat_map(|i| (0..200).map(move |j| [i, j].map(|k| f64::from(k) * side))).collect();
        let inside: Vec<_> = (-12..=12)
            .flat_map(|i| (-12..=12).map(move |j| [i, j].map(|k| f64::from(k) * side)))
            .filter(|[x, y]| x * x + y * y <= radius * radius)
            .collect();
        let variance = inside.iter().map(|[x, _]| x * x).sum::<f64>() / (inside.len() as f64 - 1.0);
        assert!((variance / (radius * radius / 4.0) - 1.0).abs() < 0.05, "{variance}");
        let entropy = ln(2.0 * PI * E * variance);
        // Points at the border have part of a circle.
        let found = mean_map_entropy(&points, radius);
        assert!(found < entropy && entropy - found < 0.1, "{found} {entropy}");
    }

    #[test]
    fn points_on_a_line_are_left_out() {
        let line: Vec<_> = (0..100).map(|k| [f64::from(k) * 0.01, 0.75]).collect();
        assert!(mean_map_entropy(&line, 0.3).is_nan());
    }
}
