//! Functions of a cell as NumPy's ufuncs: `loops` speaks C with NumPy, this file names the functions.

mod loops;

use mean_information::{Real, elementwise};
use pyo3::prelude::*;
use std::ffi::CStr;

/// A function of one number that becomes a ufunc.
trait Elementwise {
    /// The name.
    const NAME: &'static CStr;
    /// The docstring, after the signature that NumPy writes.
    const DOC: &'static CStr;

    /// Computes the function of each number of `from`; both are of the same length.
    fn apply<T: Real>(from: &[T], to: &mut [T]);
}

/// Makes a type of a function of the library; the docstrings are files, which doctest reads as part of the module.
macro_rules! elementwise {
    ($($type:ident $name:literal $doc:literal $function:path;)*) => {
        $(
            struct $type;

            impl Elementwise for $type {
                const NAME: &'static CStr = $name;
                const DOC: &'static CStr = match CStr::from_bytes_with_nul(
                    concat!(include_str!($doc), "\0").as_bytes(),
                ) {
                    Ok(doc) => doc,
                    Err(_) => panic!("a docstring holds no NUL"),
                };

                fn apply<T: Real>(from: &[T], to: &mut [T]) {
                    $function(from, to);
                }
            }
        )*

        /// Adds the ufuncs to the module.
        pub(crate) fn add_to(module: &Bound<'_, PyModule>) -> PyResult<()> {
            $(loops::add_to::<$type>(module)?;)*
            Ok(())
        }
    };
}

elementwise! {
    Entropy c"entropy" "docs/entropy.txt" elementwise::entropy;
    Information c"information" "docs/information.txt" elementwise::information;
    EntropyFromLogOdds c"entropy_from_log_odds" "docs/entropy_from_log_odds.txt" elementwise::entropy_from_log_odds;
    InformationFromLogOdds c"information_from_log_odds" "docs/information_from_log_odds.txt"
        elementwise::information_from_log_odds;
    OccupancyFromLogOdds c"occupancy_from_log_odds" "docs/occupancy_from_log_odds.txt"
        elementwise::occupancy_from_log_odds;
    LogOddsFromOccupancy c"log_odds_from_occupancy" "docs/log_odds_from_occupancy.txt"
        elementwise::log_odds_from_occupancy;
}
