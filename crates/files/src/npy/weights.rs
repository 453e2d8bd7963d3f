//! The weights of particles.

use super::header::{self, Element, Header};
use super::values::Values;
use crate::error::{Error, ErrorKind, Place};
use crate::options::Options;
use crate::size::{Size, reserve};
use std::io::Read;

/// All integers up to this one are floats.
const MOST_INTEGER: u128 = 1 << f64::MANTISSA_DIGITS;

/// Reads a list of weights from a file of `length` bytes.
///
/// # Errors
/// An [`Error`] if this is no `.npy` file, holds anything but a list of float32, float64 or integers, has an integer that
/// `f64` may not hold, or is not exactly as long as its header says.
pub fn read_weights(mut input: impl Read, length: u64, options: &Options) -> Result<Vec<f64>, Error> {
    let header = Header::read(&mut input, header::WEIGHTS)?;
    let [count] = header.dimensions("the weights")?;
    header.check_length(length, count.into())?;
    let size = Size::claimed(count, 1, options.max_kept(), || format!("{count} weights,"))?;
    let count = size.cells();
    let mut values = Values { input, header: &header };
    match header.element {
        Element::Float32 => {
            let weights = values.take::<f32, 4>(count, f32::from_le_bytes)?;
            Ok(weights.into_iter().map(f64::from).collect())
        }
        Element::Float64 => values.take::<f64, 8>(count, f64::from_le_bytes),
        Element::Int8 => integers(&mut values, count, i8::from_le_bytes),
        Element::Bool => Err(Error::new(ErrorKind::Unsupported, "holds bool")
            .with_value("bool")
            .allowing("; allowed ", header::WEIGHTS)),
        Element::Integer { bytes: 1, .. } => integers(&mut values, count, u8::from_le_bytes),
        Element::Integer { bytes: 2, signed: true } => integers(&mut values, count, i16::from_le_bytes),
        Element::Integer { bytes: 2, .. } => integers(&mut values, count, u16::from_le_bytes),
        Element::Integer { bytes: 4, signed: true } => integers(&mut values, count, i32::from_le_bytes),
        Element::Integer { bytes: 4, .. } => integers(&mut values, count, u32::from_le_bytes),
        Element::Integer { signed: true, .. } => integers(&mut values, count, i64::from_le_bytes),
        Element::Integer { .. } => integers(&mut values, count, u64::from_le_bytes),
    }
}

/// Reads the next `count` integers, exactly.
fn integers<S: Into<i128>, const N: usize>(
    values: &mut Values<'_, impl Read>,
    count: usize,
    of: impl Fn([u8; N]) -> S,
) -> Result<Vec<f64>, Error> {
    let mut exact = Vec::new();
    reserve(&mut exact, count, count)?;
    for (index, value) in values.take(count, of)?.into_iter().enumerate() {
        let value: i128 = value.into();
        if value.unsigned_abs() > MOST_INTEGER {
            return Err(Error::new(ErrorKind::OutOfRange, format!("weight {index} is {value}"))
                .at(Place::Item(index))
                .with_value(value.to_string())
                .allowing(", allowed are ", format!("integers up to 2^53 = {MOST_INTEGER}")));
        }
        exact.push(value as f64);
    }
    Ok(exact)
}
