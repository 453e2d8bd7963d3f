//! Entropy and information of many cells at once, correctly rounded, in the lanes of whatever vector unit there is.
//!
//! Ziv's strategy once more, with a first step in floating point and without branches, which compilers turn into vector
//! instructions: about each of some thousand centres, value and slope are known to twice the precision ([`table`]), the
//! rest is a short polynomial ([`kernel`]), and a rounding test shows whether the sum of them all has one nearest
//! float. The few cells that fail it are left to [`CellEnclosures`](super::CellEnclosures). So every vector unit gives
//! the same bits: the right ones. The proof is in the chapter [`sums`](crate::book::sums).

// A call or a branch in the loop and it is no longer made into vector instructions.
#![allow(clippy::inline_always, clippy::needless_bitwise_bool)]

mod format;
mod kernel;
mod table;

pub(crate) use kernel::{BLOCK, Block};

use crate::real::{Floats, Real};
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use std::sync::LazyLock;
use table::Table;

/// Sums entropy and information over a block of occupancies, by the widest vector unit at hand.
pub(crate) fn sums<T: Real>(cells: &[T; BLOCK]) -> Block {
    match T::floats(cells) {
        Floats::Single(cells) => single::sums(cells),
        Floats::Double(cells) => double::sums(cells),
    }
}

/// Sums the information over a block of occupancies, without entropies.
pub(crate) fn information<T: Real>(cells: &[T; BLOCK]) -> Block {
    match T::floats(cells) {
        Floats::Single(cells) => single::information(cells),
        Floats::Double(cells) => double::information(cells),
    }
}

/// Defines the kernels for a format, each compiled for several vector units, of which the widest is taken that the
/// processor has: AVX-512 from Ice Lake and Zen 4 on (`multiversion` asks for their extensions, since older ones
/// run slower with it).
macro_rules! dispatch {
    ($format:ident, $float:ident) => {
        mod $format {
            use super::*;

            /// Holds the table of the format, made when first needed.
            static TABLE: LazyLock<Table<$float>> = LazyLock::new(Table::new);

            dispatch!(sums, $float, true);
            dispatch!(information, $float, false);
        }
    };
    ($name:ident, $float:ident, $entropy:literal) => {
        pub(super) fn $name(cells: &[$float; BLOCK]) -> Block {
            #[multiversion(targets(
                "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+bmi2+fma",
                "x86_64+avx2+bmi2+fma"
            ))]
            fn by_target(table: &Table<$float>, cells: &[$float; BLOCK]) -> Block {
                if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
                    Block::of::<$float, true, $entropy>(table, cells)
                } else {
                    Block::of::<$float, false, $entropy>(table, cells)
                }
            }

            by_target(&TABLE, cells)
        }
    };
}

dispatch!(single, f32);
dispatch!(double, f64);

#[cfg(test)]
mod tests;
