//! What containers that are a stream of records share.

use super::delivery::Delivery;
use crate::error::Error;
use std::io::{self, Read};

/// A kind of container: how its records are read.
pub(super) trait Container {
    /// Reads the record that begins here, without going beyond it. Returns whether more may follow.
    fn record(&mut self, input: &mut CountedInput<'_>, delivery: &mut Delivery<'_>) -> Result<bool, Error>;

    /// Tells whether a bag that ends at byte `end` has all its messages.
    fn is_whole(&self, end: u64) -> bool;
}

/// A reader that counts its bytes.
pub(super) struct CountedInput<'a> {
    input: &'a mut dyn Read,
    /// The byte that comes next.
    pub(super) at: u64,
    length: u64,
    /// Whether a record claimed to go on beyond the file.
    pub(super) is_cut: bool,
}

impl<'a> CountedInput<'a> {
    /// Begins to count the bytes of an input of so many.
    pub(super) fn new(input: &'a mut dyn Read, length: u64) -> Self {
        Self { input, at: 0, length, is_cut: false }
    }

    /// Notes that a record claims to go on for `more` bytes: if these are beyond the file, the file was cut within it.
    pub(super) fn expect(&mut self, more: u64) {
        self.is_cut |= self.at.checked_add(more).is_none_or(|end| end > self.length);
    }
}

impl Read for CountedInput<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let read = self.input.read(buffer)?;
        self.at += read as u64;
        Ok(read)
    }
}
