//! The mean information of many maps in one array, whose axes are those of a map and those that number maps.

use crate::cells::{Chosen, Stop, Sums};
use crate::encodings::EachCell;
use crate::errors::out_of_memory;
use crate::long_work::Steps;
use mean_information::{ExactSum, InformationSum};
use num_traits::Zero;
use num_traits::float::FloatCore;
use numpy::ndarray::{ArrayD, Axis, Dimension, IxDyn, indices};
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;

/// The cells of a map below which maps are measured many at once.
const SMALL: usize = 1024;
/// The cells that are measured at once.
const BATCH: usize = 4096;

/// Computes the mean information along axes: an array of the others.
pub(crate) fn along<E: EachCell>(chosen: &Chosen<'_, E::Stored>, axes: &[usize]) -> PyResult<ArrayD<E::Float>>
where
    InformationSum<E::Float>: Sums<E>,
{
    let kept: Vec<_> = (0..chosen.cells.ndim()).filter(|axis| !axes.contains(axis)).collect();
    let length = |&axis: &usize| chosen.cells.len_of(Axis(axis));
    let (shape, size) =
        (kept.iter().map(length).collect::<Vec<_>>(), axes.iter().map(length).product::<usize>());
    let mut means = Vec::new();
    means.try_reserve_exact(shape.iter().product()).map_err(|_| out_of_memory())?;
    let measured = if size == 0 {
        means.resize(shape.iter().product(), E::Float::zero());
        Ok(())
    } else if size < SMALL {
        small::<E>(chosen, &[&kept, axes].concat(), size, &mut means)
    } else {
        large::<E>(chosen, &kept, &shape, &mut means)
    };
    // The index in a refusal is that in the whole array.
    measured.map_err(|stop| chosen.refusal::<E>(stop))?;
    ArrayD::from_shape_vec(IxDyn(&shape), means).map_err(|error| PyValueError::new_err(error.to_string()))
}

/// Measures maps one by one.
fn large<E: EachCell>(
    chosen: &Chosen<'_, E::Stored>,
    kept: &[usize],
    shape: &[usize],
    means: &mut Vec<E::Float>,
) -> Result<(), Stop>
where
    InformationSum<E::Float>: Sums<E>,
{
    let mut steps = Steps::default();
    for place in indices(shape) {
        let mut part = chosen.clone();
        // From the last axis on, so that the numbers of the others stay.
        for (&axis, &at) in kept.iter().zip(place.as_array_view()).rev() {
            part.cells.index_axis_inplace(Axis(axis), at);
            if let Some(mask) = &mut part.mask {
                mask.index_axis_inplace(Axis(axis), at);
            }
        }
        means.push(part.measure::<E, InformationSum<E::Float>>(&mut steps)?.mean());
    }
    Ok(())
}

/// Measures maps of `size` cells many at once; `order` has the axes that number maps first.
fn small<E: EachCell>(
    chosen: &Chosen<'_, E::Stored>,
    order: &[usize],
    size: usize,
    means: &mut Vec<E::Float>,
) -> Result<(), Stop> {
    let cells = chosen.cells.view().permuted_axes(order);
    let (maps, mut steps) = (BATCH / size, Steps::default());
    let mut bits = vec![E::Float::zero(); maps * size];
    let mut batch = Vec::with_capacity(maps * size);
    if let (Some(all), None) = (cells.as_slice(), &chosen.mask) {
        for cells in all.chunks(maps * size) {
            // Copied, as each cell is looked at twice, and another thread may write meanwhile.
            batch.clear();
            batch.extend_from_slice(cells);
            let bits = &mut bits[..batch.len()];
            E::information(&batch, bits);
            for (cells, bits) in batch.chunks(size).zip(bits.chunks(size)) {
                means.push(mean::<E>(cells, bits)?);
            }
            steps.add(2 * batch.len() as u64)?;
        }
        return Ok(());
    }
    let mask = chosen.mask.as_ref().map(|mask| mask.view().permuted_axes(order));
    let mut mask = mask.as_ref().map(|mask| mask.iter());
    let mut ends = Vec::with_capacity(maps);
    let mut cells = cells.iter();
    while cells.len() > 0 {
        for _ in 0..maps.min(cells.len() / size) {
            match &mut mask {
                None => batch.extend(cells.by_ref().take(size)),
                Some(mask) => {
                    let pairs = cells.by_ref().take(size).zip(mask);
                    batch.extend(pairs.filter(|&(_, &mask)| mask != 0).map(|(cell, _)| cell));
                }
            }
            ends.push(batch.len());
        }
        let bits = &mut bits[..batch.len()];
        E::information(&batch, bits);
        let mut start = 0;
        for &end in &ends {
            means.push(mean::<E>(&batch[start..end], &bits[start..end])?);
            start = end;
        }
        steps.add((4 * ends.len() * size) as u64)?;
        batch.clear();
        ends.clear();
    }
    Ok(())
}

/// Computes the mean information of a map from the information of its cells, each rounded once: exact until it is read.
fn mean<E: EachCell>(cells: &[E::Stored], bits: &[E::Float]) -> Result<E::Float, Stop> {
    if bits.iter().any(|bits| bits.is_nan()) {
        return Err(Stop::NotAllowed);
    }
    let mut sum = ExactSum::new();
    for &bits in bits {
        sum.add(bits);
    }
    let observed = cells.iter().filter(|&&cell| !E::is_unknown(cell)).count();
    Ok(sum.mean(observed as u64))
}
