//! OctoMap's octrees: `.ot` (`OcTree`, `ColorOcTree`) with the log-odds of each node, `.bt` with free and occupied only.
//!
//! A tree parts a cube of `2^16` finest cells a side; a node at depth `d` is a cube of `8^(16 - d)` of them. Read as a
//! stream: a head of text, then the nodes, each before its children. Nothing is kept but the way to the node.
//!
//! | file | a node is |
//! |---|---|
//! | `.ot` | log-odds (nats) as `f32`; of a `ColorOcTree` three bytes of colour; a byte whose bit `i` promises child `i` |
//! | `.bt` | two bytes; two bits for each child from the lowest: 0 none, 1 a free leaf, 2 an occupied leaf, 3 an inner node |
//!
//! A `.bt` without a head of text, as they were before OctoMap had one, has 16 bytes in its place: 3, the side of a cell (`f64`)
//! and the number of nodes. `id 1` is `OcTree`.
//!
//! All numbers are little-endian. Only leaves mean something: OctoMap computes inner nodes from them.

mod head;
mod octant;
mod tree;
mod visitor;
mod walk;

pub use octant::{DEPTH, Octant};
pub(crate) use tree::read_message;
pub use tree::{Octree, has_name, read};
pub use visitor::{Leaf, OctreeVisitor};
