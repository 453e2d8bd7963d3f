//! `vectors/judge.py`, the verdict without Rust: it says of ports what `meaninfo check` says.

mod common;

use common::*;
use std::fs;
use std::process::{Command, Output};

const JUDGE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../vectors/judge.py");

/// Two logarithms as people write them, in plain Python: a port of the cells, and functions of single operations.
const FAULTY: &str = r#"
import json, math, sys

def entropy(p):
    if not 0 <= p <= 1:
        raise ValueError
    return sum(-q * math.log2(q) for q in (p, 1 - p) if q > 0)

def observed(cells):
    if not all(0 <= p <= 1 for p in cells):
        return math.nan
    return sum(p != 0.5 for p in cells)

def whole(p):
    bits = entropy(p)
    return int(bits) if bits == int(bits) else bits

class Count:
    def __init__(self, cells):
        self.cells = cells
    def __index__(self):
        return self.cells
    def __float__(self):
        return float(self.cells)

def counted(cells):
    count = observed(cells)
    return Count(count) if count == count else count

def answer(run):
    try:
        h = entropy(float.fromhex(run["args"]["p"]))
    except ValueError:
        return {"error": "domain"}
    return {"result": (h if run["op"] == "cell.entropy" else 1 - h).hex()}

if __name__ == "__main__":
    ops = ["cell.entropy", "cell.information"]
    hello = {"protocol": 1, "name": "two logarithms", "language": "Python", "version": "1", "formats": ["f64"], "ops": ops}
    for line in sys.stdin:
        request = json.loads(line)
        if request["cmd"] == "stop":
            break
        reply = hello if request["cmd"] == "start" else {"seq": request["seq"], **answer(request)}
        print(json.dumps(reply), flush=True)
"#;

/// Runs the judge; `None`, and a note, where there is no `python3`.
fn judge(arguments: &[&str]) -> Option<Output> {
    match Command::new("python3").arg(JUDGE).args(arguments).output() {
        Ok(output) => Some(output),
        Err(error) => {
            println!("skipped: python3: {error}");
            None
        }
    }
}

fn last_line(output: &[u8]) -> &str {
    text(output).lines().last().unwrap_or_default()
}

#[test]
fn the_library_as_a_port_is_right() {
    let meaninfo = meaninfo().get_program().to_str().unwrap().to_owned();
    let Some(output) = judge(&["--", &meaninfo, "port"]) else { return };
    assert_eq!((output.status.code(), text(&output.stderr)), (Some(0), ""), "{}", text(&output.stdout));
    assert_eq!(last_line(&output.stdout), "17376 passed, 0 failed, 0 skipped");
}

#[test]
fn a_faulty_port_is_wrong_where_the_check_finds_it_wrong() {
    let folder = Folder::new();
    let port = folder.text_path("port.py");
    fs::write(&port, FAULTY).unwrap();
    for ops in ["cell.entropy", "cell.information", "cell.*"] {
        let Some(output) = judge(&["--ops", ops, "python3", &port]) else { return };
        assert_eq!(output.status.code(), Some(1), "{}", text(&output.stderr));
        let check = meaninfo().args(["check", "--ops", ops, "--", "python3", &port]).output().unwrap();
        assert_eq!(last_line(&output.stdout), last_line(&check.stdout), "{ops}");
    }
    // A port that ends, or prints something else: no JSON, no object, no welcome.
    let programs = ["print('ready')", "pass", "print(1.5)", "print('{\"protocol\": 1}')"];
    for command in programs.map(|program| ["python3", "-c", program]) {
        let Some(output) = judge(&command) else { return };
        assert_eq!(output.status.code(), Some(2));
        assert!(text(&output.stderr).starts_with("judge.py: no answer"), "{}", text(&output.stderr));
    }
}

/// Judges a function of [`FAULTY`], in a file of its own.
fn judge_function(folder: &Folder, op: &str, name: &str) -> Option<Output> {
    let file = folder.text_path("functions.py");
    fs::write(&file, FAULTY).unwrap();
    judge(&["--ops", op, "--call", &format!("{file}:{name}")])
}

#[test]
fn functions_are_judged() {
    let folder = Folder::new();
    let call = |op, name| judge_function(&folder, op, name);
    let Some(output) = call("map.observed", "observed") else { return };
    assert_eq!(last_line(&output.stdout), "149 passed, 0 failed, 149 skipped", "{}", text(&output.stderr));
    let output = call("cell.entropy", "entropy").unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(text(&output.stdout).contains("    entropy/f64/"), "{}", text(&output.stdout));
    let output = call("cell.*", "entropy").unwrap();
    assert_eq!(output.status.code(), Some(2));
}

/// An integer stands for a float where the operation has floats, and any integer for a count, as NumPy's do.
#[test]
fn integers_are_read_as_the_operation_means_them() {
    let folder = Folder::new();
    let call = |op, name| judge_function(&folder, op, name);
    for (op, name, same) in [("cell.entropy", "whole", "entropy"), ("map.observed", "counted", "observed")] {
        let Some(output) = call(op, name) else { return };
        assert_eq!(text(&output.stdout), text(&call(op, same).unwrap().stdout), "{}", text(&output.stderr));
    }
}

/// A port whose answers are those of the library, but for what a change makes of their text.
fn changed(change: &str, meaninfo: &str) -> String {
    format!(
        r#"
import re, subprocess, sys
port = subprocess.Popen([{meaninfo:?}, "port"], stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)
for line in sys.stdin:
    port.stdin.write(line)
    port.stdin.flush()
    print(re.sub({change}, port.stdout.readline()), end="", flush=True)
"#
    )
}

/// -0 is within a tolerance of several ulp of 0, and not the nearest float; texts are read exactly.
#[test]
fn signs_and_digits_are_read_as_the_check_reads_them() {
    let folder = Folder::new();
    let (port, meaninfo) =
        (folder.text_path("port.py"), meaninfo().get_program().to_str().unwrap().to_owned());
    for (change, ops, is_right) in [
        (r#"r'"0x0p\+?0"', '"-0x0p+0"'"#, "expected.*", true),
        (r#"r'"0x0p\+?0"', '"-0x0p+0"'"#, "cell.information", false),
        // Digits that no float has, though the nearest float is right.
        (r"r'(0x1\.[0-9a-f]+)p', r'\g<1>00000000000000001p'", "cell.information", false),
        (r"r'(0x1\.[0-9a-f]+)p', r'\g<1>0000000000000000p'", "cell.information", true),
        // A decimal is no hexadecimal float.
        (r#"r'"0x1p-1"', '"0.5"'"#, "cell.information", false),
    ] {
        fs::write(&port, changed(change, &meaninfo)).unwrap();
        let Some(output) = judge(&["--ops", ops, "python3", &port]) else { return };
        assert_eq!(output.status.code(), Some(i32::from(!is_right)), "{ops}: {}", text(&output.stdout));
        let check = self::meaninfo().args(["check", "--ops", ops, "--", "python3", &port]).output().unwrap();
        assert_eq!(last_line(&output.stdout), last_line(&check.stdout), "{change} {ops}");
    }
}

#[test]
fn a_function_that_gives_no_number_is_bad_usage() {
    let folder = Folder::new();
    let file = folder.text_path("functions.py");
    fs::write(&file, "def nothing(p):\n    pass\n").unwrap();
    let Some(output) = judge(&["--ops", "cell.entropy", "--call", &format!("{file}:nothing")]) else {
        return;
    };
    assert_eq!(output.status.code(), Some(2));
    assert!(text(&output.stderr).contains("no number, but None"), "{}", text(&output.stderr));
}
