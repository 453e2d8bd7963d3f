//! The operations that a port of this measure implements: one list, by name, with the exact meaning of each.
//!
//! The port protocol, the vectors, the command `meaninfo check`, the bench `operations` and the page
//! [`operations`](crate::book::operations) are driven by [`OPERATIONS`]. Arguments are the exact values of the floats,
//! and the tolerance counts from the exact real result.
//!
//! ```
//! use mean_information::operations::{Answer, Value, find};
//! let operation = find("map.mean_information").expect("in the list");
//! let cells = Value::List(vec![0.25_f64, 0.5, 0.96875]);
//! assert_eq!(operation.run(&[cells])?, Answer::Float(0.49404977561407626));
//! # Ok::<(), mean_information::operations::Refusal>(())
//! ```

mod run;
mod table;

pub use table::OPERATIONS;

use crate::error::Error;
use alloc::vec::Vec;
use core::fmt;

/// One operation: its name in the protocol, what it takes and gives, and how near to exact an answer must be.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operation {
    /// Its name, as `cell.entropy`.
    pub name: &'static str,
    /// Its arguments, in the order of [`Operation::run`].
    pub arguments: &'static [Argument],
    /// What its result is.
    pub result: Outcome,
    /// What is allowed; anything else is answered with the error `domain`.
    pub domain: &'static str,
    /// The exact result as a formula.
    pub equation: &'static str,
    /// The function of this crate that computes it.
    pub function: &'static str,
    /// How far an answer may be from the exact result, in spacings of the format's floats at the answer; 0.5 is the
    /// float nearest to it, ties to even. A test of a grid allows more, see `vectors/README.md`.
    pub tolerance_ulp: f64,
    which: run::Which,
}

/// An argument of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Argument {
    /// Its name in the protocol.
    pub name: &'static str,
    /// What it is made of.
    pub shape: Shape,
}

/// What an argument is made of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// One float.
    Float,
    /// Floats.
    List,
    /// Lists of floats.
    Rows,
}

impl Shape {
    /// Its name in `vectors/v1/operations.json`.
    ///
    /// ```
    /// use mean_information::operations::find;
    /// let weights = find("expected.mean_information").expect("in the list").arguments[0];
    /// assert_eq!((weights.name, weights.shape.name()), ("weights", "list"));
    /// ```
    pub fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::List => "list",
            Self::Rows => "rows",
        }
    }
}

/// What a result is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Outcome {
    /// A float.
    Float,
    /// How many.
    Count,
}

impl Outcome {
    /// Its name in `vectors/v1/operations.json`: `float` or `count`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Count => "count",
        }
    }
}

/// The value of an argument.
#[derive(Clone, Debug, PartialEq)]
pub enum Value<T> {
    /// One float.
    Float(T),
    /// Floats.
    List(Vec<T>),
    /// Lists of floats.
    Rows(Vec<Vec<T>>),
}

impl<T> Value<T> {
    /// What it is made of.
    pub fn shape(&self) -> Shape {
        match self {
            Self::Float(_) => Shape::Float,
            Self::List(_) => Shape::List,
            Self::Rows(_) => Shape::Rows,
        }
    }
}

/// A result.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Answer<T> {
    /// A float.
    Float(T),
    /// How many.
    Count(u64),
}

/// Why there is no result.
#[derive(Clone, Debug, PartialEq)]
pub enum Refusal {
    /// Outside the domain: the protocol's error `domain`.
    Domain(Error),
    /// Inside it, but beyond what this crate computes, such as a grid of too many cells: the protocol's `skipped`.
    TooLarge(Error),
    /// Not the arguments of this operation.
    Arguments,
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Domain(error) | Self::TooLarge(error) => error.fmt(f),
            Self::Arguments => f.write_str("not the arguments of this operation"),
        }
    }
}

impl core::error::Error for Refusal {}

/// The operation of that name.
///
/// ```
/// use mean_information::operations::find;
/// assert_eq!(find("limit.area").map(|operation| operation.tolerance_ulp), Some(2.0));
/// assert_eq!(find("limit.volume"), None);
/// ```
pub fn find(name: &str) -> Option<&'static Operation> {
    OPERATIONS.iter().find(|operation| operation.name == name)
}
