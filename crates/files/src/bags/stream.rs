//! Containers that are a stream of records: MCAP and ROS 1's `.bag`, known by their first bytes.

use super::container::{Container, CountedInput};
use super::delivery::{Delivery, Visitor};
use super::{mcap, rosbag};
use crate::error::{Error, ErrorKind, Place};
use crate::options::Options;
use crate::warning::Warning;
use std::io::Read;

/// Reads a bag from its first byte to its last and hands its messages to `visitor`.
///
/// # Errors
/// An [`Error`] if this is neither MCAP nor a bag of ROS 1, breaks the rules of its container at the byte that
/// [`Error::place`] tells, holds a message of a wanted topic longer than a map within the limit on cells, or as
/// `visitor` refuses a message. A bag that ends within a record is no error but [`Warning::BagCutShort`].
pub fn read_stream(
    mut input: impl Read,
    length: u64,
    options: &Options,
    visitor: &mut dyn Visitor,
) -> Result<Vec<Warning>, Error> {
    read_file(&mut input, length, &mut Delivery::new(visitor, options.max_kept()))
}

/// Reads a file of a bag.
pub(super) fn read_file(
    input: &mut dyn Read,
    length: u64,
    delivery: &mut Delivery<'_>,
) -> Result<Vec<Warning>, Error> {
    delivery.begin_file();
    let mut input = CountedInput::new(input, length);
    let mut magic = Vec::new();
    (&mut input).take(mcap::MAGIC.len() as u64).read_to_end(&mut magic)?;
    let mut container: Box<dyn Container> = if magic == mcap::MAGIC {
        Box::new(mcap::Mcap::default())
    } else if magic == rosbag::MAGIC[..magic.len()] && magic.len() == mcap::MAGIC.len() {
        rosbag::read_version(&mut input)?;
        Box::new(rosbag::Rosbag::default())
    } else {
        let refused = Error::new(ErrorKind::Format, "is no bag by its first bytes").at(Place::Byte(0));
        return Err(refused.allowing("; allowed are ", "MCAP and bags of ROS 1, version 2.0"));
    };
    loop {
        let start = input.at;
        let read = if start < length { container.record(&mut input, delivery) } else { Ok(false) };
        match read {
            Ok(true) if input.is_cut => return Ok(vec![cut(start, delivery)]),
            Ok(true) => {}
            Ok(false) if container.is_whole(start) => return Ok(Vec::new()),
            Ok(false) => return Ok(vec![cut(start, delivery)]),
            // A visitor's refusal stands; anything else of a record that the file does not hold, such as a length beyond the
            // limit, is the file's end.
            Err(error)
                if matches!(error.place(), Some(Place::Message { .. }))
                    && !(input.is_cut && error.kind() == ErrorKind::TooLarge) =>
            {
                return Err(error);
            }
            Err(_) if input.is_cut => return Ok(vec![cut(start, delivery)]),
            Err(error) => {
                return Err(error.preceded_by(&format!("record at byte {start}: ")).at(Place::Byte(start)));
            }
        }
    }
}

/// Creates the warning of a bag that ends at `byte`.
fn cut(byte: u64, delivery: &Delivery<'_>) -> Warning {
    Warning::BagCutShort { byte, messages: delivery.messages() }
}
