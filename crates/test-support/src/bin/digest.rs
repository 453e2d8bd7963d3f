//! Prints the digests of a million results, of integrals and of scans, for `tests/same_bits.rs`.
//!
//!     cargo run --release --package mean-information-test-support --bin digest

use mean_information_test_support::digest::digests;

fn main() {
    for digest in digests() {
        println!("{digest:016x}");
    }
}
