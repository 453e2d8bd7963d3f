//! Tallies as bytes: a format of fixed size, the same from every language and on every platform
//! ([`tally_format`](crate::book::tally_format)).

use super::exact_sum::ExactSum;
use super::map_tally::Tally;
use crate::error::{Error, TallyFault};
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
    /// [`Error::TallyBytes`] if the bytes are of something else, of a later version, of another length, damaged, or of floats of
    /// another format than `T` (which [`format_of_bytes`] tells); [`Error::OutOfRange`] if they are of sums and counts that no
    /// cells have. The checksum finds every single flipped bit and up to 32 in a row; of other damage it misses one in `2^32`.
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
        let body = checked(bytes).map_err(Error::TallyBytes)?;
        let format = half(body, 6);
        if format != bits::<T>() {
            let allowed = if bits::<T>() == 32 { "32" } else { "64" };
            return Err(Error::TallyBytes(TallyFault::OtherFormat { bits: format, allowed }));
        }
        let counts = [0, 1, 2].map(|k| word(body, COUNTS + 8 * k));
        let sum = |start| ExactSum { limbs: core::array::from_fn(|limb| word(body, start + 8 * limb)) };
        Self::from_parts([sum(SUMS), sum(SUMS + SUM)], counts)
    }
}

/// Returns the name of the format of a tally's floats, "f32" or "f64", from the bytes that [`Tally::to_bytes`] wrote.
///
/// # Errors
/// [`Error::TallyBytes`] as [`Tally::from_bytes`], whatever the format.
///
/// ```
/// use mean_information::{Tally, tally::format_of_bytes};
/// assert_eq!(format_of_bytes(&Tally::from_occupancies(&[0.25_f32]).to_bytes()), Ok("f32"));
/// assert!(format_of_bytes(b"a tally").is_err());
/// ```
pub fn format_of_bytes(bytes: &[u8]) -> Result<&'static str, Error> {
    let body = checked(bytes).map_err(Error::TallyBytes)?;
    match half(body, 6) {
        32 => Ok(f32::FORMAT),
        64 => Ok(f64::FORMAT),
        bits => Err(Error::TallyBytes(TallyFault::OtherFormat { bits, allowed: "32 or 64" })),
    }
}

/// Returns the bits of a float.
fn bits<T: Real>() -> u16 {
    8 * size_of::<T>() as u16
}

/// Returns the bytes before the checksum, whose version, number and checksum are right.
fn checked(bytes: &[u8]) -> Result<&[u8], TallyFault> {
    let shared = bytes.len().min(MAGIC.len());
    if bytes[..shared] != MAGIC[..shared] {
        return Err(TallyFault::NoTally);
    }
    // The version before the length: later ones may be of another.
    if bytes.len() >= 6 {
        match half(bytes, 4) {
            VERSION => {}
            0 => return Err(TallyFault::Damaged),
            version => return Err(TallyFault::LaterVersion { version }),
        }
    }
    let (TALLY_BYTES, Some((body, checksum))) = (bytes.len(), bytes.split_last_chunk()) else {
        return Err(TallyFault::Length { given: bytes.len() });
    };
    if u32::from_le_bytes(*checksum) == crc32(body) { Ok(body) } else { Err(TallyFault::Damaged) }
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
