//! An interval by its two ends, of any type.

/// The real numbers from `lower` to `upper`, or none.
///
/// An operation on intervals gives an interval that contains the exact result of the operation on any numbers in
/// them; so does a formula. An infinite end means that there is no bound on that side.
///
/// A function is evaluated where it is defined: `√[-1, 4]` is `[0, 2]`, and `ln [-2, -1]` is [`EMPTY`](Self::EMPTY).
/// An operation on an empty interval gives an empty one. Division by an interval with 0 inside gives no bounds.
///
/// The ends are the nearest floats in their direction. They may be the next floats for products, quotients and roots
/// near overflow and underflow, and for a value of another function that is within `2^-65` of a float, relative to it
/// (proved in [`integration`](crate::book::integration)).
///
/// ```
/// use mean_information::interval::Interval;
/// use mean_information::scalar::Scalar;
///
/// let p = Interval::new(0.25_f64, 0.75)?;
/// let entropy = p.entropy(); // bits; 1 at p = 1/2
/// assert_eq!((entropy.lower(), entropy.upper()), (0.8112781244591328, 1.0));
/// # Ok::<(), mean_information::Error>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval<T> {
    /// The lower end; `+inf` only in the empty interval.
    pub(super) lower: T,
    /// The upper end; `-inf` only in the empty interval.
    pub(super) upper: T,
}

impl<T> Interval<T> {
    /// Creates the interval of the one number `x`, finite.
    pub(crate) const fn point(x: T) -> Self
    where
        T: Copy,
    {
        Self { lower: x, upper: x }
    }

    /// Creates the interval between two ends that are known to be in order.
    pub(crate) const fn between(lower: T, upper: T) -> Self {
        Self { lower, upper }
    }
}
