//! The text of a yaml file, as yaml-cpp takes its bytes.
//!
//! yaml-cpp passes over comments and values that nobody asks for in any encoding, takes a tab for a space between tokens, and reads UTF-16 that says so.
//! The parser used here does not: what it would refuse is put right before, with a warning.

use crate::error::{Error, ErrorKind};
use crate::warning::Warning;
use std::borrow::Cow;

/// Decodes a file. Bytes that are no UTF-8 are [replaced](NOT_UTF_8), and tabs between tokens become spaces.
pub(super) fn text(bytes: &[u8], warnings: &mut Vec<Warning>) -> Result<String, Error> {
    let decoded = match bytes {
        [0xff, 0xfe, rest @ ..] => utf_16(rest, u16::from_le_bytes)?,
        [0xfe, 0xff, rest @ ..] => utf_16(rest, u16::from_be_bytes)?,
        _ => utf_8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), warnings),
    };
    let mut text = String::with_capacity(decoded.len());
    let (mut first, mut count) = (None, 0);
    for (line, number) in decoded.split_inclusive('\n').zip(1..) {
        if line.contains('\t') && spaced(line, &mut text) {
            first.get_or_insert(number);
            count += 1;
        } else if !line.contains('\t') {
            text.push_str(line);
        }
    }
    warnings.extend(first.map(|line| Warning::TabAsSpace { line, count }));
    Ok(text)
}

/// Decodes units of two bytes.
fn utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, Error> {
    let (units, rest) = bytes.as_chunks();
    let units: Vec<u16> = units.iter().map(|&bytes| unit(bytes)).collect();
    let text = String::from_utf16(&units).ok().filter(|_| rest.is_empty());
    text.ok_or_else(|| Error::new(ErrorKind::Format, "is not the UTF-16 text it says it is"))
}

/// The character that stands for bytes that are no UTF-8: a value that has it is not the one of the file.
pub(super) const NOT_UTF_8: char = char::REPLACEMENT_CHARACTER;

/// Decodes UTF-8, with anything in comments and in values that are not read.
fn utf_8(bytes: &[u8], warnings: &mut Vec<Warning>) -> String {
    match String::from_utf8_lossy(bytes) {
        Cow::Borrowed(text) => text.to_owned(),
        Cow::Owned(text) => {
            warnings.push(Warning::CommentsNotUtf8);
            text
        }
    }
}

/// Appends a line whose tabs between tokens are spaces; tells whether there were some. Tabs in quotes, within a value and
/// before the first token stay.
fn spaced(line: &str, text: &mut String) -> bool {
    let (mut quote, mut before, mut changed) = (None, '\n', false);
    let mut rest = line;
    while let Some(c) = rest.chars().next() {
        let blanks = rest.len() - rest.trim_start_matches([' ', '\t']).len();
        if quote.is_none() && blanks > 0 {
            let (run, after) = rest.split_at(blanks);
            let next = after.chars().next().unwrap_or('\n');
            let separates = matches!(before, ':' | ',' | '[' | '{' | '-')
                || (before != '\n' && matches!(next, '#' | ']' | '}' | ',' | ':' | '\r' | '\n'));
            if separates && run.contains('\t') {
                changed = true;
                text.extend(run.chars().map(|_| ' '));
            } else {
                text.push_str(run);
            }
            rest = after;
            continue;
        }
        match (c, quote) {
            ('"' | '\'', None) => quote = Some(c),
            (_, Some(open)) if c == open => quote = None,
            // A comment may hold anything.
            ('#', None) if matches!(text.chars().next_back(), None | Some(' ' | '\t' | '\n')) => {
                text.push_str(rest);
                return changed;
            }
            _ => {}
        }
        text.push(c);
        before = c;
        rest = &rest[c.len_utf8()..];
    }
    changed
}
