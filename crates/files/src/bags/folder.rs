//! The files of a bag: one, or those that rosbag2 puts into a folder.

use crate::error::{Error, ErrorKind, Place};
use saphyr_parser::{Event, Parser};
use std::borrow::Cow;
use std::collections::BTreeSet;
use std::ffi::OsStr;
use std::fs::{self, File};
use std::io::Read;
use std::path::{Path, PathBuf};

/// The file of a folder that says which others belong to the bag.
const METADATA: &str = "metadata.yaml";
/// Its key that lists them.
const LISTED: &str = "relative_file_paths";
/// The most bytes of it; real ones have thousands.
const MOST: u64 = 1 << 24;
/// The most names in a message.
const NAMED: usize = 4;

/// The endings of bags, each kind with those that it may have.
const ENDINGS: [&[&str]; 3] = [&[".mcap"], &[".db3"], &[".bag", ".bag.active"]];
const ROS1: usize = 2;
/// The ending of a file that rosbag2 compressed as a whole, behind the other.
const PACKED: &str = ".zstd";

/// Tells whether a path is read as that of a bag: by the ending of its name, `.mcap`, `.bag`, `.bag.active` or `.db3`, or as
/// a folder, which is to hold such files.
pub fn is_bag(path: &Path) -> bool {
    path.is_dir() || kind(path).is_some()
}

/// Returns the files that are read of the bag at `path`: itself, or of a folder the bags, and what says which they are.
///
/// # Errors
/// An [`Error`] if the folder holds none, or does not say which bags belong together.
pub fn bag_files(path: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut files = parts(path)?;
    files.extend(Some(path.join(METADATA)).filter(|file| file.is_file()));
    Ok(files)
}

/// Returns the files of a bag that have messages, in their order: that of `metadata.yaml`, or else of their numbers.
pub(super) fn parts(path: &Path) -> Result<Vec<PathBuf>, Error> {
    if !path.is_dir() {
        return Ok(vec![path.to_owned()]);
    }
    let metadata = path.join(METADATA);
    let listed =
        if metadata.is_file() { listed(&metadata).map_err(|error| error.in_file(&metadata))? } else { None };
    let read = || match listed {
        Some(names) => names.iter().map(|name| named(path, name)).collect(),
        None => numbered(found(path)?),
    };
    read().map_err(|error| error.in_file(path))
}

/// Tells whether a file was compressed as a whole.
pub(super) fn is_packed(path: &Path) -> bool {
    name(path).ends_with(PACKED)
}

fn name(path: &Path) -> String {
    path.file_name().unwrap_or_default().to_string_lossy().to_ascii_lowercase()
}

/// Returns the number of the kind of a bag by its name.
fn kind(path: &Path) -> Option<usize> {
    let name = name(path);
    let name = name.strip_suffix(PACKED).unwrap_or(&name);
    ENDINGS.iter().position(|endings| endings.iter().any(|&ending| name.ends_with(ending)))
}

/// Returns the file with the ending of a compressed one taken away.
fn unpacked(path: &Path) -> PathBuf {
    if is_packed(path) { path.with_extension("") } else { path.to_owned() }
}

/// Returns the files of a folder that are bags by their names; of one that is there compressed, too, the other.
fn found(folder: &Path) -> Result<Vec<PathBuf>, Error> {
    let mut files = BTreeSet::new();
    for entry in fs::read_dir(folder)? {
        let path = entry?.path();
        if kind(&path).is_some() {
            files.insert(path);
        }
    }
    let is_needed = |path: &&PathBuf| !is_packed(path) || !files.contains(&unpacked(path));
    Ok(files.iter().filter(is_needed).cloned().collect())
}

/// Puts the files of a folder that lists none in the order of their numbers: `run_2` before `run_10`. Files of several
/// kinds or names are several bags, and so are several of ROS 1, whose parts no name tells from other runs.
fn numbered(mut files: Vec<PathBuf>) -> Result<Vec<PathBuf>, Error> {
    let stem = |path: &PathBuf| {
        let name = name(&unpacked(path));
        let stem = name.rsplit_once('.').map_or("", |(stem, _)| stem);
        let digits = stem.trim_end_matches(|c: char| c.is_ascii_digit());
        digits.strip_suffix('_').unwrap_or(stem).to_owned()
    };
    let Some(first) = files.first() else {
        let refused =
            Error::new(ErrorKind::NotAFile, "is a folder that holds no bag, no .mcap, .db3 or .bag file");
        return Err(refused.allowing("; allowed are ", "files, and folders of bags"));
    };
    let is_one = |path: &PathBuf| kind(path) == kind(first) && stem(path) == stem(first);
    if files.len() > 1 && (kind(first) == Some(ROS1) || !files.iter().all(is_one)) {
        let names = files.iter().filter_map(|path| path.file_name()).map(OsStr::to_string_lossy);
        let mut names: Vec<_> = names.take(NAMED).map(Cow::into_owned).collect();
        if files.len() > NAMED {
            names.push("...".to_owned());
        }
        let words =
            format!("is a folder of several bags, {}, without a {METADATA} that lists", names.join(", "));
        let refused =
            Error::new(ErrorKind::Choice, words + " which belong together").at(Place::Option("file"));
        return Err(refused.with_value(files.len().to_string()).allowing("; allowed is ", "the name of one"));
    }
    files.sort_by_key(|path| (path.as_os_str().len(), path.clone()));
    Ok(files)
}

/// Returns the file of a folder that its list calls so. Before version 4 a list has the name of the folder, too; and a file
/// that was compressed may be there unpacked.
fn named(folder: &Path, listed: &str) -> Result<PathBuf, Error> {
    let within = folder.join(listed);
    let last = folder.join(Path::new(listed).file_name().unwrap_or_default());
    let tried = [unpacked(&within), unpacked(&last), within, last];
    let there = tried.into_iter().find(|path| path.is_file());
    there.ok_or_else(|| {
        let words = format!("lists {listed} in its {METADATA}, which is not there");
        Error::new(ErrorKind::NotFound, words).with_value(listed).at(Place::Key(LISTED))
    })
}

/// Returns the files that are listed; `None` if no key lists any. By events: aliases stand for nothing.
fn listed(metadata: &Path) -> Result<Option<Vec<String>>, Error> {
    let mut bytes = Vec::new();
    File::open(metadata)?.take(MOST + 1).read_to_end(&mut bytes)?;
    if bytes.len() as u64 > MOST {
        return Err(Error::out_of_range("its length", bytes.len(), format!("at most {MOST} bytes")));
    }
    let text = super::fields::utf8(&bytes)?;
    let mut parser = Parser::new_from_str(text);
    let (mut is_key, mut files) = (false, None);
    loop {
        let (event, _) = match parser.next_event() {
            None => return Ok(None),
            Some(Ok(next)) => next,
            Some(Err(error)) => {
                let line = error.marker().line();
                let words = format!("is malformed YAML in line {line}: {}; remove it", error.info());
                let refused = Error::new(ErrorKind::Format, words + " to have the files by their names");
                return Err(refused.at(Place::Line(line as u64)).caused_by(error));
            }
        };
        match (event, &mut files) {
            (Event::SequenceEnd, Some(_)) => return Ok(files.filter(|files: &Vec<String>| !files.is_empty())),
            (Event::Scalar(name, ..), Some(files)) => files.push(name.into_owned()),
            (Event::SequenceStart(..), None) if is_key => files = Some(Vec::new()),
            (Event::Scalar(key, ..), None) => is_key = key == LISTED,
            _ => is_key = false,
        }
    }
}
