//! What a reader noticed that makes a map mean less than it seems, with its figures.

mod sentences;

use crate::options::Mode;

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
    /// Grades beyond the thresholds are lost in mode scale: their cells are certain.
    GradesClipped {
        /// The number of grey levels that are lost, but for black, white and what map savers write.
        levels: usize,
        /// The number of cells of these levels.
        count: u64,
        /// The threshold of free cells.
        free_thresh: f64,
        /// The threshold of occupied cells.
        occupied_thresh: f64,
    },
    /// An image has one grey for free and one for occupied cells at most, in probability mode.
    TwoGreys {
        /// The number of these greys, 1 or 2.
        levels: usize,
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
    /// Comments of the yaml file, or values that are not read, are not UTF-8.
    CommentsNotUtf8,
    /// Tabs of the yaml file are read as spaces.
    TabAsSpace {
        /// The first line with one, from 1.
        line: u64,
        /// The number of such lines.
        count: u64,
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
    /// nav2's loader may take the levels of an image with colours or alpha of 16 bits for others by 1 of 255.
    SixteenBits,
    /// The loader takes the levels of an image of this kind for others.
    LevelsDiffer {
        /// The kind, as "a BMP of 16 bits".
        of: &'static str,
    },
    /// ROS 1's loader refuses an image of this kind.
    RefusedByRos1 {
        /// The kind, as "PAM".
        of: &'static str,
    },
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
    /// Scans have no beam and are passed over.
    ScansWithoutBeams {
        /// The number of scans.
        count: u64,
    },
    /// Poses of a topic have the time of the pose before and are passed over.
    PosesAtOneTime {
        /// The number of poses passed over.
        count: u64,
    },
    /// Transforms of TF are no poses and are passed over, as by tf2.
    TransformsUnsound {
        /// The number of transforms.
        count: u64,
    },
    /// The beams of a scan are taken for beams of one time, which they are not.
    BeamsApart {
        /// The longest time from the first beam of a scan to its last, in seconds.
        seconds: f64,
    },
    /// The laser is tilted on the robot, which the plane drops.
    LaserTilted {
        /// The angle between the plane of its beams and that of the robot, in degrees.
        degrees: f64,
    },
    /// A frame is on `/tf_static` and on `/tf`, whose poses hold.
    FrameStaticAndMoving {
        /// The frame.
        frame: String,
    },
    /// A trajectory is that of the laser itself, so that the mount that is given does not apply to it.
    PosesOfLaser,
    /// A laser has no greatest range, so that beams that did not return say nothing.
    NoGreatestRange {
        /// The number of scans.
        count: u64,
    },
    /// The scans of a saved state are what Cartographer keeps of them.
    CloudsThinned,
    /// The last line of a text is cut short and left out, or may be, as nothing ends its last field.
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
    /// Most poses of a text are tilted so far that its numbers seem to be in another order, or not to be a robot's.
    MostTiltedFar {
        /// The number of poses that are tilted by more than 45 degrees.
        count: u64,
        /// The number of all poses.
        poses: u64,
        /// True if most are not if the quaternion is read with w first.
        w_first: bool,
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
    /// A scan of a filter's log has no particles after it and is left out.
    ScanWithoutParticles {
        /// The line of the scan, from 1.
        line: u64,
    },
    /// Weights of a filter's particles are so small beside the greatest that they are 0.
    WeightsUnderflow {
        /// The number of weights, of all steps.
        weights: u64,
    },
    /// A filter's log states that other numbers of particles count than its weights say.
    OtherWeightsStated {
        /// The number of steps.
        steps: u64,
        /// The gain by which the weights were taken.
        gain: f64,
    },
    /// A filter's log states neither the gain of its weights nor a number that would tell it.
    GainNotStated {
        /// The gain by which the weights were taken.
        gain: f64,
    },
    /// Leaves of an octree have log-odds 0, which is unknown.
    LeavesOfLogOdds0 {
        /// The number of leaves.
        leaves: u64,
        /// The number of finest cells that they stand for.
        cells: u64,
    },
    /// Bytes 127 and 128 of an MRPT map before version 3 are read as unknown, as MRPT does.
    HalvesReadAsUnknown {
        /// The number of cells.
        count: u64,
        /// The version of the map.
        version: u8,
    },
}
