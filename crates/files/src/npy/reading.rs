//! One map in an array: its cells, or only what its measures need of them.

use super::elements::{CellReader, read_cells};
use super::header::{self, Header};
use super::stack::{MapsVisitor, Order, visit_maps};
use super::values::Values;
use super::watch::{FloatWatch, of_percentages};
use crate::cells::{ByteEncoding, Cells, CellsVisitor, Contents, Counts, Readable};
use crate::error::{Error, ErrorKind};
use crate::map::Map;
use crate::options::Options;
use crate::size::Size;
use crate::warning::Warning;
use mean_information::map::{Grid, Histogram};
use std::io::Read;

/// Reads an array from a file of `length` bytes.
///
/// # Errors
/// An [`Error`] if this is no `.npy` file, holds anything but a two-dimensional array that fits the encoding, is not
/// exactly as long as its header says, or has a cell that is not allowed: the first one in the file is named.
pub fn read(mut input: impl Read, length: u64, options: &Options) -> Result<Map, Error> {
    let header = Header::read(&mut input, header::MAPS)?;
    let [rows, columns] = header.dimensions("rows and columns")?;
    let cells = visit_maps(input, length, &header, [1, rows, columns], options, OnlyMap)?;
    let (cells, warnings) = cells.ok_or_else(|| Error::new(ErrorKind::Format, "holds no map"))?;
    Ok(Map { cells, resolution: options.resolution, warnings, files: Vec::new() })
}

/// Reads the type of the elements of an array of maps from its header, as NumPy names it: "float32".
///
/// # Errors
/// An [`Error`] if this is no `.npy` file, or holds elements that no map has.
pub fn read_type(input: impl Read) -> Result<String, Error> {
    Header::read(input, header::MAPS).map(|header| header.element.name())
}

/// Takes the one map of a stack, and what there is to say of it.
struct OnlyMap;

impl MapsVisitor for OnlyMap {
    type Output = Option<(Cells, Vec<Warning>)>;

    fn visit<E: Readable>(self, maps: Vec<Grid<E>>) -> Self::Output {
        let grid = maps.into_iter().next()?;
        let bytes = size_of::<E::Stored>() == 1;
        let mut warnings = if bytes { Vec::new() } else { FloatWatch::of(&grid).warnings() };
        let cells = E::cells(grid);
        if let Cells::Percent(grid) = &cells {
            warnings = of_percentages(&Histogram::from_cells(grid.cells()));
        }
        Some((cells, warnings))
    }
}

/// Reads an array of at most `max_cells` cells from a file of `length` bytes, of which no cell is kept: integers are counted,
/// and floats given to `visitor`, some at a time, in the order of the file.
///
/// # Errors
/// As [`read`].
pub fn read_contents(
    mut input: impl Read,
    length: u64,
    options: &Options,
    max_cells: u64,
    visitor: &mut impl CellsVisitor,
) -> Result<Map<Contents>, Error> {
    let header = Header::read(&mut input, header::MAPS)?;
    let [rows, columns] = header.dimensions("rows and columns")?;
    // Before the limit, which is no matter of a file that was cut short.
    header.check_length(length, u128::from(columns) * u128::from(rows))?;
    let size = Size::within(columns, rows, max_cells)?;
    size.placed(options.resolution.unwrap_or(1.0), [0.0, 0.0], 0.0)?;
    let order = Order { size, count: 1, by_columns: header.fortran_order };
    let stream = Stream { values: Values { input, header: &header }, order, visitor };
    let (cells, warnings) = read_cells(header.element, options, stream)?;
    Ok(Map { cells, resolution: options.resolution, warnings, files: Vec::new() })
}

/// The number of cells that a visitor is given at once, so many that threads may share them.
const MANY: usize = 1 << 16;

/// Returns the place and the value of the first element that no cell has.
fn first_error<S, const N: usize>(
    piece: &[[u8; N]],
    cell: impl Fn([u8; N]) -> Result<S, f64>,
) -> Option<(usize, f64)> {
    piece.iter().enumerate().find_map(|(k, &bytes)| Some((k, cell(bytes).err()?)))
}

/// The cells of an array that are not kept.
struct Stream<'a, R, V> {
    values: Values<'a, R>,
    order: Order,
    visitor: &'a mut V,
}

impl<R: Read, V: CellsVisitor> CellReader for Stream<'_, R, V> {
    type Output = (Contents, Vec<Warning>);

    fn floats<E: Readable, const N: usize>(
        mut self,
        cell: impl Fn([u8; N]) -> Result<E::Stored, f64>,
    ) -> Result<Self::Output, Error> {
        let order = self.order;
        let Size { width, height } = order.size;
        let (mut watch, mut cells, mut done) = (FloatWatch::new::<E>(), Vec::new(), 0);
        self.values.pieces(width * height, |piece: &[[u8; N]]| {
            // A loop that leaves early takes longer.
            let mut all_are_cells = true;
            cells.extend(piece.iter().map(|&bytes| {
                cell(bytes).unwrap_or_else(|_| {
                    all_are_cells = false;
                    E::unknown()
                })
            }));
            if !all_are_cells && let Some((k, value)) = first_error(piece, &cell) {
                return Err(order.no_cell::<E>(done + k, value));
            }
            done += piece.len();
            if cells.len() >= MANY || done == width * height {
                watch.see::<E>(&cells);
                self.visitor.visit::<E>(&cells);
                cells.clear();
            }
            Ok(())
        })?;
        // A map without cells has an encoding, too.
        if done == 0 {
            self.visitor.visit::<E>(&[]);
        }
        Ok((Contents::Visited { width, height }, watch.warnings()))
    }

    fn integers<E: ByteEncoding, const N: usize>(
        mut self,
        cell: impl Fn([u8; N]) -> Result<i8, f64>,
    ) -> Result<Self::Output, Error> {
        let order = self.order;
        let Size { width, height } = order.size;
        let (mut counts, mut cells, mut done) = (Histogram::default(), Vec::new(), 0);
        // Bytes are counted as they are, which vector code does; what they mean is looked up in the end.
        let by_byte: Option<Vec<Result<i8, f64>>> =
            (N == 1).then(|| (0..=u8::MAX).map(|byte| cell([byte; N])).collect());
        self.values.pieces(width * height, |piece: &[[u8; N]]| {
            if let Some(by_byte) = &by_byte {
                counts.add_cells(piece.as_flattened());
                let bad = |(byte, count): (usize, &u64)| *count > 0 && by_byte[byte].is_err();
                if !counts.counts().iter().enumerate().any(bad) {
                    done += piece.len();
                    return Ok(());
                }
            }
            cells.clear();
            for &bytes in piece {
                let read = cell(bytes).map_err(|value| order.no_cell::<E>(done + cells.len(), value))?;
                cells.push(read);
            }
            done += cells.len();
            counts.add_cells(&cells);
            Ok(())
        })?;
        if let Some(by_byte) = by_byte {
            let bytes = counts;
            counts = Histogram::default();
            for (count, cell) in bytes.counts().iter().zip(by_byte) {
                if let Ok(cell) = cell {
                    counts.add_many(cell, *count);
                }
            }
        }
        let values =
            (i8::MIN..=i8::MAX).map(|cell| (cell, counts.count(cell))).filter(|&(_, count)| count > 0);
        let counted = Counts { width, height, values: values.collect() };
        let is_percent = E::unknown() == -1;
        let warnings = if is_percent { of_percentages(&counts) } else { Vec::new() };
        Ok((Contents::Counted(<E as ByteEncoding>::counted(counted)), warnings))
    }
}
