//! Every equation of the report and every theorem is executed in its section.
//!
//! The code names what it executes, `Eq. 3` or `Theorem (no ties)`, in a comment; an `assert` follows in the same
//! block, on that line or before the next that names something.

use crate::book::{chapter, chapters};
use crate::markdown::{Line, lines, sections};
use std::collections::{BTreeMap, BTreeSet};

const KINDS: [&str; 4] = ["Theorem", "Lemma", "Proposition", "Corollary"];

/// The equations and theorems that a line of code names.
fn named(line: &str) -> Vec<String> {
    let Some((_, comment)) = line.split_once("//") else { return Vec::new() };
    let equation = |rest: &str| {
        let digits: String = rest.chars().take_while(char::is_ascii_digit).collect();
        format!("Eq. {digits}")
    };
    let equations = comment.split("Eq. ").skip(1).map(equation);
    let theorem = |kind: &&str| {
        let name = |rest: &str| Some(format!("{kind} ({})", rest.strip_prefix(" (")?.split_once(')')?.0));
        comment.split(kind).skip(1).filter_map(name).collect::<Vec<_>>()
    };
    let theorems = KINDS.iter().flat_map(theorem);
    equations.chain(theorems).collect()
}

/// What the blocks of Rust of a section name and assert.
fn executed(section: &[Line]) -> BTreeSet<String> {
    let (mut executed, mut meant, mut rust) = (BTreeSet::new(), Vec::new(), false);
    for line in section {
        match line {
            Line::Fence(mark) => {
                rust = ["", "rust"].contains(mark);
                meant.clear();
            }
            Line::Code(line) if rust => {
                let names = named(line);
                if !names.is_empty() {
                    meant = names;
                }
                if line.split("//").next().unwrap().contains("assert") {
                    executed.extend(meant.iter().cloned());
                }
            }
            _ => {}
        }
    }
    executed
}

/// The equations that a line of the page numbers, and the theorems that it states.
fn stated(line: &Line) -> Vec<String> {
    match line {
        Line::Code(code) => {
            let number = |tag: &str| format!("Eq. {}", tag.split('}').next().unwrap());
            code.split("\\tag{").skip(1).map(number).collect()
        }
        Line::Text(text) => {
            let bold = text.split("**").skip(1).step_by(2).map(|bold| bold.trim_end_matches('.'));
            let theorems = bold.filter(|bold| KINDS.contains(&bold.split(' ').next().unwrap()));
            let theorem = |name: &str| {
                assert!(name.contains(" (") && name.ends_with(')'), "{text}: has no name in parentheses");
                name.to_owned()
            };
            theorems.map(theorem).collect()
        }
        Line::Heading(_) | Line::Fence(_) => Vec::new(),
    }
}

#[test]
fn equations_and_theorems_are_executed() {
    let (mut doctests, mut statements, mut without) = (0, BTreeMap::<String, usize>::new(), Vec::new());
    for (name, _) in chapters() {
        let page = chapter(&name);
        let lines = lines(&page);
        doctests += lines.iter().filter(|line| [Line::Fence(""), Line::Fence("rust")].contains(line)).count();
        for section in sections(&lines) {
            let executed = executed(&lines[section.clone()]);
            for at in section {
                for statement in stated(&lines[at]) {
                    if !executed.contains(&statement) {
                        without.push(format!("docs/{name}.md:{}: {statement}", at + 1));
                    }
                    *statements.entry(statement).or_default() += 1;
                }
            }
        }
    }
    let equations: Vec<_> = statements.keys().filter(|name| name.starts_with("Eq.")).collect();
    println!("{doctests} doctests; equations and theorems: {statements:?}");
    assert_eq!(equations, ["Eq. 1", "Eq. 2", "Eq. 3", "Eq. 4", "Eq. 5", "Eq. 6", "Eq. 7"]);
    assert!(without.is_empty(), "without a doctest that names it and asserts:\n{}", without.join("\n"));
}
