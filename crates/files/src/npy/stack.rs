//! Stacks of maps in one array, `[particle, row, column]`.

use super::elements::{CellReader, no_cell, read_cells};
use super::header::{self, Header};
use super::values::Values;
use crate::cells::{ByteEncoding, Readable};
use crate::error::{Error, ErrorKind};
use crate::options::Options;
use crate::size::{Size, reserve};
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
    // Before the limit, which is no matter of a file that was cut short.
    header.check_length(
        length,
        [rows, columns].iter().fold(count.into(), |all: u128, &side| all.saturating_mul(side.into())),
    )?;
    let all = Size::claimed(columns, rows.saturating_mul(count), options.max_kept(), || match count {
        1 => format!("{columns} x {rows} = {} cells,", u128::from(columns) * u128::from(rows)),
        _ => format!("{count} particles of {columns} x {rows} cells, together"),
    })?;
    // A factor of sizes that fit.
    let size = Size { width: all.width, height: all.height / (count.max(1) as usize) };
    let geometry = size.placed(options.resolution.unwrap_or(1.0), [0.0, 0.0], 0.0)?;
    let maps = Maps { values: Values { input, header }, size, count: count as usize, geometry, visitor };
    read_cells(header.element, options, maps)
}

/// The maps of an array whose header was checked, and who visits them.
struct Maps<'a, R, V> {
    values: Values<'a, R>,
    size: Size,
    count: usize,
    geometry: Geometry,
    visitor: V,
}

impl<R: Read, V: MapsVisitor> CellReader for Maps<'_, R, V> {
    type Output = V::Output;

    fn floats<E: Readable, const N: usize>(
        self,
        cell: impl Fn([u8; N]) -> Result<E::Stored, f64>,
    ) -> Result<V::Output, Error> {
        self.read::<E, N>(cell)
    }

    fn integers<E: ByteEncoding, const N: usize>(
        self,
        cell: impl Fn([u8; N]) -> Result<i8, f64>,
    ) -> Result<V::Output, Error> {
        self.read::<E, N>(cell)
    }
}

impl<R: Read, V: MapsVisitor> Maps<'_, R, V> {
    /// Reads all maps, and has them visited.
    fn read<E: Readable, const N: usize>(
        mut self,
        cell: impl Fn([u8; N]) -> Result<E::Stored, f64>,
    ) -> Result<V::Output, Error> {
        let cells = self.size.cells();
        let fortran_order = self.values.header.fortran_order;
        // By columns, the particles lie between each other: all must be read first.
        let all = if fortran_order { self.take::<E, N>(cells * self.count, 0, &cell)? } else { Vec::new() };
        let mut maps = Vec::new();
        for particle in 0..self.count {
            let cells = if fortran_order {
                self.by_columns(&all, particle)?
            } else {
                self.take::<E, N>(cells, particle * cells, &cell)?
            };
            maps.push(Grid::<E>::new(self.size.width, self.size.height, self.geometry, cells)?);
        }
        Ok(self.visitor.visit(maps))
    }

    /// Reads the next `count` cells, of which the first is the cell number `first` in the file.
    fn take<E: Readable, const N: usize>(
        &mut self,
        count: usize,
        first: usize,
        cell: impl Fn([u8; N]) -> Result<E::Stored, f64>,
    ) -> Result<Vec<E::Stored>, Error> {
        let order = self.order();
        let mut cells = Vec::new();
        self.values.pieces(count, |piece: &[[u8; N]]| {
            reserve(&mut cells, piece.len(), count)?;
            for &bytes in piece {
                let read = cell(bytes).map_err(|value| order.no_cell::<E>(first + cells.len(), value))?;
                cells.push(read);
            }
            Ok(())
        })?;
        Ok(cells)
    }

    /// Returns where cells stand in the file.
    fn order(&self) -> Order {
        Order { size: self.size, count: self.count, by_columns: self.values.header.fortran_order }
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

/// The order of the cells in a file.
#[derive(Clone, Copy)]
pub(super) struct Order {
    pub(super) size: Size,
    pub(super) count: usize,
    pub(super) by_columns: bool,
}

impl Order {
    /// Creates the error of the cell number `index` in the file, whose value is none.
    pub(super) fn no_cell<E: Readable>(self, index: usize, value: f64) -> Error {
        let Size { width, height } = self.size;
        let (map, row, column) = if self.by_columns {
            (index % self.count, index / self.count % height, index / self.count / height)
        } else {
            (index / width / height, index / width % height, index % width)
        };
        let refused = no_cell::<E>(row, column, value);
        match self.count {
            1 => refused,
            _ => refused.in_map(map).preceded_by(&format!("particle {map}: ")),
        }
    }
}
