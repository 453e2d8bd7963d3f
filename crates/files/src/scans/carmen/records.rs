//! The records of a log, one at a time.

use super::message::{front_laser, odometry, robot_laser};
use super::parameters::Parameters;
use crate::error::{Error, ErrorKind};
use crate::scans::mount::Mount;
use crate::scans::options::ScanOptions;
use crate::scans::range_scan::RangeScan;
use crate::text::{Line, Lines};
use crate::trajectory::check_time;
use crate::warning::Warning;
use crate::words::Words;
use mean_information::scan::Pose;
use std::io::BufRead;

/// A record of a CARMEN log.
#[derive(Clone, Debug, PartialEq)]
pub enum Record {
    /// A scan, of `FLASER` or `ROBOTLASER1`.
    Scan(RangeScan),
    /// A pose by odometry, of `ODOM`.
    Odometry {
        /// The time, in seconds.
        time: f64,
        /// The pose of the robot.
        pose: Pose,
    },
}

/// The records of a CARMEN log, in the order of the file; memory holds a line at a time. An error ends them.
///
/// The times of scans ascend: one that repeats the time of the scan before is passed over and counted in
/// [`Warning::ScansAtOneTime`], one before it is refused.
///
/// ```
/// use mean_information_files::scans::{ScanOptions, carmen::{Record, Records}};
///
/// let log = "# a robot\nPARAM laser_front_laser_resolution 45\nODOM 0 0 0.1 0 0 0 2.5 host 0.5\n\
///            FLASER 3 2.25 81.91 1.75 0 0 0.1 0 0 0.1 2.75 host 0.75\nHELLO 1 2 3\nFLASER 3 2.25 81";
/// let mut records = Records::new(log.as_bytes(), &ScanOptions::default());
/// let read = records.by_ref().collect::<Result<Vec<_>, _>>()?;
/// let [Record::Odometry { time, .. }, Record::Scan(scan)] = &read[..] else { panic!("{read:?}") };
/// assert_eq!((*time, scan.time(), scan.bearings().at(0)), (2.5, 2.75, -std::f64::consts::FRAC_PI_4));
/// let words: Vec<_> = records.warnings().iter().map(ToString::to_string).collect();
/// assert_eq!(words[0], "1 line is not understood and passed over, by the first word: HELLO (1)");
/// assert_eq!(words[1], "line 6, the last, is cut short, or may be, as it has no end: it is left out");
/// # Ok::<(), mean_information_files::Error>(())
/// ```
///
/// Each item is an [`Error`] with the line where a message of a known name lacks a field or has one that cannot be meant:
/// a scan of no beam, angles that do not fit the number of beams, a time before that of the scan before.
#[derive(Debug)]
pub struct Records<R> {
    lines: Lines<R>,
    options: ScanOptions,
    parameters: Parameters,
    mount: Mount,
    last: Option<f64>,
    words: Words,
    same_time: u64,
    cut: Option<u64>,
    ended: bool,
}

/// What a line is.
enum Kind {
    Record(Record),
    /// A scan whose poses tell where its laser is mounted.
    Mounted(RangeScan),
    Nothing,
    NotUnderstood,
}

impl<R: BufRead> Records<R> {
    /// Creates the records of a log.
    pub fn new(input: R, options: &ScanOptions) -> Self {
        Self {
            lines: Lines::new(input),
            options: options.clone(),
            parameters: Parameters::default(),
            mount: Mount::Unknown,
            last: None,
            words: Words::default(),
            same_time: 0,
            cut: None,
            ended: false,
        }
    }

    /// Returns the signs, in the lines read so far, that the log means less than it seems.
    pub fn warnings(&self) -> Vec<Warning> {
        let mut warnings = Vec::new();
        warnings.extend(self.words.warning());
        if self.same_time > 0 {
            warnings.push(Warning::ScansAtOneTime { count: self.same_time });
        }
        warnings.extend(self.cut.map(|line| Warning::CutInLine { line }));
        warnings
    }

    /// Returns the pose of the laser in the frame of the robot, by the lines read so far: that of the parameters, or that
    /// of all `ROBOTLASER1`.
    pub fn mount(&self) -> Option<Pose> {
        self.parameters.mount().or(self.mount.same())
    }

    /// Reads up to the next record.
    fn advance(&mut self) -> Result<Option<Record>, Error> {
        while let Some(line) = self.lines.next()? {
            let kind = match read(line, &mut self.parameters, &self.options) {
                Ok(Kind::NotUnderstood) if !line.ended => None,
                Err(error) if line.may_be_cut() || !line.ended && error.kind() == ErrorKind::Format => None,
                read => Some(read?),
            };
            let (scan, mounted) = match kind {
                None => {
                    self.cut = Some(line.number);
                    return Ok(None);
                }
                Some(Kind::NotUnderstood) => {
                    self.words.add(line.fields().word().unwrap_or_default());
                    continue;
                }
                Some(Kind::Nothing) => continue,
                Some(Kind::Record(Record::Scan(scan))) => (scan, false),
                Some(Kind::Mounted(scan)) => (scan, true),
                Some(Kind::Record(record)) => return Ok(Some(record)),
            };
            if self.last == Some(scan.time()) {
                self.same_time += 1;
                continue;
            }
            if let Err(error) = check_time(scan.time(), self.last) {
                if line.may_be_cut() {
                    self.cut = Some(line.number);
                    return Ok(None);
                }
                return Err(line.blame(error));
            }
            self.last = Some(scan.time());
            if mounted && let (Some(robot), Some(laser)) = (scan.odometry(), scan.laser()) {
                self.mount.see(robot, laser).map_err(|error| line.blame(error.into()))?;
            }
            return Ok(Some(Record::Scan(scan)));
        }
        Ok(None)
    }
}

impl<R: BufRead> Iterator for Records<R> {
    type Item = Result<Record, Error>;

    fn next(&mut self) -> Option<Self::Item> {
        if self.ended {
            return None;
        }
        let next = self.advance().transpose();
        self.ended = !matches!(next, Some(Ok(_)));
        next
    }
}

/// Reads a line.
fn read(line: Line<'_>, parameters: &mut Parameters, options: &ScanOptions) -> Result<Kind, Error> {
    let mut fields = line.fields();
    let Some(word) = fields.word() else {
        return Ok(Kind::Nothing);
    };
    Ok(match word {
        b"FLASER" => Kind::Record(Record::Scan(front_laser(line, &mut fields, parameters, options)?)),
        b"ROBOTLASER1" => Kind::Mounted(robot_laser(line, &mut fields, options)?),
        b"ODOM" => {
            let (time, pose) = odometry(&mut fields, options)?;
            Kind::Record(Record::Odometry { time, pose })
        }
        b"PARAM" => {
            parameters.read(&mut fields)?;
            Kind::Nothing
        }
        b"RLASER" | b"ROBOTLASER2" | b"SYNC" | b"TRUEPOS" => Kind::Nothing,
        word if word.starts_with(b"#") || word.starts_with(b"RAWLASER") => Kind::Nothing,
        _ => Kind::NotUnderstood,
    })
}
