//! What an operation is: its name, arguments, result, formula and tolerance.

/// An operation: its name in the protocol, its arguments and result, and the tolerance of an answer.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Operation {
    /// The name, such as `cell.entropy`.
    pub name: &'static str,
    /// The arguments, in the order of [`Operation::run`].
    pub arguments: &'static [Argument],
    /// The kind of result.
    pub result: Outcome,
    /// The allowed arguments; any others are answered with the error `domain`.
    pub domain: &'static str,
    /// The exact result as a formula.
    pub equation: &'static str,
    /// The function of this crate that computes it.
    pub function: &'static str,
    /// The largest distance of an answer from the exact result, in spacings of the format's floats at the answer; 0.5 means
    /// the nearest float, ties to even. A test of a grid allows more, see `vectors/README.md`.
    pub tolerance_ulp: f64,
    pub(super) which: Which,
}

/// An argument of an operation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Argument {
    /// The name in the protocol.
    pub name: &'static str,
    /// The shape of the value.
    pub shape: Shape,
}

/// The shape of an argument.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Shape {
    /// A float.
    Float,
    /// A list of floats.
    List,
    /// A list of lists of floats.
    Rows,
}

impl Shape {
    /// Returns the name in `vectors/v1/operations.json`.
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

/// The kind of a result.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
#[non_exhaustive]
pub enum Outcome {
    /// A float.
    Float,
    /// A number of cells.
    Count,
}

impl Outcome {
    /// Returns the name in `vectors/v1/operations.json`: `float` or `count`.
    pub fn name(self) -> &'static str {
        match self {
            Self::Float => "float",
            Self::Count => "count",
        }
    }
}

/// The operations as values to match on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Which {
    CellEntropy,
    CellInformation,
    CellEntropyFromLogOdds,
    CellInformationFromLogOdds,
    CellOccupancyFromLogOdds,
    SensorOccupancy,
    MapEntropy,
    MapInformation,
    MapMeanInformation,
    MapObserved,
    FuseLogOdds,
    ExpectedMeanInformation,
    GridPolar,
    GridCartesian,
    LimitRadial,
    LimitArea,
}
