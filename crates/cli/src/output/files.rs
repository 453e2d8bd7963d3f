//! Files that appear complete, all of them or none, and never in the place of an input.

use super::standard_output;
use crate::failure::Failure;
use std::fs::{self, OpenOptions};
use std::io::{self, ErrorKind, Write};
use std::path::{Path, PathBuf};
use tempfile::{Builder, TempPath};

/// The files a command will write, and those it has read.
#[derive(Debug, Default)]
pub struct Files {
    folder: Option<PathBuf>,
    outputs: Vec<(PathBuf, Vec<u8>)>,
    inputs: Vec<PathBuf>,
}

impl Files {
    /// Creates an empty set of files.
    pub fn new() -> Self {
        Self::default()
    }

    /// Remembers the files that a map was read from.
    pub fn read(&mut self, inputs: impl IntoIterator<Item = PathBuf>) {
        self.inputs.extend(inputs);
    }

    /// Makes this folder before the files are written, if there is none; if they cannot be, it goes again.
    ///
    /// # Errors
    /// A name that something else has, or in a folder that does not exist.
    pub fn make_folder(&mut self, folder: &Path) -> Result<(), Failure> {
        let problem = |message: &str| Err(Failure::file(folder, message));
        if folder.is_dir() {
            return Ok(());
        }
        if fs::symlink_metadata(folder).is_ok() {
            return problem("is not a folder; give the name of one");
        }
        if !within(folder.parent()).is_dir() {
            return problem("is to lie in a folder that does not exist; make that first");
        }
        self.folder = Some(folder.to_owned());
        Ok(())
    }

    /// Adds a file to write.
    pub fn add(&mut self, path: &Path, contents: Vec<u8>) {
        self.outputs.push((path.to_owned(), contents));
    }

    /// Writes them: each in full under a temporary name beside its own, then renames them all.
    ///
    /// # Errors
    /// A file that is an input, is named twice, is a directory, device, stream or a link to nothing, or may not be
    /// written. Then no file has been touched, unless a rename itself failed after another had been done.
    pub fn write(self) -> Result<(), Failure> {
        let Some(folder) = &self.folder else { return self.write_all() };
        fs::create_dir(folder).map_err(|e| Failure::file(folder, format!("cannot be made: {e}")))?;
        self.write_all().inspect_err(|_| {
            // Only if it is empty, as it is unless a rename failed after another.
            let _ = fs::remove_dir(folder);
        })
    }

    /// Refuses files before the work that is to be written to them is done.
    ///
    /// # Errors
    /// Those of [`Files::write`] that do not depend on what is written, also of the files in the folder that is to be made.
    pub fn may_write<'a>(&self, paths: impl IntoIterator<Item = &'a Path>) -> Result<(), Failure> {
        let mut targets = Vec::new();
        for path in paths {
            let is_in_new = self.folder.is_some() && path.parent() == self.folder.as_deref();
            let target = if is_in_new { path.to_owned() } else { self.target(path)? };
            refuse_twice(path, &target, &targets)?;
            let folder = if is_in_new { path.parent().and_then(Path::parent) } else { target.parent() };
            // Permissions alone do not tell: the file system may be one that is not written to.
            Builder::new().tempfile_in(within(folder)).map_err(|error| not_written(path, &error))?;
            targets.push(target);
        }
        Ok(())
    }

    /// The place that `path` means, which is none that was read.
    fn target(&self, path: &Path) -> Result<PathBuf, Failure> {
        let target = target(path)?;
        if self.inputs.iter().filter_map(|input| fs::canonicalize(input).ok()).any(|input| input == target) {
            return Err(Failure::file(path, "is an input of this command; give another name to write to"));
        }
        Ok(target)
    }

    fn write_all(&self) -> Result<(), Failure> {
        let (mut targets, mut staged): (Vec<PathBuf>, Vec<TempPath>) = Default::default();
        for (path, contents) in &self.outputs {
            let target = self.target(path)?;
            refuse_twice(path, &target, &targets)?;
            staged.push(stage(&target, contents).map_err(|error| not_written(path, &error))?);
            targets.push(target);
        }
        for (target, temporary) in targets.iter().zip(staged) {
            temporary.persist(target).map_err(|error| not_written(target, &error.error))?;
        }
        Ok(())
    }
}

/// Creates the failure of a file that the system refuses to write.
fn not_written(path: &Path, error: &io::Error) -> Failure {
    Failure::file(path, format!("cannot be written: {error}"))
}

/// Refuses a file that means the place of another.
fn refuse_twice(path: &Path, target: &PathBuf, others: &[PathBuf]) -> Result<(), Failure> {
    if others.contains(target) {
        return Err(Failure::file(path, "is to be written twice; give two different names"));
    }
    Ok(())
}

/// Returns a folder that has a name: no name is the folder that the process is in.
fn within(folder: Option<&Path>) -> &Path {
    folder.filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."))
}

/// The place that `path` means, links followed; what stands there can be replaced.
fn target(path: &Path) -> Result<PathBuf, Failure> {
    let problem = |message: &str| Failure::file(path, message);
    let failed = |error: io::Error| not_written(path, &error);
    if standard_output::is(path) || is_descriptor(path) {
        return Err(problem("is a stream of this process; give the name of a file to write to"));
    }
    match fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() => {
            Err(problem("is not a regular file; give the name of a file to write to"))
        }
        Ok(metadata) if metadata.permissions().readonly() => {
            Err(problem("is write-protected; give another name, or allow it to be written"))
        }
        Ok(_) => {
            // Replacing a file needs no right to write it, so ask for it.
            OpenOptions::new().write(true).open(path).map_err(failed)?;
            fs::canonicalize(path).map_err(failed)
        }
        Err(error) if error.kind() != ErrorKind::NotFound => Err(failed(error)),
        Err(_) if fs::symlink_metadata(path).is_ok() => {
            Err(problem("is a link to a file that does not exist; give the name of the file itself"))
        }
        Err(_) => {
            // `a/` and `a/.` name a folder, though Rust takes `a` for their file name.
            let whole = path.as_os_str().as_encoded_bytes();
            let name = path.file_name().filter(|name| whole.ends_with(name.as_encoded_bytes()));
            let name = name.ok_or_else(|| problem("is not the name of a file; give one to write to"))?;
            let folder = fs::canonicalize(within(path.parent()))
                .map_err(|error| problem(&format!("its folder cannot be written to: {error}")))?;
            Ok(folder.join(name))
        }
    }
}

/// Returns whether `path` is a link in `/proc` that stands for an open file, or leads there, as `/dev/stdin` and
/// `/dev/fd/3` do: replacing what they mean would take it from the program that has it open.
fn is_descriptor(path: &Path) -> bool {
    let mut path = path.to_owned();
    // A longer chain is refused by the system itself.
    for _ in 0..40 {
        let (Ok(next), Some(folder)) = (fs::read_link(&path), path.parent()) else { return false };
        if fs::canonicalize(folder).is_ok_and(|folder| folder.starts_with("/proc")) {
            return true;
        }
        path = folder.join(next);
    }
    false
}

/// Writes the contents to a temporary file in the target's folder. Dropping it removes it.
fn stage(target: &Path, contents: &[u8]) -> io::Result<TempPath> {
    let existing = fs::metadata(target).ok();
    let mut builder = Builder::new();
    if existing.is_none() {
        ordinary_permissions(&mut builder);
    }
    let mut temporary = builder.tempfile_in(within(target.parent()))?;
    temporary.write_all(contents)?;
    if let Some(existing) = existing {
        temporary.as_file().set_permissions(existing.permissions())?;
    }
    temporary.as_file().sync_all()?;
    Ok(temporary.into_temp_path())
}

/// Sets the permissions of any new file, which umask narrows; a temporary file's own would hide it from other users.
fn ordinary_permissions(builder: &mut Builder<'_, '_>) {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666));
    }
    #[cfg(not(unix))]
    let _ = builder;
}
