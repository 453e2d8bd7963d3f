//! The files that were dropped on the page: a source that reads them where they are.

use mean_information_files::{Error, Opened, Source};
use serde::Deserialize;
use std::io::{self, BufReader, ErrorKind, Read, Seek, SeekFrom};
use std::path::Path;

/// The bytes that are read at a time.
const CHUNK: usize = 1 << 20;

/// A piece of a file: its number, the first byte, the room for the bytes; returns how many there were.
pub(crate) type ReadPiece = fn(u32, u64, &mut [u8]) -> Option<usize>;

/// A file of the page, by its place in the list of all.
#[derive(Clone, Debug, Deserialize)]
pub(crate) struct Listed {
    /// The name, without a folder.
    pub(crate) name: String,
    /// The number of bytes.
    pub(crate) length: u64,
}

/// The files of the page, by their names.
#[derive(Clone, Debug)]
pub(crate) struct Dropped {
    files: Vec<Listed>,
    read: ReadPiece,
}

impl Dropped {
    /// Creates the source of these files, read by `read`.
    pub(crate) fn new(files: Vec<Listed>, read: ReadPiece) -> Self {
        Self { files, read }
    }
}

impl Source for Dropped {
    type Input<'a> = BufReader<Remote>;

    /// A page is handed files without their folders: the last part of a path is looked for.
    fn open(&self, path: &Path) -> Result<Opened<BufReader<Remote>>, Error> {
        let name = path.file_name().map(|name| name.to_string_lossy());
        let found = (0..).zip(&self.files).find(|(_, file)| name.as_deref() == Some(&*file.name));
        let Some((file, &Listed { length, .. })) = found else {
            return Err(io::Error::from(ErrorKind::NotFound).into());
        };
        let remote = Remote { file, length, at: 0, read: self.read };
        Ok(Opened { input: BufReader::with_capacity(CHUNK, remote), length })
    }
}

/// The reader of a file of the page.
#[derive(Debug)]
pub(crate) struct Remote {
    file: u32,
    length: u64,
    at: u64,
    read: ReadPiece,
}

impl Read for Remote {
    fn read(&mut self, into: &mut [u8]) -> io::Result<usize> {
        let left = usize::try_from(self.length.saturating_sub(self.at)).unwrap_or(usize::MAX);
        let most = left.min(into.len());
        if most == 0 {
            return Ok(0);
        }
        let failed = || io::Error::other("the browser cannot read it; was it changed or removed?");
        let read = (self.read)(self.file, self.at, &mut into[..most]).ok_or_else(failed)?;
        self.at += read as u64;
        Ok(read)
    }
}

impl Seek for Remote {
    fn seek(&mut self, to: SeekFrom) -> io::Result<u64> {
        let at = match to {
            SeekFrom::Start(at) => Some(at),
            SeekFrom::End(by) => self.length.checked_add_signed(by),
            SeekFrom::Current(by) => self.at.checked_add_signed(by),
        };
        self.at = at.ok_or_else(|| io::Error::from(ErrorKind::InvalidInput))?;
        Ok(self.at)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information_files::{ErrorKind, Options, read_map_from};

    const YAML: &[u8] = b"image: folder/map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n\
        occupied_thresh: 0.65\nfree_thresh: 0.196\n";
    const PGM: &[u8] = b"P5\n2 2\n255\n\x00\x7f\xff\xcd";

    /// Two bytes at a time.
    fn read(file: u32, at: u64, into: &mut [u8]) -> Option<usize> {
        let bytes = [YAML, PGM].get(file as usize)?.get(at as usize..)?;
        let length = bytes.len().min(into.len()).min(2);
        into[..length].copy_from_slice(&bytes[..length]);
        Some(length)
    }

    fn listed(name: &str, bytes: &[u8]) -> Listed {
        Listed { name: name.to_owned(), length: bytes.len() as u64 }
    }

    #[test]
    fn a_map_is_read_from_the_files_of_a_page() {
        let both = Dropped::new(vec![listed("map.yaml", YAML), listed("map.pgm", PGM)], read);
        let map = read_map_from(&both, Path::new("map.yaml"), &Options::default()).unwrap();
        assert_eq!(map.resolution, Some(0.05));
        let alone = Dropped::new(vec![listed("map.yaml", YAML)], read);
        let refused = read_map_from(&alone, Path::new("map.yaml"), &Options::default()).unwrap_err();
        assert_eq!((refused.kind(), refused.value()), (ErrorKind::NotFound, Some("folder/map.pgm")));
    }

    #[test]
    fn a_file_that_cannot_be_read_is_told() {
        let gone = Dropped::new(vec![listed("map.npy", &[0; 9])], |_, _, _| None);
        let refused = read_map_from(&gone, Path::new("map.npy"), &Options::default()).unwrap_err();
        assert!(refused.to_string().contains("the browser cannot read it"), "{refused}");
    }
}
