//! What the page asks.

use crate::files::Listed;
use mean_information_files::{ArrayEncoding, Mode, Options, Semantics};
use mean_information_report::Reading;
use serde::{Deserialize, Deserializer, de::Error};

/// A request: an object of one key, the word that names it.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Request {
    /// The files from which maps may be read from now on, in the place of those before.
    Files { files: Vec<Listed> },
    /// Measures a map and keeps its rows, in the place of those of this name; answers with these, as JSON. Of a map that is
    /// refused no rows are kept.
    Measure { name: String, reading: Choices },
    /// Reads a map and keeps nothing of it: whether it can be read.
    Check { name: String },
    /// Forgets the rows of all maps.
    Forget {},
    /// All rows, as `meaninfo map` prints them.
    Rows { format: Format },
    /// Keeps the cells of a map, in the place of those before; answers with its size and place.
    Open { name: String, reading: Choices },
    /// The measures of the open map against the size of its cells, as `meaninfo sweep --format json` prints them.
    Sweep {},
    /// Squares of cells of what is drawn, as red, green, blue and alpha, row by row from the top.
    Squares { of: Drawn, columns: [usize; 2], rows: [usize; 2], block: usize },
    /// One cell of what is drawn.
    Cell { of: Drawn, column: usize, row: usize },
    /// The observed cells of the open map with the largest entropies, and the worst square of so many cells a side.
    Worst { side: usize },
    /// The 256 colours of the scale from 0 to 1, and that of unknown, as red, green and blue.
    Colours {},
    /// The circular room: its limits, its sensor, and the grid of cells of this size.
    Room { range: String, sigma: String, resolution: String },
    /// One cell, of the occupancy that this text says.
    Occupancy { p: String },
    /// A line of the port protocol.
    Port { line: String },
}

/// The grids that are drawn.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Drawn {
    /// The open map.
    Map,
    /// The grid of the circular room.
    Room,
}

/// The form of rows.
#[derive(Clone, Copy, Debug, Deserialize)]
#[serde(rename_all = "snake_case")]
pub(crate) enum Format {
    Json,
    Csv,
}

/// How a map is read, by the words of the command line; what is absent is as the file says.
#[derive(Clone, Debug, Default, Deserialize)]
#[serde(default)]
pub(crate) struct Choices {
    #[serde(deserialize_with = "semantics")]
    semantics: Semantics,
    #[serde(deserialize_with = "mode")]
    mode: Option<Mode>,
    #[serde(deserialize_with = "number")]
    unknown: Option<f64>,
    #[serde(deserialize_with = "encoding")]
    encoding: Option<ArrayEncoding>,
    #[serde(deserialize_with = "number")]
    resolution: Option<f64>,
    submaps: bool,
    /// The image that was described on the page, whose name its row has: there is no file of the description.
    pub(crate) image: Option<String>,
}

impl Choices {
    /// Returns the options of the readers.
    pub(crate) fn reading(&self) -> Reading {
        let options = Options {
            semantics: self.semantics,
            mode: self.mode,
            unknown: self.unknown,
            encoding: self.encoding,
            resolution: self.resolution,
            max_cells: None,
        };
        Reading { options, submaps: self.submaps, ..Reading::default() }
    }
}

/// Reads one of several words.
fn word<'de, D: Deserializer<'de>, T: Copy>(from: D, known: &[(&str, T)]) -> Result<T, D::Error> {
    let text = String::deserialize(from)?;
    let found = known.iter().find(|(word, _)| *word == text);
    found.map(|&(_, value)| value).ok_or_else(|| D::Error::custom(format!("unknown word: {text}")))
}

fn semantics<'de, D: Deserializer<'de>>(from: D) -> Result<Semantics, D::Error> {
    use Semantics::{Nav2, Nav2Humble, Ros1};
    word(from, &[("", Nav2), ("nav2", Nav2), ("nav2-humble", Nav2Humble), ("ros1", Ros1)])
}

fn mode<'de, D: Deserializer<'de>>(from: D) -> Result<Option<Mode>, D::Error> {
    use Mode::{Probability, Raw, Scale, Trinary};
    let modes = [("trinary", Trinary), ("scale", Scale), ("raw", Raw), ("probability", Probability)];
    let known: Vec<_> =
        modes.into_iter().map(|(word, mode)| (word, Some(mode))).chain([("", None)]).collect();
    word(from, &known)
}

fn encoding<'de, D: Deserializer<'de>>(from: D) -> Result<Option<ArrayEncoding>, D::Error> {
    use ArrayEncoding::{LogOdds, Mrpt, Percent, Probability};
    let encodings =
        [("probability", Probability), ("percent", Percent), ("log-odds", LogOdds), ("mrpt", Mrpt)];
    let known: Vec<_> =
        encodings.into_iter().map(|(word, encoding)| (word, Some(encoding))).chain([("", None)]).collect();
    word(from, &known)
}

/// Reads a number or `nan`; nothing is none.
fn number<'de, D: Deserializer<'de>>(from: D) -> Result<Option<f64>, D::Error> {
    let text = String::deserialize(from)?;
    let text = text.trim();
    if text.is_empty() {
        return Ok(None);
    }
    crate::room::number(text).map(Some).map_err(D::Error::custom)
}
