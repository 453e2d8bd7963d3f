//! One cell: Eq. 1, the Bernoulli entropy `H(p) = -p log2 p - (1-p) log2 (1-p)`, and Eq. 3, the information
//! `I(p) = 1 - H(p)`, both in bits, from the occupancy `p` or from the log-odds `l = ln(p / (1-p))`.
//!
//! Every function here is correctly rounded (round to nearest, ties to even) for every input; how and why is the
//! chapter [`rounding`](crate::book::rounding). They are pure functions of bits: the same on every platform.

use crate::error::Error;
use crate::real::Real;
use crate::rounded::{self, CellEnclosures};
use core::cmp::Ordering;

/// The state of a cell in a map. The paper calls a cell observed if `p != 1/2`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum State {
    /// The state at `p = 1/2` exactly: nothing is known.
    Unknown,
    /// The state at `p < 1/2`: observed.
    Free,
    /// The state at `p > 1/2`: observed.
    Occupied,
}

impl State {
    /// Returns the state of a number that is not NaN, by the side of `unknown` on which it lies.
    fn beside<T: Real>(x: T, unknown: T) -> Self {
        match x.partial_cmp(&unknown) {
            Some(Ordering::Less) => Self::Free,
            Some(Ordering::Greater) => Self::Occupied,
            _ => Self::Unknown,
        }
    }
}

/// A cell as the sums over a map see it: its state, entropy and information.
///
/// ```
/// use mean_information::cell::{Cell, State};
/// let cell = Cell::from_occupancy(0.25_f64)?;
/// assert_eq!(cell.state(), State::Free);
/// assert_eq!(cell.entropy(), 0.8112781244591328);
/// assert_eq!(cell.information(), 0.18872187554086714);
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cell<T> {
    state: State,
    entropy: T,
    information: T,
}

impl<T: Real> Cell<T> {
    /// Creates an unobserved cell: `p = 1/2`, 1 bit of entropy, no information.
    ///
    /// ```
    /// let cell = mean_information::cell::Cell::<f64>::unknown();
    /// assert_eq!((cell.entropy(), cell.information()), (1.0, 0.0));
    /// ```
    pub fn unknown() -> Self {
        Self { state: State::Unknown, entropy: T::one(), information: T::zero() }
    }

    /// Creates a cell of occupancy `p`; entropy and information are those of [`entropy`] and [`information`].
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `p` is NaN or outside `[0, 1]`.
    ///
    /// ```
    /// use mean_information::cell::Cell;
    /// assert_eq!(Cell::from_occupancy(0.3_f64)?.information(), 0.11870910076930739534646);
    /// assert!(Cell::from_occupancy(1.5_f64).is_err());
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn from_occupancy(p: T) -> Result<Self, Error> {
        if !in_unit_interval(p) {
            return Err(Error::out_of_range("occupancy", p.widen(), "0 to 1"));
        }
        Ok(Self::new(State::beside(p, T::HALF), &CellEnclosures::at_occupancy(p)))
    }

    /// Creates a cell of log-odds `l` (nats); entropy and information are those of [`entropy_from_log_odds`] and
    /// [`information_from_log_odds`]. It is unknown if and only if `l` is zero, however small `l` is.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if `l` is NaN.
    ///
    /// ```
    /// use mean_information::cell::{Cell, State};
    /// // MRPT stores 16 l in a byte: its least evidence, 1/16 nat, is an observation.
    /// let cell = Cell::from_log_odds(0.0625_f64)?;
    /// assert_eq!(cell.state(), State::Occupied);
    /// assert_eq!(cell.information(), 0.0007040971218608979);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn from_log_odds(l: T) -> Result<Self, Error> {
        if l.is_nan() {
            return Err(Error::out_of_range(
                "log-odds",
                l.widen(),
                "any number of nats, infinities included",
            ));
        }
        Ok(Self::new(State::beside(l, T::zero()), &CellEnclosures::at_log_odds(l)))
    }

    /// Creates a cell from its state and its enclosures, which are rounded here.
    fn new(state: State, enclosures: &CellEnclosures) -> Self {
        Self { state, entropy: enclosures.entropy(), information: enclosures.information() }
    }

    /// Returns the state: unknown, free or occupied.
    pub fn state(&self) -> State {
        self.state
    }

    /// Returns the entropy `H` in bits, correctly rounded (Eq. 1).
    pub fn entropy(&self) -> T {
        self.entropy
    }

    /// Returns the information `I = 1 - H` in bits, correctly rounded (Eq. 3).
    pub fn information(&self) -> T {
        self.information
    }
}

/// Returns true if `p` is a probability; false for NaN.
pub(crate) fn in_unit_interval<T: Real>(p: T) -> bool {
    p >= T::zero() && p <= T::one()
}

/// Computes the entropy `H(p) = -p log2 p - (1-p) log2 (1-p)` of a cell of occupancy `p`, in bits (Eq. 1 in base 2).
///
/// Correctly rounded: the result is the floating-point number nearest to the exact `H(p)`; ties cannot occur
/// (proved, [`rounding`](crate::book::rounding)).
///
/// Special cases: `H(0) = H(1) = 0`, `H(1/2) = 1`; NaN for `p` outside `[0, 1]` or NaN.
///
/// ```
/// use mean_information::cell::entropy;
/// assert_eq!(entropy(0.25_f64), 0.8112781244591328);
/// assert_eq!(entropy(1e-300_f64), 9.980211235070977e-298);
/// assert!(entropy(1.5_f32).is_nan());
/// ```
pub fn entropy<T: Real>(p: T) -> T {
    if in_unit_interval(p) { CellEnclosures::at_occupancy(p).entropy() } else { T::nan() }
}

/// Computes the information `I(p) = 1 - H(p)` of a cell of occupancy `p`, in bits (Eq. 3).
///
/// Correctly rounded: the result is the floating-point number nearest to the exact `I(p)`, also near `p = 1/2`,
/// where `1 - H(p)` computed in floating point has no correct digit; ties cannot occur
/// (proved, [`rounding`](crate::book::rounding)).
///
/// Special cases: `I(1/2) = 0`, `I(0) = I(1) = 1`; NaN for `p` outside `[0, 1]` or NaN.
///
/// ```
/// use mean_information::cell::information;
/// assert_eq!(information(0.25_f64), 0.18872187554086714);
/// // One ulp above one half: I = d^2 / (2 ln 2) with d = 2^-52, and not the 0 of the two-logarithm formula.
/// assert_eq!(information(0.5 + f64::EPSILON / 2.0), 3.5565178622297884e-32);
/// ```
pub fn information<T: Real>(p: T) -> T {
    if in_unit_interval(p) { CellEnclosures::at_occupancy(p).information() } else { T::nan() }
}

/// Computes the entropy of a cell of log-odds `l` (nats), in bits: `(ln(1 + e^-|l|) + |l| / (1 + e^|l|)) / ln 2`.
///
/// Correctly rounded, under the condition on ties stated in [`rounding`](crate::book::rounding).
///
/// Special cases: 1 at `l = 0`, 0 at `l = ±inf`, NaN at NaN.
///
/// ```
/// use mean_information::cell::entropy_from_log_odds;
/// assert_eq!(entropy_from_log_odds(2.0_f64), 0.5270653410031616);
/// ```
pub fn entropy_from_log_odds<T: Real>(l: T) -> T {
    if l.is_nan() { l } else { CellEnclosures::at_log_odds(l).entropy() }
}

/// Computes the information of a cell of log-odds `l` (nats), in bits: `1 - H`, see [`entropy_from_log_odds`].
///
/// Correctly rounded, under the condition on ties stated in [`rounding`](crate::book::rounding).
///
/// Special cases: 0 at `l = 0`, 1 at `l = ±inf`, NaN at NaN.
///
/// ```
/// use mean_information::cell::information_from_log_odds;
/// assert_eq!(information_from_log_odds(2.0_f64), 0.4729346589968384);
/// ```
pub fn information_from_log_odds<T: Real>(l: T) -> T {
    if l.is_nan() { l } else { CellEnclosures::at_log_odds(l).information() }
}

/// Computes the occupancy `p = 1 / (1 + e^-l)` of a cell of log-odds `l` (nats).
///
/// Correctly rounded: ties cannot occur, since `e^l` is transcendental for every float `l != 0` (Lindemann; proved,
/// [`rounding`](crate::book::rounding)).
///
/// Special cases: 1/2 at `l = 0`, 0 and 1 at `l = -inf` and `+inf`, NaN at NaN.
///
/// ```
/// use mean_information::cell::occupancy_from_log_odds;
/// assert_eq!(occupancy_from_log_odds(-2.0_f64), 0.11920292202211756);
/// ```
pub fn occupancy_from_log_odds<T: Real>(l: T) -> T {
    if l.is_nan() { l } else { rounded::occupancy_from_log_odds(l) }
}

/// Computes the log-odds `l = ln(p / (1 - p))` of a cell of occupancy `p`, in nats.
///
/// Correctly rounded: ties cannot occur, since `e^l` is transcendental for every float `l != 0` (Lindemann; proved,
/// [`rounding`](crate::book::rounding)).
///
/// Special cases: 0 at `p = 1/2`, `-inf` and `+inf` at 0 and 1; NaN for `p` outside `[0, 1]` or NaN.
///
/// ```
/// use mean_information::cell::log_odds_from_occupancy;
/// assert_eq!(log_odds_from_occupancy(0.25_f64), -1.0986122886681098);
/// // One ulp above one half: 4 * 2^-53, and not the 0 of two logarithms' difference.
/// assert_eq!(log_odds_from_occupancy(0.5 + f64::EPSILON / 2.0), 4.440892098500626e-16);
/// ```
pub fn log_odds_from_occupancy<T: Real>(p: T) -> T {
    if in_unit_interval(p) { rounded::log_odds_from_occupancy(p) } else { T::nan() }
}
