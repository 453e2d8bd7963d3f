//! Every operation of the registry on its own vectors: the time of an answer.
//!
//! `cargo bench --bench operations --features vectors`.

#![allow(missing_docs)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use mean_information::Real;
use mean_information::operations::{Answer, Argument, OPERATIONS, Operation, Shape, Value};
use mean_information::vectors::FILES;
use mean_information_test_support::exact;
use serde_json::Value as Json;
use std::hint::black_box;

/// The tests of an operation in `f64` that have one right answer: arguments and answer, to a few digits.
fn tests(operation: &Operation) -> Vec<(Vec<Value<f64>>, f64)> {
    let (_, text) =
        FILES.iter().find(|(name, _)| *name == operation.name).expect("a file for each operation");
    let file: Json = serde_json::from_str(text).expect("JSON");
    let scalar = |x: &Json| x.as_str().and_then(exact::float::<f64>).expect("a hexadecimal float");
    let list = |x: &Json| x.as_array().expect("a list").iter().map(scalar).collect::<Vec<_>>();
    let value = |shape: Shape, x: &Json| match shape {
        Shape::Float => Value::Float(scalar(x)),
        Shape::List => Value::List(list(x)),
        Shape::Rows => Value::Rows(x.as_array().expect("rows").iter().map(list).collect()),
        other => panic!("no {} in the vectors", other.name()),
    };
    let tests = file["tests"].as_array().expect("tests").iter();
    tests
        .filter(|test| test["format"] == "f64" && test["also"].is_null())
        .filter_map(|test| {
            let want = &test["want"];
            let about = want["count"].as_f64().or_else(|| want["lo"].as_str()?.parse().ok())?;
            let of = |argument: &Argument| value(argument.shape, &test["args"][argument.name]);
            Some((operation.arguments.iter().map(of).collect(), about))
        })
        .take(256)
        .collect()
}

fn answer(operation: &Operation, arguments: &[Value<f64>]) -> f64 {
    match operation.run(arguments).expect("inside the domain") {
        Answer::Float(x) => x,
        Answer::Count(count) => count as f64,
        other => panic!("no number: {other:?}"),
    }
}

fn operations(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("operations");
    group.sample_size(10);
    for operation in OPERATIONS {
        let tests = tests(operation);
        for (arguments, about) in &tests {
            let found = answer(operation, arguments);
            let near = (found - about).abs() <= 1e-9 * about.abs() + f64::from_parts(2, f64::MIN_EXPONENT);
            assert!(near, "{} of {arguments:?}: {found:e}, not {about:e}", operation.name);
        }
        group.throughput(Throughput::Elements(tests.len() as u64));
        group.bench_function(operation.name, |bencher| {
            bencher.iter(|| {
                tests.iter().map(|(arguments, _)| answer(operation, black_box(arguments))).sum::<f64>()
            });
        });
    }
    group.finish();
}

criterion_group!(benches, operations);
criterion_main!(benches);
