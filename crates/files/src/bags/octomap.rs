//! The messages of octrees: `octomap_msgs/Octomap`.

use super::delivery::{Message, Topic, Visitor, of_message};
use super::fields::Fields;
use super::read::read_bag;
use crate::error::{Error, ErrorKind, Place};
use crate::octree::{self, Octree, OctreeVisitor};
use crate::options::Options;
use crate::warning::Warning;
use std::path::Path;

/// The name of the type.
pub(super) const OCTOMAP: &str = "octomap_msgs/Octomap";

/// Reads the last octree of `topic` of the bag at `path` on the disk, and has `visitor` visit its nodes.
///
/// # Errors
/// An [`Error`] if the topic has no message; with the byte in the last one, which breaks the rules of [`octree::read`]; or
/// as [`read_bag`].
pub fn last_octree(
    path: &Path,
    topic: &str,
    options: &Options,
    visitor: &mut impl OctreeVisitor,
) -> Result<Octree, Error> {
    let read = |taken: &mut dyn Visitor| read_bag(path, options, taken);
    let mut tree = octree_of(read, topic, visitor).map_err(|error| error.in_file(path))?;
    tree.files.push(path.to_owned());
    Ok(tree)
}

/// Reads the last octree of `topic` of a bag, whose messages `read` hands to a visitor: as [`last_octree`].
///
/// # Errors
/// As [`last_octree`].
pub fn octree_of(
    read: impl FnOnce(&mut dyn Visitor) -> Result<Vec<Warning>, Error>,
    topic: &str,
    visitor: &mut impl OctreeVisitor,
) -> Result<Octree, Error> {
    let mut last = Last { topic, message: None };
    let warnings = read(&mut last)?;
    let Some((topic, number, bytes)) = last.message else {
        let refused = Error::new(ErrorKind::Format, format!("has no message of topic {topic}"));
        return Err(refused.with_value(topic));
    };
    let message = Message { topic: &topic, number, time_ns: 0, bytes: &bytes };
    let mut tree = nodes(&message, visitor).map_err(|error| of_message(&topic, number, error))?;
    tree.warnings.extend(warnings);
    Ok(tree)
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

/// Keeps the last message of a topic.
struct Last<'a> {
    topic: &'a str,
    message: Option<(Topic, u64, Vec<u8>)>,
}

impl Visitor for Last<'_> {
    fn wants(&mut self, topic: &Topic) -> bool {
        topic.name == self.topic && topic.kind == OCTOMAP
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        let mut bytes = self.message.take().map_or_else(Vec::new, |(_, _, bytes)| bytes);
        bytes.clear();
        bytes.extend(message.bytes);
        self.message = Some((message.topic.clone(), message.number, bytes));
        Ok(())
    }
}
