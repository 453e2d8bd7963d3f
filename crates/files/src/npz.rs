//! NumPy's `.npz`: a zip archive of `.npy` files, by the crate `zip`, which also knows archives above 4 GiB.

use crate::error::{Error, ErrorKind, Place};
use std::io::{self, Read, Seek};
use std::path::Path;
use zip::ZipArchive;
use zip::read::ZipFile;
use zip::result::ZipError;

/// The ending of an array's name within an archive, which NumPy leaves out.
const MEMBER: &str = ".npy";
/// The most names that a message lists.
const MOST_NAMES: usize = 12;

/// Splits `FILE.npz` or `FILE.npz:KEY` into file and key; `None` for other names.
pub(crate) fn split(path: &Path) -> Option<(&Path, Option<&str>)> {
    let text = path.to_str()?;
    let is_archive = |file: &str| file.to_ascii_lowercase().ends_with(".npz");
    if is_archive(text) {
        return Some((path, None));
    }
    // A key may have colons, too.
    let mut colons = text.match_indices(':').map(|(at, _)| (&text[..at], &text[at + 1..]));
    colons.find(|(file, _)| is_archive(file)).map(|(file, key)| (Path::new(file), Some(key)))
}

/// Opens an array of an archive: that of `key`, or the only one.
pub(crate) fn open<'a, R: Read + Seek>(
    archive: &'a mut ZipArchive<R>,
    key: Option<&str>,
) -> Result<ZipFile<'a, R>, Error> {
    let names: Vec<String> =
        archive.file_names().filter_map(|name| name.strip_suffix(MEMBER)).map(str::to_owned).collect();
    // NumPy takes a key with the ending, too.
    let key = key.map(|key| {
        key.strip_suffix(MEMBER).filter(|key| names.iter().any(|name| name == key)).unwrap_or(key)
    });
    let name = match (key, &names[..]) {
        (Some(key), _) if names.iter().any(|name| name == key) => key,
        (None, [name]) => name,
        (None, []) => {
            let refused = Error::new(ErrorKind::Unsupported, "holds no array");
            return Err(refused.allowing("; needed is ", "one that np.savez wrote"));
        }
        (Some(key), _) => {
            let refused = Error::new(ErrorKind::Choice, format!("has no array {key:?}"));
            let refused = refused.at(Place::Option("file")).with_value(key);
            return Err(refused.allowing("; it has ", listed(&names)));
        }
        (None, _) => {
            let message = format!("holds {} arrays; name one, as FILE.npz:KEY", names.len());
            return Err(Error::new(ErrorKind::Unsupported, message).allowing("; it has ", listed(&names)));
        }
    };
    archive.by_name(&format!("{name}{MEMBER}")).map_err(refused)
}

/// Reads the table of an archive.
pub(crate) fn archive<R: Read + Seek>(input: R) -> Result<ZipArchive<R>, Error> {
    ZipArchive::new(input).map_err(refused)
}

/// Returns the names of arrays for a message.
fn listed(names: &[String]) -> String {
    let more = if names.len() > MOST_NAMES { ", ..." } else { "" };
    match names {
        [] => "none".to_owned(),
        names => names[..names.len().min(MOST_NAMES)].join(", ") + more,
    }
}

/// Reads to the end of an array of which all cells are read: there its checksum is compared.
///
/// # Errors
/// An [`Error`] of kind [`ErrorKind::Format`] if it is another.
pub(crate) fn check(file: &mut impl Read) -> Result<(), Error> {
    let end = io::copy(&mut file.take(1), &mut io::sink());
    end.map(|_| ()).map_err(|error| {
        let message = "is damaged: the checksum of the array is another; copy or save it again";
        Error::new(ErrorKind::Format, message).caused_by(error)
    })
}

/// Names what the archive's reader refuses.
fn refused(error: ZipError) -> Error {
    match error {
        ZipError::Io(error) => Error::from(error),
        ZipError::UnsupportedArchive(what) => {
            Error::new(ErrorKind::Unsupported, format!("is an .npz file that is not read: {what}"))
        }
        error @ ZipError::CompressionMethodNotSupported(_) => {
            Error::new(ErrorKind::Unsupported, format!("is an .npz file that is not read: {error}"))
                .followed_by("; np.savez_compressed writes one that is")
                .caused_by(error)
        }
        error => {
            Error::new(ErrorKind::Format, format!("is no .npz file, or cut short: {error}")).caused_by(error)
        }
    }
}
