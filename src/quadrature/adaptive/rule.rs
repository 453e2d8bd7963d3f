//! Gauss-Kronrod rules: `2n + 1` values of the integrand give the integral twice, with the `n` nodes of Gauss and
//! with all, and coefficients of its series in orthogonal polynomials, which tell how fast either converges.

use super::compensated::Compensated;
use super::stretch::Stretch;
use super::tables;
use super::weights::{BANDS, MOST_DEGREES, bands, ends, top_degrees};
use crate::real::Real;

/// A Gauss-Kronrod pair, named after its evaluations.
///
/// With `n` nodes of Gauss the rule has `2n + 1` nodes and integrates polynomials of degree `3n + 1` exactly. Nodes
/// and weights are correctly rounded in either format (proved: the decimals they are written as, to 36 digits, are
/// those of the rule, and the compiler rounds once; for `f32`, rounding twice makes no difference). Few nodes suit
/// singularities and peaks, where panels are halved many times; many suit smooth and oscillating integrands.
///
/// ```
/// use mean_information::quadrature::adaptive::Rule;
/// assert_eq!(Rule::K21.evaluations(), 21);
/// assert_eq!(Rule::K21.degree(), 31);
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Rule {
    /// 7 nodes of Gauss, 15 in all.
    K15,
    /// 10 nodes of Gauss, 21 in all.
    K21,
    /// 15 nodes of Gauss, 31 in all.
    K31,
    /// 20 nodes of Gauss, 41 in all.
    K41,
    /// 25 nodes of Gauss, 51 in all.
    K51,
    /// 30 nodes of Gauss, 61 in all.
    K61,
}

/// The largest number of nodes of a rule.
const MOST: usize = 61;

/// One side of a rule, from the outermost node to the middle.
struct Table {
    nodes: &'static [f64],
    kronrod: &'static [f64],
    gauss: &'static [f64],
    bands: &'static [[f64; BANDS + MOST_DEGREES]],
    ends: &'static [[f64; 2]],
}

/// The findings of one application of a rule to a stretch.
#[derive(Clone, Copy, Debug)]
pub(super) struct RuleValue<T> {
    /// The integral by all nodes.
    pub(super) value: T,
    /// The error that these values alone suggest, rounding apart.
    pub(super) difference: T,
    /// The ratio of the upper band of the Legendre series to the lower, at most 1.
    pub(super) decay: T,
    /// A bound on what rounding has done to `value`.
    pub(super) noise: T,
    /// The largest value less the smallest.
    pub(super) spread: T,
    /// True if every value is 0.
    pub(super) is_zero: bool,
    /// The polynomial through all values, carried on to the lower and the upper end.
    pub(super) ends: [T; 2],
}

impl Rule {
    /// Every rule, from the fewest nodes to the most.
    pub const ALL: &'static [Self] = &[Self::K15, Self::K21, Self::K31, Self::K41, Self::K51, Self::K61];

    /// Returns the number of evaluations of one application, `2n + 1`.
    pub const fn evaluations(self) -> u64 {
        // Every node but the middle one stands for two.
        self.table().nodes.len() as u64 * 2 - 1
    }

    /// Returns the highest degree of polynomials that are integrated exactly: `3n + 1`, or `3n + 2` for odd `n`, by
    /// symmetry.
    pub const fn degree(self) -> u64 {
        // A symmetric rule gives 0 for odd powers: the next odd degree comes for nothing.
        (3 * self.table().nodes.len() as u64 - 2) | 1
    }

    /// Returns the least limit on evaluations, in words.
    pub(super) const fn least(self) -> &'static str {
        match self {
            Self::K15 => "15 or more for each panel between break points",
            Self::K21 => "21 or more for each panel between break points",
            Self::K31 => "31 or more for each panel between break points",
            Self::K41 => "41 or more for each panel between break points",
            Self::K51 => "51 or more for each panel between break points",
            Self::K61 => "61 or more for each panel between break points",
        }
    }

    /// Returns the nodes and weights.
    const fn table(self) -> Table {
        macro_rules! table {
            ($nodes:ident, $kronrod:ident, $gauss:ident) => {
                Table {
                    nodes: &tables::$nodes,
                    kronrod: &tables::$kronrod,
                    gauss: &tables::$gauss,
                    bands: const { &bands(&tables::$nodes, &tables::$kronrod) },
                    ends: const { &ends(&tables::$nodes) },
                }
            };
        }
        match self {
            Self::K15 => table!(NODES_15, KRONROD_15, GAUSS_15),
            Self::K21 => table!(NODES_21, KRONROD_21, GAUSS_21),
            Self::K31 => table!(NODES_31, KRONROD_31, GAUSS_31),
            Self::K41 => table!(NODES_41, KRONROD_41, GAUSS_41),
            Self::K51 => table!(NODES_51, KRONROD_51, GAUSS_51),
            Self::K61 => table!(NODES_61, KRONROD_61, GAUSS_61),
        }
    }

    /// Returns the outermost node.
    pub(super) fn outermost<T: Real>(self) -> T {
        T::nearest(self.table().nodes[0])
    }

    /// Returns the nodes of one side, from the outermost to the middle.
    #[cfg(test)]
    pub(super) fn nodes(self) -> &'static [f64] {
        self.table().nodes
    }

    /// Returns the factors of each node of one side in the coefficients of the series.
    #[cfg(test)]
    pub(super) fn bands(self) -> &'static [[f64; BANDS + MOST_DEGREES]] {
        self.table().bands
    }

    /// Returns the part of a stretch between its end and the outermost node.
    pub(super) fn gap<T: Real>(self) -> T {
        // γ ("What the ends hide"): [-1, 1] is two long.
        T::nearest((1.0 - self.table().nodes[0]) / 2.0)
    }

    /// Applies the rule to a stretch; evaluates in ascending order.
    pub(super) fn apply<T: Real>(self, f: &mut impl FnMut(T) -> T, stretch: Stretch<T>) -> RuleValue<T> {
        let table = self.table();
        let last = 2 * (table.nodes.len() - 1);
        let mut values = [T::zero(); MOST];
        let values = &mut values[..=last];
        for (i, &node) in table.nodes.iter().enumerate() {
            [values[i], values[last - i]] = stretch.pair(T::nearest(node));
        }
        // Arguments become values in place, from the lowest upwards.
        for value in values.iter_mut() {
            *value = f(*value);
        }
        table.read(values, stretch)
    }
}

impl Table {
    /// Reads from the values at the nodes, in ascending order, what they tell of the stretch.
    fn read<T: Real>(&self, values: &[T], stretch: Stretch<T>) -> RuleValue<T> {
        let last = values.len() - 1;
        // Means rather than integrals: nothing overflows that need not.
        let half = |weight: f64| T::nearest(weight) * T::HALF;
        let (mut by_all, mut by_gauss) = (Compensated::default(), Compensated::default());
        let degrees = BANDS + top_degrees(self.nodes.len() - 1);
        let (mut size, mut series) = (T::zero(), [T::zero(); BANDS + MOST_DEGREES]);
        let mut ends = [T::zero(); 2];
        for (i, (&weight, band)) in self.kronrod.iter().zip(self.bands).enumerate() {
            // The middle node counts once.
            let before = if i == last - i { T::zero() } else { values[i] };
            // The value at the mirrored node.
            let after = values[last - i];
            let [low, high] = [before, after].map(|value| half(weight) * value);
            // Q_K, with what its additions lose ("Halving the worst").
            by_all = by_all.plus(low).plus(high);
            // The mean of |g|, for the noise: 5 epsilon of it ("Rounding").
            size = size + (low.abs() + high.abs());
            // Q_G: every second node is one of Gauss.
            if i % 2 == 1 {
                let weight = half(self.gauss[i / 2]);
                by_gauss = by_gauss.plus(weight * before).plus(weight * after);
            }
            // Lagrange's weights at either end ("What the ends hide").
            let [near, far] = self.ends[i].map(T::nearest);
            ends[0] = ends[0] + (near * before + far * after);
            ends[1] = ends[1] + (near * after + far * before);
            // Polynomials are even or odd with their degree: one product serves both sides.
            let by_parity = [high + low, high - low];
            // a_k = Σ w_i p_k(x_i) g(x_i) / 2, weights and halves being in the products already.
            for (k, coefficient) in series[..degrees].iter_mut().enumerate() {
                *coefficient = *coefficient + T::nearest(band[k]) * by_parity[k % 2];
            }
        }

        // β1 and β2: four coefficients each, so that neither parity is missed; and the top band.
        let [lower, upper, top] = [&series[..4], &series[4..BANDS], &series[BANDS..]]
            .map(|band| band.iter().fold(T::zero(), |sum, coefficient| sum + coefficient.abs()));
        // β2 / β1 ("Agreement by accident"); 1 where nothing falls.
        let decay = match upper {
            _ if upper < lower => upper / lower,
            _ if upper.is_zero() => upper,
            _ => T::one(),
        };
        // ê: the two rules apart, what the series would leave at degree 2n, or what is found there ("Agreement by accident").
        let apart = (by_all.value() - by_gauss.value()).abs();
        let difference =
            if (upper + top).is_finite() { apart.max(upper * decay).max(top) } else { T::infinity() };
        // Of an infinite value the sum is NaN, too.
        let value = match stretch.widths(by_all.value()) {
            value if value.is_finite() => value,
            _ if values.iter().any(|value| value.is_nan()) => T::nan(),
            _ => T::infinity(),
        };
        RuleValue {
            value,
            difference: stretch.widths(difference),
            decay,
            noise: noise(values, size, stretch),
            spread: values.iter().fold(values[0], |most, &value| most.max(value))
                - values.iter().fold(values[0], |least, &value| least.min(value)),
            is_zero: values.iter().all(T::is_zero),
            ends,
        }
    }
}

/// Bounds what rounding does to the integral over a stretch, given the mean of `|f|`.
///
/// In units of the epsilon `2u`: relative to `|f|`, 1/2 each for weight, product, sum, width and last product, 2 for
/// the integrand, and 1/2 for the sum over all panels; in the argument, 2 for the node (`c ± h x` has six roundings,
/// below `4u` of the end in all) and 2 for the integrand's own. Below the normal range, a spacing for every product and
/// sum.
fn noise<T: Real>(values: &[T], size: T, stretch: Stretch<T>) -> T {
    let epsilon = T::epsilon();
    let [four, five] = [4, 5].map(|k| T::from_parts(k, 0));
    // Σ |g(x_(i+1)) - g(x_i)|, times epsilon before the difference so that it cannot overflow.
    let variation =
        values.windows(2).fold(T::zero(), |sum, pair| sum + (epsilon * pair[1] - epsilon * pair[0]).abs());
    // Products below the normal range are rounded to whole spacings.
    let floor = if values.iter().all(T::is_zero) {
        T::zero()
    } else {
        T::from_parts(4 * MOST as u64, T::MIN_EXPONENT)
    };
    // 10 u ∫ |g| + 8 u X Σ |g(x_(i+1)) - g(x_i)|, with 2u = epsilon ("Rounding").
    stretch.widths(five * epsilon * size + floor) + four * variation * stretch.magnitude() + floor
}
