//! The cells of arrays, in pieces: without a copy where they lie in one block of memory, in any order of axes.

use crate::long_work::Steps;
use mean_information::map::Encoding;
use mean_information::map::encoding::Probability;
use mean_information::{InformationSum, Tally};
use numpy::ndarray::{ArrayView1, ArrayViewD, Dimension};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The cells that are measured at once.
const PIECE: usize = 1 << 22;
/// The cells that are gathered at once, where they lie apart.
const GATHERED: usize = 1 << 12;
/// The cells that are chosen at once by their mask.
const TOGETHER: usize = 64;

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
            _ => self.gather(&mut take)?,
        }
        Ok(sums)
    }

    /// Hands the cells that are meant to `take`, some at a time, in any order.
    fn gather(&self, take: &mut dyn FnMut(&[S]) -> Result<(), Stop>) -> Result<(), Stop> {
        let mut gathered = Gathered::new(take);
        // One block each, laid out alike.
        if let Some(mask) = &self.mask
            && self.cells.strides() == mask.strides()
            && let (Some(cells), Some(mask)) =
                (self.cells.as_slice_memory_order(), mask.as_slice_memory_order())
        {
            gathered.chosen(cells, mask)?;
            return gathered.end();
        }
        // Along the axis on which cells stand nearest to each other.
        let nearest =
            self.cells.axes().filter(|axis| axis.len > 1).min_by_key(|axis| axis.stride.unsigned_abs());
        let Some(along) = nearest.map(|axis| axis.axis) else {
            // One cell, or none.
            let is_meant = self.mask.iter().flatten().all(|&mask| mask != 0);
            self.cells.iter().filter(|_| is_meant).try_for_each(|&cell| gathered.all(&[cell]))?;
            return gathered.end();
        };
        match &self.mask {
            None => self.cells.lanes(along).into_iter().try_for_each(|lane| gathered.lane(lane))?,
            Some(mask) => {
                for (lane, mask) in self.cells.lanes(along).into_iter().zip(mask.lanes(along)) {
                    match (lane.as_slice(), mask.as_slice()) {
                        (Some(cells), Some(mask)) => gathered.chosen(cells, mask)?,
                        // One value for all of them, broadcast.
                        _ if mask.strides() == [0] => {
                            if mask[0] != 0 {
                                gathered.lane(lane)?;
                            }
                        }
                        _ => {
                            let meant = lane.iter().zip(&mask).filter(|&(_, &mask)| mask != 0);
                            meant.map(|(&cell, _)| cell).try_for_each(|cell| gathered.all(&[cell]))?;
                        }
                    }
                }
            }
        }
        gathered.end()
    }

    /// Returns why measuring the array, or a part of it, stopped: `ValueError` naming the first cell, in the order of indices,
    /// whose value is not allowed.
    pub(crate) fn refusal<E: Encoding<Stored = S>>(&self, stop: Stop) -> PyErr {
        if let Stop::Raised(error) = stop {
            return error;
        }
        let meant = || {
            let all = self.cells.indexed_iter();
            all.filter(|(index, _)| self.mask.as_ref().is_none_or(|mask| mask[index.clone()] != 0))
        };
        let first = meant().find(|&(_, &cell)| !E::is_valid(cell));
        if let Some((index, &cell)) = first {
            let place: Vec<_> = index.as_array_view().iter().map(ToString::to_string).collect();
            let (place, value) = (place.join(", "), E::value(cell));
            let place = if place.is_empty() { String::new() } else { format!("[{place}]") };
            let (shown, allowed) = (shown(value), E::ALLOWED);
            let advice = advice::<E>(value, meant().map(|(_, &cell)| E::value(cell)));
            return PyValueError::new_err(format!("cells{place} is {shown}, allowed is {allowed}{advice}"));
        }
        PyValueError::new_err("the cells changed while they were measured")
    }
}

/// Returns a number as Python shows it.
pub(crate) fn shown(value: f64) -> String {
    if value.is_nan() { "nan".to_owned() } else { value.to_string() }
}

/// Returns what may help with a value that an encoding does not allow. What all values are decides: a step that one of them
/// needs must not change what another means, neither by itself nor by the step that follows it.
fn advice<E: Encoding>(value: f64, all: impl Iterator<Item = f64>) -> &'static str {
    if value.is_nan() {
        return "; where=~np.isnan(cells) leaves such cells out";
    }
    if E::ALLOWED != Probability::<f64>::ALLOWED {
        let is_grey = value > 100.0;
        let words = "; of the grey levels of an image, read_map reads the yaml that says what they mean";
        return if is_grey { words } else { "" };
    }
    let (mut are_near, mut are_percent, mut are_whole, mut has_unknown) = (true, true, true, false);
    for value in all {
        are_near &= value == -1.0 || (-1e-6..=1.000_001).contains(&value);
        are_percent &= value == -1.0 || (0.0..=100.0).contains(&value);
        are_whole &= value.fract() == 0.0;
        has_unknown |= value == -1.0;
    }
    match (are_near, are_percent) {
        // Before rounding is cut off, which would make -1 free.
        (true, _) if has_unknown => "; np.where(cells == -1, 0.5, cells) makes -1 unknown",
        (true, _) => "; np.clip(cells, 0, 1) cuts rounding off",
        (false, true) if are_whole => {
            "; of percentages (ROS) in floats, -1 for unknown, cells.astype(np.int8) with encoding=\"percent\", as all are \
             whole numbers"
        }
        (false, true) => {
            "; if they are percentages, -1 for unknown, np.where(cells == -1, 0.5, cells / 100) makes probabilities of them"
        }
        (false, false) => "",
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

/// A buffer of cells that lie apart.
struct Gathered<'a, S> {
    buffer: Vec<S>,
    take: &'a mut dyn FnMut(&[S]) -> Result<(), Stop>,
}

impl<'a, S: Copy> Gathered<'a, S> {
    fn new(take: &'a mut dyn FnMut(&[S]) -> Result<(), Stop>) -> Self {
        Self { buffer: Vec::with_capacity(GATHERED), take }
    }

    /// Adds cells that stand side by side.
    #[inline]
    fn all(&mut self, mut cells: &[S]) -> Result<(), Stop> {
        while !cells.is_empty() {
            let (now, rest) = cells.split_at(cells.len().min(GATHERED - self.buffer.len()));
            self.buffer.extend_from_slice(now);
            cells = rest;
            if self.buffer.len() == GATHERED {
                self.end()?;
            }
        }
        Ok(())
    }

    /// Adds cells that stand in a row.
    fn lane(&mut self, lane: ArrayView1<'_, S>) -> Result<(), Stop> {
        if let Some(cells) = lane.as_slice() {
            return self.all(cells);
        }
        let mut rest = lane.iter().copied();
        while rest.len() > 0 {
            self.buffer.extend(rest.by_ref().take(GATHERED - self.buffer.len()));
            if self.buffer.len() == GATHERED {
                self.end()?;
            }
        }
        Ok(())
    }

    /// Adds those cells whose mask is not 0.
    fn chosen(&mut self, cells: &[S], mask: &[u8]) -> Result<(), Stop> {
        for (cells, mask) in cells.chunks(TOGETHER).zip(mask.chunks(TOGETHER)) {
            let count = mask.iter().map(|&mask| usize::from(mask != 0)).sum::<usize>();
            if count == cells.len() {
                self.all(cells)?;
            } else if count > 0 {
                // Without branches: each is written, and the next one over it unless it is meant.
                let (mut kept, mut at) = ([cells[0]; TOGETHER], 0);
                for (&cell, &mask) in cells.iter().zip(mask) {
                    kept[at % TOGETHER] = cell;
                    at += usize::from(mask != 0);
                }
                self.all(&kept[..count])?;
            }
        }
        Ok(())
    }

    /// Hands over what is left.
    fn end(&mut self) -> Result<(), Stop> {
        let done = (self.take)(&self.buffer);
        self.buffer.clear();
        done
    }
}
