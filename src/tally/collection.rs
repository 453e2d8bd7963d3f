//! Tallies as collections: cells are collected, parts of a map are added and summed.

use super::information_sum::InformationSum;
use super::map_tally::Tally;
use crate::cell::Cell;
use crate::real::Real;
use core::borrow::Borrow;
use core::iter::Sum;
use core::ops::{Add, AddAssign};

/// Implements `collect`, `extend` and `sum` for a type with `new`, `add` and `merge`.
macro_rules! impl_collection {
    ($sums:ident) => {
        impl<T: Real> Extend<Cell<T>> for $sums<T> {
            fn extend<I: IntoIterator<Item = Cell<T>>>(&mut self, cells: I) {
                for cell in cells {
                    self.add(cell);
                }
            }
        }

        impl<T: Real> FromIterator<Cell<T>> for $sums<T> {
            fn from_iter<I: IntoIterator<Item = Cell<T>>>(cells: I) -> Self {
                let mut sums = Self::new();
                sums.extend(cells);
                sums
            }
        }

        impl<T: Real> $sums<T> {
            /// Merges parts of a map into one.
            fn merged<B: Borrow<Self>>(parts: impl Iterator<Item = B>) -> Self {
                // Any tree of merges gives the same bits: sums.md, theorem (exact sums).
                parts.fold(Self::new(), |mut sum, part| {
                    sum.merge(part.borrow());
                    sum
                })
            }
        }

        /// Merges two parts; panics as `merge` does.
        impl<T: Real> Add for $sums<T> {
            type Output = Self;

            fn add(mut self, other: Self) -> Self {
                self.merge(&other);
                self
            }
        }

        /// Merges another part into this one; panics as `merge` does.
        impl<T: Real> AddAssign for $sums<T> {
            fn add_assign(&mut self, other: Self) {
                self.merge(&other);
            }
        }

        /// Merges a borrowed part into this one; panics as `merge` does.
        impl<T: Real> AddAssign<&Self> for $sums<T> {
            fn add_assign(&mut self, other: &Self) {
                self.merge(other);
            }
        }

        /// Merges the sums of an iterator's parts, so that `sum()` works on serial and rayon iterators.
        impl<T: Real> Sum for $sums<T> {
            fn sum<I: Iterator<Item = Self>>(parts: I) -> Self {
                Self::merged(parts)
            }
        }

        /// Merges borrowed parts.
        impl<'a, T: Real> Sum<&'a Self> for $sums<T> {
            fn sum<I: Iterator<Item = &'a Self>>(parts: I) -> Self {
                Self::merged(parts)
            }
        }
    };
}

impl_collection!(Tally);
impl_collection!(InformationSum);
