//! The Gappa scripts of `proofs/` speak of this source: every statement they quote is there, every statement of a kernel is
//! quoted, every definition under a quotation is its translation, and every constant is the source's.
//!
//! `proofs/README.md` states the notation. That the scripts hold is for Gappa to say: `proofs/check.sh`.

mod expression;
mod lanes;
mod log_odds;
mod source;

use expression::{expressions, horner};
use source::{Integer, Source, one_line};
use std::collections::BTreeMap;
use std::fs;

/// Functions without a script of their own: they define the translation (`expression.rs`), only branch, or lose nothing.
const UNQUOTED: [&str; 20] = [
    "mul_high",
    "shift_right",
    "horner",
    "from_occupancy",
    "with_information_series",
    "distance_from_unknown",
    "is_small",
    "from_log_odds",
    "smaller_probability",
    "ln",
    "gaussian",
    "new",
    "gap",
    "ball",
    "log_odds_from_occupancy",
    "fixed_log_odds",
    "round_log_odds",
    "occupancy_from_fixed_log_odds",
    "magnitude",
    "is_above",
];

/// A quotation, and the definitions directly under it.
#[derive(Debug)]
struct Quotation {
    /// The function whose next statement it is; `None` for a fragment from anywhere.
    function: Option<String>,
    text: String,
    definitions: Vec<(String, String)>,
    /// Whether a comment follows.
    explained: bool,
}

fn scripts() -> BTreeMap<String, String> {
    let files = fs::read_dir("proofs").expect("the folder is there");
    let paths = files.map(|file| file.expect("readable").path());
    paths
        .filter(|path| path.extension().is_some_and(|extension| extension == "gappa"))
        .map(|path| {
            let name = path.file_name().expect("a file").to_string_lossy().into_owned();
            (name, fs::read_to_string(path).expect("readable"))
        })
        .collect()
}

/// The scripts of the kernels in integers: all but those of `lanes.rs`.
fn integer_scripts() -> BTreeMap<String, String> {
    scripts().into_iter().filter(|(name, _)| !lanes::is_of_lanes(name)).collect()
}

fn definition(line: &str) -> Option<(String, String)> {
    let (name, value) = line.strip_suffix(';')?.split_once(" = ")?;
    let is_name = name.chars().all(|c| c.is_alphanumeric() || c == '_');
    is_name.then(|| (name.to_owned(), value.to_owned()))
}

/// Whether a statement ends here.
fn is_complete(statement: &str) -> bool {
    statement.ends_with(';') && statement.matches('{').count() == statement.matches('}').count()
}

fn quotations(script: &str) -> Vec<Quotation> {
    let mut function = None;
    let mut quotations: Vec<Quotation> = Vec::new();
    let (mut quoting, mut defining) = (false, false);
    for line in script.lines().map(str::trim) {
        if let Some(name) = line.strip_prefix("#: fn ") {
            function = Some(name.to_owned());
            quoting = false;
        } else if let Some(text) = line.strip_prefix("#: ") {
            match quotations.last_mut().filter(|last| quoting && !is_complete(&last.text)) {
                Some(last) => last.text = one_line(&format!("{} {text}", last.text)),
                None => quotations.push(Quotation {
                    function: function.clone(),
                    text: one_line(text),
                    definitions: Vec::new(),
                    explained: false,
                }),
            }
            (quoting, defining) = (true, true);
        } else if let Some(text) = line.strip_prefix("#? ") {
            let text = text.trim().to_owned();
            quotations.push(Quotation { function: None, text, definitions: Vec::new(), explained: true });
            (quoting, defining) = (false, true);
        } else {
            if let (true, Some(definition), Some(last)) = (defining, definition(line), quotations.last_mut())
            {
                last.definitions.push(definition);
            } else {
                if let (true, Some(last)) = (defining, quotations.last_mut()) {
                    last.explained |= line.starts_with('#');
                }
                defining = false;
            }
            quoting = false;
        }
    }
    quotations
}

#[test]
fn the_scripts_quote_every_statement() {
    let source = Source::read();
    let mut quoted: BTreeMap<String, Vec<String>> = BTreeMap::new();
    let mut faults = Vec::new();
    for (name, script) in integer_scripts() {
        for quotation in quotations(&script) {
            match quotation.function {
                Some(function) => quoted.entry(function).or_default().push(quotation.text),
                None if source.lines.contains(&quotation.text) => {}
                None => faults.push(format!("{name}: not in the source: {}", quotation.text)),
            }
        }
    }
    for function in UNQUOTED {
        assert!(source.functions.contains_key(function) && !quoted.contains_key(function), "{function}");
    }
    for (function, statements) in &source.functions {
        let quoted = quoted.get(function);
        if !UNQUOTED.contains(&function.as_str()) && quoted != Some(statements) {
            faults.push(format!("fn {function}:\nthe scripts {quoted:#?}\nthe source {statements:#?}"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

#[test]
fn the_definitions_translate_their_quotations() {
    let source = Source::read();
    let (mut checked, mut faults) = (0, Vec::new());
    for (name, script) in integer_scripts() {
        for quotation in quotations(&script) {
            let text = &quotation.text;
            if !quotation.explained && quotation.definitions.is_empty() {
                faults.push(format!("{name}: neither defined nor explained: {text}"));
            }
            let whole = expressions(text);
            let parts: Vec<_> = whole.iter().flat_map(|expression| expression.parts()).collect();
            for (defined, value) in &quotation.definitions {
                let translated = match defined.strip_prefix("horner_") {
                    Some(coefficients) => parts
                        .iter()
                        .filter_map(|part| part.horner().filter(|&(name, ..)| name == coefficients))
                        .map(|(name, x, scale)| horner(name, count(&source, name), x, scale))
                        .collect(),
                    // `let defined = ...` defines it as all of the right side.
                    None if text.starts_with(&format!("let {defined} = ")) => vec![whole[0].gappa()],
                    None => parts.iter().map(|part| part.gappa()).collect::<Vec<_>>(),
                };
                if !translated.contains(value) {
                    let parts = format!("is not in {text}\nwhich is {translated:#?}");
                    faults.push(format!("{name}: {defined} = {value}\n{parts}"));
                }
                checked += 1;
            }
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(checked >= 60, "only {checked} definitions are under a quotation");
}

/// The number of elements of an array.
fn count(source: &Source, name: &str) -> usize {
    (0..source.constants.len()).take_while(|i| source.constants.contains_key(&format!("{name}_{i}"))).count()
}

#[test]
fn the_constants_are_those_of_the_source() {
    let source = Source::read();
    let mut faults = Vec::new();
    for (name, script) in integer_scripts() {
        for (constant, value) in script.lines().filter_map(definition) {
            if constant.chars().any(char::is_lowercase) {
                continue;
            }
            let expected =
                source.constants.get(&constant).unwrap_or_else(|| panic!("{name}: no constant {constant}"));
            if Integer::read(&value, "b").as_ref() != Some(expected) {
                faults.push(format!("{name}: {constant} = {value}, in the source {expected:?}"));
            }
        }
    }
    for error in source.constants.keys().filter(|name| name.ends_with("_ERROR")) {
        let goal = format!("/ {error}| <= 1");
        let proves =
            |script: &String| script.split_once("\n->").is_some_and(|(_, goals)| goals.contains(&goal));
        if !scripts().values().any(proves) {
            faults.push(format!("no script proves {error}"));
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// A line `|...| <= 1b43 # LOG_ERROR` in a script assumes what the constant, the polynomial or the other script states.
#[test]
fn the_assumptions_are_proved_elsewhere() {
    let source = Source::read();
    let scripts = integer_scripts();
    let (mut checked, mut faults) = (0, Vec::new());
    for (name, script) in &scripts {
        for line in script.lines() {
            let Some((assumption, reason)) =
                line.split_once("# ").filter(|(before, _)| before.contains("| <= "))
            else {
                continue;
            };
            let bound =
                assumption.split_once("| <= ").expect("just found").1.trim_end_matches([' ', ')', '/', '\\']);
            let holds = if let Some(tenths) = source.polynomial_errors.get(reason) {
                let bound: f64 = bound.parse().expect("a decimal number");
                let tenth_power = (0..10).fold(1.0, |power, _| power * bound);
                let certified =
                    (0..tenths.abs()).fold(1.0, |x, _| if *tenths < 0 { x / 2.0 } else { x * 2.0 });
                (certified..1.001 * certified).contains(&tenth_power)
            } else if let Some(other) = scripts.get(reason) {
                let goals = other.split_once("\n->").expect("a script has goals").1;
                goals.split("| <= ").skip(1).any(|goal| {
                    goal.split_whitespace().next().map(|first| first.trim_end_matches(')')) == Some(bound)
                })
            } else {
                let (constant, more) = reason.split_once(" + ").unwrap_or((reason, "0"));
                let Integer { m, e, .. } = source.constants[constant];
                let stated = Integer::read(bound, "b").expect("an integer");
                stated.m << stated.e == (m << e) + more.parse::<u128>().expect("an integer")
            };
            if !holds {
                faults.push(format!("{name}: {line}"));
            }
            checked += 1;
        }
    }
    assert!(faults.is_empty(), "{}", faults.join("\n"));
    assert!(checked >= 18, "only {checked} assumptions name their origin");
}
