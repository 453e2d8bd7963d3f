//! ROS 1's `.bag`, version 2.0: records of a header, which is a list of `name=value`, and data; chunks hold records,
//! compressed.

use super::container::{Container, CountedInput};
use super::delivery::{Delivery, Encoding, Topic, array, read_exactly, skip};
use super::fields::utf8;
use crate::error::{Error, ErrorKind, Place};
use bzip2::read::BzDecoder;
use lz4_flex::frame::FrameDecoder;
use std::io::Read;

/// The first line.
pub(super) const MAGIC: &[u8; 13] = b"#ROSBAG V2.0\n";

const MESSAGE: u8 = 2;
const BAG: u8 = 3;
const CHUNK: u8 = 5;
const CONNECTION: u8 = 7;

/// The most bytes of a record's header, and of the data of a connection; real ones have up to thousands.
const MOST_DECLARED: u32 = 1 << 24;

/// Reads the rest of the first line, of which 8 bytes are read.
pub(super) fn read_version(input: &mut impl Read) -> Result<(), Error> {
    if array::<5>(input)? == MAGIC[8..] {
        return Ok(());
    }
    let refused =
        Error::new(ErrorKind::Unsupported, "is a bag of ROS 1 of another version").at(Place::Byte(8));
    Err(refused.allowing(", allowed is ", "2.0"))
}

/// A reader of ROS 1's bags.
#[derive(Debug, Default)]
pub(super) struct Rosbag {
    /// The byte of the index, which follows all messages; 0 until the bag is closed.
    index: u64,
}

impl Container for Rosbag {
    fn record(&mut self, input: &mut CountedInput<'_>, delivery: &mut Delivery<'_>) -> Result<bool, Error> {
        input.expect(4);
        let length = u32::from_le_bytes(array(input)?);
        input.expect(u64::from(length) + 4);
        let header = Header::read(length, input)?;
        let length = u32::from_le_bytes(array(input)?);
        input.expect(length.into());
        let mut data = input.take(length.into());
        match header.kind()? {
            BAG => self.index = u64::from_le_bytes(header.array("index_pos")?),
            CHUNK => chunk(&header, &mut data, delivery)?,
            kind => of_kind(kind, &header, length, &mut data, delivery)?,
        }
        let left = data.limit();
        skip(&mut data, left)?;
        Ok(true)
    }

    fn is_whole(&self, end: u64) -> bool {
        self.index > 0 && end >= self.index
    }
}

/// Reads a record that is no chunk.
fn of_kind(
    kind: u8,
    header: &Header,
    length: u32,
    input: &mut dyn Read,
    delivery: &mut Delivery<'_>,
) -> Result<(), Error> {
    let id = || header.array("conn").map(|id| u64::from(u32::from_le_bytes(id)));
    match kind {
        MESSAGE => {
            let [s0, s1, s2, s3, n0, n1, n2, n3] = header.array("time")?;
            let [s, ns] = [[s0, s1, s2, s3], [n0, n1, n2, n3]].map(|x| u64::from(u32::from_le_bytes(x)));
            delivery.read(id()?, s * 1_000_000_000 + ns, length.into(), input)
        }
        CONNECTION => {
            let declared = Header::read(length, input)?;
            let [name, kind] = [utf8(header.value("topic")?)?, utf8(declared.value("type")?)?];
            delivery.declare(id()?, Topic::new(name.to_owned(), kind, Encoding::Ros1))
        }
        // The index.
        _ => Ok(skip(input, length.into())?),
    }
}

/// Reads the records of a chunk, as a stream.
fn chunk(header: &Header, input: &mut dyn Read, delivery: &mut Delivery<'_>) -> Result<(), Error> {
    let size = u64::from(u32::from_le_bytes(header.array("size")?));
    let unpacked: Box<dyn Read + '_> = match header.value("compression")? {
        b"none" => Box::new(input),
        b"bz2" => Box::new(BzDecoder::new(input)),
        b"lz4" => Box::new(FrameDecoder::new(input)),
        name => {
            let name = String::from_utf8_lossy(name);
            let refused = Error::new(ErrorKind::Unsupported, format!("is compressed by {name}"));
            return Err(refused.with_value(name).allowing(", allowed are ", "bz2, lz4 and none"));
        }
    };
    // One byte more than it claims, to see whether it has more.
    let mut records = unpacked.take(size + 1);
    loop {
        let mut length = Vec::new();
        (&mut records).take(4).read_to_end(&mut length)?;
        if length.is_empty() {
            break;
        }
        let length: [u8; 4] =
            length.try_into().map_err(|_| std::io::Error::from(std::io::ErrorKind::UnexpectedEof))?;
        let inner = Header::read(u32::from_le_bytes(length), &mut records)?;
        let length = u32::from_le_bytes(array(&mut records)?);
        let mut data = (&mut records).take(length.into());
        match inner.kind()? {
            kind @ (CHUNK | BAG) => {
                let message = format!("is a chunk with a record of kind {kind}");
                return Err(Error::new(ErrorKind::Format, message).with_value(kind.to_string()));
            }
            kind => of_kind(kind, &inner, length, &mut data, delivery)?,
        }
        let left = data.limit();
        skip(&mut data, left)?;
    }
    if records.limit() != 1 {
        let words = if records.limit() == 0 { "more" } else { "fewer" };
        let message = format!("is a chunk that claims {size} bytes and has {words}");
        return Err(Error::new(ErrorKind::Format, message).with_value(size.to_string()));
    }
    Ok(())
}

/// A list of `name=value`, each after its length.
struct Header(Vec<u8>);

impl Header {
    /// Reads the `length` bytes of a list.
    fn read(length: u32, input: &mut dyn Read) -> Result<Self, Error> {
        if length > MOST_DECLARED {
            let refused =
                Error::out_of_range("the length of a header", length, format!("at most {MOST_DECLARED}"));
            return Err(refused);
        }
        let mut bytes = Vec::new();
        read_exactly(input, length.into(), &mut bytes)?;
        Ok(Self(bytes))
    }

    /// Returns the kind of the record.
    fn kind(&self) -> Result<u8, Error> {
        self.array("op").map(|[kind]| kind)
    }

    /// Returns the value of a name that has `N` bytes.
    fn array<const N: usize>(&self, name: &str) -> Result<[u8; N], Error> {
        let value = self.value(name)?;
        value.try_into().map_err(|_| {
            let message = format!("has a {name} of {} bytes, allowed are {N}", value.len());
            Error::new(ErrorKind::Format, message).with_value(value.len().to_string())
        })
    }

    /// Returns the value of a name.
    fn value(&self, name: &str) -> Result<&[u8], Error> {
        let mut left = &*self.0;
        while let Some((length, rest)) = left.split_first_chunk() {
            let length = u32::from_le_bytes(*length);
            let Some((field, rest)) = rest.split_at_checked(length as usize) else {
                let message =
                    format!("has a field of {length} bytes in its header, but {} are left", rest.len());
                return Err(Error::new(ErrorKind::Format, message).with_value(length.to_string()));
            };
            if let Some(value) = field.strip_prefix(name.as_bytes()).and_then(|rest| rest.strip_prefix(b"="))
            {
                return Ok(value);
            }
            left = rest;
        }
        Err(Error::new(ErrorKind::Format, format!("has no {name} in its header")))
    }
}
