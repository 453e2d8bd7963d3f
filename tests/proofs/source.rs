//! What the proofs quote: the statements and the constants of `src/rounded`.

use std::collections::BTreeMap;
use std::fs;

/// The functions and constants of `src/rounded`.
pub(crate) struct Source {
    /// All lines, trimmed.
    pub(crate) lines: Vec<String>,
    /// The statements of each function of `fixed.rs`, `approximate.rs`, `gaussian.rs`, `short_gaussian.rs` and `log_odds.rs`.
    pub(crate) functions: BTreeMap<String, Vec<String>>,
    /// Integer constants; the elements of an array are `NAME_0`, `NAME_1`, ....
    pub(crate) constants: BTreeMap<String, Integer>,
    /// The bounds on the errors of the polynomials, in units of their coefficients: tenths of a binary exponent.
    pub(crate) polynomial_errors: BTreeMap<String, i32>,
}

/// `m 2^e`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Integer {
    pub(crate) negative: bool,
    pub(crate) m: u128,
    pub(crate) e: u32,
}

impl Integer {
    /// Reads `m` or `m` `separator` `e`.
    pub(crate) fn read(text: &str, separator: &str) -> Option<Self> {
        let (magnitude, negative) = match text.trim().strip_prefix('-') {
            Some(rest) => (rest, true),
            None => (text.trim(), false),
        };
        let (m, e) = magnitude.split_once(separator).unwrap_or((magnitude, "0"));
        Some(Self { negative, m: m.trim().parse().ok()?, e: e.trim().parse().ok()? })
    }
}

impl Source {
    pub(crate) fn read() -> Self {
        let [fixed, approximate, gaussian, short_gaussian, log_odds, constants, round] =
            ["fixed", "approximate", "gaussian", "short_gaussian", "log_odds", "constants", "round"].map(
                |name| {
                    let text =
                        fs::read_to_string(format!("src/rounded/{name}.rs")).expect("the source is there");
                    text.split("#[cfg(test)]").next().expect("the code before its tests").to_owned()
                },
            );
        let quoted = [fixed, approximate, gaussian, short_gaussian, log_odds].join("\n");
        let all = [quoted.as_str(), &constants, &round].join("\n");
        let code = without_comments(&quoted);
        Self {
            lines: all.lines().map(|line| line.trim().to_owned()).collect(),
            functions: functions(&code),
            constants: all.split("const ").skip(1).flat_map(constants_of).collect(),
            polynomial_errors: constants.split("/// ").filter_map(polynomial_error).collect(),
        }
    }
}

pub(crate) fn without_comments(text: &str) -> String {
    text.lines().map(|line| line.split("//").next().unwrap_or("")).collect::<Vec<_>>().join("\n")
}

fn functions(code: &str) -> BTreeMap<String, Vec<String>> {
    let mut functions = BTreeMap::new();
    let texts: Vec<&str> = code.split("fn ").collect();
    for (before, text) in texts.iter().zip(&texts[1..]) {
        let name: String = text.chars().take_while(|&c| c.is_alphanumeric() || c == '_').collect();
        let body =
            text.split_once(") -> ").and_then(|(_, rest)| rest.split_once(" {\n")).expect("a function").1;
        // A method is indented, and so is its end.
        let line = before.rsplit('\n').next().unwrap_or("");
        let indent = &line[..line.len() - line.trim_start().len()];
        let body = body.split_once(&format!("\n{indent}}}")).expect("a function ends").0;
        functions.insert(name, statements(body));
    }
    functions
}

/// Cuts at each `;` outside of brackets; the last one, without `;`, is the value.
pub(crate) fn statements(body: &str) -> Vec<String> {
    let mut depth = 0;
    let mut statements = vec![String::new()];
    for c in body.chars() {
        depth += match c {
            '(' | '[' | '{' => 1,
            ')' | ']' | '}' => -1,
            _ => 0,
        };
        statements.last_mut().expect("never empty").push(c);
        if c == ';' && depth == 0 {
            statements.push(String::new());
        }
    }
    statements.iter().map(|statement| one_line(statement)).filter(|statement| !statement.is_empty()).collect()
}

/// The text with single spaces.
pub(crate) fn one_line(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ")
}

/// `NAME: type = value;` as constants; none for the tables.
fn constants_of(text: &str) -> Vec<(String, Integer)> {
    let Some((name, value)) = text.split_once(';').and_then(|(_, _)| text.split_once(": ")) else {
        return Vec::new();
    };
    let Some(value) = value.split_once('=').and_then(|(_, value)| value.split_once(';')) else {
        return Vec::new();
    };
    match value.0.trim().strip_prefix('[') {
        None => Integer::read(value.0, "<<").map(|value| (name.to_owned(), value)).into_iter().collect(),
        Some(elements) => {
            let elements = elements.trim_end_matches(']').split(',');
            let values = elements.filter_map(|element| Integer::read(element, "<<"));
            values.enumerate().map(|(i, value)| (format!("{name}_{i}"), value)).collect()
        }
    }
}

/// From "scale 63, error at most `2^-64.2`." and the name after it: 10 (63 - 64.2).
fn polynomial_error(text: &str) -> Option<(String, i32)> {
    let (before, after) = text.split_once(", error at most `2^-")?;
    let scale: i32 = before.rsplit_once("scale ")?.1.parse().ok()?;
    let (bound, after) = after.split_once('`')?;
    let (whole, tenth) = bound.split_once('.')?;
    let tenths: i32 = format!("{whole}{tenth}").parse().ok()?;
    let name = after.split_once("const ")?.1.split_once(':')?.0;
    Some((name.to_owned(), 10 * scale - tenths))
}
