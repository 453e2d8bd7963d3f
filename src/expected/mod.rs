//! The expected map of weighted hypotheses, such as the particles of a Rao-Blackwellized particle filter:
//! `EM(x, y) = sum w_i p_i(x, y) / sum w_i`. Its mean information is the EMMI of Blanco's report.
//!
//! What is exact, and what is rounded, is the chapter [`expected`](crate::book::expected).

mod alignment;
mod hypotheses;
mod marginals;
mod particle_maps;
mod stack;
mod weights;

pub use hypotheses::{ExpectedMap, Hypotheses};
pub use weights::weighted_mean;
