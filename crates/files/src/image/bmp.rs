//! The header of a BMP: where its pixels end, its palette, and the alpha that decoders pass over.

use super::bytes::read_at;
use std::io::{self, Read, Seek};

/// The bytes of a header that are read.
const HEAD: usize = 54;

/// What the header of a BMP says.
pub(super) struct Bmp {
    /// The bytes of the second header.
    header: u32,
    /// The start of the pixels.
    start: u64,
    width: u64,
    height: u64,
    /// True if the upper row comes first.
    from_above: bool,
    /// The bits of a pixel.
    pub(super) bits: u32,
    compression: u32,
    /// The bytes of compressed pixels.
    length: u64,
    /// The entries of the palette, or 0 for as many as there can be.
    entries: u32,
}

impl Bmp {
    /// Reads the header; `None` if it is cut short.
    pub(super) fn read(input: &mut (impl Read + Seek)) -> io::Result<Option<Self>> {
        Ok(Self::of(&read_at(input, 0, HEAD)?))
    }

    fn of(head: &[u8]) -> Option<Self> {
        let number = |at: usize| Some(u32::from_le_bytes(*head.get(at..)?.first_chunk()?));
        let short = |at: usize| Some(u32::from(u16::from_le_bytes(*head.get(at..)?.first_chunk()?)));
        let (header, start) = (number(14)?, number(10)?.into());
        let plain = Self {
            header,
            start,
            width: 0,
            height: 0,
            from_above: false,
            bits: 0,
            compression: 0,
            length: 0,
            entries: 0,
        };
        if header == 12 {
            let (width, height) = (short(18)?.into(), short(20)?.into());
            return Some(Self { width, height, bits: short(24)?, ..plain });
        }
        let rows = number(22)? as i32;
        Some(Self {
            width: number(18)?.into(),
            height: rows.unsigned_abs().into(),
            from_above: rows < 0,
            bits: short(28)?,
            compression: number(30)?,
            length: number(34)?.into(),
            entries: number(46)?,
            ..plain
        })
    }

    /// Returns the end of the pixels: of rows of whole words, or as many bytes as the header says if they are compressed.
    pub(super) fn end(&self) -> Option<u64> {
        match self.compression {
            // RLE8 and RLE4.
            1 | 2 => Some(self.start + self.length).filter(|&end| end > self.start),
            _ => (u64::from(self.bits) * self.width)
                .div_ceil(32)
                .checked_mul(4 * self.height)?
                .checked_add(self.start),
        }
    }

    /// Returns the start of the palette, its entries and the bytes of each.
    pub(super) fn palette(&self) -> Option<(u64, usize, usize)> {
        let most = 1 << if self.bits <= 8 { self.bits } else { return None };
        let entries = if self.entries == 0 { most } else { self.entries.min(most) };
        Some((14 + u64::from(self.header), entries as usize, if self.header == 12 { 3 } else { 4 }))
    }

    /// Tells whether GraphicsMagick takes the fourth byte of a pixel for its alpha where no mask says so.
    pub(super) fn has_plain_alpha(&self) -> bool {
        self.bits == 32 && self.compression == 0
    }

    /// Reads the fourth byte of each pixel of 32 bits, the upper row first.
    pub(super) fn fourth_bytes(&self, input: &mut (impl Read + Seek)) -> io::Result<Vec<u8>> {
        let row = 4 * self.width;
        let mut all = Vec::new();
        for y in 0..self.height {
            let y = if self.from_above { y } else { self.height - 1 - y };
            let bytes = read_at(input, self.start + y * row, row as usize)?;
            all.extend(bytes.as_chunks::<4>().0.iter().map(|pixel| pixel[3]));
        }
        Ok(all)
    }
}
