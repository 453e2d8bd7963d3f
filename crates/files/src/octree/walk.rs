//! The nodes of a tree, one after the other.

use super::head::Head;
use super::octant::{DEPTH, Octant};
use super::visitor::{Leaf, OctreeVisitor};
use crate::error::{Error, ErrorKind, Place};
use crate::warning::Warning;
use std::io::Read;

/// The walk through a file: where it is, and what was counted.
pub(super) struct Walk<'v, R, V> {
    input: R,
    head: Head,
    visitor: &'v mut V,
    byte: u64,
    nodes: u64,
    leaves: u64,
    unknown_leaves: u64,
    unknown_cells: u64,
}

impl<'v, R: Read, V: OctreeVisitor> Walk<'v, R, V> {
    /// Creates a walk that begins behind the head.
    pub(super) fn new(input: R, head: Head, visitor: &'v mut V) -> Self {
        let byte = head.bytes;
        Self { input, head, visitor, byte, nodes: 0, leaves: 0, unknown_leaves: 0, unknown_cells: 0 }
    }

    /// Walks through all nodes.
    pub(super) fn whole(&mut self) -> Result<(), Error> {
        if self.head.binary { self.binary(Octant::ROOT) } else { self.full(Octant::ROOT) }
    }

    /// Returns the number of nodes.
    pub(super) fn nodes(&self) -> u64 {
        self.nodes
    }

    /// Returns the number of leaves.
    pub(super) fn leaves(&self) -> u64 {
        self.leaves
    }

    /// Returns the next byte's place in the file.
    pub(super) fn byte(&self) -> u64 {
        self.byte
    }

    /// Returns what was noticed.
    pub(super) fn warnings(&self) -> Vec<Warning> {
        let (leaves, cells) = (self.unknown_leaves, self.unknown_cells);
        if leaves > 0 { vec![Warning::LeavesOfLogOdds0 { leaves, cells }] } else { Vec::new() }
    }

    /// Returns the input.
    pub(super) fn into_input(self) -> R {
        self.input
    }

    /// Walks through a node of a `.ot` file and all below it; not deeper than [`DEPTH`] calls.
    fn full(&mut self, octant: Octant) -> Result<(), Error> {
        let start = self.begin()?;
        let log_odds = f32::from_le_bytes(self.take()?);
        if log_odds.is_nan() {
            let what = format!("the log-odds of the node at byte {start}");
            return Err(Error::out_of_range(what, log_odds, "a number of nats").at(Place::Byte(start)));
        }
        if self.head.coloured {
            self.take::<3>()?;
        }
        let [children] = self.take()?;
        if children == 0 {
            self.leaf(octant, Leaf::LogOdds(log_odds));
            return Ok(());
        }
        for child in (0..8).filter(|child| children >> child & 1 == 1) {
            self.full(below(octant, child, start)?)?;
        }
        self.visitor.inner(octant);
        Ok(())
    }

    /// Walks through an inner node of a `.bt` file and all below it; not deeper than [`DEPTH`] calls.
    fn binary(&mut self, octant: Octant) -> Result<(), Error> {
        let start = self.begin()?;
        let children = u16::from_le_bytes(self.take()?);
        if children == 0 {
            let message = format!(
                "the node at byte {start} has no child: whether it is free or occupied, the file does not say"
            );
            return Err(Error::new(ErrorKind::Format, message).at(Place::Byte(start)));
        }
        for child in 0..8 {
            let leaf = match children >> (2 * child) & 3 {
                0 => continue,
                1 => Leaf::Free,
                2 => Leaf::Occupied,
                _ => {
                    self.binary(below(octant, child, start)?)?;
                    continue;
                }
            };
            self.begin()?;
            self.leaf(below(octant, child, start)?, leaf);
        }
        self.visitor.inner(octant);
        Ok(())
    }

    /// Counts a leaf and has it visited.
    fn leaf(&mut self, octant: Octant, leaf: Leaf) {
        self.leaves += 1;
        if leaf == Leaf::LogOdds(0.0) {
            self.unknown_leaves += 1;
            self.unknown_cells += octant.finest_cells();
        }
        self.visitor.leaf(octant, leaf);
    }

    /// Counts a node, of which there may be no more than the head says; returns the byte where it begins.
    fn begin(&mut self) -> Result<u64, Error> {
        if self.head.nodes == Some(self.nodes) {
            let (nodes, byte) = (self.nodes, self.byte);
            let message = format!("has more nodes than the {nodes} that its head says, at byte {byte}");
            return Err(Error::new(ErrorKind::Format, message).at(Place::Byte(byte)));
        }
        self.nodes += 1;
        Ok(self.byte)
    }

    /// Reads the next `N` bytes.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], Error> {
        let mut bytes = [0; N];
        match self.input.read_exact(&mut bytes) {
            Ok(()) => {
                self.byte += N as u64;
                Ok(bytes)
            }
            Err(error) => {
                let (node, byte) = (self.nodes, self.byte);
                let of = self.head.nodes.map_or(String::new(), |nodes| format!(" of {nodes}"));
                let error = Error::from(error).at(Place::Byte(byte));
                Err(error.followed_by(&format!(", in node {node}{of}, at byte {byte}")))
            }
        }
    }
}

/// Returns the child of the node that begins at byte `start`.
fn below(octant: Octant, child: usize, start: u64) -> Result<Octant, Error> {
    octant.child(child).ok_or_else(|| {
        let message = format!("the node at byte {start}, at depth {DEPTH}, promises children");
        let refused = Error::new(ErrorKind::Format, message).at(Place::Byte(start));
        refused.allowing("; allowed are ", format!("nodes to depth {DEPTH}"))
    })
}
