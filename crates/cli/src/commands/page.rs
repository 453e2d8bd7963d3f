//! `meaninfo page`: the page for browsers, with maps inside it.

use super::Status;
use crate::failure::Failure;
use crate::output::{Files, may_write};
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use clap::Args;
use mean_information_files::{Disk, file_of};
use mean_information_report::{MeasuredMap, Reading};
use serde::Serialize;
use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

/// The page that this program was built with; empty if with none (`build.rs`).
const PAGE: &str = include_str!(concat!(env!("OUT_DIR"), "/page.html"));
/// The place of the maps in it.
const NO_MAPS: &str = r#"<script type="application/json" id="maps">[]</script>"#;

/// Tells whether this program was built with the page.
pub(super) fn is_built_in() -> bool {
    !PAGE.is_empty()
}

/// The arguments of `meaninfo page`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Maps to put into the page, as for `meaninfo map` but for bags.
    #[arg(value_name = "FILE")]
    maps: Vec<PathBuf>,
    /// Write the page to this file.
    #[arg(long, value_name = "FILE.html")]
    output: PathBuf,
}

/// A file within the page.
#[derive(Serialize)]
struct Held {
    name: String,
    base64: String,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let mut files = Files::new();
        files.read(self.maps.iter().cloned());
        may_write(&files, [], Some(&self.output))?;
        let mut held = BTreeMap::new();
        let mut failures = Vec::new();
        for map in &self.maps {
            match read(map) {
                Ok(inputs) => {
                    files.read(inputs.iter().cloned());
                    held.extend(inputs.into_iter().map(|path| (path, map)));
                }
                Err(failure) => failures.push(failure),
            }
        }
        match failures.len() {
            0 => {}
            1 => return Err(failures.remove(0)),
            _ => return Err(Failure::Several(failures)),
        }
        let page = with_maps(PAGE, &in_page(&held)?)?;
        files.add(&self.output, page.into_bytes());
        files.write()?;
        Ok(Status::Done)
    }
}

/// Returns the files of a map that the page can read.
fn read(map: &Path) -> Result<Vec<PathBuf>, Failure> {
    if file_of(map) != map {
        return Err(Failure::file(map, "is one array of an archive; save it as .npy for the page"));
    }
    let rows = MeasuredMap::read_from(&Disk, map, &Reading::default())?;
    // A description comes before its image, so that it is the one that the page begins with.
    let mut files: Vec<_> = rows.into_iter().flat_map(|row| row.files).collect();
    files.sort();
    files.dedup();
    Ok(files)
}

/// Returns the files as the page holds them, by their names without folders.
fn in_page(files: &BTreeMap<PathBuf, &PathBuf>) -> Result<Vec<Held>, Failure> {
    let mut held: Vec<Held> = Vec::new();
    for path in files.keys() {
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        if held.iter().any(|other| other.name == name) {
            let message =
                format!("another file is called {name}, too, and a page knows no folders; rename one");
            return Err(Failure::file(path, message));
        }
        let bytes =
            fs::read(path).map_err(|error| Failure::file(path, format!("cannot be read: {error}")))?;
        held.push(Held { name, base64: STANDARD.encode(bytes) });
    }
    Ok(held)
}

/// Puts files into the page.
fn with_maps(page: &str, files: &[Held]) -> Result<String, Failure> {
    if page.is_empty() {
        return Err(Failure::NotBuiltIn(
            "this meaninfo was built without the page; in a checkout, bindings/web/build.sh writes it, target/web/meaninfo.html, \
             which opens in a browser as it is, and MEANINFO_PAGE=$PWD/target/web/meaninfo.html cargo install --path crates/cli \
             puts it into meaninfo",
        ));
    }
    // Names and base64: serialisation cannot fail. No name ends the element.
    let json = serde_json::to_string(files).unwrap_or_default().replace('<', "\\u003c");
    Ok(page.replacen(NO_MAPS, &NO_MAPS.replace("[]", &json), 1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn maps_are_put_where_the_page_has_none() {
        let held = Held { name: "a</script>.npy".to_owned(), base64: "AAECAw==".to_owned() };
        let page = with_maps(&format!("before {NO_MAPS} after {NO_MAPS}"), &[held]).unwrap();
        let json = r#"[{"name":"a\u003c/script>.npy","base64":"AAECAw=="}]"#;
        assert_eq!(page, format!("before {} after {NO_MAPS}", NO_MAPS.replace("[]", json)));
        assert!(PAGE.is_empty() || PAGE.contains(NO_MAPS));
        let without = with_maps("", &[]).unwrap_err().to_string();
        assert!(without.contains("MEANINFO_PAGE=") && !without.contains("--help"), "{without}");
    }
}
