//! A disk whose files Ctrl-C closes.

use crate::errors::of_file;
use mean_information_files::{Disk, Error, Opened, Source};
use pyo3::prelude::*;
use std::cell::RefCell;
use std::fs::File;
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::Path;

/// The bytes between two looks at signals.
const BYTES: usize = 1 << 24;

/// A disk, and what a handler of signals raised while its files were read.
#[derive(Default)]
pub(crate) struct Interruptible {
    raised: RefCell<Option<PyErr>>,
}

/// A file of it.
pub(crate) struct Input<'a> {
    file: BufReader<File>,
    disk: &'a Interruptible,
    unseen: usize,
}

/// Reads without the interpreter's lock.
///
/// # Errors
/// What the reader refuses, or what a handler of signals raised.
pub(crate) fn run<T: Send>(
    py: Python<'_>,
    read: impl FnOnce(&Interruptible) -> Result<T, Error> + Send,
) -> PyResult<T> {
    py.detach(|| {
        let disk = Interruptible::default();
        read(&disk).map_err(|error| disk.raised.take().unwrap_or_else(|| of_file(error)))
    })
}

impl Source for Interruptible {
    type Input<'a> = Input<'a>;

    fn open(&self, path: &Path) -> Result<Opened<Input<'_>>, Error> {
        let Opened { input, length } = Disk.open(path)?;
        Ok(Opened { input: Input { file: input, disk: self, unseen: 0 }, length })
    }
}

impl Input<'_> {
    /// Counts bytes, and looks at signals now and then.
    fn count(&mut self, bytes: usize) -> io::Result<()> {
        self.unseen += bytes;
        if self.unseen < BYTES {
            return Ok(());
        }
        self.unseen = 0;
        Python::attach(|py| py.check_signals()).map_err(|raised| {
            self.disk.raised.replace(Some(raised));
            // Not `Interrupted`, after which readers go on.
            io::Error::other("a signal came")
        })
    }
}

impl Read for Input<'_> {
    fn read(&mut self, buffer: &mut [u8]) -> io::Result<usize> {
        let bytes = self.file.read(buffer)?;
        self.count(bytes)?;
        Ok(bytes)
    }
}

impl BufRead for Input<'_> {
    fn fill_buf(&mut self) -> io::Result<&[u8]> {
        self.count(0)?;
        self.file.fill_buf()
    }

    fn consume(&mut self, bytes: usize) {
        self.file.consume(bytes);
        // Seen at the next filling.
        self.unseen += bytes;
    }
}

impl Seek for Input<'_> {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        self.file.seek(to)
    }
}
