//! The head of an octree: lines of text up to `data`.

use crate::error::{Error, ErrorKind, Place};
use crate::text::{Fields, Line, Lines};
use std::io::BufRead;

/// The first lines of the two kinds of files.
const FULL: &str = "# Octomap OcTree file";
const BINARY: &str = "# Octomap OcTree binary file";
/// The first bytes of a `.bt` file from before OctoMap had heads of text: the kind of tree.
const OLD_BINARY: [u8; 4] = [3, 0, 0, 0];

/// What a head says.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Head {
    /// Nodes are free or occupied only: a `.bt` file.
    pub(super) binary: bool,
    /// Nodes have a colour.
    pub(super) coloured: bool,
    /// The number of nodes, where there is a head that says it.
    pub(super) nodes: Option<u64>,
    /// The side of a finest cell, in metres.
    pub(super) resolution: f64,
    /// The number of bytes of the head.
    pub(super) bytes: u64,
}

impl Head {
    /// Reads a head.
    ///
    /// # Errors
    /// An [`Error`] with the line if it is not OctoMap's, of another kind of tree, lacks a key, or ends before `data`.
    pub(super) fn read(input: &mut impl BufRead) -> Result<Self, Error> {
        if input.fill_buf()?.first() == Some(&OLD_BINARY[0]) {
            return Self::read_old(input);
        }
        let mut lines = Lines::new(input);
        let Some(first) = lines.next()? else {
            let refused = Error::new(ErrorKind::CutShort, "the file is empty");
            return Err(refused.allowing("; allowed is ", "an octree of OctoMap"));
        };
        let binary = is_binary(first)?;
        let mut bytes = first.bytes.len() as u64;
        let (mut coloured, mut nodes, mut resolution) = (None, None, None);
        while let Some(line) = lines.next()? {
            bytes += line.bytes.len() as u64;
            let mut fields = line.fields();
            match fields.word() {
                Some(b"id") => coloured = Some(is_coloured(line, fields)?),
                Some(b"size") => nodes = Some(fields.count("size")?),
                Some(b"res") => resolution = Some(side(fields)?),
                Some(b"data") => {
                    let missing = |key| {
                        Error::new(ErrorKind::Format, format!("the head lacks {key}")).at(Place::Key(key))
                    };
                    return Ok(Self {
                        binary,
                        coloured: coloured.ok_or_else(|| missing("id"))?,
                        nodes: Some(nodes.ok_or_else(|| missing("size"))?),
                        resolution: resolution.ok_or_else(|| missing("res"))?,
                        bytes,
                    });
                }
                // Comments; and keys that it does not know OctoMap passes over too.
                _ => {}
            }
        }
        Err(Error::new(ErrorKind::CutShort, "the file ends before the line `data`").at(Place::Byte(bytes)))
    }

    /// Reads the head of a `.bt` file from before OctoMap had heads of text: the kind of tree, the side, the number of nodes.
    fn read_old(input: &mut impl BufRead) -> Result<Self, Error> {
        let mut head = [0; 16];
        input.read_exact(&mut head).map_err(|error| match error.kind() {
            std::io::ErrorKind::UnexpectedEof => {
                Error::new(ErrorKind::CutShort, "the file ends within its head of 16 bytes")
                    .at(Place::Byte(0))
            }
            _ => error.into(),
        })?;
        let (kind, rest) = head.split_at(4);
        let (side, nodes) = rest.split_at(8);
        if kind != OLD_BINARY {
            return Err(no_octree().at(Place::Byte(0)));
        }
        let number = |bytes: &[u8]| bytes.iter().rev().fold(0, |number, &byte| number << 8 | u64::from(byte));
        let resolution = f64::from_bits(number(side));
        if !is_side(resolution) {
            return Err(Error::out_of_range("resolution", resolution, SIDES).at(Place::Byte(4)));
        }
        Ok(Self { binary: true, coloured: false, nodes: Some(number(nodes)), resolution, bytes: 16 })
    }

    /// Returns what stands for a head where nodes come without one, from byte `bytes`: in messages of ROS.
    ///
    /// # Errors
    /// An [`Error`] if the kind of tree is another than in a file, or a cell has no volume.
    pub(super) fn of_message(id: &str, binary: bool, resolution: f64, bytes: u64) -> Result<Self, Error> {
        let coloured = coloured(id.as_bytes())?;
        if !is_side(resolution) {
            return Err(Error::out_of_range("resolution", resolution, SIDES));
        }
        Ok(Self { binary, coloured, nodes: None, resolution, bytes })
    }
}

/// Tells the kind of file by its first line.
fn is_binary(first: Line<'_>) -> Result<bool, Error> {
    let begins = |with: &str| first.bytes.starts_with(with.as_bytes());
    if begins(FULL) || begins(BINARY) {
        return Ok(begins(BINARY));
    }
    Err(no_octree().at(Place::Line(1)))
}

/// Creates the error of a file that begins as no octree does.
fn no_octree() -> Error {
    let refused = Error::new(ErrorKind::Format, "is no octree of OctoMap by its first line");
    refused.allowing("; allowed are ", format!("`{FULL}` and `{BINARY}`"))
}

/// Tells whether the nodes of the kind of tree on this line have colours.
fn is_coloured(line: Line<'_>, mut fields: Fields<'_>) -> Result<bool, Error> {
    coloured(fields.word().unwrap_or_default()).map_err(|error| line.blame(error))
}

/// Tells whether the nodes of a kind of tree have colours.
fn coloured(id: &[u8]) -> Result<bool, Error> {
    match id {
        // So OctoMap reads the id of its first heads, too.
        b"OcTree" | b"1" => Ok(false),
        b"ColorOcTree" => Ok(true),
        other => {
            let id = String::from_utf8_lossy(other).chars().take(40).collect::<String>();
            let refused = Error::new(ErrorKind::Unsupported, format!("is of a tree `{id}`"));
            Err(refused.with_value(id).allowing(", allowed are ", "OcTree and ColorOcTree"))
        }
    }
}

/// What a side may be.
const SIDES: &str = "a positive number of metres, within the range of volumes";

/// Takes the side of a cell, in metres.
fn side(mut fields: Fields<'_>) -> Result<f64, Error> {
    let side = fields.number("res")?;
    if is_side(side) { Ok(side) } else { Err(fields.out_of_range("res", side, SIDES)) }
}

/// Tells whether a number can be a side: that of the whole cube must have a volume that is a number, and a cell too.
fn is_side(side: f64) -> bool {
    let whole = side * 65536.0;
    side > 0.0 && (side * side * side).is_normal() && (whole * whole * whole).is_finite()
}
