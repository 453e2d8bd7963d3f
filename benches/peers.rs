//! The radial limit of one room by this crate and by others, in one run: a table of times and their ratios.
//!
//! `cargo bench --bench peers`. Arb, mpmath and QUADPACK come from `benches/peers.py`, a child process, and are skipped with
//! a message where Python or a package is missing. Every result is checked before it is printed; `benches/RESULTS.md` has runs.

// What the library is compared with.
#![allow(clippy::disallowed_methods)]
#![allow(missing_docs)]

use mean_information::limit::{Weight, adaptive, closed_form, rigorous};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::scalar::Scalar;
use mean_information::sensor::GaussianSensor;
use std::cell::Cell;
use std::hint::black_box;
use std::process::Command;
use std::time::Instant;

/// The limit at `z / σ = 10`, by mpmath at 50 digits.
const LIMIT: f64 = 0.789_336_888_025_651_4;

/// What a method gives, and in what time.
struct Row {
    method: String,
    seconds: f64,
    value: f64,
    /// Claimed, or the width of the enclosure.
    error: f64,
    evaluations: u64,
}

impl Row {
    fn of(method: &str, call: impl Fn() -> (f64, f64, u64)) -> Self {
        let (value, error, evaluations) = call();
        // The least of some runs of a few milliseconds: what another process takes makes them longer, never shorter.
        let run = |calls: u32| {
            let start = Instant::now();
            for _ in 0..calls {
                black_box(call());
            }
            start.elapsed().as_secs_f64() / f64::from(calls)
        };
        let calls = (5e-3 / run(3)).clamp(1.0, 1e6) as u32;
        let seconds = (0..20).map(|_| run(calls)).fold(f64::INFINITY, f64::min);
        Self { method: method.to_owned(), seconds, value, error, evaluations }
    }

    /// From a line of the child.
    fn parse(line: &str) -> Option<Self> {
        let mut fields = line.split('\t');
        let method = fields.next()?.to_owned();
        let mut number = || fields.next()?.parse::<f64>().ok();
        let (seconds, value, error) = (number()?, number()?, number()?);
        Some(Self { method, seconds, value, error, evaluations: number()? as u64 })
    }
}

fn ours(sensor: &GaussianSensor<f64>) -> Vec<Row> {
    let enclosure = || {
        let limit = rigorous(black_box(sensor), Weight::Radial, &Rigorous::default()).expect("a room");
        assert!(limit.contains(LIMIT));
        (limit.lower, limit.width(), limit.evaluations)
    };
    let estimate = |rule| {
        let settings = GaussKronrod::new().relative(1e-12).rule(rule);
        let limit = adaptive(black_box(sensor), Weight::Radial, &settings).expect("a room");
        (limit.value, limit.error, limit.evaluations)
    };
    vec![
        // An ulp below 1.
        Row::of("closed form", || (closed_form(black_box(sensor), Weight::Radial), f64::EPSILON / 2.0, 0)),
        Row::of("rigorous", enclosure),
        Row::of("adaptive, K31", || estimate(Rule::K31)),
        Row::of("adaptive, K21", || estimate(Rule::K21)),
    ]
}

/// Double exponential quadrature at the same tolerance; what both sides share is integrated once.
fn double_exponential(alpha: f64) -> Row {
    let count = Cell::new(0);
    let deficit = |t: f64| {
        count.set(count.get() + 1);
        (-0.5 * t * t).entropy_from_log_occupancy()
    };
    let edge = (2.0 * core::f64::consts::LN_2).sqrt();
    Row::of("crate quadrature 0.1.2", || {
        count.set(0);
        let common = quadrature::integrate(deficit, 0.0, black_box(edge), 1e-12);
        let rest = quadrature::integrate(deficit, edge, black_box(alpha), 1e-12);
        let whole = alpha + edge;
        let error = (2.0 * common.error_estimate + rest.error_estimate) / whole;
        (1.0 - (2.0 * common.integral + rest.integral) / whole, error, count.get())
    })
}

/// What the child measures; nothing, with a message, where it cannot.
fn others() -> Vec<Row> {
    let script = concat!(env!("CARGO_MANIFEST_DIR"), "/benches/peers.py");
    let output = match Command::new("python3").arg(script).output() {
        Ok(output) => output,
        Err(error) => {
            eprintln!("skipped: python3: {error}");
            return Vec::new();
        }
    };
    eprint!("{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8_lossy(&output.stdout).lines().filter_map(Row::parse).collect()
}

fn main() {
    let sensor = GaussianSensor::new(2.5, 0.25).expect("positive");
    let mut rows = ours(&sensor);
    rows.push(double_exponential(10.0));
    rows.extend(others());
    let unit =
        |method: &str| rows.iter().find(|row| row.method == method).map_or(f64::NAN, |row| row.seconds);
    let (adaptive, rigorous) = (unit("adaptive, K31"), unit("rigorous"));
    println!(
        "| method | time (µs) | by that of adaptive, K31 | by that of rigorous | evaluations | claimed error or width | error |"
    );
    println!("|---|---|---|---|---|---|---|");
    for Row { method, seconds, value, error, evaluations } in &rows {
        assert!((value - LIMIT).abs() < 1e-12, "{method}: {value}");
        println!(
            "| {method} | {} | {} | {} | {evaluations} | {error:.1e} | {:.1e} |",
            short(seconds * 1e6),
            short(seconds / adaptive),
            short(seconds / rigorous),
            (value - LIMIT).abs()
        );
    }
}

/// Two digits at least.
fn short(x: f64) -> String {
    if x < 0.1 { format!("{x:.1e}") } else { format!("{x:.2}") }
}
