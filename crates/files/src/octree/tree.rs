//! A tree that was read.

use super::head::Head;
use super::visitor::OctreeVisitor;
use super::walk::Walk;
use crate::error::{Error, ErrorKind, Place};
use crate::size::at_end;
use crate::warning::Warning;
use std::io::BufRead;
use std::path::{Path, PathBuf};

/// A tree that was read: all but its nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Octree {
    /// The side of a finest cell, in metres.
    pub resolution: f64,
    /// The number of nodes, inner ones and leaves.
    pub nodes: u64,
    /// The number of leaves.
    pub leaves: u64,
    /// True of a `.bt` file, whose leaves are free or occupied only.
    pub binary: bool,
    /// The signs that the tree means less than it seems.
    pub warnings: Vec<Warning>,
    /// The files it was read from.
    pub files: Vec<PathBuf>,
}

/// Tells whether a file is an octree by the ending of its name: `.ot` or `.bt`.
///
/// ```
/// use mean_information_files::octree;
/// use std::path::Path;
/// assert!(octree::has_name(Path::new("maps/hall.BT")) && !octree::has_name(Path::new("hall.yaml")));
/// ```
pub fn has_name(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ["ot", "bt"].iter().any(|known| ending.eq_ignore_ascii_case(known)))
}

/// Reads a tree, whichever of the two kinds of files it is, and has `visitor` visit its nodes.
///
/// # Errors
/// An [`Error`] if this is no `OcTree` or `ColorOcTree` of OctoMap, has more or fewer nodes than its head says, nodes below
/// depth 16, an inner node without children, log-odds that are NaN, is cut short or goes on after its end. The place is the
/// byte of the node. Then the visitor has seen the nodes before it.
///
/// ```
/// use mean_information::{Tally, cell::Cell};
/// use mean_information_files::octree::{self, Leaf, Octant, OctreeVisitor};
///
/// /// Counts finest cells.
/// struct Measured(Tally<f64>);
/// impl OctreeVisitor for Measured {
///     fn leaf(&mut self, octant: Octant, leaf: Leaf) {
///         let Leaf::LogOdds(l) = leaf else { return };
///         let cell = Cell::from_log_odds(f64::from(l)).unwrap_or_else(|_| Cell::unknown());
///         self.0.add_many(cell, octant.finest_cells());
///     }
/// }
/// // A root with two leaves at depth 1, of 2^45 finest cells each.
/// let mut bytes = b"# Octomap OcTree file\nid OcTree\nsize 3\nres 0.05\ndata\n".to_vec();
/// for (log_odds, children) in [(0.85_f32, 0b0010_0001), (-0.4, 0), (0.85, 0)] {
///     bytes.extend(log_odds.to_le_bytes());
///     bytes.push(children);
/// }
/// let mut measured = Measured(Tally::new());
/// let tree = octree::read(&bytes[..], &mut measured)?;
/// assert_eq!((tree.leaves, measured.0.observed()), (2, 1 << 46));
/// assert_eq!(format!("{:.6}", measured.0.mean_information()), "0.073845");
/// # Ok::<(), mean_information_files::Error>(())
/// ```
pub fn read(mut input: impl BufRead, visitor: &mut impl OctreeVisitor) -> Result<Octree, Error> {
    let head = Head::read(&mut input)?;
    read_nodes(input, head, visitor)
}

/// Reads the nodes of a tree, which end where `input` does.
fn read_nodes(
    mut input: impl BufRead,
    head: Head,
    visitor: &mut impl OctreeVisitor,
) -> Result<Octree, Error> {
    let is_empty = match head.nodes {
        Some(nodes) => nodes == 0,
        None => input.fill_buf()?.is_empty(),
    };
    let mut walk = Walk::new(input, head, visitor);
    if !is_empty {
        walk.whole()?;
    }
    let (nodes, byte) = (walk.nodes(), walk.byte());
    if let Some(claimed) = head.nodes.filter(|&claimed| claimed != nodes) {
        let message = format!("has {nodes} nodes, not the {claimed} that its head says");
        return Err(Error::new(ErrorKind::Format, message)
            .with_value(nodes.to_string())
            .at(Place::Byte(byte)));
    }
    let (leaves, warnings) = (walk.leaves(), walk.warnings());
    if !at_end(walk.into_input())? {
        let message = format!("goes on after its last node, which ends before byte {byte}");
        return Err(Error::new(ErrorKind::Format, message).at(Place::Byte(byte)));
    }
    let Head { binary, resolution, .. } = head;
    Ok(Octree { resolution, nodes, leaves, binary, warnings, files: Vec::new() })
}

/// Reads the nodes of a tree as messages of ROS have them, without a head, from byte `start` of the message.
///
/// # Errors
/// An [`Error`] with the byte in the message: as [`read`].
pub(crate) fn read_message(
    nodes: &[u8],
    start: u64,
    (id, binary, resolution): (&str, bool, f64),
    visitor: &mut impl OctreeVisitor,
) -> Result<Octree, Error> {
    read_nodes(nodes, Head::of_message(id, binary, resolution, start)?, visitor)
}
