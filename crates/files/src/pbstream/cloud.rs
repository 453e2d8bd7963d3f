//! The compressed clouds of a saved state: points on a grid of a millimetre, in blocks of 1024 of them a side.
//!
//! A block is its number of points, its place (x, y, z, in blocks), and an integer a point, of which the lowest ten bits are
//! x within the block, the next ten y, and the rest z.

use super::fields::{WireValue, fields, packed};
use crate::error::{Error, ErrorKind};
use crate::scans::Kept;
use std::io::Read;

/// The side of the grid in metres.
const GRID: f32 = 0.001;
/// The bits of a coordinate within a block.
const BITS: u32 = 10;
/// The most steps of the grid from the origin along an axis; Cartographer refuses more.
const FARTHEST: i64 = 1 << 23;

/// A cloud as it is stored.
#[derive(Debug, Default)]
pub(super) struct Cloud {
    /// The number of points.
    points: u64,
    data: Vec<i32>,
}

impl Cloud {
    /// Reads a message `CompressedPointCloud` of `length` bytes, and counts its numbers.
    pub(super) fn read(input: &mut dyn Read, length: u64, kept: &mut Kept) -> Result<Self, Error> {
        let mut cloud = Self::default();
        fields(input, length, &mut |number, value, input| {
            match (number, value) {
                (1, value) => cloud.points = value.integer()?,
                (3, WireValue::Length(length)) => {
                    packed(input, length, |number| cloud.push(number, kept))?;
                }
                (3, value) => cloud.push(value.integer()?, kept)?,
                _ => {}
            }
            Ok(())
        })?;
        Ok(cloud)
    }

    /// Adds an integer.
    fn push(&mut self, number: u64, kept: &mut Kept) -> Result<(), Error> {
        let Ok(number) = i32::try_from(number.cast_signed()) else {
            let allowed = "an integer of 32 bits";
            return Err(Error::out_of_range("an integer of a cloud", number.cast_signed(), allowed));
        };
        kept.add(1)?;
        self.data.push(number);
        Ok(())
    }

    /// Tells whether the cloud has no point.
    pub(super) fn is_empty(&self) -> bool {
        self.points == 0
    }

    /// Returns x and y of the points, in metres, in single precision as Cartographer has them.
    pub(super) fn in_plane(&self) -> Result<Vec<[f32; 2]>, Error> {
        let mut points = Vec::new();
        let mut data = &*self.data;
        while let [count, x, y, _, rest @ ..] = data {
            let inside = usize::try_from(*count).ok().and_then(|count| rest.split_at_checked(count));
            let Some((block, rest)) = inside else {
                let words = format!("has a block of {count} points, but {} are left", rest.len());
                return Err(Error::new(ErrorKind::Format, words).with_value(count.to_string()));
            };
            for point in block {
                let step = |block: i32, within: i32| -> Result<f32, Error> {
                    let steps = (i64::from(block) << BITS) + i64::from(within & ((1 << BITS) - 1));
                    if !(-FARTHEST..=FARTHEST).contains(&steps) {
                        let what = "a coordinate of a cloud, in millimetres,";
                        return Err(Error::out_of_range(what, steps, format!("-{FARTHEST} to {FARTHEST}")));
                    }
                    Ok(steps as f32 * GRID)
                };
                points.push([step(*x, *point)?, step(*y, point >> BITS)?]);
            }
            data = rest;
        }
        if !data.is_empty() || points.len() as u64 != self.points {
            let words = format!("has a cloud of {} points that claims {}", points.len(), self.points);
            return Err(Error::new(ErrorKind::Format, words).with_value(self.points.to_string()));
        }
        Ok(points)
    }
}
