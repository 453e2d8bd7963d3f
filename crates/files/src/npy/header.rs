//! The header of an `.npy` file: a Python dictionary of three keys, versions 1 to 3.
//!
//! Own code: the libraries for it parse any Python literal, recursively, and take the memory a header claims.

use crate::error::{Error, ErrorKind, Place};
use std::borrow::Cow;
use std::io::Read;

/// The most bytes of a header; numpy itself reads headers up to 10 000.
const MOST_BYTES: u32 = 64 << 10;

/// The elements that an array may hold, in words.
pub(super) type Allowed = &'static str;

/// The elements that maps may hold.
pub(super) const MAPS: Allowed = "are float32 (f4), float64 (f8), integers and bool";
/// The elements that weights may hold.
pub(super) const WEIGHTS: Allowed = "for weights are float32 (f4), float64 (f8) and integers";

/// The elements that maps and weights are stored in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Element {
    Float32,
    Float64,
    Int8,
    /// True and false, a byte each.
    Bool,
    /// Other integers.
    Integer {
        bytes: usize,
        signed: bool,
    },
}

impl Element {
    /// Returns the bytes of an element.
    pub(super) fn bytes(self) -> usize {
        match self {
            Self::Int8 | Self::Bool => 1,
            Self::Float32 => 4,
            Self::Float64 => 8,
            Self::Integer { bytes, .. } => bytes,
        }
    }

    /// Returns the name of the elements.
    pub(super) fn name(self) -> String {
        match self {
            Self::Int8 => "int8".to_owned(),
            Self::Bool => "bool".to_owned(),
            Self::Float32 => "float32".to_owned(),
            Self::Float64 => "float64".to_owned(),
            Self::Integer { bytes, signed: true } => format!("int{}", 8 * bytes),
            Self::Integer { bytes, .. } => format!("uint{}", 8 * bytes),
        }
    }

    /// Returns the element of a type string.
    fn of(descr: &str) -> Option<Self> {
        let integer = |bytes, signed| Some(Self::Integer { bytes, signed });
        let (order, name) = descr.split_at_checked(1)?;
        match (order, name) {
            ("<" | ">", "f4") => Some(Self::Float32),
            ("<" | ">", "f8") => Some(Self::Float64),
            ("<" | ">" | "|", "i1") => Some(Self::Int8),
            ("<" | ">" | "|", "b1") => Some(Self::Bool),
            ("<" | ">" | "|", "u1") => integer(1, false),
            ("<" | ">", "i2") => integer(2, true),
            ("<" | ">", "u2") => integer(2, false),
            ("<" | ">", "i4") => integer(4, true),
            ("<" | ">", "u4") => integer(4, false),
            ("<" | ">", "i8") => integer(8, true),
            ("<" | ">", "u8") => integer(8, false),
            _ => None,
        }
    }
}

/// The contents of a header.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Header {
    pub element: Element,
    pub big_endian: bool,
    pub fortran_order: bool,
    /// The number of elements in each dimension.
    pub shape: Vec<u64>,
    /// The bytes before the data.
    pub length: u64,
}

impl Header {
    /// Reads a header whose element is `allowed`.
    pub(super) fn read(mut input: impl Read, allowed: Allowed) -> Result<Self, Error> {
        let mut start = Vec::new();
        input.by_ref().take(8).read_to_end(&mut start)?;
        let [0x93, b'N', b'U', b'M', b'P', b'Y', major, _] = start[..] else {
            return Err(none(&start));
        };
        let (length, prefix) = match major {
            1 => {
                let mut bytes = [0; 2];
                input.read_exact(&mut bytes)?;
                (u32::from(u16::from_le_bytes(bytes)), 10)
            }
            2 | 3 => {
                let mut bytes = [0; 4];
                input.read_exact(&mut bytes)?;
                (u32::from_le_bytes(bytes), 12)
            }
            _ => {
                return Err(Error::new(
                    ErrorKind::Unsupported,
                    format!("is an .npy file of version {major}"),
                )
                .at(Place::Byte(6))
                .with_value(major.to_string())
                .allowing(", allowed is ", "1 to 3"));
            }
        };
        if length > MOST_BYTES {
            return Err(Error::new(ErrorKind::Format, format!("claims a header of {length} bytes"))
                .at(Place::Byte(8))
                .with_value(length.to_string())
                .allowing(", allowed is ", format!("up to {MOST_BYTES}")));
        }
        let mut text = vec![0; length as usize];
        input.read_exact(&mut text)?;
        let text = std::str::from_utf8(&text).map_err(|_| malformed("text in UTF-8"))?;
        Self::parse(text, u64::from(length) + prefix, allowed)
    }

    /// Parses the dictionary.
    fn parse(text: &str, length: u64, allowed: Allowed) -> Result<Self, Error> {
        let mut rest = Rest(text);
        let (mut descr, mut fortran_order, mut shape) = (None, None, None);
        rest.expect("{")?;
        while !rest.eat("}") {
            let key = rest.string()?;
            rest.expect(":")?;
            let repeated = match key {
                "descr" => descr.replace(rest.descr()?).is_some(),
                "fortran_order" => fortran_order.replace(rest.boolean()?).is_some(),
                "shape" => shape.replace(rest.shape()?).is_some(),
                _ => return Err(malformed("the keys descr, fortran_order and shape")),
            };
            if repeated {
                return Err(malformed("each key once"));
            }
            if !rest.eat(",") {
                rest.expect("}")?;
                break;
            }
        }
        if !rest.0.trim().is_empty() {
            return Err(malformed("nothing after the dictionary"));
        }
        let (Some(descr), Some(fortran_order), Some(shape)) = (descr, fortran_order, shape) else {
            return Err(malformed("the keys descr, fortran_order and shape"));
        };
        let (element, big_endian) = element(descr, allowed)?;
        Ok(Self { element, big_endian, fortran_order, shape, length })
    }

    /// Returns the shape of an array that must have `N` dimensions, which are `what`.
    pub(super) fn dimensions<const N: usize>(&self, what: &str) -> Result<[u64; N], Error> {
        let [found, allowed] = [self.shape.len(), N].map(in_words);
        let shape = <[u64; N]>::try_from(&self.shape[..]);
        let shown = self.shape.iter().map(u64::to_string).collect::<Vec<_>>().join(" x ");
        shape.map_err(|_| {
            let refused = Error::new(ErrorKind::Unsupported, format!("holds an array of {found} ({shown})"))
                .with_value(shown)
                .allowing("; allowed is ", format!("{allowed}: {what}"));
            match (self.shape.len(), N) {
                (3, 2) if self.shape[2] == 1 => refused.followed_by("; a[:, :, 0] is its map"),
                (3, 2) => refused.followed_by("; a[0] is its first map, a[:, :, 0] its first channel"),
                (0 | 1, 2) => refused.followed_by("; p.reshape(rows, columns) makes a map of it"),
                (4.., 2) if self.shape.iter().filter(|&&length| length != 1).count() <= 2 => {
                    refused.followed_by("; np.squeeze(p) drops dimensions of 1")
                }
                (2, 3) => refused.followed_by("; p[None] makes a stack of one map"),
                (2, 1) => refused.followed_by("; w.ravel() makes a list of it"),
                _ => refused,
            }
        })
    }

    /// Refuses a file that is not exactly as long as an array of `elements` elements.
    pub(super) fn check_length(&self, length: u64, elements: u128) -> Result<(), Error> {
        let bytes = elements.saturating_mul(self.element.bytes() as u128);
        let claimed = bytes.saturating_add(self.length.into());
        if claimed == u128::from(length) {
            return Ok(());
        }
        let (kind, mended) = if claimed > u128::from(length) {
            (ErrorKind::CutShort, ": it is cut short; copy or save it again")
        } else {
            (ErrorKind::Format, ": more follows; save one array by itself, as by np.save('p.npy', p)")
        };
        Err(Error::new(kind, format!("has {length} bytes"))
            .with_value(length.to_string())
            .allowing(", its header claims ", claimed.to_string())
            .followed_by(mended))
    }
}

/// Returns a number of dimensions in words.
fn in_words(dimensions: usize) -> String {
    if dimensions == 1 { "1 dimension".to_owned() } else { format!("{dimensions} dimensions") }
}

/// Creates the error of a file that begins with other bytes, with a way out.
fn none(start: &[u8]) -> Error {
    let what = match start {
        [] => "it is empty; copy or save it again",
        [0x80, 2..=5, ..] => "it is a pickle; load it with pickle.load, then np.save('p.npy', p)",
        [b'P', b'K', 3 | 5, 4 | 6, ..] => "it is a zip archive; if np.savez wrote it, name it .npz",
        [0x89, b'H', b'D', b'F', ..] => "it is HDF5; load it with h5py, then np.save('p.npy', p)",
        [b'<', ..] => "it is a web page or other XML; download the file itself",
        start
            if !start.starts_with(b"\x93")
                && start.iter().all(|byte| byte.is_ascii_graphic() || byte.is_ascii_whitespace()) =>
        {
            "it is text; np.save('p.npy', np.loadtxt(FILE)) makes one of numbers"
        }
        _ => "it does not start with \\x93NUMPY; np.save('p.npy', p) writes one",
    };
    Error::new(ErrorKind::Format, format!("is no .npy file: {what}")).at(Place::Byte(0))
}

/// Creates the error of a header that is none.
fn malformed(allowed: impl Into<Cow<'static, str>>) -> Error {
    Error::new(ErrorKind::Format, "has a malformed .npy header").allowing("; allowed is ", allowed)
}

/// Parses the element of a type string, and whether its bytes run from the high one.
fn element(descr: &str, allowed: Allowed) -> Result<(Element, bool), Error> {
    let Some(found) = Element::of(descr) else {
        let (what, mended) = match descr.trim_start_matches(['<', '>', '|', '=']).chars().next() {
            Some('O') => ("Python objects", "p.astype('f8')"),
            Some('c') => ("complex numbers", "p.real"),
            Some('i' | 'u') => ("integers of another size", "p.astype('i1')"),
            Some('V') => ("records", "p['name of a field']"),
            Some('f') => ("floats other than float32 and float64", "p.astype('f8')"),
            _ => ("no numbers", "p.astype('f8')"),
        };
        return Err(Error::new(ErrorKind::Unsupported, format!("holds {what} ({descr:?})"))
            .with_value(descr)
            .allowing("; allowed ", allowed)
            .followed_by(&format!("; save {mended}")));
    };
    Ok((found, descr.starts_with('>')))
}

/// The part of a header that is yet to be read.
struct Rest<'a>(&'a str);

impl<'a> Rest<'a> {
    /// Passes over `token`, if it is next.
    fn eat(&mut self, token: &str) -> bool {
        let rest = self.0.trim_start().strip_prefix(token);
        self.0 = rest.unwrap_or(self.0);
        rest.is_some()
    }

    /// Passes over `token`, which must be next.
    fn expect(&mut self, token: &str) -> Result<(), Error> {
        if self.eat(token) { Ok(()) } else { Err(malformed(format!("{token:?} before {:?}", self.glance()))) }
    }

    /// Returns the next few characters, for messages.
    fn glance(&self) -> String {
        self.0.trim().chars().take(20).collect()
    }

    /// Reads a string in quotes.
    fn string(&mut self) -> Result<&'a str, Error> {
        for quote in ["'", "\""] {
            if self.eat(quote) {
                let (string, rest) = self.0.split_once(quote).ok_or_else(|| malformed("a closing quote"))?;
                self.0 = rest;
                return Ok(string);
            }
        }
        Err(malformed(format!("a string before {:?}", self.glance())))
    }

    /// Reads a type string.
    fn descr(&mut self) -> Result<&'a str, Error> {
        if self.0.trim_start().starts_with('[') {
            return Err(Error::new(ErrorKind::Unsupported, "holds a structured array")
                .allowing("; allowed are ", "plain arrays, of a number for each cell")
                .followed_by("; save p['name of a field']"));
        }
        self.string()
    }

    /// Reads True or False.
    fn boolean(&mut self) -> Result<bool, Error> {
        if self.eat("True") {
            return Ok(true);
        }
        self.expect("False").map(|()| false)
    }

    /// Reads a tuple of numbers.
    fn shape(&mut self) -> Result<Vec<u64>, Error> {
        self.expect("(")?;
        let mut shape = Vec::new();
        while !self.eat(")") {
            let text = self.0.trim_start();
            let digits = text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
            shape.push(text[..digits].parse().map_err(|_| malformed("a shape of numbers below 2^64"))?);
            self.0 = &text[digits..];
            // Python 2 wrote long integers.
            self.eat("L");
            if !self.eat(",") {
                self.expect(")")?;
                break;
            }
        }
        Ok(shape)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Header, String> {
        Header::parse(text, 128, MAPS).map_err(|fault| fault.to_string())
    }

    #[test]
    fn every_spelling_that_numpy_writes() {
        let expected = Header {
            element: Element::Float64,
            big_endian: false,
            fortran_order: true,
            shape: vec![3, 14],
            length: 128,
        };
        for text in [
            "{'descr': '<f8', 'fortran_order': True, 'shape': (3, 14), }          \n",
            "{'shape':(3,14),'fortran_order':True,'descr':'<f8'}",
            "{\"descr\": \"<f8\", \"fortran_order\": True, \"shape\": (3L, 14L)}\n",
        ] {
            assert_eq!(parse(text), Ok(expected.clone()), "{text}");
        }
        let swapped = parse("{'descr': '>f4', 'fortran_order': False, 'shape': (3, 14), }").unwrap();
        assert_eq!((swapped.element, swapped.big_endian), (Element::Float32, true));
    }

    #[test]
    fn what_is_found_and_what_is_allowed_is_said() {
        for (descr, shape, words) in [
            ("'|O'", "(3, 14)", "Python objects"),
            ("'<c16'", "(3, 14)", "complex"),
            ("'<f2'", "(3, 14)", "floats other"),
            ("'<U5'", "(3, 14)", "no numbers"),
            ("[('p', '<f8')]", "(3, 14)", "structured"),
            ("'<f8'", "(3, 14, 15)", "3 dimensions (3 x 14 x 15)"),
            ("'<f8'", "(3,)", "1 dimension (3)"),
            ("'<f8'", "()", "0 dimensions"),
            ("'<f8'", "(3, -14)", "malformed"),
            ("'<f8'", "(3, 99999999999999999999)", "malformed"),
        ] {
            let text = format!("{{'descr': {descr}, 'fortran_order': False, 'shape': {shape}, }}");
            let shape = parse(&text).and_then(|header| {
                header.dimensions::<2>("rows and columns").map_err(|fault| fault.to_string())
            });
            let refused = shape.unwrap_err();
            assert!(refused.contains(words) && refused.contains("allowed"), "{text}: {refused}");
        }
    }

    #[test]
    fn malformed_dictionaries_are_refused() {
        for text in [
            "",
            "{",
            "{}",
            "{'descr'",
            "{'descr': '<f8', 'shape': (3, 14), }",
            "{'descr': '<f8', 'descr': '<f8', 'fortran_order': False, 'shape': (3, 14), }",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 14), 'more': 2, }",
            "{'descr': '<f8', 'fortran_order': 0, 'shape': (3, 14), }",
            "{'descr': '<f8', 'fortran_order': False, 'shape': (3, 14), } more",
            "{'descr': '<f8', 'fortran_order': False, 'shape': ((((((((3, 14), }",
        ] {
            assert!(parse(text).unwrap_err().contains("malformed"), "{text}");
        }
    }
}
