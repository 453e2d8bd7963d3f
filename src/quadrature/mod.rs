//! Integrals of functions of one variable.
//!
//! [`adaptive`] estimates: any function of floats, an error that is believed.

pub mod adaptive;
