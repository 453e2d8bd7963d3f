//! What a page consists of: lines, headings, links, code spans, tables.

use std::collections::{BTreeMap, BTreeSet};
use std::ops::Range;

/// A line of Markdown.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Line<'a> {
    Heading(&'a str),
    /// The first line of a block of code, with what it is marked as.
    Fence(&'a str),
    Code(&'a str),
    Text(&'a str),
}

/// The lines of a page; a block of code ends with the fence that it began with.
pub(crate) fn lines(page: &str) -> Vec<Line<'_>> {
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
pub(crate) fn sections(lines: &[Line]) -> Vec<Range<usize>> {
    let headings = (0..lines.len()).filter(|&k| matches!(lines[k], Line::Heading(_)));
    let mut starts: Vec<_> = headings.collect();
    starts.push(lines.len());
    starts.windows(2).map(|pair| pair[0]..pair[1]).collect()
}

/// A page without its blocks of code.
pub(crate) fn plain(page: &str) -> String {
    let line = |line| match line {
        Line::Text(text) | Line::Heading(text) => format!("{text}\n"),
        Line::Fence(_) | Line::Code(_) => "\n".to_owned(),
    };
    lines(page).into_iter().map(line).collect()
}

/// Text without code spans and formulas, in which brackets are links.
pub(crate) fn prose(text: &str) -> String {
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
pub(crate) fn anchors(page: &str) -> BTreeSet<String> {
    let anchor = |line| {
        let Line::Heading(heading) = line else { return None };
        let kept = heading.chars().filter(|&c| c.is_alphanumeric() || c == ' ' || c == '-' || c == '_');
        Some(kept.collect::<String>().to_lowercase().replace(' ', "-"))
    };
    lines(page).into_iter().filter_map(anchor).collect()
}

/// Inline links and definitions of a page, and the labels that it uses without a definition.
pub(crate) fn links(page: &str) -> (Vec<String>, Vec<String>, BTreeMap<String, String>) {
    let text = plain(page);
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

/// The rows of the tables of a page, each with its cells; without heads and rules.
pub(crate) fn rows(page: &str) -> Vec<Vec<&str>> {
    let lines: Vec<_> = page.lines().collect();
    let is_row = |line: &str| line.starts_with('|');
    let is_rule = |line: &str| line.starts_with("|---");
    let body = lines.iter().enumerate().filter(|(k, line)| {
        is_row(line) && !is_rule(line) && !lines.get(k + 1).is_some_and(|next| is_rule(next))
    });
    body.map(|(_, line)| line.trim_matches('|').split('|').map(str::trim).collect()).collect()
}

/// What stands in code spans.
pub(crate) fn spans(text: &str) -> impl Iterator<Item = &str> {
    text.split('`').skip(1).step_by(2)
}
