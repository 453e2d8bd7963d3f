//! `.npy` arrays: a map of two dimensions, whose row 0 is the lowest of the grid; a stack of such maps; a list of
//! weights.

mod elements;
mod header;
mod reading;
mod stack;
mod values;
mod watch;
mod weights;
mod write;

pub use reading::{read, read_contents, read_type};
pub use stack::{MapsVisitor, read_stack};
pub use weights::read_weights;
pub use write::write;
