//! The battery of the adaptive quadrature by this crate and by others: claimed and true errors, and what they cost.
//!
//!     cargo run --release --manifest-path benches/comparison/Cargo.toml            the summary, as in RESULTS.md
//!     cargo run --release --manifest-path benches/comparison/Cargo.toml -- all     every case as well
//!
//! GSL, Boost and SciPy's QUADPACK run where the machine has them (Debian: `libgsl-dev`, `libboost-math-dev`; `PYTHON`
//! names an interpreter with SciPy).

use mean_information_test_support::battery::{self, Case};
use mean_information::Real;
use mean_information::estimate::Status;
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use std::cell::Cell;
use std::panic::{AssertUnwindSafe, catch_unwind};

mod peers;

/// The most evaluations, for those that take a limit.
const LIMIT: usize = 200_000;

/// What a method says of an integral.
struct Said {
    value: f64,
    claim: f64,
    /// Whether it says that it is done.
    done: bool,
}

/// A way to integrate between points to a relative tolerance; nothing if it gives no value.
struct Method {
    name: String,
    integrate: Box<dyn Fn(&Case, &dyn Fn(f64) -> f64, &[f64], f64) -> Option<Said>>,
}

fn ours<T: Real>(rule: Rule, f: impl FnMut(T) -> T, points: &[f64], tolerance: f64) -> Option<Said> {
    let points: Vec<T> = points.iter().map(|&x| T::nearest(x)).collect();
    let settings = GaussKronrod::new().rule(rule).relative(T::nearest(tolerance)).limit(LIMIT as u64);
    let estimate = settings.integrate_between(f, &points).expect("good settings");
    let done = estimate.status == Status::Converged;
    let finite = !matches!(estimate.status, Status::NotFinite { .. });
    finite.then(|| Said { value: estimate.value.widen(), claim: estimate.error.widen(), done })
}

fn bilby(f: &dyn Fn(f64) -> f64, points: &[f64], tolerance: f64) -> Option<Said> {
    let integrator =
        bilby::AdaptiveIntegrator::default().with_abs_tol(0.0).with_rel_tol(tolerance).with_max_evals(LIMIT);
    let [from, breaks @ .., to] = points else { return None };
    let result = integrator.integrate_with_breaks(*from, *to, breaks, f).ok()?;
    Some(Said { value: result.value, claim: result.error_estimate, done: result.converged })
}

fn gkquad(f: &dyn Fn(f64) -> f64, points: &[f64], tolerance: f64) -> Option<Said> {
    let [from, breaks @ .., to] = points else { return None };
    let result = gkquad::single::Integrator::new(f)
        .tolerance(gkquad::Tolerance::Relative(tolerance))
        .max_iters(LIMIT / 42)
        .points(breaks)
        .run(*from..*to);
    let (value, claim) = result.estimate_delta().ok()?;
    Some(Said { value, claim, done: true })
}

struct Problem<'a>(&'a dyn Fn(f64) -> f64);

impl quad_rs::Integrable for Problem<'_> {
    type Float = f64;
    type Input = f64;
    type Output = f64;

    fn integrand(&self, x: &f64) -> f64 {
        (self.0)(*x)
    }
}

fn quad_rs(f: &dyn Fn(f64) -> f64, points: &[f64], tolerance: f64) -> Option<Said> {
    let settings = quad_rs::IntegratorConfig::default()
        .with_absolute_tolerance(0.0)
        .with_relative_tolerance(tolerance)
        .with_max_function_evalutions(LIMIT);
    let result = quad_rs::integrate_real(Problem(f), points.to_vec(), settings).ok()?;
    Some(Said { value: result.integral, claim: result.error, done: true })
}

/// Takes no break points and an absolute tolerance: one call between two points, with the tolerance that the value
/// allows.
fn quadrature(case: &Case, f: &dyn Fn(f64) -> f64, points: &[f64], tolerance: f64) -> Option<Said> {
    let target = tolerance * case.value().abs() / (points.len() - 1) as f64;
    let mut said = Said { value: 0.0, claim: 0.0, done: true };
    for ends in points.windows(2) {
        let output = quadrature::integrate(f, ends[0], ends[1], target);
        said.value += output.integral;
        said.claim += output.error_estimate;
        said.done &= output.error_estimate <= target;
    }
    Some(said)
}

fn methods() -> Vec<Method> {
    let mut methods: Vec<Method> = Rule::ALL
        .iter()
        .map(|&rule| Method {
            name: format!("ours, {rule:?}"),
            integrate: Box::new(move |_, f, points, tolerance| ours(rule, f, points, tolerance)),
        })
        .collect();
    let mut add = |name: &str, integrate: fn(&dyn Fn(f64) -> f64, &[f64], f64) -> Option<Said>| {
        methods.push(Method {
            name: name.to_owned(),
            integrate: Box::new(move |_, f, points, tolerance| integrate(f, points, tolerance)),
        });
    };
    add("bilby 0.3.0", bilby);
    add("gkquad 0.0.4", gkquad);
    add("quad-rs 0.5.0", quad_rs);
    methods.push(Method { name: "quadrature 0.1.2".to_owned(), integrate: Box::new(quadrature) });
    for (name, peer) in peers::all() {
        methods.push(Method {
            name: name.to_owned(),
            integrate: Box::new(move |_, f, points, tolerance| peer.integrate(f, points, tolerance).ok()),
        });
    }
    methods
}

/// What came of one case.
struct Outcome {
    said: Option<Said>,
    error: f64,
    evaluations: u64,
}

impl Outcome {
    fn of(method: &Method, case: &Case, tolerance: f64, told: bool) -> Self {
        let ends = [case.points[0], case.points[case.points.len() - 1]];
        let points = if told { &case.points[..] } else { &ends[..] };
        let integrand = case.integrand::<f64>();
        let evaluations = Cell::new(0);
        let counted = |x: f64| {
            evaluations.set(evaluations.get() + 1);
            integrand(x)
        };
        // Some peers panic on values that are not finite.
        let said = catch_unwind(AssertUnwindSafe(|| (method.integrate)(case, &counted, points, tolerance)));
        let said = said.ok().flatten().filter(|said| !said.value.is_nan());
        let error = said.as_ref().map_or(f64::NAN, |said| case.error(said.value));
        Self { said, error, evaluations: evaluations.get() }
    }

    /// Whether the claim is below the truth. One that forgets rounding is forgiven four units of the last place.
    fn is_below(&self, case: &Case) -> bool {
        let forgiven = 4.0 * f64::EPSILON * case.value().abs();
        self.said.as_ref().is_some_and(|said| said.claim.is_nan() || self.error > said.claim + forgiven)
    }

    fn is_done(&self) -> bool {
        self.said.as_ref().is_some_and(|said| said.done)
    }

    fn is_right(&self, case: &Case, tolerance: f64) -> bool {
        self.error <= tolerance * case.value().abs()
    }

    fn print(&self, name: &str, case: &Case) {
        let family = format!("{} {:?}", case.family, case.parameters());
        let Some(said) = &self.said else {
            println!("| {family} | {name} | none | | | {} |", self.evaluations);
            return;
        };
        let not_done = if said.done { "" } else { ", not done" };
        let below = if self.is_below(case) { ", **below**" } else { "" };
        println!(
            "| {family} | {name} | {:.16e}{not_done} | {:.1e}{below} | {:.1e} | {} |",
            said.value, said.claim, self.error, self.evaluations
        );
    }
}

/// The cases that are hard in different ways.
const HARD: [(&str, usize); 9] = [
    ("quadpack-1", 0),
    ("quadpack-2", 20),
    ("quadpack-3", 10),
    ("quadpack-4", 0),
    ("quadpack-6", 19),
    ("runge-scaled", 5),
    ("gaussian-on-slope", 2),
    ("room-t", 4),
    ("room-rho", 1),
];

const HEAD: &str =
    "| case | method | value | claimed error | true error | evaluations |\n|---|---|---|---|---|---|";

fn main() {
    let all = std::env::args().nth(1).is_some_and(|argument| argument == "all");
    std::panic::set_hook(Box::new(|_| {}));
    let (cases, methods) = (battery::cases(), methods());
    let settings = [1e-3, 1e-6, 1e-10, 1e-13].map(|tolerance| [(tolerance, true), (tolerance, false)]);
    for (tolerance, told) in settings.concat() {
        let outcomes: Vec<Vec<Outcome>> = methods
            .iter()
            .map(|method| cases.iter().map(|case| Outcome::of(method, case, tolerance, told)).collect())
            .collect();
        let by_all: Vec<usize> = (0..cases.len())
            .filter(|&k| outcomes.iter().all(|of| of[k].is_done() && of[k].is_right(&cases[k], tolerance)))
            .collect();
        let given = if told { "given" } else { "not given" };
        println!("\n## Relative tolerance {tolerance:e}, break points {given}\n");
        println!(
            "| method | claim below truth | of these, done | done, beyond the tolerance | done | no value | \
             evaluations | of these, in the {} that all do |\n|---|---|---|---|---|---|---|---|",
            by_all.len()
        );
        for (method, outcomes) in methods.iter().zip(&outcomes) {
            let count = |holds: &dyn Fn(&Outcome, &Case) -> bool| {
                outcomes.iter().zip(&cases).filter(|(outcome, case)| holds(outcome, case)).count()
            };
            println!(
                "| {} | {} | {} | {} | {} | {} | {} | {} |",
                method.name,
                count(&|outcome, case| outcome.is_below(case)),
                count(&|outcome, case| outcome.is_below(case) && outcome.is_done()),
                count(&|outcome, case| outcome.is_done() && !outcome.is_right(case, tolerance)),
                count(&|outcome, _| outcome.is_done()),
                count(&|outcome, _| outcome.said.is_none()),
                outcomes.iter().map(|outcome| outcome.evaluations).sum::<u64>(),
                by_all.iter().map(|&k| outcomes[k].evaluations).sum::<u64>(),
            );
        }
        if all || (told && tolerance == 1e-10) {
            println!("\n{HEAD}");
            for (k, case) in cases.iter().enumerate() {
                let place = cases[..k].iter().filter(|other| other.family == case.family).count();
                if all || HARD.contains(&(case.family, place)) {
                    for (method, outcomes) in methods.iter().zip(&outcomes) {
                        if all || !method.name.starts_with("ours") || method.name.ends_with("K21") {
                            outcomes[k].print(&method.name, case);
                        }
                    }
                }
            }
        }
    }
    println!("\n## This crate in f32\n");
    println!(
        "| method | relative tolerance | claim below truth | infinite claim | done | no value | evaluations |"
    );
    println!("|---|---|---|---|---|---|---|");
    for &rule in Rule::ALL {
        for tolerance in [1e-2, 1e-4, 1e-6] {
            in_f32(rule, tolerance, &cases);
        }
    }
}

fn in_f32(rule: Rule, tolerance: f64, cases: &[Case]) {
    let [mut below, mut infinite, mut done, mut nothing, mut evaluations] = [0; 5];
    for case in cases {
        let integrand = case.integrand::<f32>();
        let counted = |x: f32| {
            evaluations += 1;
            integrand(x)
        };
        let Some(said) = ours(rule, counted, &case.points, tolerance) else {
            nothing += 1;
            continue;
        };
        below += u64::from(case.error(said.value) > said.claim);
        infinite += u64::from(said.claim.is_infinite());
        done += u64::from(said.done);
    }
    println!(
        "| ours, {rule:?} | {tolerance:e} | {below} | {infinite} | {done} | {nothing} | {evaluations} |"
    );
}
