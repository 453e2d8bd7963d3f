//! The folder of real maps and logs, where it is there.

use std::path::{Path, PathBuf};

/// Returns the path of a file or folder of the folder of real data, or prints that the test is skipped where there is none:
/// `MEANINFO_SHARED_DATA`, or `../shared/data` beside the checkout.
pub fn shared(name: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("MEANINFO_SHARED_DATA")
        .map_or_else(|| Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared/data"), PathBuf::from);
    let path = folder.join(name);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: {} is absent; MEANINFO_SHARED_DATA names the folder of real data", path.display());
    None
}

/// Returns the folder itself.
pub fn shared_data() -> Option<PathBuf> {
    shared("")
}
