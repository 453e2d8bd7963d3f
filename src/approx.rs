//! Comparisons within a bound, by the traits of the crate [`approx`](https://docs.rs/approx) (feature `approx`).
//!
//! What is exact must be equal: shapes, geometries, counts, the way in which a computation ended. The floats must be
//! within the bound, each of them. Their default `epsilon` is 0, where that of `approx` for a float is
//! `T::EPSILON = 2^-52` (`f64`): with it, any two numbers of bits below `2^-53` would pass for equal, whatever
//! `max_ulps` is.

use crate::estimate::{Enclosure, Estimate};
use crate::map::{Encoding, Grid, PolarMap};
use crate::real::Real;
use crate::tally::{InformationSum, Tally};
use ::approx::{AbsDiffEq, RelativeEq, UlpsEq};

/// A result of exact parts and of floats.
trait Parts<T> {
    /// Returns true if the exact parts are equal and all pairs of floats are `near`.
    fn agree(&self, other: &Self, near: impl Fn(&T, &T) -> bool) -> bool;
}

/// Compares two lists of cells.
fn all_near<T>(left: &[T], right: &[T], near: impl Fn(&T, &T) -> bool) -> bool {
    left.len() == right.len() && left.iter().zip(right).all(|(a, b)| near(a, b))
}

impl<E: Encoding> Parts<E::Stored> for Grid<E> {
    fn agree(&self, other: &Self, near: impl Fn(&E::Stored, &E::Stored) -> bool) -> bool {
        (self.width(), self.height(), self.geometry()) == (other.width(), other.height(), other.geometry())
            && all_near(self.cells(), other.cells(), near)
    }
}

impl<E: Encoding> Parts<E::Stored> for PolarMap<E> {
    fn agree(&self, other: &Self, near: impl Fn(&E::Stored, &E::Stored) -> bool) -> bool {
        (self.sectors(), self.rings(), self.resolution())
            == (other.sectors(), other.rings(), other.resolution())
            && all_near(self.cells(), other.cells(), near)
    }
}

impl<T: Real> Parts<T> for Tally<T> {
    fn agree(&self, other: &Self, near: impl Fn(&T, &T) -> bool) -> bool {
        (self.unknown(), self.free(), self.occupied()) == (other.unknown(), other.free(), other.occupied())
            && near(&self.entropy(), &other.entropy())
            && near(&self.information(), &other.information())
    }
}

impl<T: Real> Parts<T> for InformationSum<T> {
    fn agree(&self, other: &Self, near: impl Fn(&T, &T) -> bool) -> bool {
        (self.unknown(), self.observed()) == (other.unknown(), other.observed())
            && near(&self.total(), &other.total())
    }
}

impl<T: Real> Parts<T> for Estimate<T> {
    fn agree(&self, other: &Self, near: impl Fn(&T, &T) -> bool) -> bool {
        self.status == other.status && near(&self.value, &other.value) && near(&self.error, &other.error)
    }
}

impl<T: Real> Parts<T> for Enclosure<T> {
    fn agree(&self, other: &Self, near: impl Fn(&T, &T) -> bool) -> bool {
        self.status == other.status && near(&self.lower, &other.lower) && near(&self.upper, &other.upper)
    }
}

/// Implements the three traits for results whose floats are of type `$float`; the docstring is that of [`AbsDiffEq`].
macro_rules! impl_comparisons {
    ($(#[$doc:meta])* $result:ident<$parameter:ident: $bound:path>, $float:ty) => {
        $(#[$doc])*
        impl<$parameter: $bound + PartialEq> AbsDiffEq for $result<$parameter>
        where
            $float: Real + AbsDiffEq<Epsilon = $float>,
        {
            type Epsilon = $float;

            /// Returns 0: without an `epsilon`, nothing but equality is a small difference.
            fn default_epsilon() -> $float {
                <$float as num_traits::Zero>::zero()
            }

            // Equality first, in each of the three: infinite log-odds have no difference.
            fn abs_diff_eq(&self, other: &Self, epsilon: $float) -> bool {
                self.agree(other, |a, b| a == b || a.abs_diff_eq(b, epsilon))
            }
        }

        /// Compares each pair of floats by their difference over the larger of them.
        impl<$parameter: $bound + PartialEq> RelativeEq for $result<$parameter>
        where
            $float: Real + RelativeEq<Epsilon = $float>,
        {
            fn default_max_relative() -> $float {
                <$float>::default_max_relative()
            }

            fn relative_eq(&self, other: &Self, epsilon: $float, max_relative: $float) -> bool {
                self.agree(other, |a, b| a == b || a.relative_eq(b, epsilon, max_relative))
            }
        }

        /// Compares each pair of floats by the number of floats from one to the other, which have one sign.
        impl<$parameter: $bound + PartialEq> UlpsEq for $result<$parameter>
        where
            $float: Real + UlpsEq<Epsilon = $float>,
        {
            fn default_max_ulps() -> u32 {
                <$float>::default_max_ulps()
            }

            fn ulps_eq(&self, other: &Self, epsilon: $float, max_ulps: u32) -> bool {
                self.agree(other, |a, b| a == b || a.ulps_eq(b, epsilon, max_ulps))
            }
        }
    };
}

impl_comparisons! {
    /// Compares grids cell by cell, in the floats that they store: occupancies, or log-odds in nats. Grids of different
    /// shape, resolution (metres), origin (metres) or yaw (radians) are not equal. Maps of bytes are exact; compare them
    /// with `==`.
    ///
    /// A cell that is unknown is within an ulp of two that are observed: compare the counts of [`Grid::tally`], too.
    ///
    /// ```
    /// use approx::{assert_abs_diff_eq, assert_ulps_eq, assert_ulps_ne};
    /// use mean_information::map::{Geometry, Grid, encoding::Probability};
    /// let map = |cells: [f64; 2]| {
    ///     Grid::<Probability<f64>>::new(2, 1, Geometry::new(0.05, [-3.0, 2.0])?, cells.to_vec())
    /// };
    /// let (ours, theirs) = (map([0.3, 0.97])?, map([0.1 + 0.2, 0.97])?);
    /// assert_ulps_eq!(ours, theirs, max_ulps = 1); // 0.1 + 0.2 is the float above 0.3
    /// assert_abs_diff_eq!(ours, theirs, epsilon = 6e-17);
    /// assert_ulps_ne!(map([1e-17, 0.97])?, map([2e-17, 0.97])?, max_ulps = 1);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    Grid<E: Encoding>, E::Stored
}

impl_comparisons! {
    /// Compares polar maps cell by cell, in the floats that they store, as those of a [`Grid`]. Maps of different numbers
    /// of sectors or rings, or of different resolution (metres), are not equal.
    ///
    /// ```
    /// use approx::{assert_relative_eq, assert_relative_ne};
    /// use mean_information::map::{PolarMap, encoding::LogOdds};
    /// let map = |l| PolarMap::<LogOdds<f32>>::new(3, 1, 0.4, vec![f32::NEG_INFINITY, 0.0, l]);
    /// assert_relative_eq!(map(2.5)?, map(2.501)?, max_relative = 4e-4); // 2.501 - 2.5 is 3.998e-4 of 2.501
    /// assert_relative_ne!(map(2.5)?, map(2.501)?, max_relative = 3.9e-4);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    PolarMap<E: Encoding>, E::Stored
}

impl_comparisons! {
    /// Compares tallies: the numbers of unknown, free and occupied cells must be equal, [`Tally::entropy`] and
    /// [`Tally::information`], in bits, within the bound.
    ///
    /// ```
    /// use approx::{assert_ulps_eq, assert_ulps_ne};
    /// use mean_information::Tally;
    /// let ours = Tally::from_occupancies(&[0.3, 0.5, 0.97]);
    /// let theirs = Tally::from_occupancies(&[0.1 + 0.2, 0.5, 0.97]);
    /// assert_ne!(ours, theirs); // the sums are exact
    /// assert_ulps_eq!(ours, theirs, max_ulps = 1);
    /// // Another order has the same sums, and another number of free cells.
    /// assert_ulps_ne!(ours, Tally::from_occupancies(&[0.7, 0.5, 0.97]), max_ulps = 1);
    /// ```
    Tally<T: Real>, T
}

impl_comparisons! {
    /// Compares sums of information: the numbers of unknown and observed cells must be equal,
    /// [`InformationSum::total`], in bits, within the bound.
    ///
    /// ```
    /// use approx::{assert_abs_diff_eq, assert_abs_diff_ne};
    /// use mean_information::InformationSum;
    /// let ours = InformationSum::from_occupancies(&[0.25_f32, 0.5, 0.97]); // 0.994313 bits
    /// let theirs = InformationSum::from_occupancies(&[0.25, 0.5, 0.9701]); // 0.994815 bits
    /// assert_abs_diff_eq!(ours, theirs, epsilon = 6e-4);
    /// assert_abs_diff_ne!(ours, theirs, epsilon = 4e-4);
    /// ```
    InformationSum<T: Real>, T
}

impl_comparisons! {
    /// Compares estimates: they must have ended in the same way, and value and claimed error be within the bound. The
    /// number of evaluations is their cost, and may differ.
    ///
    /// Whether an estimate is *right* is another question: `|value - truth| <= error`.
    ///
    /// ```
    /// use approx::{assert_abs_diff_eq, assert_abs_diff_ne};
    /// use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
    /// let [ours, theirs, cut] = [(Rule::K15, 999), (Rule::K61, 999), (Rule::K15, 15)].map(|(rule, limit)| {
    ///     let rules = GaussKronrod::new().rule(rule).limit(limit).relative(1e-9);
    ///     rules.integrate(|x: f64| 1.0 / (x * x + 0.001), 0.0, 1.0)
    /// });
    /// assert_abs_diff_eq!(ours?, theirs.clone()?, epsilon = 1e-6);
    /// assert_abs_diff_ne!(cut?, theirs?, epsilon = 1e6); // it did not converge
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    Estimate<T: Real>, T
}

impl_comparisons! {
    /// Compares enclosures: they must have ended in the same way, and both ends be within the bound. The number of
    /// evaluations is their cost, and may differ.
    ///
    /// ```
    /// use approx::{assert_abs_diff_eq, assert_abs_diff_ne};
    /// use mean_information::limit::{Weight, rigorous};
    /// use mean_information::{quadrature::rigorous::Rigorous, sensor::GaussianSensor};
    /// let sensor = GaussianSensor::new(2.0_f64, 0.2)?;
    /// let limit = |tolerance| rigorous(&sensor, Weight::Radial, &Rigorous::new().relative(tolerance));
    /// assert_abs_diff_eq!(limit(1e-12)?, limit(1e-14)?, epsilon = 1e-11);
    /// assert_abs_diff_ne!(limit(1e-12)?, limit(0.01)?, epsilon = 1e-11);
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    Enclosure<T: Real>, T
}
