//! Stacks of maps in one array, `[particle, row, column]`.

use super::header::{self, Element, Header};
use super::values::Values;
use crate::cells::Readable;
use crate::error::{Error, ErrorKind};
use crate::options::{ArrayEncoding, Options};
use crate::size::{Size, reserve};
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};
use mean_information::map::{Geometry, Grid};
use std::io::Read;

/// A visitor of the maps of an array, whatever their encoding.
///
/// ```
/// use mean_information::map::Grid;
/// use mean_information_files::Readable;
/// use mean_information_files::npy::MapsVisitor;
///
/// /// Counts the observed cells of each map.
/// struct Observed;
///
/// impl MapsVisitor for Observed {
///     type Output = Vec<u64>;
///
///     fn visit<E: Readable>(self, maps: Vec<Grid<E>>) -> Vec<u64> {
///         maps.iter().map(|map| map.tally().observed()).collect()
///     }
/// }
/// ```
pub trait MapsVisitor {
    /// The result of the visit.
    type Output;

    /// Visits all maps.
    fn visit<E: Readable>(self, maps: Vec<Grid<E>>) -> Self::Output;
}

/// Reads the maps of a filter's particles from a file of `length` bytes, an array of three dimensions, particle, row and
/// column, and has `visitor` visit them.
///
/// # Errors
/// As for one map; the limit on cells is one on the cells of all particles together.
pub fn read_stack<V: MapsVisitor>(
    mut input: impl Read,
    length: u64,
    options: &Options,
    visitor: V,
) -> Result<V::Output, Error> {
    let header = Header::read(&mut input, header::MAPS)?;
    let shape = header.dimensions("particles, rows and columns")?;
    if shape.contains(&0) {
        let refused = Error::new(ErrorKind::Unsupported, "holds no particles, or particles without cells");
        return Err(refused.allowing("; allowed are ", "sizes of 1 or more"));
    }
    visit_maps(input, length, &header, shape, options, visitor)
}

/// Reads the maps of an array of this shape, and has them visited.
pub(super) fn visit_maps<V: MapsVisitor>(
    input: impl Read,
    length: u64,
    header: &Header,
    [count, rows, columns]: [u64; 3],
    options: &Options,
    visitor: V,
) -> Result<V::Output, Error> {
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
            visitor.visit(maps.read::<Probability<f32>, 4>(f32::from_le_bytes)?)
        }
        (ArrayEncoding::Probability, Element::Float64) => {
            visitor.visit(maps.read::<Probability<f64>, 8>(f64::from_le_bytes)?)
        }
        (ArrayEncoding::LogOdds, Element::Float32) => {
            visitor.visit(maps.read::<LogOdds<f32>, 4>(f32::from_le_bytes)?)
        }
        (ArrayEncoding::LogOdds, Element::Float64) => {
            visitor.visit(maps.read::<LogOdds<f64>, 8>(f64::from_le_bytes)?)
        }
        (ArrayEncoding::Percent, Element::Int8) => visitor.visit(maps.read::<Percent, 1>(i8::from_le_bytes)?),
        (ArrayEncoding::Mrpt, Element::Int8) => {
            visitor.visit(maps.read::<MrptLogOdds, 1>(i8::from_le_bytes)?)
        }
        (encoding, element) => return Err(mismatch(encoding, element)),
    })
}

/// Creates the error of an encoding that does not fit the elements.
fn mismatch(encoding: ArrayEncoding, element: Element) -> Error {
    let (name, needed) = match encoding {
        ArrayEncoding::Probability => ("probability", "float32 or float64"),
        ArrayEncoding::LogOdds => ("log-odds", "float32 or float64"),
        ArrayEncoding::Percent => ("percent", "int8"),
        ArrayEncoding::Mrpt => ("mrpt", "int8"),
    };
    Error::new(ErrorKind::Unsupported, format!("holds {}", element.name()))
        .with_value(element.name())
        .allowing(&format!(", the encoding {name} needs "), needed)
}

/// The maps of an array whose header was checked.
struct Maps<'a, R> {
    values: Values<'a, R>,
    size: Size,
    count: usize,
    geometry: Geometry,
}

impl<R: Read> Maps<'_, R> {
    /// Reads all maps.
    fn read<E: Readable, const N: usize>(
        &mut self,
        of: fn([u8; N]) -> E::Stored,
    ) -> Result<Vec<Grid<E>>, Error> {
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
                1 => Error::from(error),
                _ => Error::from(error).in_map(particle).preceded_by(&format!("particle {particle}: ")),
            })?);
        }
        Ok(maps)
    }

    /// Returns the rows of one particle of an array stored by columns.
    fn by_columns<S: Copy>(&self, all: &[S], particle: usize) -> Result<Vec<S>, Error> {
        let mut cells = Vec::new();
        reserve(&mut cells, self.size.cells(), self.size.cells())?;
        for row in 0..self.size.height {
            let first = (particle + self.count * row).min(all.len());
            cells.extend(all[first..].iter().step_by(self.count * self.size.height).copied());
        }
        Ok(cells)
    }
}
