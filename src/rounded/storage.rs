//! Where a number of any size keeps its limbs: a few in place, as almost all have, more on the heap.

use alloc::{vec, vec::Vec};
use core::ops::{Deref, DerefMut};

/// Limbs in place: what a mean of occupancies and its quotient take.
const FEW: usize = 6;

/// Limbs, lowest first; a slice of them.
#[derive(Clone, Debug)]
pub(super) enum Limbs {
    Few { limbs: [u64; FEW], length: usize },
    Many(Vec<u64>),
}

impl Limbs {
    /// So many limbs of 0.
    #[inline]
    pub(super) fn zeros(length: usize) -> Self {
        if length <= FEW { Self::Few { limbs: [0; FEW], length } } else { Self::Many(vec![0; length]) }
    }

    /// As many limbs as this, cut or with zeros above.
    #[inline]
    pub(super) fn resize(&mut self, wanted: usize) {
        match self {
            Self::Few { limbs, length } if wanted <= FEW => {
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
