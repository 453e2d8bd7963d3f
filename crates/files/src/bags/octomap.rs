//! The messages of octrees: `octomap_msgs/Octomap`.

use super::delivery::{Message, Topic, of_message};
use super::fields::Fields;
use crate::error::{Error, Place};
use crate::octree::{self, Octree, OctreeVisitor};
use crate::warning::Warning;
use std::path::PathBuf;

/// The name of the type.
pub(super) const OCTOMAP: &str = "octomap_msgs/Octomap";

/// A message with an octree, whose nodes are read when they are asked for.
#[derive(Clone, Debug)]
pub struct OctreeMessage {
    topic: Topic,
    number: u64,
    bytes: Vec<u8>,
    /// The signs that the bag means less than it seems.
    pub(super) warnings: Vec<Warning>,
    /// The files of the bag.
    pub(super) files: Vec<PathBuf>,
}

impl OctreeMessage {
    /// Keeps a message, in the memory of the one before.
    pub(super) fn keep(message: &Message<'_>, before: Option<Self>) -> Self {
        let mut bytes = before.map_or_else(Vec::new, |before| before.bytes);
        bytes.clear();
        bytes.extend(message.bytes);
        let (warnings, files) = (Vec::new(), Vec::new());
        Self { topic: message.topic.clone(), number: message.number, bytes, warnings, files }
    }

    /// Returns the name of its topic.
    pub fn topic(&self) -> &str {
        &self.topic.name
    }

    /// Reads the octree, and has `visitor` visit its nodes.
    ///
    /// # Errors
    /// An [`Error`] with the byte in the message, which breaks the rules of [`octree::read`](crate::octree::read).
    pub fn read(&self, visitor: &mut impl OctreeVisitor) -> Result<Octree, Error> {
        let Self { topic, number, bytes, warnings, files } = self;
        let message = Message { topic, number: *number, time_ns: 0, bytes };
        let mut tree = nodes(&message, visitor).map_err(|error| of_message(topic, *number, error))?;
        tree.warnings.extend(warnings.iter().cloned());
        tree.files.extend(files.iter().cloned());
        Ok(tree)
    }
}

/// Reads a message.
fn nodes(message: &Message<'_>, visitor: &mut impl OctreeVisitor) -> Result<Octree, Error> {
    let mut fields = Fields::new(message)?;
    fields.header()?;
    let binary = fields.bytes(1)? != [0];
    let id_place = fields.place(4);
    let id = fields.text()?;
    let resolution = fields.f64()?;
    let count = fields.u32()?;
    let start = match fields.place(1) {
        Place::Byte(start) => start,
        _ => 0,
    };
    let data = fields.bytes(count as usize)?;
    let read = octree::read_message(data, start, (id, binary, resolution), visitor);
    read.map_err(|error| if error.place().is_none() { error.at(id_place) } else { error })
}
