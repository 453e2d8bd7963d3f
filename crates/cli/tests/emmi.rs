//! Tests of `meaninfo emmi`.

mod common;
mod filter;
mod particles;
