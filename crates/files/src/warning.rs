//! What a reader noticed that makes a map mean less than it seems, with its figures.

use crate::options::Mode;
use std::fmt;

/// The grey level, of 255, that map savers write for unknown.
pub(crate) const SAVED_UNKNOWN: u8 = 205;

/// A sign, noticed by a reader, that a map means less than it seems. It displays as a sentence; what to do about it is
/// added by who knows how options are given.
///
/// ```
/// use mean_information_files::{Mode, Warning};
/// let warning =
///     Warning::SavedUnknownReadAs { grey: 205, percent: 0, count: 17, mode: Mode::Trinary, free_thresh: Some(0.25) };
/// let text = "17 cells of grey 205, which map savers write for unknown, read as free under free_thresh 0.25; \
///             a free_thresh of 0.196 keeps that grey unknown";
/// assert_eq!(warning.to_string(), text);
/// ```
#[derive(Clone, Debug, PartialEq)]
#[non_exhaustive]
pub enum Warning {
    /// Cells outside 0 to 100 that are not unknown are read as unknown, in raw mode.
    OutOfRangeReadAsUnknown {
        /// The number of cells.
        count: u64,
    },
    /// Cells of the grey that map savers write for unknown, 205 of 255, are read as something else.
    SavedUnknownReadAs {
        /// The grey, of the image's own depth.
        grey: u16,
        /// The percentage that it is read as.
        percent: i8,
        /// The number of cells.
        count: u64,
        /// The mode that it is read in.
        mode: Mode,
        /// The `free_thresh` that makes it free, where a lower one would keep it unknown.
        free_thresh: Option<f64>,
    },
    /// Cells of a grey that often means unknown are observed, in probability mode.
    OftenUnknownObserved {
        /// The grey, of the image's own depth.
        grey: u16,
        /// The number of cells.
        count: u64,
    },
    /// Cells are unknown because their pixels are not opaque.
    TransparentReadAsUnknown {
        /// The number of cells.
        count: u64,
    },
    /// The alpha of pixels that are not opaque is averaged with their colour, as the loader does.
    AlphaAveraged {
        /// The number of cells.
        count: u64,
    },
    /// A mode of three states is used for an image of many greys.
    GreysThresholded {
        /// The number of grey levels.
        levels: usize,
        /// The number of cells whose grey is neither black, white, nor the one most often used.
        count: u64,
        /// The grey that probably means unknown, of the image's own depth.
        unknown: Option<u16>,
    },
    /// Thresholds are above 1, the largest occupancy.
    ThresholdsAbove1 {
        /// The threshold of free cells.
        free: f64,
        /// The threshold of occupied cells.
        occupied: f64,
    },
    /// The threshold of free cells is not below that of occupied ones.
    ThresholdsCross {
        /// The threshold of free cells.
        free: f64,
        /// The threshold of occupied cells.
        occupied: f64,
        /// True if cells between them are free, false if they are occupied.
        free_wins: bool,
    },
    /// A key of the yaml file occurs again, and its first value holds.
    RepeatedKey {
        /// The key.
        key: &'static str,
    },
    /// Something follows the first document of the yaml file, and is not read.
    MoreDocuments,
    /// Comments of the yaml file are not UTF-8.
    CommentsNotUtf8,
    /// A tab of the yaml file is read as a space.
    TabAsSpace {
        /// The line, from 1.
        line: u64,
    },
    /// Something follows the image in its file, and is passed over.
    BytesAfterImage,
    /// The header of a raw PGM ends in two bytes, of which the second is read as the first pixel.
    PgmLineEnd,
    /// Decoders of JPEG differ by a level.
    JpegLevels,
    /// No percentage is above 1, and some are 1: they may be states.
    NoPercentageAbove1 {
        /// The number of cells that are 1.
        count: u64,
    },
    /// Cells are beside unknown by less than sums in floats are exact.
    BesideUnknown {
        /// The number of cells.
        count: u64,
    },
    /// Cells of an array hold a grey, as a fraction of 255, that often means unknown.
    OftenUnknownValue {
        /// The grey of 255.
        grey: u8,
        /// The value, as the array has it.
        value: f64,
        /// The number of cells.
        count: u64,
    },
    /// nav2's loader may take the levels of an image of 16 bits for others by 1 of 255.
    SixteenBits,
    /// nav2's loader may take the levels of a PGM of this maximum value for others.
    PgmMaximum {
        /// The maximum value of its header.
        white: u16,
    },
    /// ROS 1's loader refuses a PGM of this maximum value.
    PgmMaximumRefused {
        /// The maximum value of its header.
        white: u16,
    },
    /// The indices of a palette are read as grey levels, as in ROS 1's loader.
    PaletteIndices,
    /// Lines of a log are not understood and passed over.
    LinesNotUnderstood {
        /// The number of lines.
        lines: u64,
        /// The first words of the lines, each with its number of lines; only the first eight words are kept.
        words: Vec<(String, u64)>,
    },
    /// Scans have the time of the scan before and are passed over.
    ScansAtOneTime {
        /// The number of scans passed over.
        count: u64,
    },
    /// The last line of a text is cut short and left out.
    CutInLine {
        /// The line, from 1.
        line: u64,
    },
    /// Poses of a trajectory are pitched or rolled by more than a degree, which the plane drops.
    TiltDropped {
        /// The number of poses.
        count: u64,
        /// The greatest angle between the robot's z axis and the world's, in degrees.
        greatest_degrees: f64,
    },
    /// A bag ends within a record, or was not closed by who recorded it: only its whole messages are read.
    BagCutShort {
        /// The byte at which its last whole record ends.
        byte: u64,
        /// The number of messages before it.
        messages: u64,
    },
    /// Updates of a map come before the map and are passed over.
    UpdatesBeforeMap {
        /// The number of updates.
        count: u64,
    },
    /// The program that made the map keeps its probabilities within an interval.
    Clamped {
        /// The least probability.
        least: f32,
        /// The greatest probability.
        greatest: f32,
    },
    /// Submaps are counted together, and a place that lies in several counts in each.
    SubmapsTogether {
        /// The number of submaps.
        count: usize,
    },
    /// Bytes 127 and 128 of an MRPT map before version 3 are read as unknown, as MRPT does.
    HalvesReadAsUnknown {
        /// The number of cells.
        count: u64,
        /// The version of the map.
        version: u8,
    },
}

impl fmt::Display for Warning {
    #[expect(clippy::too_many_lines, reason = "a sentence for each")]
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match *self {
            Self::OutOfRangeReadAsUnknown { count } => {
                let cells = cells_in_words(count);
                write!(f, "{cells} outside 0 to 100 and other than unknown (-1 or 255), read as unknown")
            }
            Self::SavedUnknownReadAs { percent, count, mode, free_thresh, .. } => {
                let (cells, read) = (cells_in_words(count), state_in_words(percent));
                write!(
                    f,
                    "{cells} of grey {SAVED_UNKNOWN}, which map savers write for unknown, read as {read}"
                )?;
                match free_thresh {
                    Some(thresh) => write!(
                        f,
                        " under free_thresh {thresh}; a free_thresh of 0.196 keeps that grey unknown"
                    ),
                    None if mode == Mode::Scale => write!(f, "; mode scale has no grey for unknown"),
                    None => Ok(()),
                }
            }
            Self::OftenUnknownObserved { grey, count } => {
                write!(f, "{} of grey {grey} counted as observed", cells_in_words(count))
            }
            Self::TransparentReadAsUnknown { count } => {
                write!(f, "{} not opaque (transparent), read as unknown", are(count))
            }
            Self::AlphaAveraged { count } => write!(
                f,
                "{} not opaque (transparent): as in that loader, alpha is averaged with the colour",
                are(count)
            ),
            Self::GreysThresholded { levels, count, .. } => write!(
                f,
                "the image has {levels} grey levels, {} between them that mode trinary reads as free, occupied or \
                 unknown",
                cells_in_words(count)
            ),
            Self::ThresholdsAbove1 { free, occupied } => {
                let above = free.max(occupied);
                write!(
                    f,
                    "thresholds above 1 (free_thresh {free}, occupied_thresh {occupied}): no cell is above 1"
                )?;
                if above > 2.0 {
                    write!(f, "; if they are percentages, write {} for {above}", above / 100.0)?;
                }
                Ok(())
            }
            Self::ThresholdsCross { free, occupied, free_wins } => {
                let state = if free_wins { "free" } else { "occupied" };
                write!(
                    f,
                    "free_thresh {free} is not below occupied_thresh {occupied}: cells that both hold for are read \
                     as {state}"
                )
            }
            Self::RepeatedKey { key } => {
                write!(f, "the key occurs twice: {key}; its first value is read, as yaml-cpp does")
            }
            Self::MoreDocuments => {
                write!(f, "the yaml file goes on after its first document, which alone is read")
            }
            Self::CommentsNotUtf8 => write!(f, "comments of the yaml file are not UTF-8, and passed over"),
            Self::TabAsSpace { line } => {
                write!(f, "line {line} of the yaml file has a tab, which is read as a space")
            }
            Self::BytesAfterImage => {
                write!(f, "the file goes on after its image; what follows is passed over")
            }
            Self::PgmLineEnd => write!(
                f,
                "the PGM header has line ends of two bytes (CR LF): as in the loaders, the second is read as the first \
                 pixel, and every pixel stands one to the right"
            ),
            Self::JpegLevels => {
                write!(f, "decoders of JPEG differ by a grey level: a loader may read others")
            }
            Self::NoPercentageAbove1 { count } => {
                let cells = cells_in_words(count);
                write!(
                    f,
                    "no cell above 1: 0 and 1 are read as 0 % and 1 % ({cells}), not as free and occupied"
                )
            }
            Self::BesideUnknown { count } => write!(
                f,
                "{} an ulp or two from 1/2: unknown cells that were averaged in floats, and counted as observed",
                are(count)
            ),
            Self::OftenUnknownValue { grey, count, .. } => write!(
                f,
                "{} of {grey}/255, a grey that often means unknown, counted as observed",
                cells_in_words(count)
            ),
            Self::SixteenBits => {
                write!(f, "the image has 16 bits: nav2_map_server may take its levels for others by 1 of 255")
            }
            Self::PgmMaximum { white } => write!(
                f,
                "the PGM's maximum value is {white}: nav2_map_server may take its levels for others"
            ),
            Self::PgmMaximumRefused { white } => write!(
                f,
                "ROS 1's map_server refuses a PGM of maximum value {white}; its levels are read as of 255"
            ),
            Self::PaletteIndices => write!(
                f,
                "the image has a palette: as in ROS 1's map_server, its indices are read as grey levels"
            ),
            Self::LinesNotUnderstood { lines, ref words } => {
                let are = if lines == 1 { "1 line is".to_owned() } else { format!("{lines} lines are") };
                write!(f, "{are} not understood and passed over, by the first word: ")?;
                let listed: Vec<_> = words.iter().map(|(word, count)| format!("{word} ({count})")).collect();
                f.write_str(&listed.join(", "))?;
                let others = lines - words.iter().map(|(_, count)| count).sum::<u64>();
                if others > 0 { write!(f, " and others ({others})") } else { Ok(()) }
            }
            Self::ScansAtOneTime { count } => {
                write!(f, "{count} scans have the time of the scan before and are passed over")
            }
            Self::CutInLine { line } => write!(f, "line {line}, the last, is cut short and left out"),
            Self::TiltDropped { count, greatest_degrees } => write!(
                f,
                "{count} poses are pitched or rolled by more than 1 degree, up to {greatest_degrees:.1}: dropped, as \
                 scans lie in the plane"
            ),
            Self::BagCutShort { byte, messages } => {
                write!(
                    f,
                    "the bag is cut short at byte {byte} or was not closed: its {messages} whole messages are read"
                )
            }
            Self::UpdatesBeforeMap { count } => {
                write!(f, "{count} updates come before the first map and are passed over")
            }
            Self::Clamped { least, greatest } => {
                write!(f, "probabilities are clamped to {least:.3} to {greatest:.3} by who made them")
            }
            Self::SubmapsTogether { count } => {
                write!(f, "{count} submaps counted together: a place that lies in several counts in each")
            }
            Self::HalvesReadAsUnknown { count, version } => write!(
                f,
                "{} of 127 or 128 of 255, read as unknown as MRPT does: version {version} cannot store 1/2",
                cells_in_words(count)
            ),
        }
    }
}

/// Returns a count of cells in words.
fn cells_in_words(count: u64) -> String {
    if count == 1 { "1 cell".to_owned() } else { format!("{count} cells") }
}

/// Returns a count of cells that are something.
fn are(count: u64) -> String {
    format!("{} {}", cells_in_words(count), if count == 1 { "is" } else { "are" })
}

/// Returns a percentage in words.
fn state_in_words(percent: i8) -> String {
    match percent {
        0 => "free".to_owned(),
        100 => "occupied".to_owned(),
        percent => format!("{percent} percent"),
    }
}
