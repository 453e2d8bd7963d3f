//! Adaptive Gauss-Kronrod quadrature: halve the worst panel until the claimed error is within the tolerance.
//!
//! What the error claims and why is derived in [`book::quadrature`](crate::book::quadrature).

mod compensated;
mod doubts;
mod grading;
mod integrate;
mod integration;
mod panel;
mod panels;
mod rule;
mod settings;
mod stretch;
mod tables;
#[cfg(test)]
mod tests;
mod weights;

pub use grading::graded;
pub use rule::Rule;
pub use settings::GaussKronrod;
