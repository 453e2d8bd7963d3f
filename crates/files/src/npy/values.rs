//! The values of an array, in the order of the file.

use super::header::Header;
use crate::error::Error;
use crate::size::{read_pieces, reserve};
use std::io::Read;

/// The values of an array that are yet to be read.
pub(super) struct Values<'a, R> {
    pub(super) input: R,
    pub(super) header: &'a Header,
}

impl<R: Read> Values<'_, R> {
    /// Reads the next `count` values of `N` bytes.
    pub(super) fn take<S, const N: usize>(
        &mut self,
        count: usize,
        of: fn([u8; N]) -> S,
    ) -> Result<Vec<S>, Error> {
        let mut values = Vec::new();
        let big_endian = self.header.big_endian;
        read_pieces(&mut self.input, count, N, |piece| {
            let elements = piece.as_chunks().0.iter();
            reserve(&mut values, elements.len(), count)?;
            values.extend(elements.map(|&bytes| {
                let mut bytes: [u8; N] = bytes;
                if big_endian {
                    bytes.reverse();
                }
                of(bytes)
            }));
            Ok(())
        })?;
        Ok(values)
    }
}
