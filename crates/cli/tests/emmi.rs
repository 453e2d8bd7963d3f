//! Tests of `meaninfo emmi`.

mod common;
mod particles;
