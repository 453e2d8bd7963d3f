//! What a public docstring says of a result: how exact it is, where that comes from, and an example with a number.

use crate::{read, sources};

/// Words of which one tells how far a result may be from the exact one.
const EXACTNESS: [&str; 9] = [
    "orrectly rounded",
    "xact",
    " ulp",
    "within",
    "roved",
    "same bits",
    "the bits of",
    "rounded once",
    "claim",
];
/// Words of which one tells where a formula or its bound comes from.
const SOURCE: [&str; 6] = ["Eq.", "Eqs.", "crate::book::", "IEEE 754", "Theorem", "See [`"];
/// Types of results that are computed.
const RESULTS: [&str; 10] =
    ["T", "f64", "Float", "Tally", "Information", "Grid", "PolarMap", "Estimate", "Enclosure", "ExpectedMap"];

/// A public function.
struct Function {
    /// File and line.
    place: String,
    name: String,
    /// Its own docstring.
    doc: String,
    /// That of the `impl`'s type, where it stands in the same file.
    of_type: String,
    returns: String,
    body: String,
}

impl Function {
    /// A float, sums, a map or an integral, and not one that was handed in.
    fn computes(&self) -> bool {
        let words = self.returns.split(|c: char| !c.is_alphanumeric());
        let field = self.body.starts_with(['&', '[', 's']) && !self.body.replace("()", "").contains('(');
        let given = self.returns.starts_with('&') || field;
        !given && words.clone().any(|word| RESULTS.contains(&word))
    }
}

/// The public functions of a file. `pub` means reachable here: the lint `unreachable_pub` is on.
fn functions(file: &str, text: &str) -> Vec<Function> {
    let lines: Vec<_> = text.lines().collect();
    let doc_above = |at: usize| -> String {
        let above = lines[..at].iter().rev().map(|line| line.trim());
        let doc = above.take_while(|line| line.starts_with("///") || line.starts_with("#["));
        let mut doc: Vec<_> = doc.collect();
        doc.reverse();
        doc.join("\n")
    };
    let mut found = Vec::new();
    let mut of_type = String::new();
    for (at, line) in lines.iter().enumerate() {
        if line.starts_with("impl") {
            let head = line.trim_end_matches(" {").rsplit(" for ").next().unwrap();
            let name = head
                .trim_start_matches("impl")
                .split('>')
                .rev()
                .find(|part| !part.trim().is_empty())
                .unwrap();
            let name = name.split('<').next().unwrap().trim();
            let declared = lines.iter().position(|line| line.starts_with(&format!("pub struct {name}")));
            of_type = declared.map(doc_above).unwrap_or_default();
        }
        let Some((_, rest)) = line.split_once("pub fn ").or_else(|| line.split_once("pub const fn ")) else {
            continue;
        };
        let code = lines[at..].join("\n");
        let (signature, body) = code.split_once(" {\n").unwrap();
        let returns = signature.split_once("-> ").map_or("", |(_, returns)| returns);
        found.push(Function {
            place: format!("{file}:{}", at + 1),
            name: rest.split(['<', '(']).next().unwrap().to_owned(),
            doc: doc_above(at),
            of_type: of_type.clone(),
            returns: returns.split("\nwhere").next().unwrap().to_owned(),
            body: body.split("\n    }").next().unwrap().trim().to_owned(),
        });
    }
    found
}

#[test]
fn a_result_says_how_exact_it_is_and_why() {
    let (mut computed, mut faults) = (0, Vec::new());
    for file in sources("src").iter().map(|file| file.to_str().unwrap()) {
        let text = read(file);
        for function in functions(file, &text) {
            let Function { place, name, doc, of_type, returns, .. } = &function;
            let says = |words: &[&str]| words.iter().any(|word| doc.contains(word) || of_type.contains(word));
            let mut fault = |what: &str| faults.push(format!("{place} {name}: {what}"));
            if returns.contains("Result<") && !doc.contains("# Errors") {
                fault("no heading `# Errors`");
            }
            if function.computes() {
                computed += 1;
                if !says(&EXACTNESS) {
                    fault("how exact?");
                }
                if !says(&SOURCE) {
                    fault("from where?");
                }
                if !says(&["```"]) {
                    fault("no example");
                }
            }
        }
    }
    assert!(computed > 40, "{computed}");
    assert!(faults.is_empty(), "{} of {computed}:\n{}", faults.len(), faults.join("\n"));
}
