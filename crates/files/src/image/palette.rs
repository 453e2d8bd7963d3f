//! Palettes of BMP, GIF and TGA, and images in which every entry is the grey of its own number: the indices that SDL hands on,
//! which ROS 1 takes for greys.

use super::bmp::Bmp;
use super::bytes::read_at;
use super::ending::first_frame;
use image::ImageFormat;
use std::io::{self, BufRead, Read, Seek, SeekFrom};

/// The palette of an image, and where it stands in its file.
pub(super) struct Palette {
    start: u64,
    /// The bytes of an entry: 3, or 4 of which the last is not used.
    entry: usize,
    bytes: Vec<u8>,
}

impl Palette {
    /// Finds the palette of an image, and returns to its beginning; none if it has none that is whole.
    pub(super) fn find(input: &mut (impl BufRead + Seek), format: ImageFormat) -> io::Result<Option<Self>> {
        let place = match format {
            ImageFormat::Bmp => Bmp::read(input)?.and_then(|head| head.palette()),
            ImageFormat::Tga => of_tga(&read_at(input, 0, 8)?),
            ImageFormat::Gif => {
                first_frame(input)?.and_then(|frame| frame.palette).map(|(start, n)| (start, n, 3))
            }
            _ => None,
        };
        let Some((start, entries, entry)) = place else { return Ok(None) };
        let bytes = read_at(input, start, entries * entry)?;
        input.rewind()?;
        Ok((bytes.len() == entries * entry).then_some(Self { start, entry, bytes }))
    }

    /// Tells whether the entries are the greys of their own numbers.
    pub(super) fn is_grey_scale(&self) -> bool {
        let entries = self.bytes.chunks_exact(self.entry).enumerate();
        entries.into_iter().all(|(n, entry)| entry[..3].iter().all(|&sample| usize::from(sample) == n))
    }

    /// Returns the file with the greys of their own numbers in the place of the entries.
    pub(super) fn numbered<R: Read + Seek>(mut self, input: R) -> Numbered<R> {
        for (n, entry) in self.bytes.chunks_exact_mut(self.entry).enumerate() {
            entry[..3].fill(n as u8);
        }
        Numbered { input, place: 0, palette: self }
    }
}

/// Returns the start of a TGA's palette, its entries and the bytes of each, if they are whole bytes and numbered from 0.
fn of_tga(head: &[u8]) -> Option<(u64, usize, usize)> {
    let [id, 1, 1 | 9, 0, 0, low, high, bits @ (24 | 32)] = *head.first_chunk()? else { return None };
    Some((18 + u64::from(id), u16::from_le_bytes([low, high]).into(), usize::from(bits) / 8))
}

/// A file with another palette.
pub(super) struct Numbered<R> {
    input: R,
    place: u64,
    palette: Palette,
}

impl<R: Read> Read for Numbered<R> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let length = self.input.read(buffer)?;
        for (place, byte) in (self.place..).zip(&mut buffer[..length]) {
            let within = place.checked_sub(self.palette.start).and_then(|n| usize::try_from(n).ok());
            if let Some(&own) = within.and_then(|n| self.palette.bytes.get(n)) {
                *byte = own;
            }
        }
        self.place += length as u64;
        Ok(length)
    }
}

impl<R: Seek> Seek for Numbered<R> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.place = self.input.seek(to)?;
        Ok(self.place)
    }
}
