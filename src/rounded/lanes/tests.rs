//! The kernel against the enclosures, and its blocks against cells one by one.

use super::format::{BLOCK, HALF, LEAST, Lane, Split};
use super::kernel::{Block, Results, distance};
use super::sum::Parts;
use super::table::{Rows, Table, row};
use super::{double, single};
use crate::cell::{Cell, State};
use crate::real::Real;
use crate::rounded::beyond_float::{self, Fixed};
use crate::rounded::{approximate, normalised, shift_right};
use crate::tally::ExactSum;
use alloc::vec::Vec;
use approx::abs_diff_eq;
use core::sync::atomic::{AtomicU64, Ordering};
use proptest::prelude::*;

/// The kernels of a format.
trait Kernels: Lane {
    const ERROR: f64;
    /// The coefficients of the series.
    const TERMS: usize;

    /// `V` in two parts.
    fn value<const FUSED: bool, const ENTROPY: bool>(table: &Table, x: Self, near: bool) -> [f64; 2];
    fn series<const FUSED: bool>(b: Self, y: Self) -> Self;
    fn results<const FUSED: bool, const ENTROPY: bool>(
        table: &Table,
        cells: &[Self; BLOCK],
        results: &mut [Self; BLOCK],
    );
    fn sums<const FUSED: bool, const ENTROPY: bool>(
        table: &Table,
        cells: &[Self; BLOCK],
        results: &mut Results<Self>,
    ) -> Block;
}

macro_rules! impl_kernels {
    ($float:ident, $kernel:ident, $terms:literal, $value:item) => {
        impl Kernels for $float {
            const ERROR: f64 = $kernel::ERROR;
            const TERMS: usize = $terms;

            $value

            fn series<const FUSED: bool>(b: Self, y: Self) -> Self {
                $kernel::series::<FUSED>(b, y)
            }

            fn results<const FUSED: bool, const ENTROPY: bool>(
                table: &Table,
                cells: &[Self; BLOCK],
                results: &mut [Self; BLOCK],
            ) {
                $kernel::results::<FUSED, ENTROPY>(table, cells, results);
            }

            fn sums<const FUSED: bool, const ENTROPY: bool>(
                table: &Table,
                cells: &[Self; BLOCK],
                results: &mut Results<Self>,
            ) -> Block {
                $kernel::sums::<FUSED, ENTROPY>(table, cells, results)
            }
        }
    };
}

impl_kernels!(
    f32,
    single,
    3,
    fn value<const FUSED: bool, const ENTROPY: bool>(table: &Table, x: f32, near: bool) -> [f64; 2] {
        let (c, number) = f32::centre(x);
        let (rows, row) = (table.rows::<ENTROPY>(), row::<ENTROPY>(number, near));
        let (h, rest) = single::rest::<FUSED, ENTROPY>(x, c, near);
        [single::value::<FUSED>(rows.value[row], rows.slope[row], h, rest), 0.0]
    }
);
impl_kernels!(
    f64,
    double,
    6,
    fn value<const FUSED: bool, const ENTROPY: bool>(table: &Table, x: f64, near: bool) -> [f64; 2] {
        double::value::<FUSED, ENTROPY>(&table.rows::<ENTROPY>(), x, near).into()
    }
);

/// In units of `2^unit`.
fn units(x: Fixed, unit: i32) -> i128 {
    match unit - x.exponent {
        up @ ..0 => (x.value << -up) as i128,
        down => shift_right(x.value, down) as i128,
    }
}

fn units_of<T: Lane>(x: T, unit: i32) -> i128 {
    let (value, exponent) = x.parts();
    let magnitude = units(Fixed { value: value.into(), exponent }, unit);
    if x < T::zero() { -magnitude } else { magnitude }
}

/// The error of the kernel's value at `p`, relative to the value; `None` beyond the table.
fn error<T: Kernels, const FUSED: bool, const ENTROPY: bool>(table: &Table, p: T) -> Option<f64> {
    let q = p.min(T::one() - p);
    let near = q + q > T::HALF;
    let x = if near { T::one() - (q + q) } else { q + q };
    if x < T::nearest(LEAST.into()) {
        return None;
    }
    let (m, e) = normalised(p);
    let (entropy, information) = approximate::from_occupancy(m, e);
    let exact = beyond_float::middle(if ENTROPY && !near { entropy } else { information });
    // Of 120 bits, whatever its size.
    let unit = exact.exponent + 8 - exact.value.leading_zeros() as i32;
    let exact = units(exact, unit);
    let parts = T::value::<FUSED, ENTROPY>(table, x, near).map(|part| units_of(part, unit));
    Some((parts[0] + parts[1] - exact).abs() as f64 / exact as f64)
}

/// The rows of the table that have a centre: the value's name, the centre, value, slope, their rests and the inverse.
fn rows(table: &Table) -> impl Iterator<Item = (&'static str, [f64; 6])> {
    fn row_of(rows: &Rows<'_>, row: usize, c: f64) -> [f64; 6] {
        let (value_low, slope_low) = f64::unpack(rows.low[row]);
        [c, rows.value[row], rows.slope[row], value_low, slope_low, rows.inverse[row]]
    }
    (0..HALF).map_while(|number| Some((number as u32, f64::centre_of(number)?))).flat_map(
        move |(number, c)| {
            [
                ("near", row_of(&table.rows::<true>(), row::<true>(number, true), c)),
                ("entropy", row_of(&table.rows::<true>(), row::<true>(number, false), c)),
                ("information", row_of(&table.rows::<false>(), row::<false>(number, false), c)),
            ]
        },
    )
}

/// A digest (64-bit FNV-1a) of the words of the table.
fn digest() -> u64 {
    rows(&Table::new())
        .flat_map(|(_, row)| row)
        .flat_map(|x| x.to_bits().to_le_bytes())
        .fold(0xcbf2_9ce4_8422_2325, |hash, byte| (hash ^ u64::from(byte)).wrapping_mul(0x0100_0000_01b3))
}

/// The rows that `proofs/rows.sollya` has certified.
#[test]
fn the_table_is_the_certified_one() {
    assert_eq!(digest(), 0xe139_9cde_96b7_f1bb);
}

/// Both formats have the same centres, under the same numbers.
#[test]
fn the_formats_share_the_table() {
    let centres = (0..=HALF).map_while(f64::centre_of);
    assert!(centres.eq((0..=HALF).map_while(f32::centre_of).map(f64::from)));
    for x in ends::<f32>().map(|p| distance(p).0).filter(|&x| x >= LEAST) {
        let ((c, number), (centre, same)) = (f32::centre(x), f64::centre(x.into()));
        assert_eq!((f64::from(c), number), (centre, same), "{x}");
    }
}

/// Prints the rows for `proofs/rows.sollya`.
#[test]
#[ignore = "output for proofs/check.sh"]
fn rows_for_the_proof() {
    let dyadic = |x: f64| {
        let (m, e) = x.parts();
        std::format!("{}{m} * 2^({e})", if x < 0.0 { "-" } else { "" })
    };
    std::println!("// {:#x?}", digest());
    for (name, row) in rows(&Table::new()) {
        std::println!("row(\"{name}\", {});", row.map(dyadic).join(", "));
    }
}

/// Both ends of each cell of the table, where the centre is farthest, in both halves of it.
fn ends<T: Lane>() -> impl Iterator<Item = T> {
    let cells = (0..).map_while(T::centre_of);
    cells.flat_map(|c| {
        let (m, e) = c.parts();
        // The lowest bit of a centre is half of its cell.
        let half = T::from_parts(m & m.wrapping_neg(), e);
        let (first, last) = (c - half, c + half - T::from_parts(1, e));
        [first, last].into_iter().flat_map(|x| [x * T::HALF, T::HALF - x * T::HALF, T::HALF + x * T::HALF])
    })
}

/// The largest error at the ends of the cells, relative to the bound.
fn largest<T: Kernels>() -> f64 {
    let table = &Table::new();
    let errors = ends::<T>().filter(|&p| p < T::one()).flat_map(|p| {
        [
            error::<T, true, true>(table, p),
            error::<T, false, true>(table, p),
            error::<T, true, false>(table, p),
            error::<T, false, false>(table, p),
        ]
    });
    errors.flatten().fold(0.0, f64::max) / T::ERROR
}

/// `2 ln 2 E` from the powers of `c' = (1 - b) / 2`, with an argument so large that every term is seen.
#[test]
fn the_series_has_the_coefficients_of_the_chapter() {
    fn check<T: Kernels>(b: f64, y: f64) {
        let (c, rest) = ((1.0 - b) / 2.0, f64::midpoint(1.0, b));
        let power = |x: f64, n: usize| (0..n).fold(1.0, |product, _| product * x);
        let term = |j: usize| {
            let sign = if j.is_multiple_of(2) { 1.0 } else { -1.0 };
            (sign * power(rest, j + 1) + power(c, j + 1)) / ((j + 1) * (j + 2)) as f64 * power(y, j)
        };
        let exact = (0..T::TERMS).map(term).sum::<f64>() / (2.0 * core::f64::consts::LN_2);
        for found in
            [T::series::<true>, T::series::<false>].map(|series| series(T::nearest(b), T::nearest(y)))
        {
            // A dozen roundings of terms below 1.
            assert!(
                abs_diff_eq!(found.widen(), exact, epsilon = 16.0 * T::epsilon().widen()),
                "{b} {y}: {found} {exact}"
            );
        }
    }
    for (b, y) in [(0.9375, 0.875), (-0.8125, 0.75), (0.375, -0.9375), (0.0, 0.5), (-0.5625, -0.8125)] {
        check::<f64>(b, y);
        check::<f32>(b, y);
    }
}

/// The bounds are proved in the chapter on sums. They are sums of the worst of each operation, a few times what
/// happens; a bound ten times too large would leave cells open for nothing.
#[test]
fn errors_are_within_the_bounds() {
    let (single, double) = (largest::<f32>(), largest::<f64>());
    assert!(single <= 1.0 && double <= 1.0, "{single} {double}");
    assert!(single > 0.1 && double > 0.1, "{single} {double}");
}

/// What a block must have found, and what must be stored, from its cells one by one.
fn check<T: Kernels, const FUSED: bool, const ENTROPY: bool>(
    table: &Table,
    cells: &[T; BLOCK],
    singles: &[Option<Cell<T>>; BLOCK],
) -> usize {
    let mut stored = [T::HALF; BLOCK];
    T::results::<FUSED, ENTROPY>(table, cells, &mut stored);
    for ((&p, &result), single) in cells.iter().zip(&stored).zip(singles) {
        let one = single.map_or(T::nan(), |cell| if ENTROPY { cell.entropy() } else { cell.information() });
        assert!(
            result == T::OPEN || result == one || one.is_nan() && result.is_nan(),
            "{p:e}: {result:e} for {one:e}"
        );
    }
    let mut results = [T::zero(); 2 * BLOCK];
    let mut block = T::sums::<FUSED, ENTROPY>(table, cells, &mut results);
    block.add_small(&results);
    let (mut entropy, mut information) = (ExactSum::new(), ExactSum::new());
    let mut states = Vec::new();
    let open: Vec<T> = block.open(cells).collect();
    assert!(open.iter().all(|&p| Cell::from_occupancy(p).is_ok()), "only cells are left open");
    // But near 1/2 the bound on a stored entropy of f32 is relative to `1 - V`.
    let near = |p: T| T::PRECISION == f32::PRECISION && (p - T::HALF).abs() < T::HALF * T::HALF;
    let undecided = cells.iter().zip(&stored).filter(|(p, result)| **result == T::OPEN && !near(**p)).count();
    assert!(undecided <= open.len(), "one result of a cell is undecided where both are decided");
    let mut left = open.iter().copied().peekable();
    for (&p, &single) in cells.iter().zip(singles) {
        if left.next_if(|&x| x == p).is_some() {
            continue;
        }
        // What is no probability is passed over.
        let Some(cell) = single else { continue };
        entropy.add(cell.entropy());
        information.add(cell.information());
        states.push(cell.state());
    }
    let sum = |x: Parts| {
        let mut sum = ExactSum::new();
        sum.add_parts::<f64>(x);
        sum
    };
    let count = |state| states.iter().filter(|&&x| x == state).count() as u64;
    assert_eq!(sum(block.information), information);
    assert_eq!(block.unknown, count(State::Unknown));
    if ENTROPY {
        assert_eq!(sum(block.entropy), entropy);
        assert_eq!(block.occupied, count(State::Occupied));
        assert_eq!(block.free, count(State::Free));
    } else {
        assert_eq!(block.free, count(State::Free) + count(State::Occupied));
    }
    states.len()
}

/// The fewest cells that a kernel decides.
fn check_all<T: Kernels>(table: &Table, cells: &[T; BLOCK]) -> usize {
    let singles = singles(cells);
    let decided = [
        check::<T, true, true>(table, cells, &singles),
        check::<T, false, true>(table, cells, &singles),
        check::<T, true, false>(table, cells, &singles),
        check::<T, false, false>(table, cells, &singles),
    ];
    decided.into_iter().min().unwrap_or(0)
}

/// The cells one by one; none where there is no probability.
fn singles<T: Lane>(cells: &[T; BLOCK]) -> [Option<Cell<T>>; BLOCK] {
    cells.map(|p| Cell::from_occupancy(p).ok())
}

/// Repeats the cells until the block is full.
fn filled<T: Lane>(cells: &[T]) -> [T; BLOCK] {
    core::array::from_fn(|k| cells[k % cells.len()])
}

fn special<T: Kernels>() {
    let table = &Table::new();
    let (one, least) = (T::one(), T::from_parts(1, T::MIN_EXPONENT));
    let ulp = T::epsilon();
    let edge = T::nearest(f64::from(LEAST) / 2.0);
    let none = [T::nan(), -T::HALF, one + ulp, T::infinity(), T::neg_infinity(), -least, T::max_value()];
    assert_eq!(check_all(table, &filled(&none)), 0);
    let exact = [T::zero(), -T::zero(), T::HALF, one];
    assert_eq!(check_all(table, &filled(&exact)), BLOCK);
    assert_eq!(check_all(table, &filled(&[least, edge - edge * ulp])), 0);
    let beside = [T::HALF + ulp, T::HALF - ulp, one - ulp / (one + one), T::HALF - edge * T::HALF];
    let inside = if T::epsilon().widen() < f64::from(LEAST) { 0 } else { BLOCK };
    assert_eq!(check_all(table, &filled(&beside)), inside);
    let quarter = T::HALF * T::HALF;
    let borders =
        [edge, T::HALF - edge, T::HALF + edge, quarter, quarter + ulp, quarter - ulp, one - quarter];
    assert!(check_all(table, &filled(&borders)) > BLOCK / 2);
}

#[test]
fn special_cells() {
    special::<f32>();
    special::<f64>();
}

/// Random cells towards 0, towards 1/2 and towards 1.
#[test]
fn blocks_are_sums_of_cells() {
    let table = Table::new();
    proptest!(ProptestConfig::with_cases(32), |(cells in prop::collection::vec(0.0_f64..1.0, BLOCK), scale in 0_i32..40)| {
        let power = f64::from_parts(1, -scale);
        let towards: [fn(f64) -> f64; 3] = [|d| d, |d| 0.5 + d / 2.0, |d| 1.0 - d];
        for place in towards {
            let cells: Vec<f64> = cells.iter().map(|d| place(d * power)).collect();
            let decided = check_all(&table, &filled(&cells));
            let singles: Vec<f32> = cells.iter().map(|&p| p as f32).collect();
            let decided_singles = check_all(&table, &filled(&singles));
            // Few of a hundred fail the rounding test (docs/sums.md).
            prop_assert!(scale > 5 || decided > BLOCK / 2 && decided_singles > BLOCK / 2);
        }
    });
}

/// Every `f32` that the table reaches, by every kernel: in blocks of successive floats, and of floats far from each
/// other, so that no two errors make up for each other in both.
#[test]
#[ignore = "minutes in release mode: proofs/exhaust.sh"]
fn every_single_by_every_kernel() {
    let table = &Table::new();
    let (first, last) = (f32::from_parts(1, -34).to_bits(), 1.0_f32.to_bits());
    let blocks = (last - first).div_ceil(BLOCK as u32);
    let results = AtomicU64::new(0);
    let work = |part: u32| {
        for block in (part..blocks).step_by(2) {
            let successive: [f32; BLOCK] =
                core::array::from_fn(|k| f32::from_bits(first + block * BLOCK as u32 + k as u32));
            let apart = core::array::from_fn(|k| f32::from_bits(first + block + k as u32 * blocks));
            let decided = check_all(table, &successive) + check_all(table, &apart);
            results.fetch_add(decided as u64, Ordering::Relaxed);
        }
    };
    std::thread::scope(|scope| (0..2).for_each(|part| drop(scope.spawn(move || work(part)))));
    let inputs = u64::from(blocks) * BLOCK as u64;
    std::println!("kernels of f32: {inputs} inputs, {} results, 0 wrong", results.into_inner());
}
