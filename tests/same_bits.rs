//! The same bits in every build: debug and release, with and without the instructions of this machine's processor (fused
//! multiply-add among them).

use mean_information_test_support::digest::DIGESTS;
use std::env;
use std::path::PathBuf;
use std::process::Command;

/// The digests that the program `digest` prints when it is built in this way.
fn digests(name: &str, arguments: &[&str], flags: &str) -> Vec<u64> {
    let root = env!("CARGO_MANIFEST_DIR");
    let target = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("same-bits").join(name);
    let output = Command::new(env!("CARGO"))
        .args(["run", "--quiet", "--package", "mean-information-test-support", "--bin", "digest"])
        .args(arguments)
        .env("CARGO_TARGET_DIR", target)
        .env("RUSTFLAGS", flags)
        .env_remove("CARGO_ENCODED_RUSTFLAGS")
        .current_dir(root)
        .output()
        .expect("cargo runs");
    assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
    let digits = String::from_utf8(output.stdout).expect("digests are text");
    digits.lines().map(|line| u64::from_str_radix(line, 16).expect("a digest is hexadecimal")).collect()
}

#[test]
fn results_and_integrals_have_the_same_bits_in_debug() {
    assert_eq!(digests("debug", &[], ""), DIGESTS);
}

#[test]
fn results_and_integrals_have_the_same_bits_in_release() {
    assert_eq!(digests("release", &["--release"], ""), DIGESTS);
}

#[test]
fn results_and_integrals_have_the_same_bits_with_native_instructions() {
    assert_eq!(digests("native", &["--release"], "-C target-cpu=native"), DIGESTS);
}
