//! A submap of a saved state: `Submap`, `Submap2D`, `Grid2D`.

use super::fields::{WireValue, fields, packed};
use crate::cells::Counts;
use crate::error::{Error, ErrorKind};
use crate::size::Size;
use mean_information::map::encoding::Probability;
use std::io::Read;

/// The greatest cost where the grid does not say; the least is what is left to 1.
const GREATEST_COST: f32 = 0.9;
/// The bit of a cell that marks it as updated.
const MARK: u16 = 1 << 15;

/// A submap: its name, and how often each probability occurs in it.
#[derive(Clone, Debug)]
pub struct Submap {
    /// The number of its trajectory.
    pub trajectory: u64,
    /// The number of the submap in its trajectory.
    pub index: u64,
    /// Tells whether no scan will be added any more.
    pub is_finished: bool,
    /// The side of a cell in metres.
    pub resolution: f64,
    /// The least and the greatest probability that a known cell can have.
    pub clamp: [f32; 2],
    /// The probabilities; unknown cells have 1/2.
    pub counts: Counts<Probability<f32>>,
}

/// The fields of a `Grid2D`.
struct Grid {
    resolution: f64,
    width: u64,
    height: u64,
    /// The number of cells of each value, without its mark.
    values: Vec<u64>,
    cells: u64,
    costs: [f32; 2],
}

impl Submap {
    /// Reads a message `Submap` of `length` bytes, whose grid has at most `max_cells` cells.
    pub(super) fn read(input: &mut dyn Read, length: u64, max_cells: u64) -> Result<Self, Error> {
        let [mut trajectory, mut index, mut is_finished] = [0; 3];
        let mut grid = None;
        fields(input, length, &mut |number, value, input| match number {
            1 => fields(input, value.length()?, &mut |number, value, _| {
                match number {
                    1 => trajectory = value.integer()?,
                    2 => index = value.integer()?,
                    _ => {}
                }
                Ok(())
            }),
            2 => fields(input, value.length()?, &mut |number, value, input| {
                match number {
                    3 => is_finished = value.integer()?,
                    4 => grid = Some(Grid::read(input, value.length()?)?),
                    _ => {}
                }
                Ok(())
            }),
            3 => Err(Error::new(ErrorKind::Unsupported, "has submaps in three dimensions")
                .allowing("; allowed are ", "submaps in the plane, of probabilities")),
            _ => Ok(()),
        })?;
        let Some(grid) = grid else {
            return Err(Error::new(
                ErrorKind::Format,
                format!("has no grid in submap {trajectory}, {index}"),
            ));
        };
        let of = |error: Error| error.preceded_by(&format!("submap {trajectory}, {index}: "));
        let resolution = grid.resolution;
        let (clamp, counts) = grid.counts(max_cells).map_err(of)?;
        Ok(Self { trajectory, index, is_finished: is_finished != 0, resolution, clamp, counts })
    }
}

impl Grid {
    /// Reads a message `Grid2D` of `length` bytes.
    fn read(input: &mut dyn Read, length: u64) -> Result<Self, Error> {
        let values = vec![0; usize::from(MARK)];
        let mut grid = Self { resolution: 0.0, width: 0, height: 0, values, cells: 0, costs: [0.0; 2] };
        fields(input, length, &mut |number, value, input| {
            match (number, value) {
                (1, value) => grid.read_limits(input, value.length()?)?,
                (2, WireValue::Length(length)) => {
                    packed(input, length, |cell| grid.add(cell))?;
                }
                (2, cell) => grid.add(cell.integer()?)?,
                (5, _) => {
                    let refused =
                        Error::new(ErrorKind::Unsupported, "has submaps of signed distances (TSDF)");
                    return Err(refused.allowing("; allowed are ", "submaps in the plane, of probabilities"));
                }
                (6, value) => grid.costs[0] = value.float()?,
                (7, value) => grid.costs[1] = value.float()?,
                _ => {}
            }
            Ok(())
        })?;
        Ok(grid)
    }

    /// Reads a message `MapLimits` of `length` bytes.
    fn read_limits(&mut self, input: &mut dyn Read, length: u64) -> Result<(), Error> {
        fields(input, length, &mut |number, value, input| match number {
            1 => {
                self.resolution = value.double()?;
                Ok(())
            }
            3 => fields(input, value.length()?, &mut |number, value, _| {
                match number {
                    1 => self.width = value.integer()?,
                    2 => self.height = value.integer()?,
                    _ => {}
                }
                Ok(())
            }),
            _ => Ok(()),
        })
    }

    /// Counts a cell.
    fn add(&mut self, cell: u64) -> Result<(), Error> {
        let Ok(value) = u16::try_from(cell) else {
            let refused =
                Error::out_of_range(format!("cell {}", self.cells), cell.cast_signed(), "0 to 65535");
            return Err(refused);
        };
        self.values[usize::from(value & !MARK)] += 1;
        self.cells += 1;
        Ok(())
    }

    /// Returns the least and the greatest probability, and the number of cells of each.
    fn counts(self, max_cells: u64) -> Result<([f32; 2], Counts<Probability<f32>>), Error> {
        let Size { width, height } = Size::within(self.width, self.height, max_cells)?;
        Size { width, height }.placed(self.resolution, [0.0; 2], 0.0)?;
        if u128::from(self.cells) != width as u128 * height as u128 {
            let message = format!("has {} cells", self.cells);
            let refused = Error::new(ErrorKind::Format, message).with_value(self.cells.to_string());
            return Err(refused.allowing(", allowed are ", format!("{width} x {height}")));
        }
        let [least, greatest] = match self.costs {
            [0.0, 0.0] => [1.0 - GREATEST_COST, GREATEST_COST],
            costs => costs,
        };
        if !(0.0 <= least && least < greatest && greatest <= 1.0) {
            let costs = format!("{least} to {greatest}");
            return Err(Error::out_of_range("the range of costs", costs, "an interval within 0 to 1"));
        }
        let scale = (greatest - least) / 32766.0;
        let occupancy = |value: usize| match value {
            0 => 0.5,
            // The least and the greatest value may round to beside the interval.
            value => (1.0 - (value as f32 * scale + (least - scale))).clamp(0.0, 1.0),
        };
        let counted = self.values.iter().enumerate().filter(|&(_, &count)| count > 0);
        let values = counted.map(|(value, &count)| (occupancy(value), count)).collect();
        Ok(([1.0 - greatest, 1.0 - least], Counts { width, height, values }))
    }
}
