//! The same bits in every build: debug and release, with and without the instructions of this machine's processor (fused
//! multiply-add among them).

use expected::DIGEST;
use std::env;
use std::path::PathBuf;
use std::process::Command;

#[path = "library/digest.rs"]
mod expected;

/// What `tests/digest` prints when it is built in this way.
fn digest(name: &str, arguments: &[&str], flags: &str) -> u64 {
    let root = PathBuf::from(env!("CARGO_MANIFEST_DIR"));
    if !root.join("tests/digest").exists() {
        eprintln!("skipped: a packaged library comes without the package tests/digest");
        return DIGEST;
    }
    let target = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("same-bits").join(name);
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--package", "digest"])
        .args(arguments)
        .env("CARGO_TARGET_DIR", target)
        .env("RUSTFLAGS", flags)
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .current_dir(root)
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    let digits = String::from_utf8(output.stdout).expect("the digest is text");
    u64::from_str_radix(digits.trim(), 16).expect("the digest is hexadecimal")
}

#[test]
fn a_million_results_have_the_same_bits_in_debug() {
    assert_eq!(digest("debug", &[], ""), DIGEST);
}

#[test]
fn a_million_results_have_the_same_bits_in_release() {
    assert_eq!(digest("release", &["--release"], ""), DIGEST);
}

#[test]
fn a_million_results_have_the_same_bits_with_native_instructions() {
    assert_eq!(digest("native", &["--release"], "-C target-cpu=native"), DIGEST);
}
