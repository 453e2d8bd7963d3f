//! The values that an operation takes, and its answers.

use super::operation::Shape;
use crate::error::Error;
use alloc::vec::Vec;
use core::fmt;

/// The value of an argument.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Value<T> {
    /// A float.
    Float(T),
    /// A list of floats.
    List(Vec<T>),
    /// A list of lists of floats.
    Rows(Vec<Vec<T>>),
}

impl<T> Value<T> {
    /// Returns the shape of the value.
    pub fn shape(&self) -> Shape {
        match self {
            Self::Float(_) => Shape::Float,
            Self::List(_) => Shape::List,
            Self::Rows(_) => Shape::Rows,
        }
    }
}

/// The result of an operation.
#[derive(Clone, Copy, Debug, PartialEq)]
#[non_exhaustive]
pub enum Answer<T> {
    /// A float.
    Float(T),
    /// A number of cells.
    Count(u64),
}

/// The reason why there is no result.
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Refusal {
    /// An argument outside the domain: the protocol's error `domain`.
    Domain(Error),
    /// A result that this crate does not compute, such as that of a grid of too many cells: the protocol's `skipped`.
    TooLarge(Error),
    /// A wrong number or shape of arguments.
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

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        if error.is_too_large() { Self::TooLarge(error) } else { Self::Domain(error) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Neither a limit of this crate nor the memory of a machine is the end of a domain.
    #[test]
    fn what_is_too_large_is_in_the_domain() {
        for error in [Error::too_many_cells(3, 2), Error::no_memory(3)] {
            assert_eq!(Refusal::from(error.clone()), Refusal::TooLarge(error));
        }
        let error = Error::out_of_range("p", 1.5, "0 to 1");
        assert_eq!(Refusal::from(error.clone()), Refusal::Domain(error));
    }
}
