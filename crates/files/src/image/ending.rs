//! Where an image ends in its file, by the marks of its format: decoders stop reading somewhere before or beyond.
//!
//! TIFF has no end, as its parts may stand in any order and anything may lie between them; and the end of TGA is a footer,
//! with areas of the writer's own before it.

use super::bmp::Bmp;
use super::bytes::read_at;
use image::ImageFormat;
use std::io::{self, BufRead, Read, Seek, SeekFrom};

/// Returns the place after the last byte of the image; none where the format or a broken file does not tell.
pub(super) fn end(input: &mut (impl BufRead + Seek), format: ImageFormat) -> io::Result<Option<u64>> {
    match format {
        ImageFormat::Bmp => Ok(Bmp::read(input)?.and_then(|head| head.end())),
        ImageFormat::Gif => Ok(first_frame(input)?.map_or(Ok(None), |frame| end_of_gif(input, frame.end))?),
        ImageFormat::Jpeg => end_of_jpeg(input),
        ImageFormat::WebP => {
            // A chunk of odd length is padded.
            let length = read_at(input, 4, 4)?.first_chunk().map(|&bytes| u32::from_le_bytes(bytes));
            Ok(length.map(|length| 8 + u64::from(length).next_multiple_of(2)))
        }
        _ => Ok(None),
    }
}

/// The first image of a GIF.
pub(super) struct Frame {
    /// The start of its palette and the number of entries.
    pub(super) palette: Option<(u64, usize)>,
    end: u64,
}

/// Finds the first image of a GIF.
pub(super) fn first_frame(input: &mut (impl BufRead + Seek)) -> io::Result<Option<Frame>> {
    let head = read_at(input, 0, 13)?;
    let Some(&flags) = head.get(10) else { return Ok(None) };
    let mut palette = table(flags).map(|entries| (13, entries));
    let mut place = 13 + 3 * table(flags).unwrap_or(0) as u64;
    loop {
        let block = read_at(input, place, 10)?;
        match (block.first(), block.get(9)) {
            (Some(0x21), _) => place = after_blocks(input, place + 2)?,
            (Some(0x2c), Some(&flags)) => {
                let own = table(flags);
                palette = own.map(|entries| (place + 10, entries)).or(palette);
                // A byte, the size of codes, precedes the pixels.
                let end = after_blocks(input, place + 11 + 3 * own.unwrap_or(0) as u64)?;
                return Ok(Some(Frame { palette, end }));
            }
            _ => return Ok(None),
        }
    }
}

/// Returns the place after the last block of a GIF, its trailer; none if it has no trailer.
fn end_of_gif(input: &mut (impl BufRead + Seek), mut place: u64) -> io::Result<Option<u64>> {
    loop {
        let block = read_at(input, place, 10)?;
        place = match (block.first(), block.get(9)) {
            (Some(0x21), _) => after_blocks(input, place + 2)?,
            (Some(0x2c), Some(&flags)) => {
                after_blocks(input, place + 11 + 3 * table(flags).unwrap_or(0) as u64)?
            }
            (Some(0x3b), _) => return Ok(Some(place + 1)),
            _ => return Ok(None),
        }
    }
}

/// Returns the number of entries of a GIF's palette, if the flags say that there is one.
fn table(flags: u8) -> Option<usize> {
    (flags & 0x80 != 0).then(|| 2 << (flags & 7))
}

/// Returns the place after a GIF's chain of blocks of up to 255 bytes, which one of 0 bytes ends.
fn after_blocks(input: &mut (impl Read + Seek), mut place: u64) -> io::Result<u64> {
    input.seek(SeekFrom::Start(place))?;
    let mut length = [0];
    while input.read(&mut length)? == 1 {
        place += 1 + u64::from(length[0]);
        if length == [0] {
            break;
        }
        input.seek_relative(length[0].into())?;
    }
    Ok(place)
}

/// Returns the place after the mark that ends a JPEG; none if there is none.
fn end_of_jpeg(input: &mut (impl BufRead + Seek)) -> io::Result<Option<u64>> {
    input.rewind()?;
    let mut place = 0;
    // Whether the byte before is 0xff: with the next one it is a mark, but for one of 0, which is a pixel's.
    let mut marked = false;
    let mut next = [0];
    while input.read(&mut next)? == 1 {
        place += 1;
        match (marked, next[0]) {
            (true, 0xd9) => return Ok(Some(place)),
            // Marks without a length: within pixels, and at the beginning.
            (true, 0 | 1 | 0xd0..=0xd8) => marked = false,
            (true, mark) if mark != 0xff => {
                let length =
                    read_at(input, place, 2)?.first_chunk().map_or(2, |&bytes| u16::from_be_bytes(bytes));
                (place, marked) = (place + u64::from(length.max(2)), false);
                input.seek(SeekFrom::Start(place))?;
            }
            (_, byte) => marked = byte == 0xff,
        }
    }
    Ok(None)
}

/// Returns the number of components of a JPEG, from the segment that says its size.
pub(super) fn components_of_jpeg(input: &mut (impl BufRead + Seek)) -> io::Result<Option<u8>> {
    let mut place = 2;
    while let [0xff, mark, high, low, rest @ ..] = &read_at(input, place, 10)?[..] {
        match mark {
            // Marks of tables and of an arithmetic coder lie among those of a frame.
            0xc4 | 0xc8 | 0xcc => {}
            0xc0..=0xcf => return Ok(rest.get(5).copied()),
            // The pixels.
            0xda => break,
            _ => {}
        }
        place += 2 + u64::from(u16::from_be_bytes([*high, *low])).max(2);
    }
    Ok(None)
}
