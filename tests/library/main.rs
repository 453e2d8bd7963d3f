//! The library against its definition: properties, relations and special cases.

mod cell;
mod common;
mod guarantees;
mod map;
mod tally;
