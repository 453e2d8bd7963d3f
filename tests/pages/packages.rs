//! The packages that crates.io hands out hold what their users need, and no more.

use crate::{ROOT, read, sources, versioned};
use std::process::Command;

/// A package, the files and folders that it may hold besides what cargo adds, and some that it must.
const PACKAGES: [(&str, &[&str], &[&str]); 4] = [
    (
        "mean-information",
        &[
            "src/",
            "docs/",
            "vectors/README.md",
            "vectors/v1/",
            "examples/measure.rs",
            "examples/own_sensor.rs",
            "examples/watch_emmi.rs",
            "CHANGELOG.md",
        ],
        &["src/lib.rs", "docs/rounding.md", "docs/figures/figure-1.svg", "vectors/v1/cell.entropy.json"],
    ),
    ("mean-information-files", &["src/"], &["src/lib.rs"]),
    ("mean-information-report", &["src/"], &["src/lib.rs"]),
    ("mean-information-cli", &["src/", "build.rs"], &["src/main.rs", "src/output/page.css", "build.rs"]),
];
/// Files of every package.
const ALWAYS: [&str; 5] = ["Cargo.toml", "Cargo.toml.orig", "README.md", "LICENSE-APACHE", "LICENSE-MIT"];
/// Files that cargo makes, of which it leaves out the first for a changed tree and the second for a library.
const MADE: [&str; 2] = [".cargo_vcs_info.json", "Cargo.lock"];

/// Lists the files that `cargo package` packs.
fn packed(package: &str) -> Vec<String> {
    let output = Command::new(env!("CARGO"))
        .args(["package", "--list", "--allow-dirty", "--offline", "--package", package])
        .current_dir(ROOT)
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{package}: {}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).expect("paths are text").lines().map(str::to_owned).collect()
}

#[test]
fn packages_hold_what_their_users_need() {
    if versioned().is_none() {
        return println!("skipped: cargo asks git what to pack, and this is no checkout");
    }
    for (package, allowed, needed) in PACKAGES {
        let files = packed(package);
        for file in &files {
            let expected = ALWAYS.contains(&&**file)
                || MADE.contains(&&**file)
                || allowed
                    .iter()
                    .any(|start| file == start || start.ends_with('/') && file.starts_with(start));
            assert!(expected, "{package} packs {file}");
            assert!(!file.contains(".py") && !file.contains("/check.mjs"), "{package} packs {file}");
        }
        for file in ALWAYS.iter().chain(needed) {
            assert!(files.iter().any(|packed| packed == file), "{package} lacks {file}");
        }
    }
}

/// A package is tested alone, where cargo has left out what is not published: `.ci/release`.
#[test]
fn packaged_tests_do_without_what_is_not_published() {
    let folders = ["src", "crates/files/src", "crates/report/src", "crates/cli/src"];
    let files: Vec<_> = folders.into_iter().flat_map(sources).collect();
    assert!(files.len() > 200);
    for path in files {
        let uses = read(&path).contains("mean_information_test_support");
        assert!(!uses, "{} uses a crate that is not published", path.display());
    }
}
