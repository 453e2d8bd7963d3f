//! How many instructions a call takes. Unlike times, they repeat: on any machine, however busy, with the same compiler.
//!
//! `cargo bench --bench instructions` runs itself under `valgrind --tool=callgrind`, once with few calls of a function and once
//! with more; the difference is that of the calls alone. Valgrind has no AVX-512, which no function of one cell uses.

// What the library is compared with.
#![allow(clippy::disallowed_methods)]
#![allow(missing_docs)]

use mean_information::cell::{
    Cell, entropy, information, information_from_log_odds, occupancy_from_log_odds,
};
use mean_information::elementary::{exp, ln, sqrt};
use mean_information::limit::{Weight, closed_form};
use mean_information::room::CartesianRoom;
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{ExactSum, Real};
use std::hint::black_box;
use std::process::Command;

/// The arguments of a function.
const COUNT: usize = 1024;

/// A function of one argument, of a shape: what is made of a number uniform in (0, 1).
struct Function {
    name: &'static str,
    shape: fn(f64) -> f64,
    /// Calls it on some arguments: the sum of the results.
    calls: fn(&[f64]) -> f64,
    /// Their mean is known to lie here.
    mean: [f64; 2],
}

macro_rules! function {
    ($name:literal, $float:ident, $shape:expr, $function:expr, $mean:expr) => {
        Function {
            name: concat!($name, ", ", stringify!($float)),
            shape: $shape,
            calls: |arguments| {
                let function = $function;
                arguments.iter().map(|&x| f64::from(black_box(function(black_box(x as $float))))).sum()
            },
            mean: $mean,
        }
    };
}

/// Both of a cell.
fn both<T: Real>(p: T) -> T {
    Cell::from_occupancy(p).map_or(T::zero(), |cell| cell.entropy() + cell.information())
}

fn limit<T: Real>(ratio: T) -> T {
    let sigma = T::nearest(0.375);
    let sensor = GaussianSensor::new(ratio * sigma, sigma);
    sensor.map_or(T::zero(), |sensor| closed_form(&sensor, Weight::Radial))
}

fn add(x: f64) -> f64 {
    let mut sum = ExactSum::new();
    sum.add(x);
    black_box(&sum);
    x
}

/// From a sensor somewhere in its cell to the centre of cell `(i, i / 2)`.
fn distance(i: f64) -> f64 {
    let sensor = SteppedSensor::new(2.0, 0.2, 0.25, 0.875).expect("a sensor");
    let room = CartesianRoom::new(sensor, 0.05, [0.3, 0.1]).expect("a room");
    room.distance(i as i64, i as i64 / 2).expect("a cell")
}

fn plateau(u: f64) -> f64 {
    GaussianSensor::new(2.0 + u, 0.05).map_or(0.0, |sensor| sensor.plateau())
}

fn functions() -> Vec<Function> {
    let uniform = |u: f64| u;
    let cells = |u: f64| (400.0 * u).floor();
    let odds = |u: f64| 16.0 * (u - 0.5);
    // From e^-8 to e^8.
    let spread = |u: f64| (16.0 * (u - 0.5)).exp();
    // z / σ from 1 to 1000.
    let rooms = |u: f64| 1000_f64.powf(u);
    // Means of the integrals, with room for 1024 arguments.
    let (information_mean, entropy_mean) = ([0.25, 0.31], [0.69, 0.75]);
    let (exp_mean, ln_mean) = ([150.0, 230.0], [-0.7, 0.7]);
    vec![
        function!("nothing", f64, uniform, |x: f64| x, [0.45, 0.55]),
        function!("nothing", f32, uniform, |x: f32| x, [0.45, 0.55]),
        function!("entropy", f64, uniform, entropy::<f64>, entropy_mean),
        function!("entropy", f32, uniform, entropy::<f32>, entropy_mean),
        function!("two logarithms of the C library", f64, uniform, two_logarithms, entropy_mean),
        function!("information", f64, uniform, information::<f64>, information_mean),
        function!("information", f32, uniform, information::<f32>, information_mean),
        function!("Cell::from_occupancy, both", f64, uniform, both::<f64>, [0.999, 1.001]),
        function!("Cell::from_occupancy, both", f32, uniform, both::<f32>, [0.999, 1.001]),
        function!("information_from_log_odds", f64, odds, information_from_log_odds::<f64>, [0.55, 0.75]),
        function!("information_from_log_odds", f32, odds, information_from_log_odds::<f32>, [0.55, 0.75]),
        function!("occupancy_from_log_odds", f64, odds, occupancy_from_log_odds::<f64>, [0.45, 0.55]),
        function!("occupancy_from_log_odds", f32, odds, occupancy_from_log_odds::<f32>, [0.45, 0.55]),
        function!("elementary::exp", f64, odds, exp::<f64>, exp_mean),
        function!("elementary::exp", f32, odds, exp::<f32>, exp_mean),
        function!("exp of the C library", f64, odds, f64::exp, exp_mean),
        function!("elementary::ln", f64, spread, ln::<f64>, ln_mean),
        function!("elementary::ln", f32, spread, ln::<f32>, ln_mean),
        function!("ln of the C library", f64, spread, f64::ln, ln_mean),
        function!("elementary::sqrt", f64, uniform, sqrt::<f64>, [0.62, 0.71]),
        function!("elementary::sqrt", f32, uniform, sqrt::<f32>, [0.62, 0.71]),
        function!("CartesianRoom::distance", f64, cells, distance, [0.01, 30.0]),
        function!("GaussianSensor::plateau", f64, uniform, plateau, [0.0, 2.0]),
        function!("limit::closed_form, radial", f64, rooms, limit::<f64>, [0.8, 0.99]),
        function!("limit::closed_form, radial", f32, rooms, limit::<f32>, [0.8, 0.99]),
        function!("ExactSum::add to nothing", f64, uniform, add, [0.45, 0.55]),
    ]
}

/// Eq. 1 as it stands.
fn two_logarithms(p: f64) -> f64 {
    -p * p.log2() - (1.0 - p) * (1.0 - p).log2()
}

/// What runs under valgrind: every argument so many times.
fn call(function: &Function, rounds: usize) {
    let mut state = 20261121_u64;
    let arguments: Vec<f64> = (0..COUNT)
        .map(|_| {
            state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
            (function.shape)(((state >> 11) as f64 + 0.5) / (1_u64 << 53) as f64)
        })
        .collect();
    for _ in 0..rounds {
        let mean = (function.calls)(&arguments) / COUNT as f64;
        let [least, most] = function.mean;
        assert!((least..=most).contains(&mean), "{}: a mean of {mean}", function.name);
    }
}

/// The instructions of a whole run of this program.
fn instructions(name: &str, rounds: usize) -> u64 {
    let program = std::env::current_exe().expect("this program");
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args(["call", name, &rounds.to_string()])
        .output()
        .expect("valgrind");
    let text = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.success(), "{text}");
    let collected = text.lines().find_map(|line| line.split_once("Collected : ")?.1.trim().parse().ok());
    collected.expect("what callgrind says at its end")
}

fn main() {
    let functions = functions();
    let arguments: Vec<String> = std::env::args().collect();
    if let [_, call_it, name, rounds] = arguments.as_slice()
        && call_it == "call"
    {
        let function = functions.iter().find(|function| function.name == name).expect("a name");
        call(function, rounds.parse().expect("a number"));
        return;
    }
    if let Err(error) = Command::new("valgrind").arg("--version").output() {
        eprintln!("skipped: valgrind, Debian's package of that name: {error}");
        return;
    }
    println!("| function | instructions a call |");
    println!("|---|---|");
    let mut nothing = 0.0;
    for Function { name, .. } in &functions {
        let calls = 4.0 * COUNT as f64;
        let a_call = (instructions(name, 5) - instructions(name, 1)) as f64 / calls - nothing;
        if name.starts_with("nothing") {
            // The loop.
            nothing = a_call.max(nothing);
        } else {
            println!("| `{name}` | {a_call:.0} |");
        }
    }
}
