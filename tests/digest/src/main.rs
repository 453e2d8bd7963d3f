//! Prints the digests of a million results and of integrals, for `tests/same_bits.rs`.
//!
//!     cargo run --release --package digest

#[allow(dead_code, reason = "the expected digest is for the tests")]
#[path = "../../library/digest.rs"]
mod digest;

fn main() {
    for digest in digest::digests() {
        println!("{digest:016x}");
    }
}
