//! The keys and values of a yaml file, read by events: no document is built, so a small file cannot become a large one.

use super::text::NOT_UTF_8;
use crate::error::{Error, ErrorKind, Place};
use crate::warning::Warning;
use saphyr_parser::{Event, Parser, StrInput};
use std::collections::HashMap;
use std::collections::hash_map::Entry;

/// The value of a key.
pub(super) enum YamlValue {
    /// One text.
    Scalar(String),
    /// A list of texts.
    List(Vec<String>),
}

/// Reads the values of `keys` of the mapping that a text begins with; none of a text without documents. As in yaml-cpp the
/// first of equal keys holds, and what follows the first document is not looked at; `warnings` say so.
pub(super) fn values(
    text: &str,
    keys: &[&'static str],
    warnings: &mut Vec<Warning>,
) -> Result<HashMap<&'static str, YamlValue>, Error> {
    Events { text, parser: Parser::new_from_str(text) }.values(keys, warnings)
}

/// The events of a file, without anchors and aliases.
struct Events<'a> {
    text: &'a str,
    parser: Parser<'a, StrInput<'a>>,
}

impl<'a> Events<'a> {
    /// Returns the next event.
    fn next(&mut self) -> Result<Event<'a>, Error> {
        let (event, span) = match self.parser.next_event() {
            Some(Ok(next)) => next,
            Some(Err(error)) => {
                let line = error.marker().line();
                // The parser refuses a tab, also a legal one, in words that do not say so.
                let has =
                    |c| self.text.lines().nth(line.saturating_sub(1)).is_some_and(|line| line.contains(c));
                let what = match () {
                    () if has('\t') => "the line has a tab; write a space instead",
                    () if self
                        .text
                        .lines()
                        .skip(line.saturating_sub(2))
                        .take(3)
                        .any(|line| line.contains(NOT_UTF_8)) =>
                    {
                        "the line is not UTF-8 text; save the file as UTF-8"
                    }
                    () if self.text.contains(":\u{a0}") => {
                        "a no-break space follows a colon; write a plain one"
                    }
                    () => error.info(),
                };
                let message = format!("is malformed YAML in line {line}: {what}");
                return Err(Error::new(ErrorKind::Format, message)
                    .at(Place::Line(line as u64))
                    .caused_by(error));
            }
            None => return Err(Error::new(ErrorKind::Format, "is malformed YAML: it ends too early")),
        };
        let anchor = match &event {
            Event::Scalar(_, _, anchor, _)
            | Event::SequenceStart(anchor, _)
            | Event::MappingStart(anchor, _) => *anchor,
            Event::Alias(_) => 1,
            _ => 0,
        };
        if anchor != 0 {
            let line = span.start.line();
            let message = format!("line {line} has an anchor or alias; plain values are allowed");
            return Err(Error::new(ErrorKind::Unsupported, message).at(Place::Line(line as u64)));
        }
        Ok(event)
    }

    /// Reads the values of `keys` of the mapping that is the first document.
    fn values(
        mut self,
        keys: &[&'static str],
        warnings: &mut Vec<Warning>,
    ) -> Result<HashMap<&'static str, YamlValue>, Error> {
        let mut values = HashMap::new();
        loop {
            match self.next()? {
                Event::StreamStart | Event::DocumentStart(_) => {}
                Event::MappingStart(..) => break,
                Event::StreamEnd => return Ok(values),
                _ => {
                    return Err(Error::new(ErrorKind::Format, "is no map description")
                        .allowing(": allowed are ", "lines of `key: value`"));
                }
            }
        }
        loop {
            match self.next()? {
                Event::MappingEnd => break,
                Event::Scalar(name, ..) => {
                    let value = self.value()?;
                    let Some(&key) = keys.iter().find(|&&key| key == name) else {
                        continue;
                    };
                    let Some(value) = value else {
                        return Err(Error::new(ErrorKind::Format, format!("{key} is a mapping or nested"))
                            .at(Place::Key(key))
                            .allowing(", allowed is ", "a value"));
                    };
                    match values.entry(key) {
                        Entry::Vacant(entry) => _ = entry.insert(value),
                        Entry::Occupied(_) => warnings.push(Warning::RepeatedKey { key }),
                    }
                }
                start => {
                    self.nested(&start)?;
                    self.value()?;
                }
            }
        }
        // What follows on the lines of the document itself belongs to it; another document does not.
        let end = self.next()?;
        if !matches!(end, Event::DocumentEnd) || !matches!(self.next(), Ok(Event::StreamEnd)) {
            warnings.push(Warning::MoreDocuments);
        }
        Ok(values)
    }

    /// Reads the next value; `None` if it is a mapping, or a list of other things than scalars.
    fn value(&mut self) -> Result<Option<YamlValue>, Error> {
        match self.next()? {
            Event::Scalar(text, ..) => Ok(Some(YamlValue::Scalar(text.into_owned()))),
            Event::SequenceStart(..) => {
                let mut items = Some(Vec::new());
                loop {
                    match self.next()? {
                        Event::SequenceEnd => return Ok(items.map(YamlValue::List)),
                        Event::Scalar(text, ..) => {
                            if let Some(items) = &mut items {
                                items.push(text.into_owned());
                            }
                        }
                        start => {
                            self.nested(&start)?;
                            items = None;
                        }
                    }
                }
            }
            start => self.nested(&start).map(|()| None),
        }
    }

    /// Passes over the rest of a collection.
    fn nested(&mut self, start: &Event<'_>) -> Result<(), Error> {
        let mut depth = i64::from(matches!(start, Event::SequenceStart(..) | Event::MappingStart(..)));
        while depth > 0 {
            depth += match self.next()? {
                Event::SequenceStart(..) | Event::MappingStart(..) => 1,
                Event::SequenceEnd | Event::MappingEnd => -1,
                _ => 0,
            };
        }
        Ok(())
    }
}
