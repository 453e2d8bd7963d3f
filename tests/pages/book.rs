//! The book: every equation of the report and every theorem is executed in its section, every link leads somewhere.

use crate::read;
use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

/// A line of Markdown.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Line<'a> {
    Heading(&'a str),
    /// The first line of a block of code, with what it is marked as.
    Fence(&'a str),
    Code(&'a str),
    Text(&'a str),
}

/// The lines of a page; a block of code ends with the fence that it began with.
fn lines(page: &str) -> Vec<Line<'_>> {
    let mut fence = None;
    let line = |line| {
        let ticks = |line: &str| line.trim_start().chars().take_while(|&c| c == '`').count();
        match fence {
            Some(opened) if ticks(line) >= opened && line.trim().chars().all(|c| c == '`') => {
                fence = None;
                Line::Text("")
            }
            Some(_) => Line::Code(line),
            None if ticks(line) >= 3 => {
                fence = Some(ticks(line));
                Line::Fence(line.trim().trim_start_matches('`').trim())
            }
            None if line.starts_with('#') => Line::Heading(line.trim_start_matches('#').trim()),
            None => Line::Text(line),
        }
    };
    page.lines().map(line).collect()
}

/// The lines from each heading to before the next.
fn sections(lines: &[Line]) -> Vec<Range<usize>> {
    let headings = (0..lines.len()).filter(|&k| matches!(lines[k], Line::Heading(_)));
    let mut starts: Vec<_> = headings.collect();
    starts.push(lines.len());
    starts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// The chapters that rustdoc shows, in their order, and the pictures of each.
fn chapters() -> Vec<(String, Vec<String>)> {
    let source = read(root().join("src/book/mod.rs"));
    let list = source
        .split("chapters! {")
        .nth(1)
        .and_then(|rest| rest.split('}').next())
        .expect("the list of chapters");
    let entries = list.split(';').map(str::trim).filter(|entry| !entry.is_empty());
    let chapter = |entry: &str| {
        let pictures = entry.split('"').skip(1).step_by(2).map(str::to_owned).collect();
        (entry.split_whitespace().next().expect("a name").to_owned(), pictures)
    };
    entries.map(chapter).collect()
}

fn chapter(name: &str) -> String {
    read(root().join("docs").join(name).with_extension("md"))
}

#[test]
fn the_chapters_are_the_files_in_the_order_of_the_contents() {
    let chapters: Vec<_> = chapters().into_iter().map(|(name, _)| name).collect();
    let files = fs::read_dir(root().join("docs")).expect("docs").map(|entry| entry.expect("an entry").path());
    let pages = files.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    let names: BTreeSet<_> =
        pages.map(|path| path.file_stem().unwrap().to_str().unwrap().to_owned()).collect();
    // The front page, and the pages for those who read the code or the report beside the book.
    let others = ["README", "architecture", "paper"].map(str::to_owned);
    let expected: BTreeSet<_> = chapters.iter().chain(&others).cloned().collect();
    assert_eq!(names.difference(&expected).collect::<Vec<_>>(), Vec::<&String>::new());
    assert!(chapters.iter().all(|name| names.contains(name)));

    let contents = chapter("README");
    let rows = contents.lines().filter(|line| line.starts_with("| ") && line.contains(']'));
    let label = |row: &str| {
        let cell = row.split('|').nth(2).expect("a cell").trim();
        let label = cell.rsplit_once('[').expect("a link").1.trim_end_matches(']');
        label.to_lowercase()
    };
    assert_eq!(rows.map(label).collect::<Vec<_>>(), chapters);
    // Each ends with the way to the next.
    for pair in chapters.windows(2) {
        let text = chapter(&pair[0]);
        let next = text.split("\n\n").find(|paragraph| paragraph.starts_with("Next: "));
        let next = next.unwrap_or_else(|| panic!("docs/{}.md does not lead to the next chapter", pair[0]));
        let leads = [format!("][{}]", pair[1]), format!("[{}]", pair[1])];
        assert!(leads.iter().any(|link| next.contains(link)), "docs/{}.md: {next}", pair[0]);
    }
}

/// Equations with a number and theorems, each with a doctest before the next heading, which says of an equation that it is
/// meant; equations 1 to 7 are all there.
#[test]
fn equations_and_theorems_are_executed() {
    let (mut doctests, mut equations, mut theorems) = (0, BTreeMap::<u32, usize>::new(), 0);
    let mut without = Vec::new();
    for (name, _) in chapters() {
        let page = chapter(&name);
        let lines = lines(&page);
        for section in sections(&lines) {
            let here = &lines[section.clone()];
            let (mut tests, mut code, mut rust) = (0, String::new(), false);
            for line in here {
                match line {
                    Line::Fence(mark) => {
                        rust = ["", "rust"].contains(mark);
                        tests += usize::from(rust);
                    }
                    Line::Code(line) if rust => code.push_str(line),
                    _ => {}
                }
            }
            doctests += tests;
            let mut needs = |line: usize, what: String, said: &str| {
                if tests == 0 || !code.contains(said) {
                    without.push(format!("docs/{name}.md:{}: {what}", section.start + line + 1));
                }
            };
            for (k, line) in here.iter().enumerate() {
                match line {
                    Line::Code(code) => {
                        for tag in code.split("\\tag{").skip(1) {
                            let number = tag.split('}').next().and_then(|number| number.parse().ok());
                            let number = number.expect("a number in \\tag{}");
                            *equations.entry(number).or_default() += 1;
                            needs(k, format!("equation {number}"), &format!("Eq. {number}"));
                        }
                    }
                    Line::Text(text) => {
                        for kind in ["Theorem", "Lemma", "Proposition", "Corollary"] {
                            let Some(rest) = text.strip_prefix("**").and_then(|text| text.strip_prefix(kind))
                            else {
                                continue;
                            };
                            assert!(rest.starts_with(" ("), "docs/{name}.md: {text}: has no name");
                            theorems += 1;
                            needs(k, format!("{kind}{}", rest.split("**").next().unwrap_or_default()), "");
                        }
                    }
                    Line::Heading(_) | Line::Fence(_) => {}
                }
            }
        }
    }
    println!("{doctests} doctests, equations {equations:?}, {theorems} theorems");
    assert_eq!(equations.keys().copied().collect::<Vec<_>>(), [1, 2, 3, 4, 5, 6, 7]);
    assert!(without.is_empty(), "without a doctest:\n{}", without.join("\n"));
}

/// Text without code spans and formulas, in which brackets are links.
fn prose(text: &str) -> String {
    let mut prose = String::new();
    for (k, part) in text.split('`').enumerate() {
        // A label is a code span in brackets: it stays.
        if k % 2 == 0 {
            prose.push_str(part);
        } else if prose.ends_with('[') {
            prose.extend(["`", part, "`"]);
        }
    }
    prose
}

/// The anchors that GitHub and rustdoc give to headings.
fn anchors(page: &str) -> BTreeSet<String> {
    let anchor = |line| {
        let Line::Heading(heading) = line else { return None };
        let kept = heading.chars().filter(|&c| c.is_alphanumeric() || c == ' ' || c == '-' || c == '_');
        Some(kept.collect::<String>().to_lowercase().replace(' ', "-"))
    };
    lines(page).into_iter().filter_map(anchor).collect()
}

/// Inline links and definitions of a page, and the labels that it uses without a definition.
fn links(page: &str) -> (Vec<String>, Vec<String>, BTreeMap<String, String>) {
    let text: String = lines(page)
        .into_iter()
        .map(|line| match line {
            Line::Text(text) | Line::Heading(text) => format!("{text}\n"),
            Line::Fence(_) | Line::Code(_) => "\n".to_owned(),
        })
        .collect();
    let definition = |line: &str| {
        let (label, target) = line.strip_prefix('[')?.split_once("]: ")?;
        Some((label.to_lowercase(), target.trim().to_owned()))
    };
    let definitions: BTreeMap<_, _> = text.lines().filter_map(definition).collect();
    let body: Vec<_> = text.lines().filter(|line| definition(line).is_none()).collect();
    let body = prose(&body.join("\n"));
    let (mut targets, mut labels) = (Vec::new(), Vec::new());
    let mut rest = body.as_str();
    while let Some((_, after)) = rest.split_once('[') {
        rest = after;
        let Some((text, after)) = after.split_once(']') else { break };
        let label = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ").to_lowercase();
        if let Some(target) = after.strip_prefix('(') {
            targets.push(target.split([')', ' ']).next().unwrap_or_default().to_owned());
        } else if let Some(reference) = after.strip_prefix('[') {
            // Arrays of arrays have empty brackets.
            labels.extend(reference.split(']').next().filter(|label| !label.is_empty()).map(label));
        } else if text.starts_with('`') || definitions.contains_key(&label(text)) {
            labels.push(label(text));
        }
    }
    (targets, labels, definitions)
}

/// Every page that is meant to be read.
fn pages() -> Vec<PathBuf> {
    let mut pages = Vec::new();
    let mut folders = vec![root().to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            let name = path.file_name().unwrap().to_str().unwrap().to_owned();
            if path.is_dir() && !name.starts_with('.') && name != "target" {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "md")
                && path != root().join("src/book/links.md")
            {
                pages.push(path);
            }
        }
    }
    pages.sort();
    pages
}

#[test]
fn links_lead_somewhere() {
    let mut wrong = Vec::new();
    let mut count = 0;
    for path in pages() {
        let page = read(&path);
        let (targets, labels, definitions) = links(&page);
        let shown = path.strip_prefix(root()).unwrap().display().to_string();
        for label in &labels {
            if !definitions.contains_key(label) {
                wrong.push(format!("{shown}: [{label}] is defined nowhere"));
            }
        }
        for label in definitions.keys().filter(|&label| !labels.contains(label)) {
            wrong.push(format!("{shown}: [{label}] is not used"));
        }
        for target in targets.iter().chain(definitions.values()) {
            count += 1;
            if target.starts_with("https://") || target.starts_with("http://") {
                continue;
            }
            let (file, anchor) = target.split_once('#').unwrap_or((target, ""));
            let file = if file.is_empty() { path.clone() } else { path.parent().unwrap().join(file) };
            if !file.exists() {
                wrong.push(format!("{shown}: there is no {target}"));
            } else if !anchor.is_empty() && !anchors(&read(&file)).contains(anchor) {
                wrong.push(format!("{shown}: {target} is no heading"));
            }
        }
    }
    println!("{count} links");
    assert!(count > 50 && wrong.is_empty(), "{count} links\n{}", wrong.join("\n"));
}

/// What rustdoc is told of a label is what the chapters say of it: the same chapter, or an item in that file.
#[test]
fn labels_mean_the_same_to_rustdoc() {
    let items = read(root().join("src/book/links.md"));
    let (_, _, items) = links(&items);
    let mut used = BTreeSet::new();
    for name in chapters().into_iter().map(|(name, _)| name).chain(["README".to_owned()]) {
        let (_, _, definitions) = links(&chapter(&name));
        for (label, target) in definitions {
            let item = items
                .get(&label)
                .unwrap_or_else(|| panic!("docs/{name}.md: [{label}]: not in src/book/links.md"));
            if let Some(chapter) = item.strip_prefix("crate::book::") {
                let (chapter, anchor) = chapter.split_once('#').unwrap_or((chapter, ""));
                let anchor = if anchor.is_empty() { String::new() } else { format!("#{anchor}") };
                assert_eq!(target, format!("{chapter}.md{anchor}"), "docs/{name}.md: [{label}]");
            } else if item == "crate::book" {
                assert_eq!(target, "README.md", "docs/{name}.md: [{label}]");
            } else {
                let source = read(root().join("docs").join(&target));
                let defined = item.rsplit("::").next().expect("a name");
                let file = [format!("/{defined}.rs"), format!("/{defined}/mod.rs")];
                let kinds = ["struct", "enum", "trait", "fn", "const", "type"];
                // A variant of an enumeration stands alone on its line.
                let lines =
                    [format!("    {defined},"), format!("    {defined}("), format!("    {defined} {{")];
                let found = file.iter().any(|end| target.ends_with(end))
                    || kinds.iter().any(|kind| source.contains(&format!("{kind} {defined}")))
                    || lines.iter().any(|line| source.contains(line));
                assert!(found, "docs/{name}.md: {target} has no {defined}");
            }
            used.insert(label);
        }
    }
    let unused: Vec<_> = items.keys().filter(|&label| !used.contains(label)).collect();
    assert_eq!(unused, Vec::<&String>::new(), "labels in src/book/links.md that no chapter uses");
}

#[test]
fn pictures_travel_with_their_pages() {
    for (name, pictures) in chapters() {
        let (targets, _, _) = links(&chapter(&name));
        let shown: Vec<_> = targets
            .into_iter()
            .filter(|target| Path::new(target).extension() == Some("svg".as_ref()))
            .collect();
        assert_eq!(shown, pictures, "docs/{name}.md and src/book/mod.rs");
    }
}

/// What the page on notation calls an identifier is one.
#[test]
fn identifiers_of_the_notation_are_in_the_source() {
    let mut folders = vec![root().join("src")];
    let mut words = BTreeSet::new();
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).expect("a folder") {
            let path = entry.expect("an entry").path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|extension| extension == "rs") {
                let source = read(&path);
                words.extend(source.split(|c: char| !c.is_alphanumeric() && c != '_').map(str::to_owned));
            }
        }
    }
    let page = chapter("notation");
    let rows = page.lines().filter(|line| line.starts_with("| ") && line.split('|').count() == 6);
    let identifiers =
        rows.flat_map(|row| row.split('|').nth(4).expect("a column").split('`').skip(1).step_by(2));
    let identifiers: Vec<_> = identifiers.flat_map(|identifier| identifier.split("::")).collect();
    assert!(identifiers.len() > 30, "{identifiers:?}");
    let unknown: Vec<_> = identifiers.iter().filter(|&&identifier| !words.contains(identifier)).collect();
    assert!(unknown.is_empty(), "{unknown:?}");
}
