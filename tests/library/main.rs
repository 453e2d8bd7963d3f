//! The library against its definition: properties, relations and special cases.

mod adaptive;
mod bounds;
mod cell;
mod closed_form;
mod common;
mod elementary;
mod elementwise;
mod expected;
mod fusion;
mod guarantees;
mod inequalities;
mod interval;
mod limit;
mod map;
mod operations;
mod rigorous;
mod room;
mod scan;
mod sensor;
mod tally;
mod tally_bytes;
#[cfg(feature = "rayon")]
mod threads;
