//! Integrals of functions of one variable: [`adaptive`], with an estimate of the error, and [`rigorous`], with a proof
//! of it.
//!
//! Both are settings that functions of the same names replace, one at a time; the function that integrates checks them
//! together, and refuses them with what is allowed.

pub mod adaptive;
pub mod rigorous;
mod tolerance;

pub(crate) use tolerance::Tolerance;
