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
        of: impl Fn([u8; N]) -> S,
    ) -> Result<Vec<S>, Error> {
        let mut values = Vec::new();
        self.pieces(count, |piece: &[[u8; N]]| {
            reserve(&mut values, piece.len(), count)?;
            values.extend(piece.iter().map(|&bytes| of(bytes)));
            Ok(())
        })?;
        Ok(values)
    }

    /// Gives the next `count` values of `N` bytes, the low one first, a piece at a time.
    pub(super) fn pieces<const N: usize>(
        &mut self,
        count: usize,
        mut each: impl FnMut(&[[u8; N]]) -> Result<(), Error>,
    ) -> Result<(), Error> {
        let big_endian = self.header.big_endian;
        let mut swapped: Vec<[u8; N]> = Vec::new();
        read_pieces(&mut self.input, count, N, |piece| {
            let piece = piece.as_chunks().0;
            if !big_endian {
                return each(piece);
            }
            swapped.clear();
            swapped.extend_from_slice(piece);
            for bytes in &mut swapped {
                bytes.reverse();
            }
            each(&swapped)
        })
    }
}
