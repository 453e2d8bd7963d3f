//! The square root of an integer, cut: as `u128::isqrt`, without its divisions.
//!
//! Newton's iteration finds `1 / √x` from a table of 8 bits, and `√x` from that; the remainder decides the last unit.

/// The values of `1 / √x` in the middle of 192 parts of `[1/4, 1)`, scale 15: within `2^-7.9` of it over the whole
/// part.
static INVERSES: [u16; 192] = {
    let mut inverses = [0; 192];
    let mut k = 0;
    while k < 192 {
        // x = (k + 64 + 1/2) / 256
        inverses[k] = ((512 << 30) / (2 * k as u64 + 129)).isqrt() as u16;
        k += 1;
    }
    inverses
};

/// Computes `floor(√n)` for `n > 0`.
///
/// Let `n = x 2^128` with `x` in `[1/4, 1)`. A value `y = (1 - e) / √x` gives
/// `y (3 - x y^2) / 2 = (1 - 3/2 e^2 + e^3 / 2) / √x`, below `1 / √x`, so that the relative errors of `inverse` are
/// below `2^-7.9`, `2^-15.1`, `2^-29.4`, all cuts included; the last is not above `1 / √x`. A root `s = (1 - e) √n`
/// plus `(n - s^2) y / 2` is not above `√n` either, and short of it by `(e^2 / 2 + e' e) √n`, where `e'` is the error
/// of `y`: here less than `2^6` and then `2^-22`, of which the floor makes less than `1 + 2^-22`. So the last root is
/// `floor(√n)` or one less.
#[inline]
pub(crate) fn square_root(n: u128) -> u64 {
    debug_assert!(n > 0);
    // By an even number of bits, so that the root is moved by half as many.
    let shift = n.leading_zeros() & !1;
    let n = n << shift;
    let x = (n >> 64) as u64;
    // Scales 15, 30, 62.
    let inverse = u64::from(INVERSES[(x >> 56) as usize - 64]);
    let twice = (3 << 62) - (x >> 32) * (inverse * inverse);
    let inverse = (inverse * (twice >> 32)) >> 16;
    // The bits of `n` below `x`, and those cut, are less than two units.
    let twice = (3 << 60) - 2 - (product(x, inverse * inverse) >> 64) as u64;
    let inverse = inverse * (twice >> 29);

    // The remainders are below 2^100 and 2^71.
    let remainder = |root: u64| n - product(root, root);
    // √n = x / √x, scale 64; then (n - s^2) y / 2 is added twice.
    let root = (product(x, inverse) >> 62) as u64;
    let root = root + (product((remainder(root) >> 36) as u64, inverse) >> 91) as u64;
    let root = root + (product((remainder(root) >> 8) as u64, inverse) >> 119) as u64;
    // (root + 1)^2 = root^2 + 2 root + 1.
    let root = root + u64::from(remainder(root) > 2 * u128::from(root));
    root >> (shift / 2)
}

/// Multiplies two limbs, exactly.
#[inline]
fn product(a: u64, b: u64) -> u128 {
    u128::from(a) * u128::from(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn check(n: u128) {
        assert_eq!(u128::from(square_root(n)), n.isqrt(), "{n}");
    }

    #[test]
    fn about_every_power_of_two_and_every_part_of_the_table() {
        for k in 0..128 {
            for n in (1_u128 << k).saturating_sub(9)..=(1_u128 << k) + 9 {
                check(n.max(1));
            }
        }
        for part in 64..256_u128 {
            for step in 0..9 {
                check((part << 120) + step);
                check((part << 120) + (step << 64) - 1);
                check((part << 120) + ((1 << 120) - 1 - step));
            }
        }
        for below in 0..1000 {
            check(u128::MAX - below);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(20_000))]

        #[test]
        fn it_is_that_of_the_standard_library(n in 1_u128.., shift in 0_u32..127) {
            check(n);
            check((n >> shift).max(1));
        }

        /// Where one unit more or less decides.
        #[test]
        fn about_squares(root in 1_u64.., shift in 0_u32..63, off in -3_i128..4) {
            let root = u128::from((root >> shift).max(2));
            check((root * root).saturating_add_signed(off));
            check((root * (root + 1)).saturating_add_signed(off));
        }
    }
}
