//! What is installed beside the command: completions for shells and manual pages; and what `--version` says.

mod common;

use common::*;
use mean_information_cli::check::Vectors;
use std::fs;
#[cfg(unix)]
use std::path::Path;
use std::process::Command;

/// The commands, as `--help` lists them.
fn commands() -> Vec<String> {
    let help = stdout(&["--help"]);
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let commands = commands.lines().take_while(|line| !line.is_empty());
    let names = commands.filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next());
    names.filter(|&name| name != "help").map(str::to_owned).collect()
}

#[test]
fn every_shell_has_a_script_with_every_command_and_its_options() {
    for shell in ["bash", "elvish", "fish", "powershell", "zsh"] {
        let script = stdout(&["completions", shell]);
        for word in commands().iter().map(String::as_str).chain(["heat-map", "known-failures"]) {
            assert!(script.contains(word), "{shell}: {word}");
        }
    }
    let folder = Folder::new();
    let file = folder.text_path("meaninfo.fish");
    assert_eq!(stdout(&["completions", "fish", "--output", &file]), "");
    assert_eq!(text(&read(&file)), stdout(&["completions", "fish"]));
    assert!(refusal(&["completions", "tcsh"]).contains("bash, elvish, fish, powershell, zsh"));
}

/// Bash, where it is there, completes a command, an option and a value.
#[test]
fn bash_completes() {
    let folder = Folder::new();
    let script = folder.text_path("meaninfo");
    stdout(&["completions", "bash", "--output", &script]);
    let completed = |words: &str| {
        let program = format!(
            "source '{script}'; COMP_WORDS=({words}); COMP_CWORD=$((${{#COMP_WORDS[@]}} - 1)); \
             _meaninfo meaninfo \"${{COMP_WORDS[-1]}}\" \"${{COMP_WORDS[-2]}}\"; echo \"${{COMPREPLY[@]}}\""
        );
        let output = Command::new("bash").args(["--norc", "-c", &program]).output().ok()?;
        output.status.success().then(|| text(&output.stdout).trim().to_owned())
    };
    if completed("meaninfo tra").is_none() {
        return println!("skipped: no bash");
    }
    for (words, expected) in [
        ("meaninfo tra", "trajectory"),
        ("meaninfo map --heat", "--heat-map"),
        ("meaninfo map --format j", "json"),
        ("meaninfo map --semantics nav2-", "nav2-humble"),
    ] {
        assert_eq!(completed(words).as_deref(), Some(expected), "{words}");
    }
}

#[test]
fn every_command_has_a_manual_page() {
    let folder = Folder::new();
    let man = folder.text_path("man1");
    assert_eq!(stdout(&["man", "--out", &man]), "");
    let mut pages: Vec<_> =
        fs::read_dir(&man).unwrap().map(|page| page.unwrap().file_name().into_string().unwrap()).collect();
    pages.sort();
    let mut expected: Vec<_> = commands().iter().map(|command| format!("meaninfo-{command}.1")).collect();
    expected.push("meaninfo.1".to_owned());
    expected.sort();
    assert_eq!(pages, expected);
    let page = |name: &str| String::from_utf8(read(format!("{man}/{name}"))).unwrap();
    for (name, words) in [
        ("meaninfo.1", &["meaninfo\\-trajectory(1)", ".TH meaninfo 1"][..]),
        ("meaninfo-map.1", &["\\-\\-heat\\-map", "\\-\\-unknown", "FILE", ".SH OPTIONS"]),
        ("meaninfo-trajectory.1", &["\\-\\-mount", "TUM text", ".SH \"EXIT STATUS\"", "2 refused"]),
        (
            "meaninfo-bag.1",
            &[concat!(".TH meaninfo-bag 1  \"meaninfo ", env!("CARGO_PKG_VERSION"), "\" meaninfo")],
        ),
    ] {
        for word in words {
            assert!(page(name).contains(word), "{name}: {word}\n{}", page(name));
        }
    }
    let line = refusal(&["man", "--out", &folder.text_path("none/man1")]);
    assert!(line.contains("make that first"), "{line}");
}

/// The lines of the README, in an empty home.
#[test]
#[cfg(unix)]
fn the_readme_installs_them() {
    let readme = read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md"));
    let (_, lines) = text(&readme).split_once("```text\nmkdir -p ~/").unwrap();
    let (lines, _) = lines.split_once("```").unwrap();
    let home = Folder::new();
    let path = std::env::var("PATH").unwrap();
    let program = Path::new(env!("CARGO_BIN_EXE_meaninfo")).parent().unwrap().display();
    let mut shell = Command::new("sh");
    shell.env("HOME", home.path("")).env("PATH", format!("{program}:{path}"));
    let output = shell.args(["-e", "-c", &format!("mkdir -p ~/{lines}")]).output().unwrap();
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""));
    let script = read(home.path(".local/share/bash-completion/completions/meaninfo"));
    assert_eq!(text(&script), stdout(&["completions", "bash"]));
    assert!(home.path(".local/share/man/man1/meaninfo-map.1").exists());
}

#[test]
fn the_long_version_says_what_is_within() {
    let long = stdout(&["--version"]);
    let version = env!("CARGO_PKG_VERSION");
    let lines: Vec<_> = long.lines().collect();
    let vectors = Vectors::built_in().unwrap();
    let tests: usize = vectors.iter().map(|of| of.tests.len()).sum();
    assert_eq!(lines[0], format!("meaninfo {version}"));
    assert!(lines[1].starts_with("features: ") && lines[1].contains("page for browsers"), "{long}");
    assert_eq!(lines[2], format!("vectors: v1, {tests} tests of {} operations", vectors.len()));
    assert_eq!(lines[3], "port protocol: 1");
    // What the README shows of the port in Python.
    let readme = read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md"));
    assert!(text(&readme).contains(&format!("```text\n{tests} passed, 0 failed, 0 skipped\n```")));
    assert_eq!(stdout(&["-V"]), format!("meaninfo {version}\n"));
}
