//! Functions of many cells at once: from a slice into a slice, each element correctly rounded.
//!
//! An element has the bits of the function of the same name in [`cell`], whatever the processor: these are the loops
//! that array languages call. With the feature `std` blocks of cells go through the vector kernels, and only those that
//! a kernel leaves undecided through the function of a single cell ([`sums`](crate::book::sums), "One by one").

use crate::cell;
use crate::real::Real;
#[cfg(feature = "std")]
use crate::rounded::lanes::{self, BLOCK};

/// Stores the results of a kernel, and those of `function` where the kernel leaves them undecided.
macro_rules! each {
    ($arguments:ident, $results:ident, $kernel:ident, $function:ident) => {
        assert_places($arguments, $results);
        #[cfg(feature = "std")]
        by_blocks($arguments, $results, lanes::$kernel, cell::$function);
        #[cfg(not(feature = "std"))]
        one_by_one($arguments, $results, cell::$function);
    };
}

/// Panics unless there are as many places for results as arguments.
fn assert_places<T>(arguments: &[T], results: &[T]) {
    let (given, places) = (arguments.len(), results.len());
    assert!(given == places, "{given} arguments need as many places for results, not {places}");
}

/// Calls `function` for each argument and stores its results.
fn one_by_one<T: Real>(arguments: &[T], results: &mut [T], function: fn(T) -> T) {
    for (result, &argument) in results.iter_mut().zip(arguments) {
        *result = function(argument);
    }
}

/// Stores the results of a kernel of blocks, and those of `function` where the kernel leaves them undecided.
#[cfg(feature = "std")]
fn by_blocks<T: Real>(
    arguments: &[T],
    results: &mut [T],
    kernel: fn(&[T; BLOCK], &mut [T; BLOCK]),
    function: fn(T) -> T,
) {
    let (blocks, last) = arguments.as_chunks::<BLOCK>();
    let (places, last_places) = results.as_chunks_mut::<BLOCK>();
    for (block, places) in blocks.iter().zip(places) {
        kernel(block, places);
        if lanes::some_are_open(places) {
            settle(block, places, function);
        }
    }
    let Some(padded) = lanes::padded(last) else {
        return one_by_one(last, last_places, function);
    };
    let mut found = padded;
    kernel(&padded, &mut found);
    last_places.copy_from_slice(&found[..last.len()]);
    settle(last, last_places, function);
}

/// Replaces the results that are not decided: the negative ones.
#[cfg(feature = "std")]
fn settle<T: Real>(arguments: &[T], results: &mut [T], function: fn(T) -> T) {
    // Eight at a time, since there are few.
    for (arguments, results) in arguments.chunks(8).zip(results.chunks_mut(8)) {
        if results.iter().fold(false, |open, &result| open | (result < T::zero())) {
            for (result, &argument) in results.iter_mut().zip(arguments) {
                if *result < T::zero() {
                    *result = function(argument);
                }
            }
        }
    }
}

/// Computes the entropy `H(p) = -p log2 p - (1-p) log2 (1-p)` of each occupancy, in bits (Eq. 1 in base 2).
///
/// Correctly rounded (proved, [`rounding`](crate::book::rounding)): bit for bit [`cell::entropy`] of each.
///
/// Special cases: those of [`cell::entropy`], NaN outside `[0, 1]` among them.
///
/// # Panics
/// If the slices differ in length.
///
/// ```
/// let mut bits = [0.0; 3];
/// mean_information::elementwise::entropy(&[0.25_f64, 0.5, 1.5], &mut bits);
/// assert_eq!(bits[..2], [0.8112781244591328, 1.0]);
/// assert!(bits[2].is_nan());
/// ```
pub fn entropy<T: Real>(occupancies: &[T], results: &mut [T]) {
    each!(occupancies, results, entropies, entropy);
}

/// Computes the information `I(p) = 1 - H(p)` of each occupancy, in bits (Eq. 3).
///
/// Correctly rounded (proved, [`rounding`](crate::book::rounding)): bit for bit [`cell::information`] of each.
///
/// Special cases: those of [`cell::information`], NaN outside `[0, 1]` among them.
///
/// # Panics
/// If the slices differ in length.
///
/// ```
/// let mut bits = [0.0; 3];
/// mean_information::elementwise::information(&[0.25_f64, 0.5, 1.0], &mut bits);
/// assert_eq!(bits, [0.18872187554086714, 0.0, 1.0]);
/// ```
pub fn information<T: Real>(occupancies: &[T], results: &mut [T]) {
    each!(occupancies, results, informations, information);
}

/// Computes the entropy of each cell of log-odds `l` (nats), in bits (Eq. 1).
///
/// Correctly rounded, under the condition on ties stated in [`rounding`](crate::book::rounding): bit for bit
/// [`cell::entropy_from_log_odds`] of each.
///
/// Special cases: 1 at `l = 0`, 0 at `l = ±inf`, NaN at NaN.
///
/// # Panics
/// If the slices differ in length.
///
/// ```
/// let mut bits = [0.0; 3];
/// mean_information::elementwise::entropy_from_log_odds(&[2.0_f64, 0.0, f64::INFINITY], &mut bits);
/// assert_eq!(bits, [0.5270653410031616, 1.0, 0.0]);
/// ```
pub fn entropy_from_log_odds<T: Real>(log_odds: &[T], results: &mut [T]) {
    each!(log_odds, results, entropies_from_log_odds, entropy_from_log_odds);
}

/// Computes the information of each cell of log-odds `l` (nats), in bits (Eq. 3).
///
/// Correctly rounded, under the condition on ties stated in [`rounding`](crate::book::rounding): bit for bit
/// [`cell::information_from_log_odds`] of each.
///
/// Special cases: 0 at `l = 0`, 1 at `l = ±inf`, NaN at NaN.
///
/// # Panics
/// If the slices differ in length.
///
/// ```
/// let mut bits = [0.0; 3];
/// mean_information::elementwise::information_from_log_odds(&[2.0_f64, 0.0, -f64::INFINITY], &mut bits);
/// assert_eq!(bits, [0.4729346589968384, 0.0, 1.0]);
/// ```
pub fn information_from_log_odds<T: Real>(log_odds: &[T], results: &mut [T]) {
    each!(log_odds, results, informations_from_log_odds, information_from_log_odds);
}

/// Computes the occupancy `p = 1 / (1 + e^-l)` of each cell of log-odds `l` (nats).
///
/// Correctly rounded (proved, [`rounding`](crate::book::rounding)): bit for bit [`cell::occupancy_from_log_odds`] of
/// each. The first call makes a table of its own (`f64`; `f32` has none), in some two milliseconds (feature `std`).
///
/// Special cases: 1/2 at `l = 0`, 0 and 1 at `l = -inf` and `+inf`, NaN at NaN.
///
/// # Panics
/// If the slices differ in length.
///
/// ```
/// let mut occupancies = [0.0; 3];
/// mean_information::elementwise::occupancy_from_log_odds(&[-2.0_f64, 0.0, f64::INFINITY], &mut occupancies);
/// assert_eq!(occupancies, [0.11920292202211756, 0.5, 1.0]);
/// ```
pub fn occupancy_from_log_odds<T: Real>(log_odds: &[T], results: &mut [T]) {
    each!(log_odds, results, occupancies_from_log_odds, occupancy_from_log_odds);
}

/// Computes the log-odds `l = ln(p / (1 - p))` of each occupancy, in nats; one by one, without vector kernels.
///
/// Correctly rounded (proved, [`rounding`](crate::book::rounding)): bit for bit [`cell::log_odds_from_occupancy`] of
/// each.
///
/// Special cases: 0 at `p = 1/2`, `-inf` and `+inf` at 0 and 1, NaN outside `[0, 1]` and at NaN.
///
/// # Panics
/// If the slices differ in length.
///
/// ```
/// let mut log_odds = [0.0; 3];
/// mean_information::elementwise::log_odds_from_occupancy(&[0.25_f64, 0.5, 1.0], &mut log_odds);
/// assert_eq!(log_odds, [-1.0986122886681098, 0.0, f64::INFINITY]); // -ln 3
/// ```
pub fn log_odds_from_occupancy<T: Real>(occupancies: &[T], results: &mut [T]) {
    assert_places(occupancies, results);
    one_by_one(occupancies, results, cell::log_odds_from_occupancy);
}
