//! Integers of any size. [`limbs`] has the operations on slices, [`inline_limbs`] the storage of few limbs without the
//! heap; on these stand [`natural_number`], exact, and [`ball`], fixed point with a counted error.

pub(crate) mod ball;
mod inline_limbs;
pub(crate) mod limbs;
pub(crate) mod natural_number;
