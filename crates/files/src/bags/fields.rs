//! The fields of a message, one after the other: CDR in both orders of bytes, and ROS 1's serialisation.

use super::delivery::{Encoding, Message};
use crate::error::{Error, ErrorKind, Place};
use crate::text::shortened;
use crate::trajectory::{Quaternion, Rigid, seconds};

/// The fields of a message that are left.
#[derive(Clone, Debug)]
pub(super) struct Fields<'a> {
    bytes: &'a [u8],
    at: usize,
    /// In CDR, the byte from which numbers are aligned to their own size.
    aligned_from: Option<usize>,
    big_endian: bool,
}

impl<'a> Fields<'a> {
    /// Begins to read a message.
    pub(super) fn new(message: &Message<'a>) -> Result<Self, Error> {
        let bytes = message.bytes;
        let fields = |aligned_from: Option<usize>, big_endian| Self {
            bytes,
            at: aligned_from.unwrap_or(0),
            aligned_from,
            big_endian,
        };
        match (message.topic.encoding, bytes) {
            (Encoding::Ros1, _) => Ok(fields(None, false)),
            (Encoding::Cdr, [0, kind @ (0 | 1), _, _, ..]) => Ok(fields(Some(4), *kind == 0)),
            (Encoding::Cdr, [0x28, 0xb5, 0x2f, 0xfd, ..]) => {
                let message =
                    "is compressed by itself (compression mode message of rosbag2); convert the bag";
                Err(Error::new(ErrorKind::Unsupported, message).at(Place::Byte(0)))
            }
            (Encoding::Cdr, bytes) => {
                let found = format!("{:02x?}", &bytes[..bytes.len().min(4)]);
                let refused = Error::new(ErrorKind::Format, format!("begins with {found}"));
                let allowed = "CDR's [00, 00, ..] and [00, 01, ..]";
                Err(refused.with_value(found).allowing(", allowed are ", allowed).at(Place::Byte(0)))
            }
            (Encoding::Other, _) => {
                let refused = Error::new(ErrorKind::Unsupported, "has another serialisation");
                Err(refused.allowing(", allowed are ", "cdr and ros1"))
            }
        }
    }

    /// Tells whether this is a message of ROS 1, whose headers begin with a number of their own.
    pub(super) fn is_ros1(&self) -> bool {
        self.aligned_from.is_none()
    }

    /// Goes to the next field, which is of numbers of `size` bytes, and returns its place, for messages.
    pub(super) fn place(&mut self, size: usize) -> Place {
        if let Some(start) = self.aligned_from {
            self.at = start + (self.at - start).next_multiple_of(size);
        }
        Place::Byte(self.at as u64)
    }

    /// Takes the next `count` bytes.
    pub(super) fn bytes(&mut self, count: usize) -> Result<&'a [u8], Error> {
        let left = self.bytes.len().saturating_sub(self.at);
        let Some(taken) = self.bytes.get(self.at..).and_then(|rest| rest.get(..count)) else {
            let message = format!("has a field of {count} bytes, but {left} are left");
            let refused = Error::new(ErrorKind::Format, message).with_value(count.to_string());
            return Err(refused.at(self.place(1)));
        };
        self.at += count;
        Ok(taken)
    }

    /// Takes the next number of `N` bytes, the least significant first.
    fn array<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        self.place(N);
        let mut bytes = [0; N];
        bytes.copy_from_slice(self.bytes(N)?);
        if self.big_endian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    /// Takes the next `u32`.
    pub(super) fn u32(&mut self) -> Result<u32, Error> {
        self.array().map(u32::from_le_bytes)
    }

    /// Takes the next `i32`.
    pub(super) fn i32(&mut self) -> Result<i32, Error> {
        self.array().map(i32::from_le_bytes)
    }

    /// Takes the next `f32`.
    pub(super) fn f32(&mut self) -> Result<f32, Error> {
        self.array().map(f32::from_le_bytes)
    }

    /// Takes the next `f64`.
    pub(super) fn f64(&mut self) -> Result<f64, Error> {
        self.array().map(f64::from_le_bytes)
    }

    /// Takes the next text, which CDR ends with a zero.
    pub(super) fn text(&mut self) -> Result<&'a str, Error> {
        let length = self.u32()?;
        let place = self.place(1);
        let text = self.bytes(length as usize)?;
        let text = if self.is_ros1() { text } else { text.strip_suffix(b"\0").unwrap_or(text) };
        utf8(text).map_err(|error| error.at(place))
    }

    /// Takes the header of a message: in ROS 1 a number of its own, then the time and the name of the frame.
    pub(super) fn header(&mut self) -> Result<Header<'a>, Error> {
        if self.is_ros1() {
            self.u32()?;
        }
        let place = self.place(4);
        // ROS 1 has no times before 1970, ROS 2 none after 2038.
        let whole = if self.is_ros1() { i64::from(self.u32()?) } else { i64::from(self.i32()?) };
        let time_ns = whole * 1_000_000_000 + i64::from(self.u32()?);
        Ok(Header { time: seconds(time_ns), place, frame: self.frame()? })
    }

    /// Takes the name of a frame, of which a slash before it is none.
    pub(super) fn frame(&mut self) -> Result<&'a str, Error> {
        self.text().map(|name| name.strip_prefix('/').unwrap_or(name))
    }

    /// Takes the next pose: three numbers of the position, four of the orientation.
    pub(super) fn pose(&mut self) -> Result<Rigid, Error> {
        let mut numbers = [0.0; 7];
        for number in &mut numbers {
            *number = self.f64()?;
        }
        let [x, y, z, turn @ ..] = numbers;
        Ok(Rigid { position: [x, y, z], turn: Quaternion(turn) })
    }
}

/// The header of a message.
#[derive(Clone, Debug)]
pub(super) struct Header<'a> {
    /// The time, in seconds.
    pub(super) time: f64,
    /// The place of the time.
    pub(super) place: Place,
    /// The name of the frame.
    pub(super) frame: &'a str,
}

/// Takes bytes as text.
pub(super) fn utf8(bytes: &[u8]) -> Result<&str, Error> {
    str::from_utf8(bytes).map_err(|error| {
        let text = shortened(bytes);
        let message = format!("has a text that is not UTF-8: {text}");
        Error::new(ErrorKind::Format, message).with_value(text).caused_by(error)
    })
}
