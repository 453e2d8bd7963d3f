//! Why the image that a yaml file names is not there, and what to write instead.

use crate::error::{Error, ErrorKind, Place};
use crate::source::Source;
use std::path::Path;

/// Creates the error of a yaml file at `path` whose image, written as `named` and looked for at `tried`, does not exist.
pub(super) fn missing_image(
    source: &impl Source,
    path: &Path,
    named: &str,
    tried: &Path,
    cause: Error,
) -> Error {
    let name = named.rsplit(['/', '\\']).next().unwrap_or_default();
    let beside = path.parent().unwrap_or(Path::new("")).join(name);
    let mended = if beside == tried {
        "; write the path of the image from the folder of the yaml file".to_owned()
    } else if !name.is_empty() && source.open(&beside).is_ok() {
        format!("; {name} lies beside the yaml file: write `image: {name}`")
    } else {
        format!("; no {name} lies beside the yaml file either")
    };
    let message =
        format!("image is {named:?}, and there is no file {}{}{mended}", tried.display(), why(named));
    Error::new(ErrorKind::NotFound, message)
        .at(Place::Key("image"))
        .with_value(named)
        .caused_by(cause.in_file(tried))
        .in_file(path)
}

/// Returns what is special about a path.
fn why(named: &str) -> &'static str {
    let drive = matches!(named.as_bytes(), [letter, b':', b'/' | b'\\', ..] if letter.is_ascii_alphabetic());
    if named.starts_with('~') {
        "; ~ is not replaced by a home folder"
    } else if named.contains("$(") {
        "; $(...) is replaced only in launch files"
    } else if named.contains("://") {
        "; it is a URL, which no loader opens"
    } else if drive {
        "; it begins with a drive letter of Windows"
    } else if named.contains('\\') {
        "; it has backslashes, which separate folders only on Windows"
    } else if named.contains('$') {
        "; variables are not replaced"
    } else {
        ""
    }
}
