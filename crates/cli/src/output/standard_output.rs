//! Standard output, also under its names as a file.

use crate::failure::Failure;
use std::io::{self, ErrorKind, Write};
use std::path::Path;

/// Returns whether `path` is what standard output goes to: `/dev/stdout`, or the file it was redirected to.
pub(super) fn is(path: &Path) -> bool {
    #[cfg(unix)]
    {
        use std::fs::{self, File};
        use std::os::fd::AsFd;
        use std::os::unix::fs::MetadataExt;
        let stdout = || File::from(io::stdout().as_fd().try_clone_to_owned()?).metadata();
        let place = |metadata: fs::Metadata| (metadata.dev(), metadata.ino());
        fs::metadata(path).and_then(|file| Ok(place(file) == place(stdout()?))).unwrap_or(false)
    }
    #[cfg(not(unix))]
    {
        let _ = path;
        false
    }
}

/// Prints `text`.
///
/// # Errors
/// Standard output that cannot be written. A reader who closed it early is no error.
pub(super) fn print(text: &str) -> Result<(), Failure> {
    let mut stdout = io::stdout().lock();
    match stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()) {
        Err(error) if error.kind() != ErrorKind::BrokenPipe => {
            Err(Failure::StandardOutput(error.to_string()))
        }
        _ => Ok(()),
    }
}
