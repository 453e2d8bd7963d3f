//! Cartographer's saved states, `.pbstream`: the probability grids of its submaps, whole, where its exported images are
//! thresholded.
//!
//! A state is eight bytes of magic, then records: their length in eight bytes, and a protobuf message in gzip. The first is a
//! header with the version of the format. All is
//! read as a stream, by hand: a dozen fields of four messages are needed, which no crate would read without holding a
//! submap twice. Of a cell's value `v`, whose bit 15 is a mark, 0 is unknown; otherwise, in `f32` as in Cartographer,
//!
//! `p = 1 - (v k + (least - k))`, with `k = (greatest - least) / 32766`.
//!
//! A node is a scan: the points of a compressed cloud, on a grid of a millimetre, in the tracking frame turned upright. It
//! was thinned out for the matching of scans, and beams that did not return are not in it. Its pose is there twice, as it
//! was when the scan was matched and as the pose graph has it.

mod cloud;
mod fields;
mod header;
mod nodes;
mod reading;
mod submap;

pub use reading::{read, read_scans};
pub use submap::Submap;
