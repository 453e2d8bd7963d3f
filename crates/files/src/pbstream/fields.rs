//! The fields of a protobuf message, read as a stream.

use crate::error::{Error, ErrorKind};
use std::io::{self, BufRead, BufReader, Read, Take};

/// The value of a field, of which texts and messages are still to be read.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WireValue {
    /// An integer.
    Varint(u64),
    /// Eight bytes.
    Bits64(u64),
    /// Four bytes.
    Bits32(u32),
    /// So many bytes that follow.
    Length(u64),
}

impl WireValue {
    /// Returns the length of a message, or of packed numbers.
    pub(super) fn length(self) -> Result<u64, Error> {
        if let Self::Length(length) = self { Ok(length) } else { Err(of_another_type()) }
    }

    /// Returns an integer.
    pub(super) fn integer(self) -> Result<u64, Error> {
        if let Self::Varint(number) = self { Ok(number) } else { Err(of_another_type()) }
    }

    /// Returns a number in double precision.
    pub(super) fn double(self) -> Result<f64, Error> {
        if let Self::Bits64(bits) = self { Ok(f64::from_bits(bits)) } else { Err(of_another_type()) }
    }

    /// Returns a number in single precision.
    pub(super) fn float(self) -> Result<f32, Error> {
        if let Self::Bits32(bits) = self { Ok(f32::from_bits(bits)) } else { Err(of_another_type()) }
    }
}

/// Refuses a field of another type than Cartographer gives it.
fn of_another_type() -> Error {
    Error::new(ErrorKind::Format, "has a field of another type than Cartographer's")
}

/// Takes a field by its number and its value; what it leaves of a message is passed over.
pub(super) type Each<'a> = dyn FnMut(u64, WireValue, &mut Message<'_>) -> Result<(), Error> + 'a;
/// The bytes of a message that are left.
pub(super) type Message<'a> = Take<&'a mut dyn Read>;

/// Hands the fields of a message, the next `length` bytes, to `each`.
pub(super) fn fields(input: &mut dyn Read, length: u64, each: &mut Each<'_>) -> Result<(), Error> {
    let mut message = input.take(length);
    while message.limit() > 0 {
        let [first] = array(&mut message)?;
        field(first, &mut message, each)?;
    }
    Ok(())
}

/// Hands the fields of a message that ends where `input` does, and has at most `most` bytes, to `each`.
pub(super) fn fields_to_end(input: &mut dyn Read, most: u64, each: &mut Each<'_>) -> Result<(), Error> {
    let mut message = input.take(most);
    loop {
        let mut first = Vec::new();
        (&mut message).take(1).read_to_end(&mut first)?;
        let [first] = *first else { break };
        field(first, &mut message, each)?;
    }
    if message.limit() == 0 {
        let refused = Error::new(ErrorKind::TooLarge, format!("is a message of more than {most} bytes"));
        return Err(refused.with_value(most.to_string()));
    }
    Ok(())
}

/// Hands a field, whose first byte is read, to `each`.
fn field(first: u8, message: &mut Message<'_>, each: &mut Each<'_>) -> Result<(), Error> {
    let key = varint_after(first, message)?;
    let value = match key & 7 {
        0 => WireValue::Varint(varint(message)?),
        1 => WireValue::Bits64(u64::from_le_bytes(array(message)?)),
        2 => WireValue::Length(varint(message)?),
        5 => WireValue::Bits32(u32::from_le_bytes(array(message)?)),
        kind => {
            let refused = Error::new(ErrorKind::Format, format!("has a field of wire type {kind}"));
            return Err(refused.with_value(kind.to_string()).allowing(", allowed are ", "0, 1, 2 and 5"));
        }
    };
    let WireValue::Length(length) = value else { return each(key >> 3, value, message) };
    let Some(end) = message.limit().checked_sub(length) else {
        let words = format!("has a field of {length} bytes, but its message has at most {}", message.limit());
        return Err(Error::new(ErrorKind::Format, words).with_value(length.to_string()));
    };
    each(key >> 3, value, message)?;
    let left = message.limit().saturating_sub(end);
    let passed = io::copy(&mut message.take(left), &mut io::sink())?;
    if passed < left {
        return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
    }
    Ok(())
}

/// Hands the integers of a field of `length` bytes to `each`.
pub(super) fn packed(
    input: &mut dyn Read,
    length: u64,
    mut each: impl FnMut(u64) -> Result<(), Error>,
) -> Result<(), Error> {
    // The reader takes no byte from behind the field.
    let mut numbers = BufReader::new(input.take(length));
    while !numbers.fill_buf()?.is_empty() {
        each(varint(&mut numbers)?)?;
    }
    if numbers.into_inner().limit() > 0 {
        return Err(io::Error::from(io::ErrorKind::UnexpectedEof).into());
    }
    Ok(())
}

/// Reads an integer of up to ten bytes, the least significant seven bits first.
fn varint(input: &mut impl Read) -> Result<u64, Error> {
    let [first] = array(input)?;
    varint_after(first, input)
}

/// Reads the rest of an integer, whose first byte is read.
fn varint_after(first: u8, input: &mut impl Read) -> Result<u64, Error> {
    let (mut byte, mut number) = (first, u64::from(first & 0x7f));
    for shift in (7..70).step_by(7) {
        if byte < 0x80 {
            return Ok(number);
        }
        [byte] = array(input)?;
        number |= u64::from(byte & 0x7f) << shift.min(63);
    }
    if byte < 0x80 {
        return Ok(number);
    }
    Err(Error::new(ErrorKind::Format, "has an integer of more than ten bytes"))
}

/// Reads the next `N` bytes.
pub(super) fn array<const N: usize>(input: &mut impl Read) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    input.read_exact(&mut bytes)?;
    Ok(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn integers_of_one_to_ten_bytes() {
        let read = |bytes: &[u8]| varint(&mut &*bytes).map_err(|error| error.kind());
        assert_eq!(read(&[0x07]), Ok(7));
        assert_eq!(read(&[0xfd, 0x04]), Ok(637));
        assert_eq!(read(&[0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0xff, 0x01]), Ok(u64::MAX));
        assert_eq!(read(&[0x80; 11]), Err(ErrorKind::Format));
        assert_eq!(read(&[0x80]), Err(ErrorKind::CutShort));
    }
}
