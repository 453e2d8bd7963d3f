//! What several test suites share. Not published: the library's own unit tests, which travel in its package, do without.
//!
//! | module | holds | used by |
//! |---|---|---|
//! | [`exact`] | decimals and hexadecimal floats, read exactly | `tests/vectors`, `benches/operations.rs` |
//! | [`digest`] | digests of a million results and of integrals | `tests/same_bits.rs` |
//! | [`battery`] | integrals with their values to 32 digits | `tests/library`, `benches/comparison` |
//! | `formats` | maps made on the spot, and folders for them (feature `formats`) | `crates/files/tests`, `crates/cli/tests` |
//! | [`properties`] | what fuzzing tries to break | `fuzz`, `crates/files/tests` |
//! | [`logs`] | public laser logs | `tests/library` |
//! | [`real_data`] | where real maps and logs are, if they are there | `tests/library`, `crates/files/tests`, `crates/cli/tests` |
//! | [`timing`] | the time of a call on a machine that others use, too | `benches/peers`, `crates/cli/benches` |

pub mod battery;
pub mod digest;
pub mod exact;
#[cfg(feature = "formats")]
pub mod formats;
pub mod logs;
pub mod properties;
pub mod real_data;
pub mod timing;
