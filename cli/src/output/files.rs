//! Files that appear complete, all of them or none, and never in the place of an input.

use crate::failure::Failure;
use crate::maps::Problem;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::{Builder, NamedTempFile, TempPath};

/// The files a command will write, and those it has read.
#[derive(Debug, Default)]
pub struct Files {
    outputs: Vec<(PathBuf, Vec<u8>)>,
    inputs: Vec<PathBuf>,
}

impl Files {
    /// None yet.
    pub fn new() -> Self {
        Self::default()
    }

    /// Remembers the files that a map was read from.
    pub fn read(&mut self, inputs: impl IntoIterator<Item = PathBuf>) {
        self.inputs.extend(inputs);
    }

    /// Adds a file to write.
    pub fn add(&mut self, path: &Path, contents: Vec<u8>) {
        self.outputs.push((path.to_owned(), contents));
    }

    /// Writes them: each in full under a temporary name beside its own, then renames them all.
    ///
    /// # Errors
    /// A file that is an input, is named twice, is a directory or device, or cannot be written. Then no file has been
    /// touched, unless a rename itself failed after another had been done.
    pub fn write(self) -> Result<(), Failure> {
        let inputs: Vec<_> = self.inputs.iter().filter_map(|path| fs::canonicalize(path).ok()).collect();
        let mut staged: Vec<(PathBuf, TempPath)> = Vec::new();
        for (path, contents) in &self.outputs {
            let problem = |message: String| Problem::new(path, message);
            let target = target(path)?;
            if inputs.contains(&target) {
                return Err(
                    problem("is an input of this command; give another name to write to".into()).into()
                );
            }
            if staged.iter().any(|(other, _)| *other == target) {
                return Err(problem("is to be written twice; give two different names".into()).into());
            }
            let temporary =
                stage(&target, contents).map_err(|e| problem(format!("cannot be written: {e}")))?;
            staged.push((target, temporary));
        }
        for (target, temporary) in staged {
            temporary
                .persist(&target)
                .map_err(|e| Problem::new(&target, format!("cannot be written: {}", e.error)))?;
        }
        Ok(())
    }
}

/// The place that `path` means, links followed.
fn target(path: &Path) -> Result<PathBuf, Problem> {
    let problem = |message: String| Problem::new(path, message);
    match fs::metadata(path) {
        Ok(metadata) if !metadata.is_file() => {
            return Err(problem("is not a regular file; give the name of a file to write to".into()));
        }
        Ok(_) => return fs::canonicalize(path).map_err(|e| problem(format!("cannot be written: {e}"))),
        Err(_) => {}
    }
    let name =
        path.file_name().ok_or_else(|| problem("is not the name of a file; give one to write to".into()))?;
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let folder =
        fs::canonicalize(folder).map_err(|e| problem(format!("its folder cannot be written to: {e}")))?;
    Ok(folder.join(name))
}

/// Writes the contents to a temporary file in the target's folder. Dropping it removes it.
fn stage(target: &Path, contents: &[u8]) -> std::io::Result<TempPath> {
    let folder = target.parent().unwrap_or(Path::new("."));
    let mut temporary: NamedTempFile = ordinary_permissions(&mut Builder::new()).tempfile_in(folder)?;
    temporary.write_all(contents)?;
    temporary.as_file().sync_all()?;
    Ok(temporary.into_temp_path())
}

/// Those of any new file, which the process's umask narrows; a temporary file's own would hide it from other users.
fn ordinary_permissions<'a, 'b>(builder: &'b mut Builder<'a, 'a>) -> &'b mut Builder<'a, 'a> {
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        builder.permissions(fs::Permissions::from_mode(0o666))
    }
    #[cfg(not(unix))]
    builder
}
