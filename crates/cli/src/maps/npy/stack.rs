//! Stacks of maps in one array, `[particle, row, column]`, and the weights of the particles.

use super::header::{self, Element, Header};
use crate::maps::cells::Readable;
use crate::maps::size::{Size, read_pieces, reserve};
use crate::maps::{ArrayEncoding, Fault, Options};
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Geometry, Grid};
use std::io::Read;

/// All integers up to this one are floats.
const MOST_INTEGER: u128 = 1 << f64::MANTISSA_DIGITS;

/// What is done with the maps of an array, whatever their encoding.
pub trait WithMaps {
    /// What comes of it.
    type Output;

    /// Does it.
    fn with<E: Readable>(self, maps: Vec<Grid<E>>) -> Self::Output;
}

/// Reads the maps of a filter's particles from a file of `length` bytes: an array of three dimensions, particle, row
/// and column.
///
/// # Errors
/// As for one map; the limit on cells is one on the cells of all particles together.
pub fn read_stack<W: WithMaps>(
    mut input: impl Read,
    length: u64,
    options: &Options,
    what: W,
) -> Result<W::Output, Fault> {
    let header = Header::read(&mut input, header::MAPS)?;
    let shape = header.dimensions("particles, rows and columns")?;
    if shape.contains(&0) {
        return Err(Fault::new(
            "holds no particles, or particles without cells; allowed are sizes of 1 or more",
        ));
    }
    with_maps(input, length, &header, shape, options, what)
}

/// Reads a list of weights from a file of `length` bytes.
///
/// # Errors
/// A [`Fault`] if this is no `.npy` file, holds anything but a list of float32, float64 or integers, has an integer that
/// `f64` may not hold, or is not exactly as long as its header says.
pub fn read_weights(mut input: impl Read, length: u64, options: &Options) -> Result<Vec<f64>, Fault> {
    let header = Header::read(&mut input, header::WEIGHTS)?;
    let [count] = header.dimensions("the weights")?;
    let size = Size::claimed(count, 1, options.max_kept(), || format!("{count} weights,"))?;
    header.check_length(length, count)?;
    let count = size.cells();
    let mut values = Values { input, header: &header };
    match header.element {
        Element::Float32 => {
            let weights = values.take::<f32, 4>(count, f32::from_le_bytes)?;
            Ok(weights.into_iter().map(f64::from).collect())
        }
        Element::Float64 => values.take::<f64, 8>(count, f64::from_le_bytes),
        Element::Int8 => values.integers(count, i8::from_le_bytes),
        Element::Integer { bytes: 1, .. } => values.integers(count, u8::from_le_bytes),
        Element::Integer { bytes: 2, signed: true } => values.integers(count, i16::from_le_bytes),
        Element::Integer { bytes: 2, .. } => values.integers(count, u16::from_le_bytes),
        Element::Integer { bytes: 4, signed: true } => values.integers(count, i32::from_le_bytes),
        Element::Integer { bytes: 4, .. } => values.integers(count, u32::from_le_bytes),
        Element::Integer { signed: true, .. } => values.integers(count, i64::from_le_bytes),
        Element::Integer { .. } => values.integers(count, u64::from_le_bytes),
    }
}

/// Reads the maps of an array of this shape, and does with them what is to be done.
pub(super) fn with_maps<W: WithMaps>(
    input: impl Read,
    length: u64,
    header: &Header,
    [count, rows, columns]: [u64; 3],
    options: &Options,
    what: W,
) -> Result<W::Output, Fault> {
    let all = Size::claimed(columns, rows.saturating_mul(count), options.max_kept(), || match count {
        1 => format!("{columns} x {rows} = {} cells,", u128::from(columns) * u128::from(rows)),
        _ => format!("{count} particles of {columns} x {rows} cells, together"),
    })?;
    header.check_length(length, all.cells() as u64)?;
    // A factor of sizes that fit.
    let size = Size { width: all.width, height: all.height / (count.max(1) as usize) };
    let geometry = size.placed(options.resolution.unwrap_or(1.0), [0.0, 0.0], 0.0)?;
    let mut maps = Maps { values: Values { input, header }, size, count: count as usize, geometry };
    let encoding = options.encoding.unwrap_or(match header.element {
        Element::Int8 => ArrayEncoding::Percent,
        _ => ArrayEncoding::Probability,
    });
    Ok(match (encoding, header.element) {
        (ArrayEncoding::Probability, Element::Float32) => {
            what.with(maps.read::<Probability<f32>, 4>(f32::from_le_bytes)?)
        }
        (ArrayEncoding::Probability, Element::Float64) => {
            what.with(maps.read::<Probability<f64>, 8>(f64::from_le_bytes)?)
        }
        (ArrayEncoding::LogOdds, Element::Float32) => {
            what.with(maps.read::<LogOdds<f32>, 4>(f32::from_le_bytes)?)
        }
        (ArrayEncoding::LogOdds, Element::Float64) => {
            what.with(maps.read::<LogOdds<f64>, 8>(f64::from_le_bytes)?)
        }
        (ArrayEncoding::Percent, Element::Int8) => what.with(maps.read::<Percent, 1>(i8::from_le_bytes)?),
        (ArrayEncoding::Mrpt, Element::Int8) => what.with(maps.read::<MrptLogOdds, 1>(i8::from_le_bytes)?),
        (encoding, element) => return Err(mismatch(encoding, element)),
    })
}

fn mismatch(encoding: ArrayEncoding, element: Element) -> Fault {
    let (name, needed) = match encoding {
        ArrayEncoding::Probability => ("probability", "float32 or float64"),
        ArrayEncoding::LogOdds => ("log-odds", "float32 or float64"),
        ArrayEncoding::Percent => ("percent", "int8"),
        ArrayEncoding::Mrpt => ("mrpt", "int8"),
    };
    Fault::new(format!("holds {}, the encoding {name} needs {needed}", element.name()))
}

/// The values of an array, in the order of the file.
struct Values<'a, R> {
    input: R,
    header: &'a Header,
}

impl<R: Read> Values<'_, R> {
    /// The next so many values of `N` bytes.
    fn take<S, const N: usize>(&mut self, count: usize, of: fn([u8; N]) -> S) -> Result<Vec<S>, Fault> {
        let mut values = Vec::new();
        let big_endian = self.header.big_endian;
        read_pieces(&mut self.input, count, N, |piece| {
            let elements = piece.as_chunks().0.iter();
            reserve(&mut values, elements.len(), count)?;
            values.extend(elements.map(|&bytes| {
                let mut bytes: [u8; N] = bytes;
                if big_endian {
                    bytes.reverse();
                }
                of(bytes)
            }));
            Ok(())
        })?;
        Ok(values)
    }

    /// The next so many integers, exactly.
    fn integers<S: Into<i128>, const N: usize>(
        &mut self,
        count: usize,
        of: fn([u8; N]) -> S,
    ) -> Result<Vec<f64>, Fault> {
        let mut exact = Vec::new();
        reserve(&mut exact, count, count)?;
        for (index, value) in self.take(count, of)?.into_iter().enumerate() {
            let value: i128 = value.into();
            if value.unsigned_abs() > MOST_INTEGER {
                return Err(Fault::new(format!(
                    "weight {index} is {value}, allowed are integers up to 2^53 = {MOST_INTEGER}"
                )));
            }
            exact.push(value as f64);
        }
        Ok(exact)
    }
}

/// The maps of an array whose header was checked.
struct Maps<'a, R> {
    values: Values<'a, R>,
    size: Size,
    count: usize,
    geometry: Geometry,
}

impl<R: Read> Maps<'_, R> {
    fn read<E: Readable, const N: usize>(
        &mut self,
        of: fn([u8; N]) -> E::Stored,
    ) -> Result<Vec<Grid<E>>, Fault> {
        let cells = self.size.cells();
        // By columns, the particles lie between each other: all must be read first.
        let all = if self.values.header.fortran_order {
            self.values.take(cells * self.count, of)?
        } else {
            Vec::new()
        };
        let mut maps = Vec::new();
        for particle in 0..self.count {
            let cells = if self.values.header.fortran_order {
                self.by_columns(&all, particle)?
            } else {
                self.values.take(cells, of)?
            };
            let grid = Grid::new(self.size.width, self.size.height, self.geometry, cells);
            maps.push(grid.map_err(|error| match self.count {
                1 => Fault::from(error),
                _ => Fault::new(format!("particle {particle}: {error}")),
            })?);
        }
        Ok(maps)
    }

    /// The rows of one particle of an array stored by columns.
    fn by_columns<S: Copy>(&self, all: &[S], particle: usize) -> Result<Vec<S>, Fault> {
        let mut cells = Vec::new();
        reserve(&mut cells, self.size.cells(), self.size.cells())?;
        for row in 0..self.size.height {
            let first = (particle + self.count * row).min(all.len());
            cells.extend(all[first..].iter().step_by(self.count * self.size.height).copied());
        }
        Ok(cells)
    }
}
