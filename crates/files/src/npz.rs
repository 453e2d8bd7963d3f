//! NumPy's `.npz`: a zip archive of `.npy` files, by the crate `zip`, which also knows archives above 4 GiB.

use crate::error::{Error, ErrorKind};
use std::io::{Read, Seek};
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
    match text.rsplit_once(':') {
        _ if is_archive(text) => Some((path, None)),
        Some((file, key)) if is_archive(file) => Some((Path::new(file), Some(key))),
        _ => None,
    }
}

/// Opens an array of an archive: that of `key`, or the only one.
pub(crate) fn open<'a, R: Read + Seek>(
    archive: &'a mut ZipArchive<R>,
    key: Option<&str>,
) -> Result<ZipFile<'a, R>, Error> {
    let names: Vec<String> =
        archive.file_names().map(|name| name.strip_suffix(MEMBER).unwrap_or(name).to_owned()).collect();
    let name = match (key, &names[..]) {
        (Some(key), _) if names.iter().any(|name| name == key) => key,
        (None, [name]) => name,
        (Some(key), _) => {
            let refused = Error::new(ErrorKind::NotFound, format!("has no array {key:?}")).with_value(key);
            return Err(refused.allowing("; it has ", listed(&names)));
        }
        (None, _) => {
            let message = format!("holds {} arrays; name one, as FILE.npz:KEY", names.len());
            return Err(Error::new(ErrorKind::Unsupported, message).allowing("; it has ", listed(&names)));
        }
    };
    let whole = format!("{name}{MEMBER}");
    let whole = if archive.index_for_name(&whole).is_some() { whole } else { name.to_owned() };
    archive.by_name(&whole).map_err(refused)
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

/// Names what the archive's reader refuses.
fn refused(error: ZipError) -> Error {
    match error {
        ZipError::Io(error) => Error::from(error),
        ZipError::UnsupportedArchive(what) => {
            Error::new(ErrorKind::Unsupported, format!("is an .npz file that is not read: {what}"))
        }
        error => Error::new(ErrorKind::Format, format!("is no .npz file: {error}")).caused_by(error),
    }
}
