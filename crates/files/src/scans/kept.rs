//! The numbers of a log that are kept, limited: what is compressed may hold a thousand times as many as it has bytes.

use crate::error::{Error, ErrorKind};
use crate::options::MAX_CELLS;

/// The number of numbers so far, of 8 bytes each.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Kept(u64);

impl Kept {
    /// Creates a count that allows so many more.
    #[cfg(test)]
    pub(crate) fn with_room(numbers: u64) -> Self {
        Self(MAX_CELLS - numbers)
    }

    /// Counts more.
    ///
    /// # Errors
    /// An [`Error`] if they are more than [`MAX_CELLS`]: 2 GiB.
    pub(crate) fn add(&mut self, numbers: usize) -> Result<(), Error> {
        self.0 = self.0.saturating_add(numbers as u64);
        if self.0 <= MAX_CELLS {
            return Ok(());
        }
        let refused = Error::new(ErrorKind::OutOfMemory, "holds more than the limit of ranges and poses");
        Err(refused.with_value(self.0.to_string()).allowing(", allowed are ", MAX_CELLS.to_string()))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn as_many_as_are_allowed_and_no_more() {
        let mut kept = Kept::default();
        kept.add(MAX_CELLS as usize - 7).unwrap();
        kept.add(7).unwrap();
        let refused = kept.add(3).unwrap_err();
        let words = "holds more than the limit of ranges and poses, allowed are 268435456";
        assert_eq!((refused.kind(), refused.to_string().as_str()), (ErrorKind::OutOfMemory, words));
        assert!(kept.add(usize::MAX).is_err());
    }
}
