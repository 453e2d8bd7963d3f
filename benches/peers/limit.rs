//! The radial limit of one room. Arb, mpmath and QUADPACK come from `limit.py`, a child process.

use crate::program::{Timed, output_of, python};
use mean_information::limit::{Weight, adaptive, closed_form, rigorous};
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::scalar::Scalar;
use mean_information::sensor::GaussianSensor;
use mean_information_test_support::timing::least_time;
use std::cell::Cell;
use std::hint::black_box;

/// The limit at `z / σ = 10`, by mpmath at 50 digits.
const LIMIT: f64 = 0.789_336_888_025_651_4;

/// The value of a method.
struct Limit {
    value: f64,
    /// Claimed, or the width of the enclosure.
    error: f64,
    evaluations: u64,
}

fn row(method: &str, call: impl Fn() -> (f64, f64, u64)) -> Timed<Limit> {
    let (value, error, evaluations) = call();
    let result = Limit { value, error, evaluations };
    Timed { method: method.to_owned(), seconds: least_time(0.1, call), result }
}

/// From a line of the child.
fn parse(line: &str) -> Option<Timed<Limit>> {
    let mut fields = line.split('\t');
    let method = fields.next()?.to_owned();
    let mut number = || fields.next()?.parse::<f64>().ok();
    let (seconds, value, error) = (number()?, number()?, number()?);
    Some(Timed { method, seconds, result: Limit { value, error, evaluations: number()? as u64 } })
}

fn ours(sensor: &GaussianSensor<f64>) -> Vec<Timed<Limit>> {
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
        row("closed form", || (closed_form(black_box(sensor), Weight::Radial), f64::EPSILON / 2.0, 0)),
        row("rigorous", enclosure),
        row("adaptive, K31", || estimate(Rule::K31)),
        row("adaptive, K21", || estimate(Rule::K21)),
    ]
}

/// Double exponential quadrature at the same tolerance; what both sides share is integrated once.
fn double_exponential(alpha: f64) -> Timed<Limit> {
    let count = Cell::new(0);
    let deficit = |t: f64| {
        count.set(count.get() + 1);
        (-0.5 * t * t).entropy_from_log_occupancy()
    };
    let edge = (2.0 * core::f64::consts::LN_2).sqrt();
    row("crate quadrature 0.1.2", || {
        count.set(0);
        let common = quadrature::integrate(deficit, 0.0, black_box(edge), 1e-12);
        let rest = quadrature::integrate(deficit, edge, black_box(alpha), 1e-12);
        let whole = alpha + edge;
        let error = (2.0 * common.error_estimate + rest.error_estimate) / whole;
        (1.0 - (2.0 * common.integral + rest.integral) / whole, error, count.get())
    })
}

pub(crate) fn compare() {
    let sensor = GaussianSensor::new(2.5, 0.25).expect("positive");
    let mut rows = ours(&sensor);
    rows.push(double_exponential(10.0));
    rows.extend(output_of(&mut python("limit.py")).lines().filter_map(parse));
    let unit =
        |method: &str| rows.iter().find(|row| row.method == method).map_or(f64::NAN, |row| row.seconds);
    let (adaptive, rigorous) = (unit("adaptive, K31"), unit("rigorous"));
    println!(
        "| method | time (µs) | by that of adaptive, K31 | by that of rigorous | evaluations | claimed error or width | error |"
    );
    println!("|---|---|---|---|---|---|---|");
    for Timed { method, seconds, result } in &rows {
        let Limit { value, error, evaluations } = result;
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
