//! Ports with a fault each: what they answer is wrong, or they break the protocol at the request [`AT`].

use super::fixture::AS_PORT;
use mean_information::Real;
use mean_information_report::hex_float;
use mean_information_report::port;
use mean_information_report::protocol::{Answer, Argument, Claim, Reply, Request, Run};
use serde_json::{Value, json};
use std::collections::BTreeMap;
use std::io::{self, BufRead, Write};
use std::process::{Command, Stdio, exit};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::{Arc, mpsc};
use std::thread;
use std::time::Duration;

/// The request at which a port misbehaves.
const AT: u64 = 7;
/// The request whose arrival ends a port that reads ahead.
const AHEAD: u64 = 12;
/// Longer than it takes to send what is sent ahead.
const SOON: Duration = Duration::from_millis(300);

/// Serves with the fault of that name.
pub(crate) fn serve(fault: &str, rest: &[String]) {
    match fault {
        "sleeper" | "mute" => sleep(),
        "dies" => {
            eprintln!("cannot find numpy");
            exit(4);
        }
        "orphan" => orphan(rest),
        _ => {}
    }
    // Requests are read ahead by a thread.
    let (sender, requests) = mpsc::channel();
    let waiting = Arc::new(AtomicUsize::new(0));
    let (name, unanswered) = (fault.to_owned(), Arc::clone(&waiting));
    thread::spawn(move || {
        for line in io::stdin().lock().lines() {
            let line = line.unwrap_or_default();
            let before = unanswered.fetch_add(1, Ordering::SeqCst);
            let run = serde_json::from_str(&line);
            if name == "exits-reading" && matches!(&run, Ok(Request::Run(Run { seq: AHEAD, .. })))
                || name == "exits-ahead" && before > 3
            {
                eprintln!("reading failed");
                exit(3);
            }
            let _ = sender.send(line);
        }
    });
    let mut held = String::new();
    while let Ok(line) = requests.recv() {
        let Ok(request) = serde_json::from_str::<Request>(&line) else { exit(9) };
        let answer = match &request {
            Request::Run(run) => {
                if fault.starts_with("exits-") && run.seq == 2 {
                    thread::sleep(SOON);
                }
                if run.seq == AT || fault == "exits-always" {
                    misbehave(fault, run);
                }
                let answer = Answer::new(run.seq, reply(fault, run));
                if fault == "reorders" && run.seq == AT {
                    thread::spawn(move || {
                        thread::sleep(SOON);
                        print(&(answer.line() + "\n"));
                    });
                    waiting.fetch_sub(1, Ordering::SeqCst);
                    continue;
                }
                let debugging =
                    if fault == "debugs" { format!("p = {:?}\n", run.args) } else { String::new() };
                debugging + &answer.line()
            }
            Request::Start { .. } => welcome(fault),
            Request::Stop => match fault {
                "ignores-stop" => sleep(),
                "talks-at-stop" => "bye".to_owned(),
                "exits-3-at-stop" => exit(3),
                "leaves-at-stop" => {
                    leave_behind();
                    return;
                }
                _ => return,
            },
        };
        if fault == "never-flushes" && matches!(request, Request::Run(_)) {
            held += &(answer + "\n");
        } else {
            print(&(answer + "\n"));
        }
        waiting.fetch_sub(1, Ordering::SeqCst);
    }
    print(&held);
}

/// Whoever no longer reads has ended this.
fn print(text: &str) {
    let mut stdout = io::stdout().lock();
    if stdout.write_all(text.as_bytes()).and_then(|()| stdout.flush()).is_err() {
        exit(1);
    }
}

fn sleep() -> ! {
    loop {
        thread::sleep(Duration::from_secs(1));
    }
}

/// Leaves a process that holds its pipes.
fn orphan(rest: &[String]) {
    std::fs::write(&rest[0], leave_behind().to_string()).unwrap();
    print(&(welcome("orphan") + "\n"));
    exit(3);
}

/// Starts a process that holds the output of this one; its number.
fn leave_behind() -> u32 {
    let program = std::env::current_exe().unwrap();
    Command::new(program).args([AS_PORT, "sleeper"]).stdin(Stdio::null()).spawn().unwrap().id()
}

/// Breaks the protocol.
fn misbehave(fault: &str, run: &Run) {
    let right = Answer::new(run.seq, port::reply(run)).line();
    match fault {
        "hangs" => sleep(),
        "floods" => loop {
            print("all work and no play");
        },
        "floods-lines" => loop {
            print(&format!("{right}\n"));
        },
        "floods-stderr" => loop {
            eprintln!("working");
        },
        "garbage" => print("computing \u{1b}[31mcell\u{1b}[0m 7 ...\n"),
        "debris" => print(&format!("{right}{right}\n")),
        "no-utf8" => {
            let _ = io::stdout().lock().write_all(b"\xff\xfe\n");
        }
        "nested" => print(&("[".repeat(50_000) + "\n")),
        "closes" => {
            let null = std::fs::OpenOptions::new().write(true).open("/dev/null").unwrap();
            rustix::stdio::dup2_stdout(null).unwrap();
            sleep();
        }
        "exits-3" | "exits-always" => {
            eprintln!("Traceback (most recent call last):\nZeroDivisionError: division by zero");
            exit(3);
        }
        "cuts" => {
            print(&right[..right.len() / 2]);
            exit(0);
        }
        "float-number" => print("{\"seq\":7.0,\"result\":\"0x1p-1\"}\n"),
        "no-parts" => print("{\"seq\":7}\n"),
        "wrong-type" => print("{\"seq\":7,\"error\":3}\n"),
        "no-object" => print("[7,\"0x1p-1\"]\n"),
        "leaves" => {
            leave_behind();
            exit(3);
        }
        "no-number" => print("{\"result\":\"0x1p-1\"}\n"),
        "both" => print("{\"seq\":7,\"result\":\"0x1p-1\",\"error\":\"domain\"}\n"),
        _ => {}
    }
}

fn welcome(fault: &str) -> String {
    let mut welcome = port::welcome();
    welcome.ops = vec!["cell.information".to_owned(), "map.observed".to_owned()];
    match fault {
        "protocol-2" => welcome.protocol = 2,
        "refuses" => return "{\"error\":\"protocol\"}".to_owned(),
        "no-ops" => welcome.ops.clear(),
        "strange-ops" => welcome.ops = vec!["cell.entopy".to_owned()],
        "no-formats" => welcome.formats = vec!["f16".to_owned()],
        "garbled" => return "hello".to_owned(),
        "no-protocol" => return "{\"formats\":[\"f64\"]}".to_owned(),
        "no-list" => return "{\"protocol\":1,\"formats\":\"f64\"}".to_owned(),
        "negative-claim" => welcome.claims = claims(&[("*", -1.0, 0.0)]),
        "huge-claim" => welcome.claims = claims(&[("cell.*", 1e300, 0.0)]),
        "double-only" => welcome.formats = vec!["f64".to_owned(), "f80".to_owned()],
        "half" => welcome.ops = vec!["cell.information".to_owned(), "cell.entopy".to_owned()],
        "huge-bits" => welcome.claims = claims(&[("cell.*", 0.0, 0.5)]),
        "claims" => welcome.claims = claims(&[("cell.*", 4.0, 0.0), ("mop.*", 3.0, 0.0)]),
        "claims-bits" => welcome.claims = claims(&[("cell.*", 0.0, 2e-16)]),
        _ => {}
    }
    welcome.line()
}

fn claims(claims: &[(&str, f64, f64)]) -> BTreeMap<String, Claim> {
    claims.iter().map(|&(op, ulp, bits)| (op.to_owned(), Claim { ulp, bits })).collect()
}

/// What a wrong implementation answers.
fn reply(fault: &str, run: &Run) -> Reply {
    let right = port::reply(run);
    let single = run.format == f32::FORMAT;
    let float = |x: f64| {
        Reply::Result(if single { hex_float::format(x as f32) } else { hex_float::format(x) }.into())
    };
    let value = match &right {
        Reply::Result(Value::String(text)) => hex_float::parse::<f64>(text).ok(),
        _ => None,
    };
    let count = matches!(right, Reply::Result(Value::Number(_)));
    let domain = matches!(right, Reply::Error(_));
    match (fault, value) {
        ("nan", _) if !count => float(f64::NAN),
        ("nan-for-domain", _) if domain && !count => float(f64::NAN),
        ("accepts", _) if domain => float(0.25),
        ("refuses-all", _) => Reply::error("domain"),
        ("other-word", _) if domain => Reply::error("ValueError"),
        ("wrong-format", Some(_)) => {
            // The number in double precision, also where single was asked for.
            let double = Run { format: f64::FORMAT.to_owned(), ..run.clone() };
            port::reply(&double)
        }
        ("numbers", Some(x)) => Reply::Result(json!(x)),
        ("integers", Some(_)) => Reply::Result(json!(1)),
        ("text-count", _) if count => Reply::Result("0x1p+0".into()),
        ("nats", Some(x)) => float(x * std::f64::consts::LN_2),
        ("hartleys", Some(x)) => float(x * std::f64::consts::LOG10_2),
        ("doubles", Some(x)) => float(2.0 * x),
        ("entropy", Some(x)) => float(1.0 - x),
        ("constant", Some(_)) => float(0.625),
        ("infinite", Some(_)) => float(f64::INFINITY),
        ("single", Some(x)) => float(f64::from(x as f32)),
        ("single-inside", Some(x)) if !single => float(f64::from((x * 3.0) as f32) / 3.0),
        ("claims" | "next", Some(x)) if single => {
            Reply::Result(hex_float::format(f32::from_bits((x as f32).to_bits() + 1)).into())
        }
        ("claims" | "next", Some(x)) => float(f64::from_bits(x.to_bits() + 1)),
        ("claims-bits" | "off-by-bits", Some(x)) if !single => float(x + 1.5e-16),
        ("skips-all", _) => Reply::Skipped("too busy".to_owned()),
        ("skips", Some(_)) if single => Reply::Skipped("no \u{1b}single precision".to_owned()),
        ("counts-all", _) if count => match &run.args["cells"] {
            Argument::List(cells) => Reply::Result(cells.len().into()),
            _ => right,
        },
        ("one-wrong", Some(x)) if run.seq == AT => float(x * 1.5),
        _ => right,
    }
}
