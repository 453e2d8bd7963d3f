//! Tallies from their parts: refused where no cells have these sums and counts.

use super::exact_sum::ExactSum;
use super::map_tally::Tally;
use crate::error::Error;
use crate::real::Real;
use core::cmp::Ordering;
use core::marker::PhantomData;

impl<T: Real> Tally<T> {
    /// Creates a tally of these sums and counts.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] for counts that overflow, sums above 1 bit for each cell, an entropy below that of the unknown
    /// cells, sums that are no sums of numbers of `T`, and entropy and information that are not 1 bit for each cell together.
    pub(super) fn from_parts(
        [entropy, information]: [ExactSum; 2],
        [unknown, free, occupied]: [u64; 3],
    ) -> Result<Self, Error> {
        let observed = total(free, occupied)?;
        let cells = total(observed, unknown)?;
        // A cell has at most 1 bit of either; an unknown one has an entropy of 1 bit (Eq. 1).
        check_information(&information, observed)?;
        if compare(&entropy, unknown).is_lt() || compare(&entropy, cells).is_gt() {
            let allowed = "1 bit for each unknown cell, and at most 1 for each other";
            return Err(Error::out_of_range("entropy of the tally", entropy.value(), allowed));
        }
        check_format::<T>("entropy of the tally", &entropy)?;
        check_format::<T>("information of the tally", &information)?;
        // H + I = 1 bit (Eq. 3). The larger of the two is in [1/2, 1] and the other at most 1/2, so that their roundings are
        // within 2^-(P+1) and 2^-(P+2): together less than 2^-P for each cell.
        let (mut both, mut most, mut rounding) = (entropy.clone(), ExactSum::new(), ExactSum::new());
        both.merge(&information);
        let bits = both.value();
        rounding.add_many(T::from_parts(1, -(T::PRECISION as i32)), cells);
        most.add_many(T::one(), cells);
        most.merge(&rounding);
        let high = both.compare_sum(&most).is_gt();
        both.merge(&rounding);
        if high || compare(&both, cells).is_lt() {
            let allowed = "1 bit for each cell";
            return Err(Error::out_of_range("entropy and information of the tally together", bits, allowed));
        }
        Ok(Self { entropy, information, unknown, free, occupied, format: PhantomData })
    }
}

/// Adds two counts of cells.
///
/// # Errors
/// [`Error::OutOfRange`] if the sum overflows.
pub(super) fn total(cells: u64, others: u64) -> Result<u64, Error> {
    cells.checked_add(others).ok_or_else(|| {
        let sum = cells as f64 + others as f64;
        Error::out_of_range("number of cells of the tally", sum, "at most 2^64 - 1")
    })
}

/// Refuses information above 1 bit for each observed cell.
pub(super) fn check_information(information: &ExactSum, observed: u64) -> Result<(), Error> {
    if compare(information, observed).is_gt() {
        let allowed = "at most 1 bit for each observed cell";
        return Err(Error::out_of_range("information of the tally", information.value(), allowed));
    }
    Ok(())
}

/// Refuses a sum that is no multiple of the smallest number of `T`, since its terms are.
pub(super) fn check_format<T: Real>(what: &'static str, sum: &ExactSum) -> Result<(), Error> {
    if sum.is_multiple_of_power(T::MIN_EXPONENT) {
        return Ok(());
    }
    Err(Error::out_of_range(what, sum.value(), "a sum of numbers of the tally's format"))
}

/// Compares a sum with the integer `n`.
fn compare(sum: &ExactSum, n: u64) -> Ordering {
    let mut bound = ExactSum::new();
    bound.add_many(1.0_f64, n);
    sum.compare_sum(&bound)
}
