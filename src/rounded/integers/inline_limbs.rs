//! The storage of a number of any size: a few limbs in place, as almost all numbers have, more on the heap.

use alloc::{vec, vec::Vec};
use core::ops::{Deref, DerefMut};

/// The number of limbs in place: enough for a mean of occupancies and its quotient.
const FEW: usize = 6;

/// The limbs of a number, lowest first; dereferences to a slice of them.
#[derive(Clone, Debug)]
pub(super) enum Limbs {
    /// The first `length` limbs of an array; those beyond are not part of the number.
    Few { limbs: [u64; FEW], length: usize },
    /// Limbs on the heap.
    Many(Vec<u64>),
}

impl Limbs {
    /// Creates `length` limbs of 0.
    #[inline]
    pub(crate) fn zeros(length: usize) -> Self {
        if length <= FEW { Self::Few { limbs: [0; FEW], length } } else { Self::Many(vec![0; length]) }
    }

    /// Changes the number of limbs: cuts the upper ones, or adds zeros above.
    #[inline]
    pub(crate) fn resize(&mut self, wanted: usize) {
        match self {
            Self::Few { limbs, length } if wanted <= FEW => {
                // Limbs beyond the length may be left from before.
                limbs[wanted.min(*length)..].fill(0);
                *length = wanted;
            }
            Self::Few { limbs, length } => {
                let mut many = Vec::with_capacity(wanted);
                many.extend_from_slice(&limbs[..*length]);
                many.resize(wanted, 0);
                *self = Self::Many(many);
            }
            Self::Many(limbs) => limbs.resize(wanted, 0),
        }
    }
}

impl Deref for Limbs {
    type Target = [u64];

    #[inline]
    fn deref(&self) -> &[u64] {
        match self {
            Self::Few { limbs, length } => &limbs[..*length],
            Self::Many(limbs) => limbs,
        }
    }
}

impl DerefMut for Limbs {
    #[inline]
    fn deref_mut(&mut self) -> &mut [u64] {
        match self {
            Self::Few { limbs, length } => &mut limbs[..*length],
            Self::Many(limbs) => limbs,
        }
    }
}

impl From<Vec<u64>> for Limbs {
    fn from(limbs: Vec<u64>) -> Self {
        Self::Many(limbs)
    }
}
