//! Log-odds sorted apart: those that the tables have, and those far beyond, for each of which there is a kernel.
//!
//! Either kernel takes as long for a cell of the other as for one of its own, so that a map of both would pay twice. Sums of cells
//! are exact, so their order does not matter.

use crate::real::Real;
use crate::rounded::lanes::{self, BLOCK};
use alloc::vec::Vec;

/// The number of cells of which it is decided together whether they are sorted.
const STRETCH: usize = 4096;
/// The number of cells of which one is looked at, to see whether some are far.
const EVERY: usize = 16;
/// The number of far ones among those that are looked at up to which all are left as they are: single cells decide them.
const FEW: usize = 2;

/// Calls `take` with cells of which few are far, and with cells that all are: each cell is in one call.
pub(super) fn each<T: Real>(cells: &[T], mut take: impl FnMut(&[T], &[T])) {
    let mut sorted = Sorted { near: Vec::new(), far: Vec::new(), near_count: 0, far_count: 0 };
    let mut first = 0;
    for (number, stretch) in cells.chunks(STRETCH).enumerate() {
        // At another place of each 16, since far cells may recur after a number of cells that divides 16.
        let looked_at = stretch.chunks(EVERY).enumerate().map(|(k, cells)| cells[5 * k % cells.len()]);
        let seen = looked_at.filter(|&l| lanes::is_far(l)).count();
        if seen <= FEW {
            continue;
        }
        // Those since the last that was sorted.
        let start = number * STRETCH;
        take(&cells[first..start], &[]);
        first = start + stretch.len();
        sorted.add(stretch);
        sorted.take_blocks(&mut take);
    }
    take(&cells[first..], &[]);
    take(&sorted.near[..sorted.near_count], &sorted.far[..sorted.far_count]);
}

/// Cells sorted apart, of which whole blocks are taken.
struct Sorted<T> {
    near: Vec<T>,
    far: Vec<T>,
    near_count: usize,
    far_count: usize,
}

impl<T: Real> Sorted<T> {
    /// Adds the cells of a stretch, where either kind has less than a block.
    fn add(&mut self, cells: &[T]) {
        for places in [&mut self.near, &mut self.far] {
            places.resize(STRETCH + BLOCK, T::zero());
        }
        let before = self.near_count + self.far_count;
        let mut near = self.near_count;
        for (k, &l) in cells.iter().enumerate() {
            // Into both, where the next one takes the place of one that is wrong: no processor could foresee a branch.
            self.near[near] = l;
            self.far[before + k - near] = l;
            near += usize::from(!lanes::is_far(l));
        }
        (self.near_count, self.far_count) = (near, before + cells.len() - near);
    }

    /// Calls `take` with the whole blocks, and keeps the rest.
    fn take_blocks(&mut self, mut take: impl FnMut(&[T], &[T])) {
        let [near, far] = [self.near_count, self.far_count].map(|count| count / BLOCK * BLOCK);
        take(&self.near[..near], &self.far[..far]);
        self.near.copy_within(near..self.near_count, 0);
        self.far.copy_within(far..self.far_count, 0);
        (self.near_count, self.far_count) = (self.near_count - near, self.far_count - far);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Calls [`each`]; returns how many cells come with which are far, and how many far ones, when all are there in some order.
    fn taken(cells: &[f64]) -> (usize, usize) {
        let (mut all, mut counts) = (Vec::new(), (0, 0));
        each(cells, |near, far| {
            assert!(far.iter().all(|&l| lanes::is_far(l)));
            all.extend([near, far].concat());
            counts.0 += near.len();
            counts.1 += far.len();
        });
        all.sort_by(f64::total_cmp);
        let mut given = cells.to_vec();
        given.sort_by(f64::total_cmp);
        assert_eq!(all, given);
        counts
    }

    #[test]
    fn far_cells_are_sorted_apart() {
        let far = |k: usize| 64.0 + k as f64 / 1000.0;
        let cells = |is_far: fn(usize) -> bool, count: usize| -> Vec<f64> {
            (0..count).map(|k| if is_far(k) { -far(k) } else { far(k) / -512.0 }).collect()
        };
        assert_eq!(taken(&[]), (0, 0));
        assert_eq!(taken(&cells(|_| true, 10_000)), (0, 10_000));
        assert_eq!(taken(&cells(|_| false, 10_000)), (10_000, 0));
        assert_eq!(taken(&cells(|k| k % 5 == 0, 10_000)), (8000, 2000));
        // Wherever they are among 16.
        assert_eq!(taken(&cells(|k| k % 2 == 1, 10_000)), (5000, 5000));
        assert_eq!(taken(&cells(|k| k % 16 == 7, 16_000)), (15_000, 1000));
        // The second stretch and a part of the third, and one that is seen alone.
        assert_eq!(taken(&cells(|k| (5000..9000).contains(&k), 20_000)), (16_000, 4000));
        assert_eq!(taken(&cells(|k| k == 4096, 10_000)), (10_000, 0));
        // No entropy that a kernel has: infinite, or none.
        assert_eq!(taken(&[f64::INFINITY, 1e3, f64::MAX].repeat(100)), (300, 0));
    }

    /// There is no table for `f32`.
    #[test]
    fn single_precision_stays_together() {
        let mut counts = (0, 0);
        each(&[80.0_f32].repeat(9000), |near, far| counts = (counts.0 + near.len(), counts.1 + far.len()));
        assert_eq!(counts, (9000, 0));
    }
}
