//! The list of operations: the page, the file for other languages and the vectors have the same one.

use crate::guarantees::guarantees;
use mean_information::Real;
use mean_information::operations::{Answer, OPERATIONS, Operation, Outcome, Refusal, Shape, Value, find};
use serde_json::{Value as Json, json};
use std::collections::HashSet;
use std::fs;
use std::path::Path;

#[test]
fn names_are_unique_and_found() {
    let names: HashSet<_> = OPERATIONS.iter().map(|operation| operation.name).collect();
    assert_eq!(names.len(), OPERATIONS.len());
    assert!(OPERATIONS.iter().all(|operation| find(operation.name) == Some(operation)));
}

#[test]
fn the_page_has_the_list() {
    let row = |operation: &Operation| {
        let arguments = operation.arguments.iter().map(|argument| match argument.shape {
            Shape::Float => argument.name.to_owned(),
            Shape::List => format!("{}[]", argument.name),
            Shape::Rows => format!("{}[][]", argument.name),
            other => panic!("how is a {} written?", other.name()),
        });
        let arguments = arguments.collect::<Vec<_>>().join(", ");
        let Operation { name, function, tolerance_ulp, .. } = operation;
        format!("| `{name}` | {arguments} | `{function}` | {tolerance_ulp} |")
    };
    let item = |Operation { name, equation, domain, .. }: &Operation| {
        format!("`{name}`: `{equation}`. Allowed: {domain}.")
    };
    let page = include_str!("../../docs/operations.md");
    let rows: Vec<_> = page.lines().filter(|line| line.starts_with("| `")).collect();
    assert_eq!(rows, OPERATIONS.iter().map(row).collect::<Vec<_>>());
    // Lines are broken anywhere between words.
    let items = page.split("\n* ").skip(1).filter_map(|item| item.split("\n\n").next());
    let items = items.map(|item| item.split_whitespace().collect::<Vec<_>>().join(" "));
    assert_eq!(items.collect::<Vec<_>>(), OPERATIONS.iter().map(item).collect::<Vec<_>>());
}

#[test]
fn the_file_for_other_languages_has_the_list() {
    let list: Vec<_> = OPERATIONS
        .iter()
        .map(|operation| {
            let argument = |argument: &mean_information::operations::Argument| {
                json!({"name": argument.name, "shape": argument.shape.name()})
            };
            json!({
                "name": operation.name,
                "arguments": operation.arguments.iter().map(argument).collect::<Vec<_>>(),
                "result": operation.result.name(),
                "domain": operation.domain,
                "equation": operation.equation,
                "function": operation.function,
                "tolerance_ulp": operation.tolerance_ulp,
            })
        })
        .collect();
    let file: Json = serde_json::from_str(include_str!("../../vectors/v1/operations.json")).expect("JSON");
    assert_eq!(file, Json::from(list));
}

#[test]
fn no_file_of_vectors_is_missing_or_forgotten() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("vectors/v1");
    let files = fs::read_dir(folder).expect("the vectors").map(|entry| entry.expect("an entry").file_name());
    let files: HashSet<_> =
        files.filter_map(|name| name.into_string().ok()?.strip_suffix(".json").map(str::to_owned)).collect();
    let names = OPERATIONS.iter().map(|operation| operation.name.to_owned()).chain(["operations".to_owned()]);
    assert_eq!(files, names.collect());
}

/// A function that promises less than a port must keep, or nothing, cannot be its reference.
#[test]
fn what_an_operation_asks_its_function_promises() {
    for operation in OPERATIONS.iter().filter(|operation| operation.result == Outcome::Float) {
        // A room's cells and an expected map's tally have their bounds in the text below the table.
        if ["PolarRoom::tally", "CartesianRoom::tally", "ExpectedMap::tally"].contains(&operation.function) {
            continue;
        }
        let guarantee = guarantees().into_iter().find(|guarantee| guarantee.function == operation.function);
        let guarantee = guarantee.unwrap_or_else(|| panic!("{} promises nothing", operation.function));
        assert!(guarantee.ulps <= operation.tolerance_ulp, "{}", operation.name);
    }
}

/// Arguments inside the domain of every operation, and the answer in whole thousandths.
fn answers<T: Real>() {
    let float = |x: f64| Value::Float(T::nearest(x));
    let list = |x: &[f64]| Value::List(x.iter().map(|&x| T::nearest(x)).collect());
    let rows = |rows: [&[f64]; 2]| {
        Value::Rows(rows.map(|row| row.iter().map(|&x| T::nearest(x)).collect()).to_vec())
    };
    let cells = || list(&[0.25, 0.5, 0.875]);
    let room = || vec![float(2.0), float(0.25)];
    let with_room = |rest: &[f64]| room().into_iter().chain(rest.iter().map(|&x| float(x))).collect();
    let cases: Vec<(&str, Vec<Value<T>>, i64)> = vec![
        ("cell.entropy", vec![float(0.25)], 811),
        ("cell.information", vec![float(0.25)], 189),
        ("cell.entropy_from_log_odds", vec![float(-3.0)], 275),
        ("cell.information_from_log_odds", vec![float(-3.0)], 725),
        ("cell.occupancy_from_log_odds", vec![float(-3.0)], 47),
        ("map.entropy", vec![cells()], 2355),
        ("map.information", vec![cells()], 645),
        ("map.mean_information", vec![cells()], 323),
        ("sensor.occupancy", vec![float(1.75), float(2.0), float(0.25)], 607),
        ("fuse.log_odds", vec![cells()], 700),
        ("expected.mean_information", vec![list(&[3.0, 5.0]), rows([&[0.125, 0.5], &[0.25, 0.5]])], 272),
        ("limit.radial", room(), 743),
        ("limit.area", room(), 596),
        ("grid.polar.mean_information", with_room(&[0.125]), 757),
        ("grid.cartesian.mean_information", with_room(&[0.125, 0.5, 0.25]), 595),
    ];
    let mut missing: HashSet<_> = OPERATIONS.iter().map(|operation| operation.name).collect();
    for (name, arguments, thousandths) in cases {
        let operation = find(name).expect("in the list");
        match operation.run(&arguments) {
            Ok(Answer::Float(x)) => assert_eq!((x.widen() * 1e3).round() as i64, thousandths, "{name}"),
            other => panic!("{name}: {other:?}"),
        }
        missing.remove(name);
        refuses(operation, &arguments);
    }
    let observed = find("map.observed").expect("in the list");
    assert_eq!(observed.run(&[cells()]), Ok(Answer::Count(2)));
    refuses(observed, &[cells()]);
    assert_eq!(missing, HashSet::from(["map.observed"]));
}

/// NaN in the place of any number is outside the domain; a list for a float, or one argument too many, is a mistake of form.
fn refuses<T: Real>(operation: &Operation, arguments: &[Value<T>]) {
    for k in 0..arguments.len() {
        let mut bad = arguments.to_vec();
        match &mut bad[k] {
            Value::Float(x) => *x = T::nan(),
            Value::List(list) => list[1] = T::nan(),
            Value::Rows(rows) => rows[1][1] = T::nan(),
            other => panic!("where is the number in {other:?}?"),
        }
        assert!(matches!(operation.run(&bad), Err(Refusal::Domain(_))), "{}, argument {k}", operation.name);
        bad[k] = match bad[k] {
            Value::Float(x) => Value::List(vec![x]),
            _ => Value::Float(T::HALF),
        };
        assert_eq!(operation.run(&bad), Err(Refusal::Arguments), "{}, argument {k}", operation.name);
    }
    let more = [arguments, &[Value::Float(T::HALF)]].concat();
    assert_eq!(operation.run(&more), Err(Refusal::Arguments), "{}", operation.name);
}

#[test]
fn every_operation_answers_in_both_formats_and_refuses_what_is_not_its_own() {
    answers::<f32>();
    answers::<f64>();
}

#[test]
fn edges_of_the_domains() {
    let run = |name: &str, arguments: &[Value<f64>]| find(name).expect("in the list").run(arguments);
    let list = |x: &[f64]| Value::List(x.to_vec());
    for name in ["map.entropy", "map.information", "map.mean_information"] {
        assert_eq!(run(name, &[list(&[])]), Ok(Answer::Float(0.0)), "{name}");
    }
    assert_eq!(run("fuse.log_odds", &[list(&[])]), Ok(Answer::Float(0.5)));
    assert!(matches!(run("fuse.log_odds", &[list(&[0.0, 1.0])]), Err(Refusal::Domain(_))));
    let expected = |weights: &[f64], rows: &[&[f64]]| {
        let rows = rows.iter().map(|row| row.to_vec()).collect();
        run("expected.mean_information", &[list(weights), Value::Rows(rows)])
    };
    assert_eq!(expected(&[2.0, 3.0], &[&[], &[]]), Ok(Answer::Float(0.0)));
    for (weights, rows) in [
        (&[][..], &[][..]),
        (&[2.0], &[&[0.25][..], &[0.75]]),
        (&[2.0, 0.5], &[&[0.25], &[0.75, 0.5]]),
        (&[0.0, 0.0], &[&[0.25], &[0.75]]),
        (&[2.0, -0.5], &[&[0.25], &[0.75]]),
    ] {
        assert!(matches!(expected(weights, rows), Err(Refusal::Domain(_))), "{weights:?} {rows:?}");
    }
    let room = |x: [f64; 5]| run("grid.cartesian.mean_information", &x.map(Value::Float));
    assert!(matches!(room([2.0, 0.25, 1e-9, 0.5, 0.5]), Err(Refusal::TooLarge(_))));
    assert!(matches!(room([1e308, 1e308, 0.25, 0.5, 0.5]), Err(Refusal::TooLarge(_))));
    assert!(matches!(room([2.0, 0.25, 0.25, f64::INFINITY, 0.5]), Err(Refusal::Domain(_))));
}

#[test]
fn a_refusal_says_why() {
    let refusal = find("cell.entropy").unwrap().run(&[Value::Float(1.5_f64)]).unwrap_err();
    let Refusal::Domain(error) = &refusal else { panic!("{refusal:?}") };
    assert_eq!(refusal.to_string(), error.to_string());
    assert_eq!(Refusal::Arguments.to_string(), "not the arguments of this operation");
}
