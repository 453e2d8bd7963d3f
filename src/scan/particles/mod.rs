//! The maps of a filter's particles, which share all that they have in common: each cell has the number of a pattern, each
//! pattern for every particle the number of a value, and each value is a sum of log-odds, measured once.

mod draft;
mod index;
mod maps;
mod patterns;
mod values;

pub use maps::ParticleMaps;
