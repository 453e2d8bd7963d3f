//! The cells that the elements of an array are, by their type and by the encoding asked for.

use super::header::Element;
use crate::cells::{ByteEncoding, Readable};
use crate::error::{Error, ErrorKind};
use crate::options::{ArrayEncoding, Options};
use mean_information::map::Encoding;
use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};

/// A reader of cells, whatever their encoding.
pub(super) trait CellReader {
    /// The result.
    type Output;

    /// Reads cells of floats.
    fn floats<E: Readable, const N: usize>(
        self,
        cell: impl Fn([u8; N]) -> Result<E::Stored, f64>,
    ) -> Result<Self::Output, Error>;

    /// Reads cells of integers. `cell` gives the cell of some bytes, or the value that none has.
    fn integers<E: ByteEncoding, const N: usize>(
        self,
        cell: impl Fn([u8; N]) -> Result<i8, f64>,
    ) -> Result<Self::Output, Error>;
}

/// Has `reader` read the cells of an array of these elements.
pub(super) fn read_cells<C: CellReader>(
    element: Element,
    options: &Options,
    reader: C,
) -> Result<C::Output, Error> {
    let floats = matches!(element, Element::Float32 | Element::Float64);
    if options.unknown.is_some() && !floats {
        let message = format!("holds {}, where no value can be given for unknown", element.name());
        return Err(Error::new(ErrorKind::Unsupported, message)
            .with_value(element.name())
            .allowing("; allowed are ", "arrays of float32 and float64; in percentages -1 means unknown"));
    }
    let encoding = match (options.encoding, element) {
        (Some(encoding), _) => encoding,
        (None, Element::Integer { bytes, .. }) if bytes > 1 => return Err(ambiguous(element)),
        (None, _) if floats => ArrayEncoding::Probability,
        (None, _) => ArrayEncoding::Percent,
    };
    let single = options.unknown.map(|value| value as f32);
    let double = options.unknown;
    match (encoding, element) {
        (ArrayEncoding::Probability, Element::Float32) => reader.floats::<Probability<f32>, 4>(|bytes| {
            float::<Probability<f32>>(f32::from_le_bytes(bytes), single)
        }),
        (ArrayEncoding::Probability, Element::Float64) => reader.floats::<Probability<f64>, 8>(|bytes| {
            float::<Probability<f64>>(f64::from_le_bytes(bytes), double)
        }),
        (ArrayEncoding::LogOdds, Element::Float32) => {
            reader.floats::<LogOdds<f32>, 4>(|bytes| float::<LogOdds<f32>>(f32::from_le_bytes(bytes), single))
        }
        (ArrayEncoding::LogOdds, Element::Float64) => {
            reader.floats::<LogOdds<f64>, 8>(|bytes| float::<LogOdds<f64>>(f64::from_le_bytes(bytes), double))
        }
        // True is occupied; other bytes than 0 and 1 are true to NumPy.
        (ArrayEncoding::Percent | ArrayEncoding::Probability, Element::Bool) => {
            reader.integers::<Percent, 1>(|[byte]| Ok(if byte == 0 { 0 } else { 100 }))
        }
        (ArrayEncoding::Percent, Element::Integer { bytes: 1, .. }) => {
            // -1 as uint8.
            reader.integers::<Percent, 1>(
                |[byte]| if byte == 255 { Ok(-1) } else { integer::<Percent, _>(byte) },
            )
        }
        (ArrayEncoding::Percent, element) if !floats => by_width::<Percent, _>(element, reader),
        (ArrayEncoding::Mrpt, element) if !floats && element != Element::Bool => {
            by_width::<MrptLogOdds, _>(element, reader)
        }
        (encoding, element) => Err(mismatch(encoding, element)),
    }
}

/// Has `reader` read integers of any width.
fn by_width<E: ByteEncoding, C: CellReader>(element: Element, reader: C) -> Result<C::Output, Error> {
    match element {
        Element::Integer { bytes: 1, .. } => {
            reader.integers::<E, 1>(|bytes| integer::<E, _>(u8::from_le_bytes(bytes)))
        }
        Element::Integer { bytes: 2, signed: true } => {
            reader.integers::<E, 2>(|bytes| integer::<E, _>(i16::from_le_bytes(bytes)))
        }
        Element::Integer { bytes: 2, .. } => {
            reader.integers::<E, 2>(|bytes| integer::<E, _>(u16::from_le_bytes(bytes)))
        }
        Element::Integer { bytes: 4, signed: true } => {
            reader.integers::<E, 4>(|bytes| integer::<E, _>(i32::from_le_bytes(bytes)))
        }
        Element::Integer { bytes: 4, .. } => {
            reader.integers::<E, 4>(|bytes| integer::<E, _>(u32::from_le_bytes(bytes)))
        }
        Element::Integer { signed: true, .. } => {
            reader.integers::<E, 8>(|bytes| integer::<E, _>(i64::from_le_bytes(bytes)))
        }
        Element::Integer { .. } => {
            reader.integers::<E, 8>(|bytes| integer::<E, _>(u64::from_le_bytes(bytes)))
        }
        _ => reader.integers::<E, 1>(|bytes| integer::<E, _>(i8::from_le_bytes(bytes))),
    }
}

/// Returns the cell of a float, or the value that is none.
fn float<E: Readable>(value: E::Stored, unknown: Option<E::Stored>) -> Result<E::Stored, f64> {
    let is_nan = |stored: E::Stored| E::value(stored).is_nan();
    if unknown.is_some_and(|unknown| value == unknown || is_nan(value) && is_nan(unknown)) {
        return Ok(E::unknown());
    }
    if E::is_valid(value) { Ok(value) } else { Err(E::value(value)) }
}

/// Returns the cell of an integer, or the value that is none.
fn integer<E: ByteEncoding, I: Copy + TryInto<i8> + Into<i128>>(value: I) -> Result<i8, f64> {
    value.try_into().ok().filter(|&cell| E::is_valid(cell)).ok_or(value.into() as f64)
}

/// Creates the error of integers that may be many things.
fn ambiguous(element: Element) -> Error {
    let name = element.name();
    let bytes = element.bytes();
    Error::new(ErrorKind::Unsupported, format!("holds {name} (i{bytes}), integers other than int8 (i1)"))
        .with_value(name)
        .allowing("; allowed are ", "float32 (f4), float64 (f8), int8 (i1), uint8 and bool")
        .followed_by("; p.astype('i1') makes percentages int8 if all are -1 to 100")
}

/// Creates the error of an encoding that does not fit the elements.
fn mismatch(encoding: ArrayEncoding, element: Element) -> Error {
    let (name, needed, mended) = match encoding {
        ArrayEncoding::Probability => ("probability", "float32 or float64", "p.astype('f4')"),
        ArrayEncoding::LogOdds => ("log-odds", "float32 or float64", "l.astype('f4')"),
        ArrayEncoding::Percent => ("percent", "integers", "p.astype('i1')"),
        ArrayEncoding::Mrpt => ("mrpt", "integers", "l.astype('i1')"),
    };
    Error::new(ErrorKind::Unsupported, format!("holds {}", element.name()))
        .with_value(element.name())
        .allowing(&format!(", the encoding {name} needs "), needed)
        .followed_by(&format!("; {mended} makes it that, if the values are so meant"))
}

/// Creates the error of a cell whose value the encoding `E` does not have, with the line of Python that may help.
pub(super) fn no_cell<E: Readable>(row: usize, column: usize, value: f64) -> Error {
    let refused = mean_information::Error::cell(row, column, value, E::ALLOWED);
    Error::from(refused).followed_by(helping(E::ALLOWED == Probability::<f64>::ALLOWED, value))
}

/// Returns what may help with a value, and leaves -1 unknown whatever is done about others first.
fn helping(is_probability: bool, value: f64) -> &'static str {
    match value {
        _ if value.is_nan() && is_probability => "; np.nan_to_num(p, nan=0.5) makes NaN unknown",
        _ if value.is_nan() => "; np.nan_to_num(l, nan=0.0) makes NaN unknown",
        100.0..=255.0 if value > 100.0 => "; (255 - g) / 255 makes probabilities of greys",
        _ if !is_probability => "",
        -1.0 => {
            "; np.where(p == -1, 0.5, p / 100) makes probabilities of percentages; among probabilities \
             np.where(p == -1, 0.5, p) makes -1 unknown"
        }
        -1e-6..=1.000001 => "; np.where(p == -1, 0.5, np.clip(p, 0, 1)) cuts rounding off",
        1.0..=100.0 if value.fract() == 0.0 => {
            "; np.where(p == -1, 0.5, p / 100) makes probabilities of percentages"
        }
        1.0..=100.0 => {
            "; np.where(p == -1, 0.5, p / 100) makes probabilities of percentages, 1 / (1 + np.exp(-l)) of log-odds"
        }
        _ => "; 1 / (1 + np.exp(-l)) makes probabilities of log-odds",
    }
}
