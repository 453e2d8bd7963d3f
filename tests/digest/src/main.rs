//! Prints the digest of a million results, for `tests/same_bits.rs`.
//!
//!     cargo run --release --package digest

#[allow(dead_code, reason = "the expected digest is for the tests")]
#[path = "../../library/digest.rs"]
mod digest;

fn main() {
    println!("{:016x}", digest::digest());
}
