//! Outward-rounded intervals: [`Interval`], for whose operations `f(X)` contains `{f(x): x in X}`, always.
//!
//! The chapter [`integration`](crate::book::integration) proves it, and says what they are for.

mod arithmetic;
mod complex;
mod endpoint;
mod ends;
mod floats;
mod powers;
mod wide;

pub(crate) use complex::Complex;
pub use endpoint::{Endpoint, Toward};
pub use ends::Interval;
pub(crate) use wide::Wide;
