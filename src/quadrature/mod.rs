//! Integrals of functions of one variable: [`adaptive`], with an estimate of the error, and [`rigorous`], with a proof of it.

pub mod adaptive;
pub mod rigorous;
