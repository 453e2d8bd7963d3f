//! The cells of arrays, in pieces: without a copy where they lie in one block of memory, in any order of axes.

use crate::long_work::Steps;
use mean_information::map::Encoding;
use mean_information::{InformationSum, Tally};
use numpy::ndarray::{ArrayViewD, Dimension, FoldWhile, Zip};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The cells that are measured at once.
const PIECE: usize = 1 << 22;
/// The cells that are gathered at once, where they lie apart.
const GATHERED: usize = 1 << 12;

/// Cells of an array, and those among them that are meant: all, or those where the mask is not 0.
#[derive(Clone)]
pub(crate) struct Chosen<'a, S> {
    pub(crate) cells: ArrayViewD<'a, S>,
    pub(crate) mask: Option<ArrayViewD<'a, u8>>,
}

/// Sums over cells in an encoding.
pub(crate) trait Sums<E: Encoding> {
    /// The sums of no cells.
    fn none() -> Self;
    /// The sums of these cells, without those that the encoding does not allow.
    fn of(cells: &[E::Stored]) -> Self;
    fn merge(&mut self, other: &Self);
    fn cells(&self) -> u64;
}

macro_rules! sums {
    ($($sums:ident $of:ident;)*) => {
        $(impl<E: Encoding> Sums<E> for $sums<E::Float> {
            fn none() -> Self {
                Self::new()
            }

            fn of(cells: &[E::Stored]) -> Self {
                E::$of(cells)
            }

            fn merge(&mut self, other: &Self) {
                self.merge(other);
            }

            fn cells(&self) -> u64 {
                self.cells()
            }
        })*
    };
}

sums! {
    Tally tally;
    InformationSum information_sum;
}

impl<S: Copy> Chosen<'_, S> {
    /// Measures the cells.
    ///
    /// # Errors
    /// A cell whose value is not allowed, for [`Self::refusal`]; what signals raise.
    pub(crate) fn measure<E: Encoding<Stored = S>, M: Sums<E>>(&self, steps: &mut Steps) -> Result<M, Stop> {
        let mut sums = M::none();
        let mut take = |piece: &[S]| {
            let part = M::of(piece);
            // Sums skip what is not allowed, so that their count tells of it.
            if part.cells() != piece.len() as u64 {
                return Err(Stop::NotAllowed);
            }
            sums.merge(&part);
            Ok(steps.add(piece.len() as u64)?)
        };
        match (self.cells.as_slice_memory_order(), &self.mask) {
            (Some(all), None) => all.chunks(PIECE).try_for_each(take)?,
            (_, None) => {
                let mut gathered = Gathered::new(take);
                let cells = Zip::from(&self.cells);
                finish(cells.fold_while(Ok(()), |_, &cell| gathered.push(cell)))?;
                gathered.end()?;
            }
            (_, Some(mask)) => {
                let mut gathered = Gathered::new(&mut take);
                let cells = Zip::from(&self.cells).and(mask);
                finish(cells.fold_while(Ok(()), |_, &cell, &mask| {
                    if mask == 0 { FoldWhile::Continue(Ok(())) } else { gathered.push(cell) }
                }))?;
                gathered.end()?;
            }
        }
        Ok(sums)
    }

    /// Returns why measuring the array, or a part of it, stopped: `ValueError` naming the first cell, in the order of indices,
    /// whose value is not allowed.
    pub(crate) fn refusal<E: Encoding<Stored = S>>(&self, stop: Stop) -> PyErr {
        if let Stop::Raised(error) = stop {
            return error;
        }
        for (index, &cell) in self.cells.indexed_iter() {
            let is_meant = self.mask.as_ref().is_none_or(|mask| mask[index.clone()] != 0);
            if is_meant && !E::is_valid(cell) {
                let place: Vec<_> = index.as_array_view().iter().map(ToString::to_string).collect();
                let (place, value) = (place.join(", "), E::value(cell));
                let place = if place.is_empty() { String::new() } else { format!("[{place}]") };
                let shown = if value.is_nan() { "nan".to_owned() } else { value.to_string() };
                let advice =
                    if value.is_nan() { "; where=~np.isnan(cells) leaves such cells out" } else { "" };
                let allowed = E::ALLOWED;
                return PyValueError::new_err(format!(
                    "cells{place} is {shown}, allowed is {allowed}{advice}"
                ));
            }
        }
        PyValueError::new_err("the cells changed while they were measured")
    }
}

/// Why measuring stopped.
pub(crate) enum Stop {
    NotAllowed,
    Raised(PyErr),
}

impl From<PyErr> for Stop {
    fn from(error: PyErr) -> Self {
        Self::Raised(error)
    }
}

/// Returns what a fold ended with.
fn finish(fold: FoldWhile<Result<(), Stop>>) -> Result<(), Stop> {
    fold.into_inner()
}

/// A buffer of cells that lie apart.
struct Gathered<S, F> {
    buffer: Vec<S>,
    take: F,
}

impl<S, F: FnMut(&[S]) -> Result<(), Stop>> Gathered<S, F> {
    fn new(take: F) -> Self {
        Self { buffer: Vec::with_capacity(GATHERED), take }
    }

    fn push(&mut self, cell: S) -> FoldWhile<Result<(), Stop>> {
        self.buffer.push(cell);
        if self.buffer.len() < GATHERED {
            return FoldWhile::Continue(Ok(()));
        }
        match self.end() {
            Ok(()) => FoldWhile::Continue(Ok(())),
            Err(error) => FoldWhile::Done(Err(error)),
        }
    }

    fn end(&mut self) -> Result<(), Stop> {
        let done = (self.take)(&self.buffer);
        self.buffer.clear();
        done
    }
}
