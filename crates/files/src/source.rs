//! Where files come from: a disk, or memory where there is none, as on a page in a browser.

use crate::error::{Error, ErrorKind};
use crate::size::CHUNK;
use std::collections::BTreeMap;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Cursor, Seek};
use std::path::{Path, PathBuf};

/// A place that files are opened from by their names: the yaml file of a ROS map names another one.
pub trait Source {
    /// The reader of a file.
    type Input<'a>: BufRead + Seek
    where
        Self: 'a;

    /// Opens a file.
    ///
    /// # Errors
    /// An [`Error`] if there is none of that name, or it cannot be read; an [`io::Error`] becomes one by `?`.
    fn open(&self, path: &Path) -> Result<Opened<Self::Input<'_>>, Error>;
}

/// The beginning of what stands for a file that Git keeps elsewhere.
const LFS_POINTER: &[u8] = b"version https://git-lfs";

/// Opens a file, unless it only stands for one.
///
/// # Errors
/// As [`Source::open`]; and [`ErrorKind::Unsupported`] for a Git LFS pointer.
pub(crate) fn open<'a, S: Source>(source: &'a S, path: &Path) -> Result<Opened<S::Input<'a>>, Error> {
    let mut opened = source.open(path)?;
    if opened.input.fill_buf()?.starts_with(LFS_POINTER) {
        let refused = Error::new(ErrorKind::Unsupported, "is a Git LFS pointer, not the file it stands for");
        return Err(refused.followed_by("; fetch it with `git lfs pull`"));
    }
    Ok(opened)
}

/// A file that was opened.
#[derive(Debug)]
pub struct Opened<I> {
    /// The bytes, from the beginning.
    pub input: I,
    /// The number of bytes.
    pub length: u64,
}

/// The file system. Only regular files are opened: a pipe could hang, a directory reads as nonsense.
#[derive(Clone, Copy, Debug, Default)]
pub struct Disk;

impl Source for Disk {
    type Input<'a> = BufReader<File>;

    fn open(&self, path: &Path) -> Result<Opened<BufReader<File>>, Error> {
        let kind = fs::metadata(path)?;
        if kind.is_dir() {
            let refused = Error::new(ErrorKind::NotAFile, "is a directory");
            return Err(refused.allowing("; allowed are ", "files"));
        }
        if !kind.is_file() {
            let refused = Error::new(ErrorKind::NotAFile, "is not a regular file");
            return Err(refused.allowing("; allowed are ", "files on disk"));
        }
        let file = File::open(path)?;
        let length = file.metadata()?.len();
        Ok(Opened { input: BufReader::with_capacity(CHUNK, file), length })
    }
}

/// Files in memory, by their names.
///
/// A name is looked for as it is; then, as a page is handed files without their folders, by its last part alone.
///
/// ```
/// use mean_information_files::{ErrorKind, Memory, Source};
/// use std::path::Path;
///
/// let mut files = Memory::new();
/// files.add("room.pgm", b"P5 1 1 255 x".to_vec());
/// assert_eq!(files.open(Path::new("/home/robot/room.pgm"))?.length, 12);
/// assert_eq!(files.open(Path::new("hall.pgm")).unwrap_err().kind(), ErrorKind::NotFound);
/// # Ok::<(), mean_information_files::Error>(())
/// ```
#[derive(Clone, Debug, Default)]
pub struct Memory(BTreeMap<PathBuf, Vec<u8>>);

impl Memory {
    /// Creates a memory without files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a file, in the place of one of the same name.
    pub fn add(&mut self, name: impl Into<PathBuf>, bytes: impl Into<Vec<u8>>) {
        self.0.insert(name.into(), bytes.into());
    }
}

impl Source for Memory {
    type Input<'a> = Cursor<&'a [u8]>;

    fn open(&self, path: &Path) -> Result<Opened<Cursor<&[u8]>>, Error> {
        let by_last_part = || self.0.get(Path::new(path.file_name()?));
        let Some(bytes) = self.0.get(path).or_else(by_last_part) else {
            return Err(io::Error::from(io::ErrorKind::NotFound).into());
        };
        Ok(Opened { input: Cursor::new(bytes), length: bytes.len() as u64 })
    }
}
