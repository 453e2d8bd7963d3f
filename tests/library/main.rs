//! The library against its definition: properties, relations and special cases.

mod cell;
mod common;
mod digest;
mod elementary;
mod guarantees;
mod map;
mod sensor;
mod tally;
