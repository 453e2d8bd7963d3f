//! MRPT's `COccupancyGridMap2D` as its toolkit serialises it, plain or in gzip: `.gridmap`, `.gridmap.gz`.
//!
//! Read as a stream: the header, then exactly the cells it claims, then the options of the map object, which say nothing
//! of its cells and are passed over, up to the end mark. Cells say how *free* they are.

use crate::cells::Cells;
use crate::error::{Error, ErrorKind, Place};
use crate::map::Map;
use crate::options::Options;
use crate::size::{CHUNK, Size, at_end, read_pieces, reserve};
use crate::warning::Warning;
use flate2::bufread::MultiGzDecoder;
use mean_information::map::Grid;
use mean_information::map::encoding::{MrptLogOdds, Probability};
use std::io::{BufRead, BufReader, Read};

const NAMES: [&[u8]; 2] = [b"COccupancyGridMap2D", b"mrpt::maps::COccupancyGridMap2D"];
const END: u8 = 0x88;
/// The most bytes of options; real ones have about 500.
const MOST_OPTIONS: u64 = 64 << 10;

/// Reads a grid map; gzip is known by its first bytes.
///
/// # Errors
/// An [`Error`] if this is no MRPT grid map of version 2 to 7 with 8-bit cells, is cut short or goes on after its end, or
/// has more cells than the limit.
pub fn read(mut input: impl BufRead, options: &Options) -> Result<Map, Error> {
    match input.fill_buf()? {
        [] => Err(Error::new(ErrorKind::CutShort, "the file is empty")
            .allowing("; allowed is ", "an MRPT grid map")),
        [0x1f, 0x8b, ..] => {
            let unzipped = BufReader::with_capacity(CHUNK, MultiGzDecoder::new(input));
            read_plain(unzipped, options)
        }
        _ => read_plain(input, options),
    }
}

/// Reads a grid map that is not compressed.
fn read_plain(mut input: impl Read, options: &Options) -> Result<Map, Error> {
    let version = read_version(&mut input)?;
    let bits = u8::from_le_bytes(bytes(&mut input)?);
    if bits != 8 {
        return Err(Error::new(ErrorKind::Unsupported, format!("has cells of {bits} bits"))
            .with_value(bits.to_string())
            .allowing(", allowed are ", "cells of 8 bits"));
    }
    let width = u32::from_le_bytes(bytes(&mut input)?);
    let height = u32::from_le_bytes(bytes(&mut input)?);
    let size = Size::within(width.into(), height.into(), options.max_kept())?;
    let mut number = || Ok::<_, Error>(f64::from(f32::from_le_bytes(bytes(&mut input)?)));
    let [x_min, x_max, y_min, y_max, resolution] = [number()?, number()?, number()?, number()?, number()?];
    let geometry = size.placed(resolution, [x_min, y_min], 0.0)?;
    check_side("x", [x_min, x_max], resolution, width)?;
    check_side("y", [y_min, y_max], resolution, height)?;

    let mut stored = Vec::new();
    read_pieces(&mut input, size.cells(), 1, |piece| {
        reserve(&mut stored, piece.len(), size.cells())?;
        stored.extend_from_slice(piece);
        Ok(())
    })?;
    pass_options(input)?;

    let Size { width, height } = size;
    let mut warnings = Vec::new();
    let cells = if version < 3 {
        let halves = stored.iter().filter(|&&byte| matches!(byte, 127 | 128)).count();
        if halves > 0 {
            warnings.push(Warning::HalvesReadAsUnknown { count: halves as u64, version });
        }
        let cells = old_cells(&stored)?;
        Cells::Probability64(Grid::<Probability<f64>>::new(width, height, geometry, cells)?)
    } else {
        let cells = stored.into_iter().map(u8::cast_signed).collect();
        Cells::Mrpt(Grid::<MrptLogOdds>::new(width, height, geometry, cells)?)
    };
    Ok(Map { cells, resolution: Some(resolution), warnings, files: Vec::new() })
}

/// Reads the name and the version of the object.
fn read_version(input: &mut impl Read) -> Result<u8, Error> {
    let no_map = || {
        Error::new(ErrorKind::Format, "is no MRPT grid map: it does not start with COccupancyGridMap2D")
            .at(Place::Byte(0))
    };
    let [first] = bytes(input)?;
    let name = NAMES.into_iter().find(|name| first == 0x80 + name.len() as u8).ok_or_else(no_map)?;
    for &expected in name {
        if bytes(input)? != [expected] {
            return Err(no_map());
        }
    }
    let [version] = bytes(input)?;
    match version {
        2..=7 => Ok(version),
        _ => Err(Error::new(ErrorKind::Unsupported, format!("is an MRPT grid map of version {version}"))
            .with_value(version.to_string())
            .allowing(", allowed is ", "2 to 7")),
    }
}

/// Checks that an extent is that of `cells` cells, as MRPT does when it reads.
fn check_side(axis: &str, [min, max]: [f64; 2], resolution: f64, cells: u32) -> Result<(), Error> {
    let extent = (max - min) / resolution;
    if (extent - f64::from(cells)).abs() <= 0.5 {
        return Ok(());
    }
    let found = format!("{axis} from {min} to {max} m in cells of {resolution} m are {extent}");
    let message = format!("claims {cells} cells along {axis}, but {found}");
    Err(Error::new(ErrorKind::Format, message).with_value(cells.to_string()))
}

/// Returns the occupancies of bytes before version 3, which are 255 times the probability of free. MRPT reads 127 and
/// 128 as log-odds 0.
fn old_cells(stored: &[u8]) -> Result<Vec<f64>, Error> {
    let mut occupancy = [0.5; 256];
    for byte in (0..=126).chain(129..=255) {
        occupancy[byte] = (255 - byte) as f64 / 255.0;
    }
    let mut cells = Vec::new();
    reserve(&mut cells, stored.len(), stored.len())?;
    cells.extend(stored.iter().map(|&byte| occupancy[usize::from(byte)]));
    Ok(cells)
}

/// Passes over the options, whose layout differs by version; the end mark must be the last byte of the file.
fn pass_options(mut input: impl Read) -> Result<(), Error> {
    let mut rest = Vec::new();
    input.by_ref().take(MOST_OPTIONS).read_to_end(&mut rest)?;
    if !at_end(input)? {
        let message = format!("goes on for more than {MOST_OPTIONS} bytes after its cells");
        return Err(Error::new(ErrorKind::Unsupported, message));
    }
    match rest.last() {
        Some(&END) => Ok(()),
        _ => Err(Error::new(
            ErrorKind::CutShort,
            "does not end with MRPT's end mark 0x88: it is cut short, or something follows the map",
        )),
    }
}

/// Reads the next `N` bytes.
fn bytes<const N: usize>(input: &mut impl Read) -> Result<[u8; N], Error> {
    let mut bytes = [0; N];
    input.read_exact(&mut bytes)?;
    Ok(bytes)
}
