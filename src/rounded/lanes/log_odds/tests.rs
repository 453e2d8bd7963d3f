//! The kernels of log-odds against the enclosures, and their blocks against cells one by one.

use super::far::{CERTAIN, FARTHEST, OF_ENTROPY, OF_OCCUPANCY};
use super::table::{FIRST, LAST, SEVENTH, SIXTH, Table, centres, of_information, of_occupancy};
use super::{Entropy, Information, NEAR, Occupancy, Quantity, double, far, single};
use crate::cell::{Cell, State, entropy_from_log_odds, information_from_log_odds, occupancy_from_log_odds};
use crate::real::Real;
use crate::rounded::beyond_float::{self, Fixed};
use crate::rounded::lanes::format::{BLOCK, Lane, Split};
use crate::rounded::lanes::kernel::{Block, Results};
use crate::rounded::lanes::sum::Parts;
use crate::rounded::ziv::normalised;
use crate::rounded::{approximate, fixed, shift_right};
use crate::tally::ExactSum;
use alloc::vec::Vec;
use core::sync::atomic::{AtomicU64, Ordering};
use proptest::prelude::*;
use std::sync::LazyLock;

mod beyond;

static TABLE: LazyLock<Table> = LazyLock::new(|| Table::new(of_information));
static OCCUPANCY: LazyLock<Table> = LazyLock::new(|| Table::new(of_occupancy));

/// A format by all its kernels: sums, then entropy, information and occupancy, with fused operations or without.
trait Kernels: Lane {
    fn sums<const FUSED: bool, const ENTROPY: bool>(
        cells: &[Self; BLOCK],
        results: &mut Results<Self>,
    ) -> Block;
    fn results<Q: Quantity, const FUSED: bool>(cells: &[Self; BLOCK], results: &mut [Self; BLOCK]);
}

impl Kernels for f32 {
    fn sums<const FUSED: bool, const ENTROPY: bool>(
        cells: &[f32; BLOCK],
        results: &mut Results<f32>,
    ) -> Block {
        single::sums::<FUSED, ENTROPY>(cells, results)
    }
    fn results<Q: Quantity, const FUSED: bool>(cells: &[f32; BLOCK], results: &mut [f32; BLOCK]) {
        single::results::<Q, FUSED>(cells, results);
    }
}

impl Kernels for f64 {
    fn sums<const FUSED: bool, const ENTROPY: bool>(
        cells: &[f64; BLOCK],
        results: &mut Results<f64>,
    ) -> Block {
        double::sums::<FUSED, ENTROPY>(&TABLE, cells, results)
    }
    fn results<Q: Quantity, const FUSED: bool>(cells: &[f64; BLOCK], results: &mut [f64; BLOCK]) {
        let (table, powers) =
            if Q::OF_OCCUPANCY { (&OCCUPANCY, &OF_OCCUPANCY) } else { (&TABLE, &OF_ENTROPY) };
        let left = double::results::<Q, FUSED>(table, cells, results);
        let open = |l: &f64| (LAST..CERTAIN).contains(&l.abs()) && l.abs() > LAST && !Q::is_complement(*l);
        assert_eq!(left, cells.iter().filter(|l| open(l)).count() as u64);
        far::results::<Q, FUSED>(powers, cells, results);
    }
}

/// A block with the results of its cells one by one.
struct Expected<T> {
    cells: [T; BLOCK],
    singles: Vec<Option<Cell<T>>>,
}

impl<T: Kernels> Expected<T> {
    fn new(cells: [T; BLOCK]) -> Self {
        Self { cells, singles: cells.iter().map(|&l| Cell::from_log_odds(l).ok()).collect() }
    }

    /// Compares the results of a kernel with those of single cells; returns the number of those that are decided.
    fn results<Q: Quantity, const FUSED: bool>(&self, one: impl Fn(usize) -> T) -> usize {
        let mut results = [T::HALF; BLOCK];
        T::results::<Q, FUSED>(&self.cells, &mut results);
        let decided = (0..BLOCK).filter(|&k| results[k] != T::OPEN);
        let compared = decided.map(|k| {
            let (l, result) = (self.cells[k], results[k]);
            assert!(l.is_nan() && result.is_nan() || result == one(k), "{l:e}: {result:e} for {:e}", one(k));
        });
        compared.count()
    }

    /// Compares the sums of a block with those of its cells; returns the number of those that are in them.
    fn sums<const FUSED: bool, const ENTROPY: bool>(&self) -> usize {
        let mut results = [T::zero(); 2 * BLOCK];
        let mut block = T::sums::<FUSED, ENTROPY>(&self.cells, &mut results);
        block.add_small(&results);
        let open: Vec<T> = block.open(&self.cells).collect();
        assert!(open.iter().all(|l| !l.is_nan()), "NaN is passed over");
        let mut left = open.iter().copied().peekable();
        let (mut entropy, mut information) = (ExactSum::new(), ExactSum::new());
        let mut states = [0; 3];
        for (&l, cell) in self.cells.iter().zip(&self.singles) {
            let Some(cell) = cell.filter(|_| left.next_if_eq(&l).is_none()) else { continue };
            entropy.add(cell.entropy());
            information.add(cell.information());
            states[cell.state() as usize] += 1;
        }
        let sum = |x: Parts| {
            let mut sum = ExactSum::new();
            sum.add_parts::<f64>(x);
            sum
        };
        let [unknown, free, occupied] =
            [State::Unknown, State::Free, State::Occupied].map(|state| states[state as usize]);
        assert_eq!(sum(block.information), information);
        if ENTROPY {
            assert_eq!(sum(block.entropy), entropy);
            assert_eq!([block.unknown, block.free, block.occupied], [unknown, free, occupied]);
        } else {
            assert_eq!([block.unknown, block.free], [unknown, free + occupied]);
        }
        states.iter().sum::<u64>() as usize
    }
}

/// Checks a block by every kernel; returns the fewest cells that one decides.
fn check<T: Kernels>(cells: &[T; BLOCK]) -> usize {
    let block = Expected::new(*cells);
    let entropy = |k: usize| block.singles[k].map_or(T::nan(), |cell| cell.entropy());
    let information = |k: usize| block.singles[k].map_or(T::nan(), |cell| cell.information());
    let occupancies = cells.map(occupancy_from_log_odds);
    let occupancy = |k: usize| occupancies[k];
    let decided = [
        block.results::<Entropy, true>(entropy),
        block.results::<Entropy, false>(entropy),
        block.results::<Information, true>(information),
        block.results::<Information, false>(information),
        block.results::<Occupancy, true>(occupancy),
        block.results::<Occupancy, false>(occupancy),
        block.sums::<true, true>(),
        block.sums::<false, true>(),
        block.sums::<true, false>(),
        block.sums::<false, false>(),
    ];
    decided.into_iter().min().unwrap_or(0)
}

/// Repeats the cells until the block is full.
fn filled<T: Kernels>(cells: &[T]) -> [T; BLOCK] {
    core::array::from_fn(|k| cells[k % cells.len()])
}

/// Finds the log-odds at which the entropy falls below `2^-k`.
fn where_entropy_is(k: i32) -> f64 {
    let (mut low, mut high) = (1.0, 128.0);
    for _ in 0..60 {
        let middle = f64::midpoint(low, high);
        let is_above = entropy_from_log_odds(middle) >= f64::from_parts(1, -k);
        *(if is_above { &mut low } else { &mut high }) = middle;
    }
    low
}

fn special<T: Kernels>() {
    // NaN is decided, but in no sum.
    assert_eq!(check(&filled(&[T::nan()])), 0);
    let exact = [T::zero(), -T::zero(), T::infinity(), T::neg_infinity()];
    assert_eq!(check(&filled(&exact)), BLOCK);
    let beside = |x: f64| {
        let x = T::nearest(x);
        let ulp = x * T::epsilon();
        [x, x + ulp, x - ulp / (T::one() + T::one()), -x]
    };
    let borders = [FIRST, NEAR, 4.0, 34.7, LAST, 64.0, 72.0, 104.0, 128.0, FARTHEST, 745.0, CERTAIN, 1024.0];
    // Where entropies are in the next part of a sum: `f32` from 2^-21 and 2^-71 on, `f64` from 2^-50.
    for border in borders.into_iter().chain([21, 50, 71].map(where_entropy_is)) {
        check(&filled(&beside(border)));
    }
    check(&filled(&[
        T::max_value(),
        T::from_parts(1, T::MIN_EXPONENT),
        T::from_parts(1, T::MIN_EXPONENT / 2),
    ]));
}

#[test]
fn special_cells() {
    special::<f32>();
    special::<f64>();
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(32))]
    /// Towards 0, and towards certainty.
    #[test]
    fn blocks_are_cells_one_by_one(cells in prop::collection::vec(-1.0_f64..1.0, BLOCK), exponent in -40_i32..11) {
        let scale = f64::from_parts(1, exponent);
        let cells: Vec<f64> = cells.iter().map(|x| x * scale).collect();
        let decided = check(&filled(&cells));
        let singles: Vec<f32> = cells.iter().map(|&l| l as f32).collect();
        let decided_singles = check(&filled(&singles));
        // Few of a thousand fail the rounding test; some are next to 0.
        prop_assert!(!(-24..=5).contains(&exponent) || decided > BLOCK / 2);
        prop_assert!(!(-30..=5).contains(&exponent) || decided_singles > BLOCK - 8);
    }
}

/// In units of `2^unit`.
fn in_units(x: Fixed, unit: i32) -> i128 {
    match unit - x.exponent {
        up @ ..0 => (x.value << -up) as i128,
        down => shift_right(x.value, down) as i128,
    }
}

/// The same of a float, with its sign.
fn float_in_units(x: f64, unit: i32) -> i128 {
    let (value, exponent) = x.parts();
    let magnitude = in_units(Fixed { value: value.into(), exponent }, unit);
    if x < 0.0 { -magnitude } else { magnitude }
}

/// In units of `2^-120`.
fn units(x: Fixed) -> i128 {
    in_units(x, -120)
}

fn units_of(x: f64) -> i128 {
    float_in_units(x, -120)
}

/// `V` of a table, from its enclosure.
fn exact(x: f64, occupancy: bool) -> i128 {
    let (m, e) = normalised(x);
    let (entropy, information) = approximate::from_log_odds(m, e);
    let q = approximate::occupancy(fixed::floor_117(m, e), true);
    let v = if x < NEAR { information } else { entropy };
    units(beyond_float::middle(if occupancy { q } else { v }))
}

/// The largest error at the ends of the cells, relative to the value; from `2^-16` to 30, beyond which units are too coarse.
fn largest<const FUSED: bool>(table: &Table, occupancy: bool) -> f64 {
    let ends = centres().filter(|&c| (f64::from_parts(1, -16)..30.0).contains(&c)).flat_map(|c| {
        let half = if c < 4.0 { f64::from_parts(1, c.parts().1 + 44) } else { 1.0 / 128.0 };
        [c - half, c + half * 0.9999999]
    });
    let error = |x: f64| {
        let (head, tail) = double::value::<FUSED>(table, x);
        let exact = exact(x, occupancy);
        (units_of(head) + units_of(tail) - exact).abs() as f64 / exact as f64
    };
    ends.map(error).fold(0.0, f64::max)
}

/// The bound is proved in the chapter on sums; one ten times too large would leave cells open for nothing.
#[test]
fn errors_are_within_the_bound() {
    for (table, occupancy) in [(&TABLE, false), (&OCCUPANCY, true)] {
        for largest in [largest::<true>(table, occupancy), largest::<false>(table, occupancy)] {
            let share = largest / double::ERROR;
            assert!((0.1..=1.0).contains(&share), "{share}");
        }
    }
}

/// The same of the kernels of `f32`, whose value is a float: beside the functions in `f64`, which are a thousand times as near.
#[test]
fn errors_in_single_precision_are_within_the_bound() {
    fn largest<const FUSED: bool>() -> f64 {
        let errors = (1..16_000).map(|k| f64::from(k as f32 * 0.00377)).flat_map(|a| {
            let (q, p) = (single::occupancy::<FUSED>(-a), single::occupancy::<FUSED>(a));
            let v = single::value::<FUSED>(a, q);
            let exact = if a < NEAR { information_from_log_odds(a) } else { entropy_from_log_odds(a) };
            let occupancies = [q / occupancy_from_log_odds(-a) - 1.0, p / occupancy_from_log_odds(a) - 1.0];
            [v / exact - 1.0, (exact - v) / (1.0 - exact), occupancies[0], occupancies[1]]
        });
        errors.map(f64::abs).fold(0.0, f64::max)
    }
    for share in [largest::<true>(), largest::<false>()].map(|largest| largest / single::ERROR) {
        assert!((0.1..=1.0).contains(&share), "{share}");
    }
}

/// Checks a number of blocks by every kernel, on two threads, and prints a line for `proofs/RESULTS.md`.
fn check_blocks<T: Kernels>(what: &str, blocks: u64, block: impl Fn(u64) -> [T; BLOCK] + Sync) {
    let results = AtomicU64::new(0);
    let work = |part: u64| {
        for number in (part..blocks).step_by(2) {
            results.fetch_add(check(&block(number)) as u64, Ordering::Relaxed);
        }
    };
    std::thread::scope(|scope| (0..2).for_each(|part| drop(scope.spawn(move || work(part)))));
    let inputs = blocks * BLOCK as u64;
    std::println!("kernels of {what}: {inputs} inputs, {} results, 0 wrong", results.into_inner());
}

/// Every `f32` by every kernel, from where the information rounds to 0 to where the entropy does, the sign by turns.
#[test]
#[ignore = "minutes in release mode: proofs/exhaust.sh"]
fn every_single_by_every_kernel() {
    let (first, last) = (f32::from_parts(1, -80).to_bits(), 130.0_f32.to_bits());
    let blocks = (last - first).div_ceil(BLOCK as u32);
    check_blocks("log-odds in f32", blocks.into(), |block| {
        let sign = if block / 2 % 2 == 0 { 1.0 } else { -1.0 };
        core::array::from_fn(|k| sign * f32::from_bits(first + (block as usize * BLOCK + k) as u32))
    });
}

/// Ten million `f64`: a third as they are in maps, a third of every magnitude from `2^-33` to `2^6`, and a third far.
#[test]
#[ignore = "a minute in release mode: proofs/exhaust.sh"]
fn random_doubles_by_every_kernel() {
    check_blocks("log-odds in f64", 40_000, |block| {
        let mut state = block.wrapping_mul(0x9e37_79b9_7f4a_7c15) | 1;
        core::array::from_fn(|k| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let uniform = (state >> 11) as f64 / (1_u64 << 52) as f64 - 1.0;
            match k % 3 {
                0 => 12.0 * uniform,
                1 => (1.0 + uniform) * f64::from_parts(1, (state % 39) as i32 - 33),
                _ => (LAST + (FARTHEST - LAST) * uniform.abs()).copysign(uniform),
            }
        })
    });
}

/// A row of a table as the kernel sees it: the table's name, the centre, value, slope, their rests, and the coefficients.
type Seen = (&'static str, [f64; 11]);

fn rows() -> impl Iterator<Item = Seen> {
    [("bits", &TABLE), ("occupancy", &OCCUPANCY)].into_iter().flat_map(|(name, table)| {
        centres().enumerate().map(move |(number, c)| {
            let (value_low, slope_low) = f64::unpack(table.low[number]);
            let (a4, a7) = double::unpack(table.fourth[number], SEVENTH);
            let (a5, a6) = double::unpack(table.fifth[number], SIXTH);
            let (a2, a3) = (table.second[number], table.third[number]);
            let (value, slope) = (table.value[number], table.slope[number]);
            (name, [c, value, slope, value_low, slope_low, a2, a3, a4, a5, a6, a7])
        })
    })
}

/// A digest (64-bit FNV-1a) of the words of the tables.
fn digest() -> u64 {
    rows()
        .flat_map(|(_, row)| row.map(f64::to_bits))
        .flat_map(u64::to_le_bytes)
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// The rows that `proofs/log_odds_rows.sollya` has certified.
#[test]
fn the_tables_are_the_certified_ones() {
    assert_eq!(digest(), 0x7412_fb7e_01fd_074e);
}

/// Prints the rows for `proofs/log_odds_rows.sollya`.
#[test]
#[ignore = "output for proofs/check.sh"]
fn rows_for_the_proof() {
    let dyadic = |x: f64| {
        let (m, e) = x.parts();
        std::format!("{}{m} * 2^({e})", if x < 0.0 { "-" } else { "" })
    };
    for (name, row) in rows() {
        std::println!("row(\"{name}\", {});", row.map(dyadic).join(", "));
    }
}
