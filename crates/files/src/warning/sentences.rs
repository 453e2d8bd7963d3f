//! The sentence of each warning.

use super::{SAVED_UNKNOWN, Warning};
use crate::error::{bounded, short};
use crate::options::Mode;
use std::fmt;

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
                        " under free_thresh {}; a free_thresh of 0.196 keeps that grey unknown",
                        short(thresh)
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
            Self::GradesClipped { levels, count, free_thresh, occupied_thresh } => {
                let [free, occupied] = [free_thresh, occupied_thresh].map(short);
                write!(
                    f,
                    "{} of {levels} grey levels made certain by free_thresh {free} and occupied_thresh {occupied}; \
                     thresholds of 0.0 and 1.0 keep their grades",
                    cells_in_words(count)
                )
            }
            Self::TwoGreys { levels } => write!(
                f,
                "the image has {levels} grey level{} beside unknown: it was thresholded before it was saved",
                if levels == 1 { "" } else { "s" }
            ),
            Self::ThresholdsAbove1 { free, occupied } => {
                let above = free.max(occupied);
                let [free, occupied] = [free, occupied].map(short);
                write!(
                    f,
                    "thresholds above 1 (free_thresh {free}, occupied_thresh {occupied}): no cell is above 1"
                )?;
                if (2.0..=100.0).contains(&above) {
                    write!(f, "; if they are percentages, write {} for {above}", above / 100.0)?;
                }
                Ok(())
            }
            Self::ThresholdsCross { free, occupied, free_wins } => {
                let state = if free_wins { "free" } else { "occupied" };
                let [free, occupied] = [free, occupied].map(short);
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
            Self::CommentsNotUtf8 => {
                write!(
                    f,
                    "comments of the yaml file are not UTF-8, or values not read here; they are passed over"
                )
            }
            Self::TabAsSpace { line, count } => {
                write!(f, "line {line} of the yaml file has a tab, which is read as a space")?;
                if count > 1 { write!(f, ", as in {} more lines", count - 1) } else { Ok(()) }
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
            Self::SixteenBits => write!(
                f,
                "the image has colours or alpha of 16 bits: nav2_map_server may take its levels for others by 1 of 255"
            ),
            Self::LevelsDiffer { of } => {
                write!(f, "the loader takes the levels of {of} for others; save it as PNG")
            }
            Self::RefusedByRos1 { of } => {
                write!(f, "ROS 1's map_server refuses {of}; it is read by its rules all the same")
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
            Self::ScansWithoutBeams { count } => write!(f, "{count} scans have no beam and are passed over"),
            Self::PosesAtOneTime { count } => {
                write!(f, "{count} poses have the time of the pose before and are passed over")
            }
            Self::TransformsUnsound { count } => write!(
                f,
                "{count} transforms are no poses (not finite, no unit quaternion, no frame) and passed over, as by tf2"
            ),
            Self::BeamsApart { seconds } => write!(
                f,
                "the beams of a scan are up to {seconds:.3} s apart (time_increment), which is not corrected: all are taken \
                 to be of the time of the first"
            ),
            Self::LaserTilted { degrees } => {
                write!(f, "the laser is tilted by {degrees:.1} degrees: dropped, as scans lie in the plane")
            }
            Self::FrameStaticAndMoving { ref frame } => write!(
                f,
                "frame {} is on /tf_static and on /tf: the poses of /tf hold, as in tf2 from its first message there on",
                bounded(frame)
            ),
            Self::PosesOfLaser => write!(
                f,
                "TF moves the laser itself, whose poses these are: the mount that is given does not apply to them"
            ),
            Self::NoGreatestRange { count } => write!(
                f,
                "{count} scans have no greatest range: beams that did not return are left out, as nothing says how far space \
                 is free"
            ),
            Self::CloudsThinned => write!(
                f,
                "the scans are the points that Cartographer keeps, thinned out and without beams that did not return; beams \
                 are taken from the origin of the tracking frame, as Cartographer inserts them"
            ),
            Self::CutInLine { line } => {
                write!(f, "line {line}, the last, is cut short, or may be, as it has no end: it is left out")
            }
            Self::TiltDropped { count, greatest_degrees } => write!(
                f,
                "{count} poses are pitched or rolled by more than 1 degree, up to {greatest_degrees:.1}: dropped, as \
                 scans lie in the plane"
            ),
            Self::MostTiltedFar { count, poses, w_first } => {
                write!(f, "{count} of {poses} poses are tilted by more than 45 degrees")?;
                f.write_str(if w_first {
                    ", but not if w comes first: the quaternions seem to be qw qx qy qz, where TUM text has qx qy qz qw, w last"
                } else {
                    ": z does not point up in them, as in the frame of a camera; give the poses of the robot or of the laser"
                })
            }
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
            Self::ScanWithoutParticles { line } => {
                write!(f, "the scan of line {line} has no particles after it and is left out")
            }
            Self::WeightsUnderflow { weights } => {
                write!(
                    f,
                    "{weights} weights of particles are 0: their logarithms are too far below the greatest"
                )
            }
            Self::OtherWeightsStated { steps, gain } => write!(
                f,
                "in {steps} steps another number of particles counts than the log states: its weights were not taken \
                 by a gain of {gain}"
            ),
            Self::GainNotStated { gain } => write!(
                f,
                "the log states no gain of its weights (PARAM ogain), and no numbers of particles that count (NEFF): they are \
                 taken by a gain of {gain}"
            ),
            Self::LeavesOfLogOdds0 { leaves, cells } => {
                let of = if leaves == 1 { "1 leaf has".to_owned() } else { format!("{leaves} leaves have") };
                write!(f, "{of} log-odds 0, which is unknown: {} of the finest", cells_in_words(cells))
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
