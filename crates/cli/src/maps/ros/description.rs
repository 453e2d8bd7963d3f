//! The yaml file of a ROS map, read by events: no document is built, so a small file cannot become a large one.

use crate::maps::{Fault, Mode, Semantics};
use saphyr_parser::{Event, Parser, StrInput};
use std::collections::HashMap;
use std::io::Read;

/// The most bytes of a yaml file.
const MOST_BYTES: u64 = 64 << 10;
const KEYS: [&str; 7] = ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"];

/// What a yaml file says of a map.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The image, relative to the folder of the yaml file or absolute.
    pub image: String,
    /// The side of a cell in metres.
    pub resolution: f64,
    /// The place of the lower left corner: x and y in metres, yaw in radians.
    pub origin: [f64; 3],
    /// Whether white is occupied.
    pub negate: bool,
    /// The occupancy above which a cell is occupied.
    pub occupied_thresh: f64,
    /// The occupancy below which a cell is free; less than `occupied_thresh`.
    pub free_thresh: f64,
    /// How grey levels are meant; trinary if the file does not say.
    pub mode: Mode,
}

/// The value of a key.
enum Value {
    Scalar(String),
    List(Vec<String>),
}

impl Description {
    /// Reads a description; `semantics` says how `negate` may be spelt.
    ///
    /// # Errors
    /// A [`Fault`] naming the key, its value and what is allowed; also for anchors, aliases, files above 64 KiB and
    /// files of several documents.
    pub fn read(input: impl Read, semantics: Semantics) -> Result<Self, Fault> {
        let mut bytes = Vec::new();
        input.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > MOST_BYTES {
            return Err(Fault::new(format!("is no map description: it is above {MOST_BYTES} bytes")));
        }
        let text = std::str::from_utf8(&bytes).map_err(|_| Fault::new("is not UTF-8 text"))?;
        let mut values = Events { text, parser: Parser::new_from_str(text) }.values()?;
        let mut take = |key: &str| values.remove(key);

        let image = scalar(take("image"), "image")?;
        if image.is_empty() {
            return Err(Fault::new("image is empty, allowed is the path of a PGM or PNG file"));
        }
        let resolution =
            number(take("resolution"), "resolution", "a positive number of metres", |x| x > 0.0)?;
        let origin = origin(take("origin"))?;
        let negate = negate(&scalar(take("negate"), "negate")?, semantics)?;
        let occupied_thresh = number(take("occupied_thresh"), "occupied_thresh", "a number", |_| true)?;
        let free_thresh = number(take("free_thresh"), "free_thresh", "a number", |_| true)?;
        if free_thresh >= occupied_thresh {
            return Err(Fault::new(format!(
                "free_thresh is {free_thresh}, allowed is less than occupied_thresh, which is {occupied_thresh}"
            )));
        }
        let mode = match take("mode") {
            None => Mode::Trinary,
            value => mode(&scalar(value, "mode")?)?,
        };
        Ok(Self { image, resolution, origin, negate, occupied_thresh, free_thresh, mode })
    }
}

fn missing(key: &str) -> Fault {
    Fault::new(format!(
        "the key {key} is missing; needed are {}, {} is optional",
        KEYS[..6].join(", "),
        KEYS[6]
    ))
}

fn scalar(value: Option<Value>, key: &str) -> Result<String, Fault> {
    match value {
        Some(Value::Scalar(text)) => Ok(text),
        Some(Value::List(_)) => Err(Fault::new(format!("{key} is a list, allowed is one value"))),
        None => Err(missing(key)),
    }
}

fn number(
    value: Option<Value>,
    key: &str,
    allowed: &str,
    is_allowed: impl Fn(f64) -> bool,
) -> Result<f64, Fault> {
    finite(&scalar(value, key)?, key, allowed).and_then(|x| {
        if is_allowed(x) { Ok(x) } else { Err(Fault::new(format!("{key} is {x}, allowed is {allowed}"))) }
    })
}

/// `.nan`, `.inf` and words are no numbers here.
fn finite(text: &str, key: &str, allowed: &str) -> Result<f64, Fault> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => Err(Fault::new(format!("{key} is {text:?}, allowed is {allowed}, finite"))),
    }
}

fn origin(value: Option<Value>) -> Result<[f64; 3], Fault> {
    let allowed = "a list of three numbers, [x, y, yaw]";
    let Some(Value::List(items)) = value else {
        return Err(value.map_or_else(
            || missing("origin"),
            |_| Fault::new(format!("origin is one value, allowed is {allowed}")),
        ));
    };
    let [x, y, yaw] = items.as_slice() else {
        return Err(Fault::new(format!("origin has {} items, allowed is {allowed}", items.len())));
    };
    Ok([
        finite(x, "x of the origin", "metres")?,
        finite(y, "y of the origin", "metres")?,
        finite(yaw, "yaw of the origin", "radians")?,
    ])
}

/// Both loaders take an integer; nav2 takes YAML 1.1's booleans as well.
fn negate(text: &str, semantics: Semantics) -> Result<bool, Fault> {
    if let Ok(number) = text.parse::<i32>() {
        return Ok(number != 0);
    }
    match (semantics, text.to_ascii_lowercase().as_str()) {
        (Semantics::Nav2, "y" | "yes" | "true" | "on") => Ok(true),
        (Semantics::Nav2, "n" | "no" | "false" | "off") => Ok(false),
        (Semantics::Nav2, _) => {
            Err(Fault::new(format!("negate is {text:?}, allowed are 0, 1, true and false")))
        }
        (Semantics::Ros1, _) => Err(Fault::new(format!(
            "negate is {text:?}, allowed are 0 and 1 (nav2 semantics allow true and false)"
        ))),
    }
}

fn mode(text: &str) -> Result<Mode, Fault> {
    match text.to_ascii_lowercase().as_str() {
        "trinary" => Ok(Mode::Trinary),
        "scale" => Ok(Mode::Scale),
        "raw" => Ok(Mode::Raw),
        _ => Err(Fault::new(format!("mode is {text:?}, allowed are trinary, scale and raw"))),
    }
}

/// The events of a file, without anchors and aliases.
struct Events<'a> {
    text: &'a str,
    parser: Parser<'a, StrInput<'a>>,
}

impl<'a> Events<'a> {
    fn next(&mut self) -> Result<Event<'a>, Fault> {
        let (event, span) = match self.parser.next_event() {
            Some(Ok(next)) => next,
            Some(Err(error)) => {
                let line = error.marker().line();
                // The parser refuses a tab, also a legal one, in words that do not say so.
                let tabbed =
                    self.text.lines().nth(line.saturating_sub(1)).is_some_and(|line| line.contains('\t'));
                let what = if tabbed { "the line has a tab; write a space instead" } else { error.info() };
                return Err(Fault::new(format!("is malformed YAML in line {line}: {what}")));
            }
            None => return Err(Fault::new("is malformed YAML: it ends too early")),
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
            return Err(Fault::new(format!("line {line} has an anchor or alias; plain values are allowed")));
        }
        Ok(event)
    }

    /// The values of the known keys of the one mapping that the file is.
    fn values(mut self) -> Result<HashMap<&'static str, Value>, Fault> {
        let mut values = HashMap::new();
        loop {
            match self.next()? {
                Event::StreamStart | Event::DocumentStart(_) => {}
                Event::MappingStart(..) => break,
                Event::StreamEnd => return Err(missing(KEYS[0])),
                _ => return Err(Fault::new("is no map description: allowed are lines of `key: value`")),
            }
        }
        loop {
            match self.next()? {
                Event::MappingEnd => break,
                Event::Scalar(name, ..) => {
                    let value = self.value()?;
                    let Some(&key) = KEYS.iter().find(|&&key| key == name) else {
                        continue;
                    };
                    let Some(value) = value else {
                        return Err(Fault::new(format!("{key} is a mapping or nested, allowed is a value")));
                    };
                    if values.insert(key, value).is_some() {
                        return Err(Fault::new(format!("the key {key} occurs twice, allowed is once")));
                    }
                }
                start => {
                    self.nested(&start)?;
                    self.value()?;
                }
            }
        }
        match (self.next()?, self.next()?) {
            (Event::DocumentEnd, Event::StreamEnd) => Ok(values),
            _ => Err(Fault::new("holds more than one YAML document, allowed is one")),
        }
    }

    /// The next value; `None` if it is a mapping, or a list of other things than scalars.
    fn value(&mut self) -> Result<Option<Value>, Fault> {
        match self.next()? {
            Event::Scalar(text, ..) => Ok(Some(Value::Scalar(text.into_owned()))),
            Event::SequenceStart(..) => {
                let mut items = Some(Vec::new());
                loop {
                    match self.next()? {
                        Event::SequenceEnd => return Ok(items.map(Value::List)),
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
    fn nested(&mut self, start: &Event<'_>) -> Result<(), Fault> {
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
