//! Ports that answer wrongly: the cause that is named first.

use super::Test;
use super::fixture::Vectors;

pub(crate) const TESTS: &[Test] = &[
    ("faults_are_named", faults_are_named),
    ("unreadable_answers_are_explained", unreadable_answers_are_explained),
    ("a_fault_of_one_test_is_found", a_fault_of_one_test_is_found),
];

/// Port, operation, kind and name of the first cause, what its note says, failures of the operation, and how many of
/// them it explains.
type Named = (&'static str, &'static str, &'static str, &'static str, &'static str, usize, u64);

const FAULTS: &[Named] = &[
    ("nats", "cell.information", "trap", "nats", "natural logarithms", 34, 34),
    ("counts-all", "map.observed", "trap", "all", "counts unknown cells", 2, 2),
    ("hartleys", "cell.information", "fact", "factor", "decimal logarithms", 34, 34),
    ("doubles", "cell.information", "fact", "factor", "2 times the exact result", 34, 34),
    ("entropy", "cell.information", "fact", "complement", "1 less", 34, 34),
    ("constant", "cell.information", "fact", "constant", "answers 0.625 whatever", 34, 34),
    ("nan", "cell.information", "fact", "nan", "NaN where there is a number", 40, 34),
    ("nan-for-domain", "cell.information", "fact", "nan-for-error", "\"domain\"", 6, 6),
    ("accepts", "cell.information", "fact", "accepts", "not checked", 6, 6),
    ("refuses-all", "cell.information", "fact", "refuses", "lie in the domain", 34, 34),
    ("other-word", "cell.information", "fact", "error", "\"ValueError\"", 6, 6),
    ("infinite", "cell.information", "fact", "infinite", "infinity", 34, 34),
    ("wrong-format", "cell.information", "fact", "not-of-format", "double precision", 17, 17),
    ("numbers", "cell.information", "fact", "unreadable", "hexadecimal float", 34, 34),
    ("integers", "cell.information", "fact", "unreadable", "hexadecimal float", 34, 34),
    ("text-count", "map.observed", "fact", "unreadable", "integer", 3, 3),
    ("single", "cell.information", "fact", "single-precision", "single precision", 17, 17),
    ("single-inside", "cell.information", "fact", "single-precision", "single precision", 17, 17),
    ("next", "cell.information", "fact", "rounding", "round once", 34, 34),
];

fn faults_are_named() {
    let vectors = Vectors::new();
    for &(fault, op, kind, name, note, failures, explained) in FAULTS {
        let json = vectors.json(fault, &[]);
        let operations = json["operations"].as_array().unwrap();
        let operation = operations.iter().find(|operation| operation["operation"] == op).unwrap();
        let cause = &operation["causes"][0];
        assert_eq!(
            (cause["kind"].as_str(), cause["name"].as_str()),
            (Some(kind), Some(name)),
            "{fault}: {operation:#}"
        );
        assert!(cause["note"].as_str().unwrap().contains(note), "{fault}: {cause}");
        let listed = operation["failures"].as_array().unwrap().len();
        assert_eq!((listed, cause["explained"].as_u64()), (failures, Some(explained)), "{fault}: {cause}");

        let (status, table) = vectors.check(fault, &["--ops", op]);
        assert_eq!(status, 1, "{fault}");
        let section = table.split(&format!("\n{op}: ")).nth(1).unwrap();
        assert!(section.lines().nth(1).unwrap().contains(note), "{fault}: {table}");
    }
}

/// What it should have been is told beside what was answered.
fn unreadable_answers_are_explained() {
    let vectors = Vectors::new();
    for (fault, op, part) in [
        ("numbers", "cell.information", ": a float is a hexadecimal float in a string, such as \"0x1.8p-2\""),
        ("text-count", "map.observed", "answered \"0x1p+0\": a count is a JSON integer, such as 3"),
    ] {
        let (_, table) = vectors.check(fault, &["--ops", op]);
        assert!(table.contains(part), "{fault}: {table}");
    }
}

fn a_fault_of_one_test_is_found() {
    let vectors = Vectors::new();
    let json = vectors.json("one-wrong", &[]);
    let operation = &json["operations"][0];
    assert_eq!((&json["failed"], &operation["worst_case"]), (&1.into(), &"test-7".into()));
    let failure = &operation["failures"][0];
    assert!(
        failure["error_ulp"].as_f64().unwrap() > 1e15
            && failure["request"].as_str().unwrap().contains("\"run\"")
    );
    let table = vectors.table("one-wrong", &[], "43 passed, 1 failed, 0 skipped");
    for part in ["worst: test-7", "p = 0x1.", "wanted from ", "answered 0x1.", " ulp off"] {
        assert!(table.contains(part), "{part}: {table}");
    }
}
