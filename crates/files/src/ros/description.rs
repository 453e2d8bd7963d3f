//! What the yaml file of a ROS map says.

use super::text::{NOT_UTF_8, text};
use super::thresholds::Thresholds;
use super::yaml::{YamlValue, values};
use crate::error::{Error, ErrorKind, Place, short};
use crate::options::{Mode, Semantics};
use crate::text::shortened;
use crate::warning::Warning;
use std::io::Read;

/// The most bytes of a yaml file.
const MOST_BYTES: u64 = 64 << 10;
/// The keys that are read; the last is optional, and the thresholds before it are where the mode uses none.
const KEYS: [&str; 7] = ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh", "mode"];

/// The description of a map by its yaml file.
#[derive(Clone, Debug, PartialEq)]
pub struct Description {
    /// The image, relative to the folder of the yaml file or absolute.
    pub image: String,
    /// The side of a cell in metres.
    pub resolution: f64,
    /// The place of the lower left corner: x and y in metres, yaw in radians.
    pub origin: [f64; 3],
    /// True if white is occupied.
    pub negate: bool,
    /// The occupancy above which a cell is occupied, if the file says.
    pub occupied_thresh: Option<f64>,
    /// The occupancy below which a cell is free, if the file says.
    pub free_thresh: Option<f64>,
    /// The meaning of grey levels; trinary if the file does not say.
    pub mode: Mode,
    /// The signs that the file says something else than it seems to.
    pub warnings: Vec<Warning>,
}

impl Description {
    /// Reads a description; `semantics` says how `negate` may be spelt.
    ///
    /// # Errors
    /// An [`Error`] naming the key, its value and what is allowed; also for anchors, aliases and files above 64 KiB.
    pub fn read(input: impl Read, semantics: Semantics) -> Result<Self, Error> {
        let mut bytes = Vec::new();
        input.take(MOST_BYTES + 1).read_to_end(&mut bytes)?;
        if bytes.len() as u64 > MOST_BYTES {
            let message = format!("is no map description: it is above {MOST_BYTES} bytes");
            return Err(Error::new(ErrorKind::Format, message));
        }
        let mut warnings = Vec::new();
        let text = text(&bytes, &mut warnings)?;
        let mut values = values(&text, &KEYS, &mut warnings)?;
        let mut take = |key: &str| values.remove(key);

        let image = scalar(take("image"), "image")?;
        if image.is_empty() {
            return Err(Error::new(ErrorKind::OutOfRange, "image is empty")
                .at(Place::Key("image"))
                .with_value("")
                .allowing(", allowed is ", "the path of an image file"));
        }
        if image.contains('\0') {
            let refused = quoted("image", &image, "image");
            return Err(refused.allowing(", allowed is ", "a path without the character NUL"));
        }
        let resolution =
            number(take("resolution"), "resolution", "a positive number of metres", |x| x > 0.0)?;
        let origin = origin(take("origin"))?;
        let negate = negate(&scalar(take("negate"), "negate")?, semantics)?;
        let mut thresh = |key: &'static str| match take(key) {
            None => Ok(None),
            value => number(value, key, "a number", |_| true).map(Some),
        };
        let occupied_thresh = thresh("occupied_thresh")?;
        let free_thresh = thresh("free_thresh")?;
        let mode = match take("mode") {
            None => Mode::Trinary,
            value => mode(&scalar(value, "mode")?)?,
        };
        Ok(Self { image, resolution, origin, negate, occupied_thresh, free_thresh, mode, warnings })
    }

    /// Returns the thresholds that `mode` uses; none for the modes that use none.
    ///
    /// # Errors
    /// An [`Error`] naming the key that is missing.
    pub(super) fn thresholds(&self, mode: Mode) -> Result<Option<Thresholds>, Error> {
        if matches!(mode, Mode::Raw | Mode::Probability) {
            return Ok(None);
        }
        let occupied = self.occupied_thresh.ok_or_else(|| missing("occupied_thresh"))?;
        let free = self.free_thresh.ok_or_else(|| missing("free_thresh"))?;
        Ok(Some(Thresholds { free, occupied }))
    }
}

/// Creates the error of a key that is absent.
fn missing(key: &'static str) -> Error {
    let needed = format!("{}, {} is optional", KEYS[..6].join(", "), KEYS[6]);
    Error::new(ErrorKind::Format, format!("the key {key} is missing"))
        .at(Place::Key(key))
        .allowing("; needed are ", needed)
}

/// Takes the value of a key as one text.
fn scalar(value: Option<YamlValue>, key: &'static str) -> Result<String, Error> {
    match value {
        Some(YamlValue::Scalar(text)) if text.contains(NOT_UTF_8) => {
            Err(Error::new(ErrorKind::Format, format!("{key} is {text:?}, which is not UTF-8 text"))
                .at(Place::Key(key))
                .with_value(text)
                .followed_by("; save the file as UTF-8"))
        }
        Some(YamlValue::Scalar(text)) => Ok(text),
        Some(YamlValue::List(_)) => Err(Error::new(ErrorKind::Format, format!("{key} is a list"))
            .at(Place::Key(key))
            .allowing(", allowed is ", "one value")),
        None => Err(missing(key)),
    }
}

/// Takes the value of a key as a number that `is_allowed`.
fn number(
    value: Option<YamlValue>,
    key: &'static str,
    allowed: &'static str,
    is_allowed: impl Fn(f64) -> bool,
) -> Result<f64, Error> {
    let x = finite(&scalar(value, key)?, key, key, allowed)?;
    if is_allowed(x) { Ok(x) } else { Err(Error::out_of_range(key, short(x), allowed).at(Place::Key(key))) }
}

/// Parses a finite number: `.nan`, `.inf` and words are none here. It is the value of `key`, or a part of it that is
/// called `what`.
fn finite(text: &str, what: &str, key: &'static str, allowed: &str) -> Result<f64, Error> {
    match text.parse::<f64>() {
        Ok(x) if x.is_finite() => Ok(x),
        _ => {
            let refused = quoted(what, text, key).allowing(", allowed is ", format!("{allowed}, finite"));
            let no_number = text.trim_start_matches(['-', '+', '.']).eq_ignore_ascii_case("nan");
            Err(match key {
                "origin" if no_number && what.starts_with("yaw") => {
                    refused.followed_by("; write 0.0 for a map that is not turned")
                }
                "origin" if no_number => refused.followed_by("; write 0.0 where the place does not matter"),
                _ if text.contains(',') => refused.followed_by("; write a point, not a comma"),
                _ => refused,
            })
        }
    }
}

/// Creates the error of a text that is not allowed.
fn quoted(what: &str, text: &str, key: &'static str) -> Error {
    let shown = shortened(text.as_bytes());
    let more = if shown.len() < text.len() { "..." } else { "" };
    Error::new(ErrorKind::OutOfRange, format!("{what} is {shown:?}{more}"))
        .with_value(text)
        .at(Place::Key(key))
}

/// Takes the value of the origin.
fn origin(value: Option<YamlValue>) -> Result<[f64; 3], Error> {
    let wrong = |what: String| {
        Error::new(ErrorKind::Format, format!("origin {what}"))
            .at(Place::Key("origin"))
            .allowing(", allowed is ", "a list of three numbers, [x, y, yaw]")
    };
    let items = match value {
        Some(YamlValue::List(items)) => items,
        Some(YamlValue::Scalar(_)) => return Err(wrong("is one value".to_owned())),
        None => return Err(missing("origin")),
    };
    let [x, y, yaw] = items.as_slice() else {
        return Err(wrong(format!("has {} items", items.len())));
    };
    Ok([
        finite(x, "x of the origin", "origin", "metres")?,
        finite(y, "y of the origin", "origin", "metres")?,
        finite(yaw, "yaw of the origin", "origin", "radians")?,
    ])
}

/// Parses whether white is occupied. All loaders take an integer; nav2 takes YAML 1.1's booleans as well.
fn negate(text: &str, semantics: Semantics) -> Result<bool, Error> {
    if let Ok(number) = text.parse::<i32>() {
        return Ok(number != 0);
    }
    let wrong = |allowed: &'static str| quoted("negate", text, "negate").allowing(", allowed are ", allowed);
    match (semantics, text.to_ascii_lowercase().as_str()) {
        (Semantics::Ros1, _) => Err(wrong("0 and 1 (nav2 semantics allow true and false)")),
        (_, "y" | "yes" | "true" | "on") => Ok(true),
        (_, "n" | "no" | "false" | "off") => Ok(false),
        _ => Err(wrong("0, 1, true and false")),
    }
}

/// Parses a mode.
fn mode(text: &str) -> Result<Mode, Error> {
    match text.to_ascii_lowercase().as_str() {
        "trinary" => Ok(Mode::Trinary),
        "scale" => Ok(Mode::Scale),
        "raw" => Ok(Mode::Raw),
        _ => Err(quoted("mode", text, "mode").allowing(", allowed are ", "trinary, scale and raw")),
    }
}
