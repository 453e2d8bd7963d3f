//! Entropy and information of many cells at once, correctly rounded, in the lanes of whatever vector unit there is.
//!
//! Ziv's strategy once more, with a first step in floating point and without branches, which compilers turn into vector
//! instructions: about each of some thousand centres, value and slope are known to twice the precision ([`table`]), the
//! rest is a short polynomial ([`single`], [`double`]), and a rounding test shows whether the sum of them all has one nearest
//! float. The few cells that fail it are left to [`CellEnclosures`](super::CellEnclosures). So every vector unit gives
//! the same bits: the right ones. The results are stored one by one, or summed up ([`sum`]); [`log_odds`] has
//! the same for log-odds. The proofs are in the chapter [`sums`](crate::book::sums).

// A call or a branch in the loop and it is no longer made into vector instructions.
#![allow(clippy::inline_always, clippy::needless_bitwise_bool)]

mod double;
mod format;
mod kernel;
mod log_odds;
mod single;
mod sum;
mod table;

pub(crate) use format::{BLOCK, FEW};
pub(crate) use kernel::{Block, Results};

use crate::real::{Floats, Pair, Real};
use multiversion::multiversion;
use multiversion::target::target_cfg_f;
use std::sync::LazyLock;
use table::Table;

/// Returns a block of the cells that are left after whole ones, and NaN, which no kernel counts (theorem (blocks), *Domain*); `None`
/// of so few that single cells are as fast.
pub(crate) fn padded<T: Real>(cells: &[T]) -> Option<[T; BLOCK]> {
    let is_worth_it = cells.len() >= FEW;
    is_worth_it.then(|| {
        let mut block = [T::nan(); BLOCK];
        block[..cells.len()].copy_from_slice(cells);
        block
    })
}

/// Sums entropy and information over a block of occupancies, by the widest vector unit at hand.
pub(crate) fn sums<T: Real>(cells: &[T; BLOCK], results: &mut Results<T>) -> Block {
    let block = match T::pair(cells, results) {
        Pair::Single(cells, results) => single_occupancies::sums(cells, results),
        Pair::Double(cells, results) => double_occupancies::sums(cells, results),
    };
    with_small(block, results)
}

/// Sums the information over a block of occupancies, without entropies.
pub(crate) fn information<T: Real>(cells: &[T; BLOCK], results: &mut Results<T>) -> Block {
    let block = match T::pair(cells, results) {
        Pair::Single(cells, results) => single_occupancies::information(cells, results),
        Pair::Double(cells, results) => double_occupancies::information(cells, results),
    };
    with_small(block, results)
}

/// Stores the entropy of each occupancy of a block: the nearest float, NaN outside `[0, 1]`, a negative number where it is
/// not decided.
pub(crate) fn entropies<T: Real>(cells: &[T; BLOCK], results: &mut [T; BLOCK]) {
    match T::pair(cells, results) {
        Pair::Single(cells, results) => single_occupancies::entropies(cells, results),
        Pair::Double(cells, results) => double_occupancies::entropies(cells, results),
    }
}

/// Stores the information of each occupancy of a block, as [`entropies`] does.
pub(crate) fn informations<T: Real>(cells: &[T; BLOCK], results: &mut [T; BLOCK]) {
    match T::pair(cells, results) {
        Pair::Single(cells, results) => single_occupancies::informations(cells, results),
        Pair::Double(cells, results) => double_occupancies::informations(cells, results),
    }
}

/// Sums entropy and information over a block of log-odds.
pub(crate) fn sums_from_log_odds<T: Real>(cells: &[T; BLOCK], results: &mut Results<T>) -> Block {
    let block = match T::pair(cells, results) {
        Pair::Single(cells, results) => single_log_odds::sums(cells, results),
        Pair::Double(cells, results) => double_log_odds::sums(cells, results),
    };
    with_small(block, results)
}

/// Sums the information over a block of log-odds, without entropies.
pub(crate) fn information_from_log_odds<T: Real>(cells: &[T; BLOCK], results: &mut Results<T>) -> Block {
    let block = match T::pair(cells, results) {
        Pair::Single(cells, results) => single_log_odds::information(cells, results),
        Pair::Double(cells, results) => double_log_odds::information(cells, results),
    };
    with_small(block, results)
}

/// Returns whether log-odds have an entropy in a kernel of their own: beyond the tables, which `f32` has not.
#[inline]
pub(crate) fn is_far<T: Real>(l: T) -> bool {
    T::PRECISION == f64::PRECISION && log_odds::far::is_far(l.widen().abs())
}

/// Stores the entropy at each of a block's log-odds: the nearest float, NaN at NaN, a negative number where it is not
/// decided.
pub(crate) fn entropies_from_log_odds<T: Real>(cells: &[T; BLOCK], results: &mut [T; BLOCK]) {
    match T::pair(cells, results) {
        Pair::Single(cells, results) => single_log_odds::entropies(cells, results),
        Pair::Double(cells, results) => double_log_odds::entropies(cells, results),
    }
}

/// Stores the information at each of a block's log-odds, as [`entropies_from_log_odds`] does.
pub(crate) fn informations_from_log_odds<T: Real>(cells: &[T; BLOCK], results: &mut [T; BLOCK]) {
    match T::pair(cells, results) {
        Pair::Single(cells, results) => single_log_odds::informations(cells, results),
        Pair::Double(cells, results) => double_log_odds::informations(cells, results),
    }
}

/// Stores the occupancy at each of a block's log-odds, as [`entropies_from_log_odds`] does.
pub(crate) fn occupancies_from_log_odds<T: Real>(cells: &[T; BLOCK], results: &mut [T; BLOCK]) {
    match T::pair(cells, results) {
        Pair::Single(cells, results) => single_log_odds::occupancies(cells, results),
        Pair::Double(cells, results) => double_log_odds::occupancies(cells, results),
    }
}

/// Returns false if all results of a block are decided; true also if one is a NaN with a sign.
pub(crate) fn some_are_open<T: Real>(results: &[T; BLOCK]) -> bool {
    match T::floats(results) {
        Floats::Single(results) => some_singles_are_open(results),
        Floats::Double(results) => some_doubles_are_open(results),
    }
}

/// Returns a block with its small results in the sums.
#[inline]
fn with_small<T: Real>(mut block: Block, results: &Results<T>) -> Block {
    if block.has_small != [false; 2] {
        // Apart from the kernels, since few blocks have any.
        match T::floats(results) {
            Floats::Single(results) => add_small_single(&mut block, results),
            Floats::Double(results) => add_small_double(&mut block, results),
        }
    }
    block
}

/// Compiles a kernel for several vector units, of which the widest is taken that the processor has: AVX-512 from Ice
/// Lake and Zen 4 on (`multiversion` asks for their extensions, since older ones run slower with it). `FUSED` is a
/// constant that the call may use.
macro_rules! by_target {
    ($visibility:vis fn $name:ident($($argument:ident: $type:ty),*) $(-> $result:ty)? { $call:expr }) => {
        #[multiversion(targets(
            "x86_64+avx512f+avx512bw+avx512cd+avx512dq+avx512vl+avx2+bmi2+fma",
            "x86_64+avx2+bmi2+fma"
        ))]
        $visibility fn $name($($argument: $type),*) $(-> $result)? {
            if target_cfg_f!(any(target_feature = "fma", target_arch = "aarch64")) {
                #[allow(dead_code, reason = "some have no fused operations")]
                const FUSED: bool = true;
                $call
            } else {
                #[allow(dead_code, reason = "some have no fused operations")]
                const FUSED: bool = false;
                $call
            }
        }
    };
}

by_target!(
    fn add_small_single(block: &mut Block, results: &Results<f32>) {
        block.add_small(results)
    }
);
by_target!(
    fn add_small_double(block: &mut Block, results: &Results<f64>) {
        block.add_small(results)
    }
);

by_target!(
    fn some_singles_are_open(results: &[f32; BLOCK]) -> bool {
        results.iter().fold(0, |bits, result| bits | result.to_bits()) >> (u32::BITS - 1) != 0
    }
);
by_target!(
    fn some_doubles_are_open(results: &[f64; BLOCK]) -> bool {
        results.iter().fold(0, |bits, result| bits | result.to_bits()) >> (u64::BITS - 1) != 0
    }
);

/// Holds the table of occupancies, of either format, made when first needed.
static TABLE: LazyLock<Table> = LazyLock::new(Table::new);

/// Defines the kernels of occupancies for a format.
macro_rules! of_occupancies {
    ($name:ident, $float:ident, $format:ident) => {
        mod $name {
            use super::$format::{results, sums as block};
            use super::{BLOCK, Block, Results, TABLE, Table, multiversion, target_cfg_f};

            by_target!(
                fn both(table: &Table, cells: &[$float; BLOCK], results: &mut Results<$float>) -> Block {
                    block::<FUSED, true>(table, cells, results)
                }
            );
            by_target!(
                fn one(table: &Table, cells: &[$float; BLOCK], results: &mut Results<$float>) -> Block {
                    block::<FUSED, false>(table, cells, results)
                }
            );
            by_target!(
                fn entropy(table: &Table, cells: &[$float; BLOCK], places: &mut [$float; BLOCK]) {
                    results::<FUSED, true>(table, cells, places)
                }
            );
            by_target!(
                fn only_information(table: &Table, cells: &[$float; BLOCK], places: &mut [$float; BLOCK]) {
                    results::<FUSED, false>(table, cells, places)
                }
            );

            pub(super) fn sums(cells: &[$float; BLOCK], results: &mut Results<$float>) -> Block {
                both(&TABLE, cells, results)
            }

            pub(super) fn information(cells: &[$float; BLOCK], results: &mut Results<$float>) -> Block {
                one(&TABLE, cells, results)
            }

            pub(super) fn entropies(cells: &[$float; BLOCK], places: &mut [$float; BLOCK]) {
                entropy(&TABLE, cells, places);
            }

            pub(super) fn informations(cells: &[$float; BLOCK], places: &mut [$float; BLOCK]) {
                only_information(&TABLE, cells, places);
            }
        }
    };
}

of_occupancies!(single_occupancies, f32, single);
of_occupancies!(double_occupancies, f64, double);

/// The kernels of log-odds in `f32`.
mod single_log_odds {
    use super::log_odds::single::{results, sums as block};
    use super::log_odds::{Entropy, Information, Occupancy};
    use super::{BLOCK, Block, Results, multiversion, target_cfg_f};

    by_target!(
        pub(super) fn sums(cells: &[f32; BLOCK], results: &mut Results<f32>) -> Block {
            block::<FUSED, true>(cells, results)
        }
    );
    by_target!(
        pub(super) fn information(cells: &[f32; BLOCK], results: &mut Results<f32>) -> Block {
            block::<FUSED, false>(cells, results)
        }
    );
    by_target!(
        pub(super) fn entropies(cells: &[f32; BLOCK], places: &mut [f32; BLOCK]) {
            results::<Entropy, FUSED>(cells, places)
        }
    );
    by_target!(
        pub(super) fn informations(cells: &[f32; BLOCK], places: &mut [f32; BLOCK]) {
            results::<Information, FUSED>(cells, places)
        }
    );
    by_target!(
        pub(super) fn occupancies(cells: &[f32; BLOCK], places: &mut [f32; BLOCK]) {
            results::<Occupancy, FUSED>(cells, places)
        }
    );
}

/// The kernels of log-odds in `f64`.
mod double_log_odds {
    use super::log_odds::double::{results, sums as block};
    use super::log_odds::far::{self, OF_ENTROPY, OF_OCCUPANCY, Powers, is_far};
    use super::log_odds::table::{Table, of_information, of_occupancy};
    use super::log_odds::{Entropy, Information, Occupancy};
    use super::{BLOCK, Block, LazyLock, Results, multiversion, target_cfg_f};

    /// Holds the table of information and entropy, made when first needed.
    static TABLE: LazyLock<Table> = LazyLock::new(|| Table::new(of_information));
    /// Holds the table of the smaller probability, made when first needed.
    static OCCUPANCY: LazyLock<Table> = LazyLock::new(|| Table::new(of_occupancy));

    /// The number of far cells of a block that are faster one by one.
    const FEW: u64 = 4;

    by_target!(
        fn both(table: &Table, cells: &[f64; BLOCK], results: &mut Results<f64>) -> Block {
            block::<FUSED, true>(table, cells, results)
        }
    );
    by_target!(
        fn one(table: &Table, cells: &[f64; BLOCK], results: &mut Results<f64>) -> Block {
            block::<FUSED, false>(table, cells, results)
        }
    );
    by_target!(
        fn entropy(table: &Table, cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) -> u64 {
            results::<Entropy, FUSED>(table, cells, places)
        }
    );
    by_target!(
        fn only_information(table: &Table, cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) -> u64 {
            results::<Information, FUSED>(table, cells, places)
        }
    );
    by_target!(
        fn occupancy(table: &Table, cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) -> u64 {
            results::<Occupancy, FUSED>(table, cells, places)
        }
    );
    by_target!(
        fn far_entropy(powers: &Powers, cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) {
            far::results::<Entropy, FUSED>(powers, cells, places)
        }
    );
    by_target!(
        fn far_occupancy(powers: &Powers, cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) {
            far::results::<Occupancy, FUSED>(powers, cells, places)
        }
    );

    pub(super) fn sums(cells: &[f64; BLOCK], results: &mut Results<f64>) -> Block {
        both(&TABLE, cells, results)
    }

    pub(super) fn information(cells: &[f64; BLOCK], results: &mut Results<f64>) -> Block {
        one(&TABLE, cells, results)
    }

    pub(super) fn entropies(cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) {
        if are_far(cells) || entropy(&TABLE, cells, places) > FEW {
            far_entropy(&OF_ENTROPY, cells, places);
        }
    }

    pub(super) fn informations(cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) {
        only_information(&TABLE, cells, places);
    }

    pub(super) fn occupancies(cells: &[f64; BLOCK], places: &mut [f64; BLOCK]) {
        if are_far(cells) || occupancy(&OCCUPANCY, cells, places) > FEW {
            far_occupancy(&OF_OCCUPANCY, cells, places);
        }
    }

    /// Returns whether all cells of a block are far.
    fn are_far(cells: &[f64; BLOCK]) -> bool {
        cells.iter().all(|l| is_far(l.abs()))
    }
}

#[cfg(test)]
mod tests;
