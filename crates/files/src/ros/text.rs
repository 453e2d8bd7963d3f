//! The text of a yaml file, as yaml-cpp takes its bytes.
//!
//! yaml-cpp passes over comments in any encoding, takes a tab for a space between tokens, and reads UTF-16 that says so.
//! The parser used here does not: what it would refuse is put right before, with a warning.

use crate::error::{Error, ErrorKind, Place};
use crate::warning::Warning;

/// Decodes a file. Bytes of comments that are no UTF-8 are replaced, and tabs between tokens become spaces.
pub(super) fn text(bytes: &[u8], warnings: &mut Vec<Warning>) -> Result<String, Error> {
    let decoded = match bytes {
        [0xff, 0xfe, rest @ ..] => utf_16(rest, u16::from_le_bytes)?,
        [0xfe, 0xff, rest @ ..] => utf_16(rest, u16::from_be_bytes)?,
        _ => utf_8(bytes.strip_prefix(b"\xef\xbb\xbf").unwrap_or(bytes), warnings)?,
    };
    let mut text = String::with_capacity(decoded.len());
    for (line, number) in decoded.split_inclusive('\n').zip(1..) {
        if line.contains('\t') && spaced(line, &mut text) {
            warnings.push(Warning::TabAsSpace { line: number });
        } else if !line.contains('\t') {
            text.push_str(line);
        }
    }
    Ok(text)
}

/// Decodes units of two bytes.
fn utf_16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Result<String, Error> {
    let (units, rest) = bytes.as_chunks();
    let units: Vec<u16> = units.iter().map(|&bytes| unit(bytes)).collect();
    let text = String::from_utf16(&units).ok().filter(|_| rest.is_empty());
    text.ok_or_else(|| Error::new(ErrorKind::Format, "is not the UTF-16 text it says it is"))
}

/// Decodes UTF-8, with anything in comments.
fn utf_8(bytes: &[u8], warnings: &mut Vec<Warning>) -> Result<String, Error> {
    if let Ok(text) = str::from_utf8(bytes) {
        return Ok(text.to_owned());
    }
    let mut text = String::with_capacity(bytes.len());
    let mut start = 0;
    for line in bytes.split_inclusive(|&byte| byte == b'\n') {
        let comment = (0..line.len())
            .find(|&at| line[at] == b'#' && (at == 0 || line[at - 1].is_ascii_whitespace()))
            .unwrap_or(line.len());
        let (value, comment) = line.split_at(comment);
        text.push_str(str::from_utf8(value).map_err(|error| {
            let place = Place::Byte((start + error.valid_up_to()) as u64);
            Error::new(ErrorKind::Format, "is not UTF-8 text").at(place).caused_by(error)
        })?);
        text.push_str(&String::from_utf8_lossy(comment));
        start += line.len();
    }
    warnings.push(Warning::CommentsNotUtf8);
    Ok(text)
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
