//! What a public docstring says of a result: how exact it is, where that comes from, and an example with a number.

use crate::markdown::rows;
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
/// Words of which one tells where a formula or its bound comes from, in the docstring of the function or its type.
const SOURCE: [&str; 6] = ["Eq.", "Eqs.", "crate::book::", "IEEE 754", "Theorem", "See [`"];
/// Types of results that are computed.
const RESULTS: [&str; 13] = [
    "T",
    "S",
    "f64",
    "Float",
    "Self",
    "Tally",
    "InformationSum",
    "Interval",
    "Grid",
    "PolarMap",
    "Estimate",
    "Enclosure",
    "ExpectedMap",
];

/// Words with which a sentence leaves open who does what.
const RIDDLES: [&str; 26] = [
    "And", "As", "By", "Does", "For", "From", "Has", "How", "In", "Is", "It", "Its", "Not", "Of", "So",
    "That", "This", "Those", "Thus", "Was", "What", "Where", "Whether", "Which", "Whose", "With",
];

/// A public function, or one of a public trait.
struct Function {
    /// File and line.
    place: String,
    /// With its type or trait, as in `Tally::entropy`, or with its module.
    name: String,
    doc: String,
    /// That of its type or trait.
    of_type: String,
    /// Whether its contract is elsewhere: it implements a trait, or its trait is sealed, for bounds and not for calls.
    inherited: bool,
    arguments: String,
    returns: String,
    body: String,
}

impl Function {
    /// A float, sums, a map or an integral, and not one that was handed in.
    fn computes(&self) -> bool {
        let mut words = self.returns.split(|c: char| !c.is_alphanumeric());
        let field = self.body.starts_with(['&', '[', 's']) && !self.body.contains(['(', '/']);
        let given = self.returns.starts_with('&') || field || self.name.ends_with("::new");
        !self.inherited && !given && !self.arguments.is_empty() && words.any(|word| RESULTS.contains(&word))
    }

    /// In its own example, or in that of its type.
    fn is_shown(&self) -> bool {
        let name = self.name.rsplit("::").next().unwrap();
        let called = [format!(".{name}("), format!("::{name}("), format!(".{name}::<")];
        self.doc.contains("```") || called.iter().any(|call| self.of_type.contains(call))
    }
}

/// What a function stands in.
#[derive(Clone, Copy, PartialEq)]
enum Block {
    Free,
    Own,
    Trait,
    OfTrait,
}

/// The public functions of a file. `pub` means reachable here: the lint `unreachable_pub` is on.
fn functions(file: &str, text: &str) -> Vec<Function> {
    let lines: Vec<_> = text.lines().collect();
    let doc_above = |at: usize| -> String {
        let above = lines[..at].iter().rev().map(|line| line.trim());
        let mut doc: Vec<_> =
            above.take_while(|line| line.starts_with("///") || line.starts_with("#[")).collect();
        doc.reverse();
        doc.join("\n")
    };
    let module = file.trim_end_matches(".rs").trim_end_matches("/mod").rsplit('/').next().unwrap();
    let free = (module.to_owned(), String::new(), Block::Free);
    let (mut of, mut of_type, mut block) = free.clone();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        if line.starts_with("impl") || line.starts_with("pub trait ") {
            (of, block) = match line.strip_prefix("pub trait ") {
                Some(rest) => (first_word(rest).to_owned(), Block::Trait),
                None if line.contains(" for ") => (implemented(line).to_owned(), Block::OfTrait),
                None => (implemented(line).to_owned(), Block::Own),
            };
            let heads = ["struct", "trait"].map(|kind| format!("pub {kind} {of}"));
            let declared = lines.iter().position(|line| heads.iter().any(|head| line.starts_with(head)));
            of_type = declared.map(doc_above).unwrap_or_default();
        } else if *line == "}" {
            (of, of_type, block) = free.clone();
        }
        let of_trait =
            line.strip_prefix("    fn ").filter(|_| [Block::Trait, Block::OfTrait].contains(&block));
        let public =
            || line.trim_start().strip_prefix("pub ")?.trim_start_matches("const ").strip_prefix("fn ");
        let Some(rest) = of_trait.or_else(public) else { continue };
        let code = lines[at..].join("\n");
        let (signature, body) = [" {\n", ";\n"]
            .iter()
            .filter_map(|end| code.split_once(end))
            .min_by_key(|(signature, _)| signature.len())
            .unwrap();
        let (arguments, returns) = signature.split_once("-> ").unwrap_or((signature, ""));
        let returns = returns.split("\nwhere").next().unwrap();
        found.push(Function {
            place: format!("{file}:{}", at + 1),
            name: format!("{of}::{}", first_word(rest)),
            doc: doc_above(at),
            of_type: of_type.clone(),
            inherited: block == Block::OfTrait || of_type.contains("/// Sealed"),
            arguments: arguments.split_once('(').unwrap().1.trim_end_matches([' ', ')']).to_owned(),
            returns: if block == Block::Trait { returns.to_owned() } else { returns.replace("Self", &of) },
            body: body.split("\n    }").next().unwrap().trim().to_owned(),
        });
    }
    found
}

fn first_word(text: &str) -> &str {
    text.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap()
}

/// The type of an `impl`.
fn implemented(line: &str) -> &str {
    let head = line.trim_start_matches("impl").rsplit(" for ").next().unwrap();
    // Past the parameters, `<T: Real>`.
    let mut depth = 0;
    let start = head.find(|c| {
        depth += i32::from(c == '<') - i32::from(c == '>');
        depth == 0 && c != '>' && c != ' '
    });
    first_word(&head[start.unwrap()..])
}

/// Every public function of the library.
fn all() -> Vec<Function> {
    sources("src").iter().flat_map(|file| functions(file.to_str().unwrap(), &read(file))).collect()
}

/// The public items of a file with the first lines of their docstrings: place, whether it is a function, the line. Those
/// of a public trait, of a public enum and of the implementation of a trait are public with it.
fn openings<'a>(file: &str, text: &'a str) -> Vec<(String, bool, &'a str)> {
    let lines: Vec<_> = text.lines().collect();
    let (mut inherited, mut found) = (false, Vec::new());
    for (at, line) in lines.iter().enumerate() {
        if !line.starts_with([' ', '/', '#']) {
            let is_impl = line.starts_with("impl") && line.contains(" for ");
            inherited = is_impl || ["pub trait ", "pub enum "].iter().any(|kind| line.starts_with(kind));
        }
        let is_doc = |line: &str| line.trim_start().starts_with("///");
        let Some(opening) = line.trim_start().strip_prefix("/// ") else { continue };
        if at > 0 && is_doc(lines[at - 1]) {
            continue;
        }
        let below = lines[at..].iter().map(|line| line.trim_start());
        let Some(item) = below.into_iter().find(|line| !line.starts_with(['/', '#'])) else { continue };
        let public = item.strip_prefix("pub ");
        if public.is_some() || inherited && line.starts_with(' ') {
            let item = public.unwrap_or(item).trim_start_matches("const ").trim_start_matches("unsafe ");
            found.push((format!("{file}:{}", at + 1), item.starts_with("fn "), opening));
        }
    }
    found
}

/// Whether a sentence begins with a verb in the third person and has an object: "Creates an empty histogram."
fn begins_with_a_verb(sentence: &str) -> bool {
    let mut words = sentence.split(' ');
    let (verb, next) = (words.next().unwrap(), words.next().unwrap_or("of"));
    let is_word =
        verb.starts_with(|c: char| c.is_ascii_uppercase()) && verb.chars().skip(1).all(char::is_lowercase);
    is_word && verb.ends_with('s') && !RIDDLES.contains(&verb) && !["of", "that", "along"].contains(&next)
}

/// Whether a sentence leaves out its subject: "Of no cells."
fn is_a_riddle(sentence: &str) -> bool {
    RIDDLES.contains(&sentence.split([' ', ',']).next().unwrap())
}

/// A function does something: "Returns the side of a cell." Anything else is something: "The side of a cell."
#[test]
fn a_docstring_begins_with_a_verb_or_names_its_object() {
    let files = ["src", "crates"].into_iter().flat_map(sources).map(|file| file.to_str().unwrap().to_owned());
    let (mut count, mut faults) = (0, Vec::new());
    for file in files {
        for (place, is_function, opening) in openings(&file, &read(&file)) {
            count += 1;
            if if is_function { !begins_with_a_verb(opening) } else { is_a_riddle(opening) } {
                faults.push(format!("{place}: {opening}"));
            }
        }
    }
    assert!(count > 800, "{count}");
    assert!(faults.is_empty(), "{} of {count}:\n{}", faults.len(), faults.join("\n"));
}

#[test]
fn a_riddle_is_no_sentence() {
    let verbs =
        ["Creates an empty histogram.", "Returns whether both ends are finite.", "Adds `count` equal cells."];
    assert!(verbs.into_iter().all(begins_with_a_verb));
    let riddles = [
        "That of no cells.",
        "Does it.",
        "Columns.",
        "IndexCounts some pixels.",
        "Its name.",
        "As many as there are.",
        "Cells along a beam.",
    ];
    assert!(!riddles.into_iter().any(begins_with_a_verb));
    assert!(
        ["Of no cells.", "That of no cells.", "What is read.", "From the file."].into_iter().all(is_a_riddle)
    );
    assert!(!["Columns.", "The cells.", "No answer in time."].into_iter().any(is_a_riddle));
}

#[test]
fn a_result_says_how_exact_it_is_and_why() {
    let (mut computed, mut faults) = (0, Vec::new());
    for function in all() {
        let Function { place, name, doc, .. } = &function;
        let says = |words: &[&str]| words.iter().any(|word| doc.contains(word));
        let of_type = |words: &[&str]| words.iter().any(|word| function.of_type.contains(word));
        let mut fault = |what: &str| faults.push(format!("{place} {name}: {what}"));
        if !function.inherited && function.returns.contains("Result<") && !says(&["# Errors"]) {
            fault("no heading `# Errors`");
        }
        if function.computes() {
            computed += 1;
            if !says(&EXACTNESS) {
                fault("how exact?");
            }
            if !says(&SOURCE) && !of_type(&SOURCE) {
                fault("from where?");
            }
            if !function.is_shown() {
                fault("no example");
            }
        }
    }
    assert!(computed > 40, "{computed}");
    assert!(faults.is_empty(), "{} of {computed}:\n{}", faults.len(), faults.join("\n"));
}

/// The table of guarantees and the docstrings give the same bounds.
#[test]
fn a_guarantee_is_in_the_docstring() {
    let page = read("docs/guarantees.md");
    let (page, _) = page.split_once("<!-- end -->").unwrap();
    let functions = all();
    for row in rows(page) {
        let function = row[0].trim_matches('`');
        let Some((of, name)) = function.split_once("::") else { continue };
        // A module is that of the file, or of its folder.
        let is_it = |known: &&Function| {
            let in_module = known.place.starts_with(&format!("src/{of}")) && known.of_type.is_empty();
            known.name == function || known.name.ends_with(&format!("::{name}")) && in_module
        };
        let known = functions.iter().find(is_it).unwrap_or_else(|| panic!("{function}: where?"));
        let words: &[&str] = match row[2] {
            "0 ulp" => &["lies between", "contain", "enclos"],
            "0.5 ulp" => &["orrectly rounded", "rounded once"],
            bound => &[bound],
        };
        assert!(
            words.iter().any(|word| known.doc.contains(word)),
            "{}: {function}: not {}",
            known.place,
            row[2]
        );
    }
}

/// Whether a docstring says "within 1.5 ulp" or "at most 2 ulp".
fn states_a_bound(doc: &str) -> bool {
    let words: Vec<_> = doc.split_whitespace().filter(|&word| word != "///").collect();
    words.windows(3).any(|words| {
        ["within", "most"].contains(&words[0])
            && words[1].parse::<f64>().is_ok()
            && words[2].starts_with("ulp")
    })
}

/// And the page has the bound of each docstring, in a row or in words about the function or its type.
#[test]
fn a_bound_in_a_docstring_is_on_the_page() {
    let page = read("docs/guarantees.md");
    let (mut count, mut faults) = (0, Vec::new());
    for Function { place, name, of_type, .. } in all().iter().filter(|function| states_a_bound(&function.doc))
    {
        count += 1;
        let (of, function) = name.split_once("::").unwrap();
        let free = of_type.is_empty() && page.contains(&format!("::{function}`"));
        if !free && !page.contains(&format!("`{name}`")) && !page.contains(&format!("`{of}`")) {
            faults.push(format!("{place} {name}"));
        }
    }
    assert!(count >= 12, "{count}");
    assert!(faults.is_empty(), "{faults:#?}");
}

/// Clippy reads no examples: a function that it forbids may not stand there either, in the place of one of `Scalar`.
#[test]
fn an_example_calls_no_function_that_is_forbidden() {
    let list = read("clippy.toml");
    let forbidden = list.lines().filter_map(|line| line.trim().strip_prefix("\"f64::")?.strip_suffix("\","));
    let calls: Vec<_> = forbidden.flat_map(|name| ["f32", "f64"].map(|f| format!("_{f}.{name}("))).collect();
    assert!(calls.len() > 40);
    let mut faults = Vec::new();
    for file in sources("src") {
        for (k, line) in read(&file).lines().enumerate() {
            if line.trim_start().starts_with("//") && calls.iter().any(|call| line.contains(call)) {
                faults.push(format!("{}:{}: {line}", file.display(), k + 1));
            }
        }
    }
    assert!(faults.is_empty(), "{faults:#?}");
}
