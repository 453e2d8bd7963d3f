//! The messages of maps: `nav_msgs/OccupancyGrid` and `map_msgs/OccupancyGridUpdate`.

use super::delivery::Message;
use super::fields::Fields;
use crate::error::{Error, ErrorKind, Place};
use crate::size::Size;
use crate::trajectory::{Quaternion, Rigid};
use mean_information::map::encoding::Percent;
use mean_information::map::{Encoding, Geometry};

/// A message of type `nav_msgs/OccupancyGrid`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct GridMessage<'a> {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The place of the map, and the side of its cells.
    pub geometry: Geometry,
    /// The percentages, row by row from the lowest, each from 0 to 100 or -1 for unknown.
    pub cells: &'a [u8],
}

/// A message of type `map_msgs/OccupancyGridUpdate`: a rectangle of a map.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct GridUpdate<'a> {
    /// The column of its first cell.
    pub column: usize,
    /// The row of its first cell.
    pub row: usize,
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// The percentages, as of a [`GridMessage`].
    pub cells: &'a [u8],
}

impl<'a> GridMessage<'a> {
    /// The name of its type.
    pub const KIND: &'static str = "nav_msgs/OccupancyGrid";

    /// Reads a message, whose numbers are in the order of bytes that it says.
    ///
    /// # Errors
    /// An [`Error`] with the byte in the message at which it is not one: its size is above `max_cells`, its cells do not
    /// fit its size or are no percentages, its place is not finite.
    pub fn read(message: &Message<'a>, max_cells: u64) -> Result<Self, Error> {
        let mut fields = Fields::new(message)?;
        fields.header()?;
        let [_loaded_seconds, _loaded_nanoseconds] = [fields.u32()?, fields.u32()?];
        let place = fields.place(4);
        let resolution = f64::from(fields.f32()?);
        let [width, height] = [fields.u32()?, fields.u32()?];
        let size =
            Size::within(width.into(), height.into(), max_cells).map_err(|error| error.at(place.clone()))?;
        let Rigid { position: [x, y, _], turn } = fields.pose()?;
        let yaw = yaw(turn);
        let geometry = size.placed(resolution, [x, y], yaw).map_err(|error| error.at(place))?;
        let Size { width, height } = size;
        Ok(Self { width, height, geometry, cells: cells(&mut fields, [width, height])? })
    }
}

impl<'a> GridUpdate<'a> {
    /// The name of its type.
    pub const KIND: &'static str = "map_msgs/OccupancyGridUpdate";

    /// Reads a message, whose numbers are in the order of bytes that it says.
    ///
    /// # Errors
    /// An [`Error`] with the byte in the message at which it is not one, or at which its rectangle leaves the map of
    /// `[columns, rows]`.
    pub fn read(message: &Message<'a>, map: [usize; 2]) -> Result<Self, Error> {
        let mut fields = Fields::new(message)?;
        fields.header()?;
        let place = fields.place(4);
        let [x, y] = [fields.i32()?, fields.i32()?];
        let [width, height] = [fields.u32()?, fields.u32()?];
        let place_in = |from: i32, count: u32, side: usize| {
            let from = usize::try_from(from).ok()?;
            let count = usize::try_from(count).ok()?;
            (from.checked_add(count)? <= side).then_some([from, count])
        };
        let (Some([column, width]), Some([row, height])) =
            (place_in(x, width, map[0]), place_in(y, height, map[1]))
        else {
            let found = format!("{width} x {height} cells from column {x} and row {y}");
            let refused = Error::new(ErrorKind::OutOfRange, format!("updates {found}"));
            let allowed = format!("a rectangle within the map's {} x {} cells", map[0], map[1]);
            return Err(refused.with_value(found).allowing(", allowed is ", allowed).at(place));
        };
        Ok(Self { column, row, width, height, cells: cells(&mut fields, [width, height])? })
    }
}

/// Returns the yaw of an orientation; messages put together by hand often have none, but zeros.
fn yaw(turn: Quaternion) -> f64 {
    if turn.0 == [0.0; 4] { 0.0 } else { turn.yaw() }
}

/// Reads the cells, which must be as many as the size says, and percentages.
fn cells<'a>(fields: &mut Fields<'a>, [width, height]: [usize; 2]) -> Result<&'a [u8], Error> {
    let place = fields.place(4);
    let count = fields.u32()?;
    if u128::from(count) != width as u128 * height as u128 {
        let message = format!("has {count} cells");
        let allowed = format!("{width} x {height} = {}", width as u128 * height as u128);
        let refused = Error::new(ErrorKind::Format, message).with_value(count.to_string());
        return Err(refused.allowing(", allowed are ", allowed).at(place));
    }
    let Place::Byte(start) = fields.place(1) else { return fields.bytes(count as usize) };
    let cells = fields.bytes(count as usize)?;
    match cells.iter().position(|&cell| !Percent::is_valid(cell.cast_signed())) {
        None => Ok(cells),
        Some(index) => {
            let value = cells[index].cast_signed();
            let refused = Error::out_of_range(format!("cell {index}"), value, Percent::ALLOWED);
            Err(refused.at(Place::Byte(start + index as u64)))
        }
    }
}
