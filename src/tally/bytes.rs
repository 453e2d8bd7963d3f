//! Tallies as bytes: a format of fixed size, the same from every language and on every platform
//! ([`tally_format`](crate::book::tally_format)).

use super::exact_sum::ExactSum;
use super::map_tally::Tally;
use crate::error::Error;
use crate::real::Real;

/// The number of bytes of a tally.
pub const TALLY_BYTES: usize = SUMS + 2 * SUM + 4;
/// The first bytes, of which no text begins with the first, and the last does not survive a change of line ends.
const MAGIC: [u8; 4] = *b"\x89MI\n";
/// The version that is written, and the only one there is.
const VERSION: u16 = 1;
/// The places of the counts and of the sums.
const COUNTS: usize = 8;
const SUMS: usize = COUNTS + 3 * 8;
/// The number of bytes of a sum.
const SUM: usize = size_of::<ExactSum>();

impl<T: Real> Tally<T> {
    /// Writes the tally as bytes, exactly: 324 of them, for [`Tally::from_bytes`] on any machine and in any language
    /// ([`tally_format`](crate::book::tally_format)). Equal tallies have equal bytes.
    ///
    /// ```
    /// use mean_information::Tally;
    /// let tally = Tally::from_occupancies(&[0.25, 0.5, 0.96875]);
    /// let bytes = tally.to_bytes();
    /// assert_eq!((&bytes[..8], bytes.len()), (&b"\x89MI\n\x01\x00\x40\x00"[..], 324));
    /// assert_eq!(Tally::from_bytes(&bytes)?, tally);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn to_bytes(&self) -> [u8; TALLY_BYTES] {
        let mut bytes = [0; TALLY_BYTES];
        let (body, checksum) = bytes.split_at_mut(TALLY_BYTES - 4);
        let mut rest = &mut *body;
        let mut write = |part: &[u8]| {
            let (place, after) = core::mem::take(&mut rest).split_at_mut(part.len());
            place.copy_from_slice(part);
            rest = after;
        };
        write(&MAGIC);
        write(&VERSION.to_le_bytes());
        write(&bits::<T>().to_le_bytes());
        for count in [self.unknown, self.free, self.occupied] {
            write(&count.to_le_bytes());
        }
        for limb in self.entropy.limbs.iter().chain(&self.information.limbs) {
            write(&limb.to_le_bytes());
        }
        checksum.copy_from_slice(&crc32(body).to_le_bytes());
        bytes
    }

    /// Reads a tally from the bytes that [`Tally::to_bytes`] wrote, exactly ([`tally_format`](crate::book::tally_format)).
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the bytes are of something else, of a later version, of floats of another format than `T`
    /// (which [`format_of_bytes`] tells), damaged (every flipped bit is found), or of sums and counts that no cells have.
    ///
    /// ```
    /// use mean_information::Tally;
    /// let mut bytes = Tally::from_occupancies(&[0.25_f32, 1.0]).to_bytes();
    /// let wrong = Tally::<f64>::from_bytes(&bytes).unwrap_err();
    /// assert_eq!(wrong.to_string(), "bits of a float in the bytes of a tally is 32, allowed is 64");
    /// bytes[40] ^= 1;
    /// assert!(Tally::<f32>::from_bytes(&bytes).is_err());
    /// ```
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, Error> {
        let body = checked(bytes)?;
        let format = half(body, 6);
        if format != bits::<T>() {
            let allowed = if bits::<T>() == 32 { "32" } else { "64" };
            return Err(Error::out_of_range(FORMAT, format.into(), allowed));
        }
        let counts = [0, 1, 2].map(|k| word(body, COUNTS + 8 * k));
        let sum = |start| ExactSum { limbs: core::array::from_fn(|limb| word(body, start + 8 * limb)) };
        Self::from_parts([sum(SUMS), sum(SUMS + SUM)], counts)
    }
}

/// Returns the name of the format of a tally's floats, "f32" or "f64", from the bytes that [`Tally::to_bytes`] wrote.
///
/// # Errors
/// [`Error::OutOfRange`] as [`Tally::from_bytes`], but for the sums and counts.
///
/// ```
/// use mean_information::{Tally, tally::format_of_bytes};
/// assert_eq!(format_of_bytes(&Tally::from_occupancies(&[0.25_f32]).to_bytes()), Ok("f32"));
/// assert!(format_of_bytes(b"a tally").is_err());
/// ```
pub fn format_of_bytes(bytes: &[u8]) -> Result<&'static str, Error> {
    match half(checked(bytes)?, 6) {
        32 => Ok(f32::FORMAT),
        64 => Ok(f64::FORMAT),
        other => Err(Error::out_of_range(FORMAT, other.into(), "32 or 64")),
    }
}

/// The name of the number at byte 6.
const FORMAT: &str = "bits of a float in the bytes of a tally";

/// Returns the bits of a float.
fn bits<T: Real>() -> u16 {
    8 * size_of::<T>() as u16
}

/// Returns the bytes before the checksum, whose version, number and checksum are right.
fn checked(bytes: &[u8]) -> Result<&[u8], Error> {
    // The version first: later ones may be of another length.
    if bytes.len() >= 6 {
        let first = u32::from_le_bytes(core::array::from_fn(|k| bytes[k]));
        if first != u32::from_le_bytes(MAGIC) {
            let allowed = "172576137, \"\\x89MI\\n\": these are the bytes of something else";
            return Err(Error::out_of_range("first four bytes of a tally", first.into(), allowed));
        }
        let version = half(bytes, 4);
        if version != VERSION {
            let allowed = if version > VERSION { "1: a later release wrote them" } else { "1" };
            return Err(Error::out_of_range("version of the bytes of a tally", version.into(), allowed));
        }
    }
    let (TALLY_BYTES, Some((body, checksum))) = (bytes.len(), bytes.split_last_chunk()) else {
        return Err(Error::out_of_range("number of bytes of a tally", bytes.len() as f64, "324"));
    };
    let checksum = u32::from_le_bytes(*checksum);
    if checksum != crc32(body) {
        let allowed = "the CRC-32 of the bytes before it: they are damaged";
        return Err(Error::out_of_range("checksum of the bytes of a tally", checksum.into(), allowed));
    }
    Ok(body)
}

/// Returns the integer of two bytes at `start`.
fn half(bytes: &[u8], start: usize) -> u16 {
    u16::from_le_bytes(core::array::from_fn(|k| bytes[start + k]))
}

/// Returns the integer of eight bytes at `start`.
fn word(bytes: &[u8], start: usize) -> u64 {
    u64::from_le_bytes(core::array::from_fn(|k| bytes[start + k]))
}

/// The remainders of the 16 halves of a byte.
const NIBBLES: [u32; 16] = {
    let mut table = [0; 16];
    let mut nibble = 0;
    while nibble < 16 {
        let (mut rest, mut bit) = (nibble as u32, 0);
        while bit < 4 {
            rest = if rest & 1 == 1 { rest >> 1 ^ 0xedb8_8320 } else { rest >> 1 };
            bit += 1;
        }
        table[nibble] = rest;
        nibble += 1;
    }
    table
};

/// Computes the CRC-32 of zip, PNG and Python's `zlib.crc32`, which no burst of up to 32 flipped bits leaves as it was.
fn crc32(bytes: &[u8]) -> u32 {
    let half = |rest: u32| rest >> 4 ^ NIBBLES[(rest & 15) as usize];
    !bytes.iter().fold(!0, |rest, &byte| half(half(rest ^ u32::from(byte))))
}

#[cfg(test)]
mod tests {
    /// The check value that every description of the sum gives.
    #[test]
    fn the_checksum_is_that_of_zip() {
        assert_eq!(super::crc32(b"123456789"), 0xcbf4_3926);
    }
}
