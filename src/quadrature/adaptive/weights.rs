//! Weights that the compiler computes from the nodes of a rule: of the coefficients of the integrand's series, and of
//! its polynomial at the ends.

/// The number of coefficients in the two bands of the Legendre series.
pub(super) const BANDS: usize = 8;
/// The largest number of coefficients in the top band.
pub(super) const MOST_DEGREES: usize = 8;

/// Returns the number of coefficients in the top band of the rule on `2n + 1` nodes.
///
/// Beside the ends of a panel neighbouring degrees are in step and may all miss a kink, and the more nodes a rule has, the
/// more of them lie there.
pub(super) const fn top_degrees(n: usize) -> usize {
    2 + n / 5
}

/// Returns the factors that turn the values of one side into coefficients of the integrand's series in polynomials that
/// are orthonormal under Kronrod's sum: of degrees `n - 3` to `n`, of four up to `(3n + 1) / 2`, and of the highest,
/// from `2n` downwards.
///
/// Up to `(3n + 1) / 2` they are the Legendre polynomials `√(2k + 1) P_k(x)`, as the product of two of that degree is a
/// polynomial that the rule integrates. The parity of each place is that of its degree.
pub(super) const fn bands<const N: usize>(
    nodes: &[f64; N],
    kronrod: &[f64; N],
) -> [[f64; BANDS + MOST_DEGREES]; N] {
    let mut result = [[0.0; BANDS + MOST_DEGREES]; N];
    let (low, high) = (N - 1, (3 * N - 2) / 2);
    let mut i = 0;
    while i < N {
        // (k + 1) P_{k+1} = (2k + 1) x P_k - k P_{k-1}
        let (mut previous, mut current, mut k) = (0.0, 1.0, 0);
        while k <= high {
            let value = square_root((2 * k + 1) as f64) * current;
            // Of either band the last four stay, degree k in place k % 4.
            result[i][if k <= low { k % 4 } else { 4 + k % 4 }] = value;
            let next = ((2 * k + 1) as f64 * nodes[i] * current - k as f64 * previous) / (k + 1) as f64;
            (previous, current, k) = (current, next, k + 1);
        }
        i += 1;
    }
    fill_top(&mut result, nodes, kronrod);
    result
}

/// Fills in the top band: degree `2n - k` in place `BANDS + k`.
///
/// What is orthogonal to all polynomials below degree `2n` is a divided difference of all values, and three terms of the
/// recurrence `x p_k = b_{k+1} p_{k+1} + b_k p_{k-1}` lead downwards from there.
const fn fill_top<const N: usize>(
    result: &mut [[f64; BANDS + MOST_DEGREES]; N],
    nodes: &[f64; N],
    kronrod: &[f64; N],
) {
    let (mut above, mut current) = ([0.0; N], [0.0; N]);
    let mut i = 0;
    while i < N {
        // 1 / (w_i ∏ 2 (x_i - x_j)): the factor 2 keeps the product of so many near 1.
        let x = nodes[i];
        // The mirrored node and the middle one, unless this is the middle one.
        let mut product = if i + 1 < N { 8.0 * x * x * kronrod[i] } else { kronrod[i] };
        let mut j = 0;
        while j + 1 < N {
            if j != i {
                product *= 4.0 * (x - nodes[j]) * (x + nodes[j]);
            }
            j += 1;
        }
        current[i] = 1.0 / product;
        i += 1;
    }
    let mut k = 0;
    while k < top_degrees(N - 1) {
        // Under Kronrod's sum of both sides, halved; the middle node counts once.
        let (mut square, mut i) = (0.0, 0);
        while i < N {
            let both = if i + 1 < N { 1.0 } else { 0.5 };
            square += both * kronrod[i] * current[i] * current[i];
            i += 1;
        }
        // It is b of the degree above this one, too.
        let norm = square_root(square);
        let mut i = 0;
        while i < N {
            let value = current[i] / norm;
            result[i][BANDS + k] = value;
            (above[i], current[i]) = (value, nodes[i] * value - norm * above[i]);
            i += 1;
        }
        k += 1;
    }
}

/// Returns the weights that carry the polynomial through all values on to the end at 1: of the nodes `x` and `-x`, the
/// Lagrange polynomials `∏ (1 - x_j) / (x - x_j)` over the other nodes.
pub(super) const fn ends<const N: usize>(nodes: &[f64; N]) -> [[f64; 2]; N] {
    let mut result = [[0.0; 2]; N];
    let mut i = 0;
    while i < N {
        let x = nodes[i];
        let (mut near, mut far, mut j) = (1.0, 1.0, 0);
        while j < N {
            let y = nodes[j];
            // The nodes of the same sign.
            if j != i {
                near *= (1.0 - y) / (x - y);
                far *= (1.0 - y) / (-x - y);
            }
            // The mirrored node, but for the middle one, which is its own.
            if j + 1 < N {
                if j == i {
                    // Of a node the other one is its mirror image.
                    near *= (1.0 + y) / (x + y);
                    far *= (1.0 - y) / (-x - y);
                } else {
                    near *= (1.0 + y) / (x + y);
                    far *= (1.0 + y) / (-x + y);
                }
            }
            j += 1;
        }
        result[i] = [near, far];
        i += 1;
    }
    result
}

/// Returns the square root by Heron's method, from above, for the compiler.
const fn square_root(x: f64) -> f64 {
    // The first steps halve the excess, the last ones square it away: twelve do for 91, twice as many for 10^6.
    let mut root = if x < 1.0 { 1.0 } else { x };
    let mut step = 0;
    while step < 24 {
        root += (x / root - root) / 2.0;
        step += 1;
    }
    root
}
