//! MCAP: records of a byte for their kind, eight for their length, and so many more; chunks hold records, compressed.
//!
//! By hand and not by the crate `mcap`: four kinds of records say all that is needed, and its decoders are C.

use super::container::{Container, CountedInput};
use super::delivery::{Delivery, Encoding, Topic, array, read_exactly, skip};
use crate::error::{Error, ErrorKind};
use crc32fast::Hasher;
use lz4_flex::frame::FrameDecoder;
use ruzstd::decoding::StreamingDecoder;
use std::collections::BTreeMap;
use std::io::{self, Read};

/// The first bytes, and the last.
pub(super) const MAGIC: &[u8; 8] = b"\x89MCAP0\r\n";

const FOOTER: u8 = 2;
const SCHEMA: u8 = 3;
const CHANNEL: u8 = 4;
const MESSAGE: u8 = 5;
const CHUNK: u8 = 6;
const DATA_END: u8 = 15;

/// The bytes of a message's record before the message itself.
const MESSAGE_HEAD: u64 = 22;
/// The most bytes of a schema or a channel; the texts of real types have thousands.
const MOST_DECLARED: u64 = 1 << 24;
/// The most bytes of the name of a compression.
const MOST_OF_NAME: u32 = 64;

/// A reader of MCAP.
#[derive(Debug, Default)]
pub(super) struct Mcap {
    /// The names of types by the numbers of schemas.
    kinds: BTreeMap<u16, String>,
    is_closed: bool,
}

impl Container for Mcap {
    fn record(&mut self, input: &mut CountedInput<'_>, delivery: &mut Delivery<'_>) -> Result<bool, Error> {
        input.expect(9);
        let [kind] = array(input)?;
        let length = u64::from_le_bytes(array(input)?);
        input.expect(length);
        // What follows the data are an index and what is said already.
        self.is_closed = matches!(kind, DATA_END | FOOTER);
        if self.is_closed {
            return Ok(false);
        }
        let mut record = input.take(length);
        if kind == CHUNK {
            self.chunk(&mut record, delivery)?;
        } else {
            self.of_kind(kind, length, &mut record, delivery)?;
        }
        let left = record.limit();
        skip(&mut record, left)?;
        Ok(true)
    }

    fn is_whole(&self, _: u64) -> bool {
        self.is_closed
    }
}

impl Mcap {
    /// Reads a record that is no chunk.
    fn of_kind(
        &mut self,
        kind: u8,
        length: u64,
        input: &mut dyn Read,
        delivery: &mut Delivery<'_>,
    ) -> Result<(), Error> {
        match kind {
            MESSAGE if length >= MESSAGE_HEAD => {
                let id = u16::from_le_bytes(array(input)?);
                let [_sequence] = [array::<4>(input)?];
                let time = u64::from_le_bytes(array(input)?);
                let [_published] = [array::<8>(input)?];
                delivery.read(id.into(), time, length - MESSAGE_HEAD, input)
            }
            SCHEMA | CHANNEL if length <= MOST_DECLARED => {
                let mut bytes = Vec::new();
                read_exactly(input, length, &mut bytes)?;
                self.declare(kind, &mut &*bytes, delivery)
            }
            SCHEMA | CHANNEL | MESSAGE => {
                let message = format!("is of kind {kind} and claims {length} bytes");
                let allowed =
                    format!("{MESSAGE_HEAD} or more for a message, at most {MOST_DECLARED} otherwise");
                Err(Error::new(ErrorKind::Format, message)
                    .with_value(length.to_string())
                    .allowing(", allowed are ", allowed))
            }
            _ => Ok(skip(input, length)?),
        }
    }

    /// Reads a schema or a channel.
    fn declare(&mut self, kind: u8, bytes: &mut &[u8], delivery: &mut Delivery<'_>) -> Result<(), Error> {
        let id = u16::from_le_bytes(within(array(bytes))?);
        if kind == SCHEMA {
            let kind = text(bytes)?;
            // As with channels, the same is declared in many chunks, and before the index again.
            if self.kinds.get(&id) != Some(&kind) {
                delivery.keep_names(&[&kind])?;
                self.kinds.insert(id, kind);
            }
            return Ok(());
        }
        let schema = u16::from_le_bytes(within(array(bytes))?);
        let (name, encoding) = (text(bytes)?, text(bytes)?);
        let kind = self.kinds.get(&schema).map_or("", String::as_str);
        delivery.declare(id.into(), Topic::new(name, kind, Encoding::named(&encoding)))
    }

    /// Reads the records of a chunk, as a stream.
    fn chunk(&mut self, input: &mut dyn Read, delivery: &mut Delivery<'_>) -> Result<(), Error> {
        let [_start, _end] = [array::<8>(input)?, array::<8>(input)?];
        let size = u64::from_le_bytes(array(input)?);
        let checksum = u32::from_le_bytes(array(input)?);
        let length = u32::from_le_bytes(array(input)?);
        let mut name = Vec::new();
        if length > MOST_OF_NAME {
            let allowed = format!("at most {MOST_OF_NAME} bytes");
            return Err(Error::out_of_range("the length of the compression's name", length, allowed));
        }
        read_exactly(input, length.into(), &mut name)?;
        let packed = u64::from_le_bytes(array(input)?);
        let packed = input.take(packed);
        let unpacked: Box<dyn Read + '_> = match &*name {
            b"" => Box::new(packed),
            b"lz4" => Box::new(FrameDecoder::new(packed)),
            b"zstd" => Box::new(StreamingDecoder::new(packed).map_err(io::Error::other)?),
            name => {
                let name = String::from_utf8_lossy(name);
                let refused = Error::new(ErrorKind::Unsupported, format!("is compressed by {name}"));
                return Err(refused.with_value(name).allowing(", allowed are ", "zstd, lz4 and none"));
            }
        };
        let mut records = Hashed { input: unpacked, hasher: Hasher::new(), length: 0 };
        loop {
            let mut kind = Vec::new();
            (&mut records).take(1).read_to_end(&mut kind)?;
            let [kind] = *kind else { break };
            let length = u64::from_le_bytes(array(&mut records)?);
            let end = records.length.checked_add(length);
            if kind == CHUNK || end.is_none_or(|end| end > size) {
                let message =
                    format!("is a chunk of {size} bytes with a record of kind {kind} and {length} bytes");
                return Err(Error::new(ErrorKind::Format, message).with_value(length.to_string()));
            }
            let mut record = (&mut records).take(length);
            self.of_kind(kind, length, &mut record, delivery)?;
            let left = record.limit();
            skip(&mut record, left)?;
        }
        if records.length != size {
            let message = format!("is a chunk that claims {size} bytes and has {}", records.length);
            return Err(Error::new(ErrorKind::Format, message).with_value(size.to_string()));
        }
        let found = records.hasher.finalize();
        if checksum != 0 && checksum != found {
            let message =
                format!("is a chunk whose checksum is {checksum:08x}, but that of its bytes is {found:08x}");
            return Err(Error::new(ErrorKind::Format, message).with_value(format!("{checksum:08x}")));
        }
        Ok(())
    }
}

/// A reader that counts its bytes and takes their checksum.
struct Hashed<'a> {
    input: Box<dyn Read + 'a>,
    hasher: Hasher,
    length: u64,
}

impl Read for Hashed<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(buffer)?;
        self.hasher.update(&buffer[..read]);
        self.length += read as u64;
        Ok(read)
    }
}

/// Takes the next text of a record that is whole.
fn text(bytes: &mut &[u8]) -> Result<String, Error> {
    let length = u32::from_le_bytes(within(array(bytes))?);
    let Some((text, rest)) = bytes.split_at_checked(length as usize) else {
        let message = format!("has a text of {length} bytes, but {} are left", bytes.len());
        return Err(Error::new(ErrorKind::Format, message).with_value(length.to_string()));
    };
    *bytes = rest;
    super::fields::utf8(text).map(str::to_owned)
}

/// Says that a record is too short for what it must hold.
fn within<T>(read: io::Result<T>) -> Result<T, Error> {
    read.map_err(|_| Error::new(ErrorKind::Format, "is too short for what it must hold"))
}
