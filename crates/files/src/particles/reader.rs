//! The lines of a filter's log.

use super::step::FilterStep;
use crate::error::{Error, ErrorKind};
use crate::scans::carmen::{customary_bearings, stated_maximum_range};
use crate::scans::{RangeScan, ScanOptions};
use crate::text::{Fields, Line, Lines};
use crate::trajectory::check_time;
use crate::warning::Warning;
use crate::words::Words;
use mean_information::scan::Pose;
use std::io::BufRead;

/// What was read so far.
#[derive(Debug)]
pub(super) struct Reader<'a> {
    options: &'a ScanOptions,
    pub(super) steps: Vec<FilterStep>,
    pub(super) gain: Option<f64>,
    maximum_range: Option<f64>,
    particles: Option<usize>,
    /// A scan, and its line, before its particles.
    pending: Option<(RangeScan, u64)>,
    words: Words,
}

impl<'a> Reader<'a> {
    /// Creates a reader that has read nothing.
    pub(super) fn new(options: &'a ScanOptions) -> Self {
        Self {
            options,
            steps: Vec::new(),
            gain: None,
            maximum_range: None,
            particles: None,
            pending: None,
            words: Words::default(),
        }
    }

    /// Reads all lines; returns what was noticed.
    pub(super) fn read(&mut self, input: impl BufRead) -> Result<Vec<Warning>, Error> {
        let mut lines = Lines::new(input);
        let mut warnings = Vec::new();
        while let Some(line) = lines.next()? {
            if line.may_be_cut() {
                warnings.push(Warning::CutInLine { line: line.number });
                continue;
            }
            match self.line(line) {
                Ok(()) => {}
                Err(error) if !line.ended && error.kind() == ErrorKind::Format => {
                    warnings.push(Warning::CutInLine { line: line.number });
                }
                Err(error) => return Err(error),
            }
        }
        warnings.extend(self.words.warning());
        if let Some((_, line)) = self.pending {
            warnings.push(Warning::ScanWithoutParticles { line });
        }
        Ok(warnings)
    }

    /// Takes in a line.
    fn line(&mut self, line: Line<'_>) -> Result<(), Error> {
        let mut fields = line.fields();
        match fields.word() {
            Some(b"LASER_READING") => self.reading(line, fields),
            Some(b"SM_UPDATE") => self.update(line, fields),
            Some(b"NEFF") => {
                let effective = fields.finite("NEFF")?;
                let step = self.steps.last_mut().filter(|_| self.pending.is_none());
                step.ok_or_else(|| before_update(line))?.stated_effective = Some(effective);
                Ok(())
            }
            Some(b"RESAMPLE") => self.resample(line, fields),
            Some(b"ODO_UPDATE") => self.count(&mut fields).map(|_| ()),
            Some(b"PARAM") => self.parameter(fields),
            Some(b"ODOM" | b"FRAME" | b"SIMULATOR_POS" | b"ENTROPY" | b"COMMENT") | None => Ok(()),
            Some(word) => {
                if !word.starts_with(b"#") {
                    self.words.add(word);
                }
                Ok(())
            }
        }
    }

    /// Takes in a parameter.
    fn parameter(&mut self, mut fields: Fields<'_>) -> Result<(), Error> {
        let place = match fields.word() {
            Some(b"ogain") => &mut self.gain,
            Some(b"maxrange") => &mut self.maximum_range,
            _ => return Ok(()),
        };
        let value = fields.finite("a parameter")?;
        if value <= 0.0 {
            return Err(fields.out_of_range("a parameter", value, "a positive number"));
        }
        *place = Some(value);
        Ok(())
    }

    /// Takes the number of particles, which never changes.
    fn count(&mut self, fields: &mut Fields<'_>) -> Result<usize, Error> {
        let count = fields.count("the number of particles")?;
        let before = *self.particles.get_or_insert(usize::try_from(count).unwrap_or(usize::MAX));
        if count == before as u64 && count > 0 {
            return Ok(before);
        }
        Err(fields.out_of_range("the number of particles", count, "1 or more, the same in all lines"))
    }

    /// Takes in a scan.
    fn reading(&mut self, line: Line<'_>, mut fields: Fields<'_>) -> Result<(), Error> {
        if let Some((_, before)) = self.pending {
            let words = format!("has a scan, but that of line {before} has no SM_UPDATE");
            return Err(line.refuse(ErrorKind::Format, &words));
        }
        let count = fields.count("the number of beams")?;
        // Memory follows the line.
        let mut ranges = Vec::new();
        for _ in 0..count {
            ranges.push(fields.number("a range")?);
        }
        let odometry = pose(&mut fields)?;
        let time = fields.finite("time")?;
        let before = self.steps.last().map(|step| step.scan.time());
        check_time(time, before).map_err(|error| line.blame(error))?;
        let bearings = customary_bearings(ranges.len()).map_err(|error| line.blame(error))?;
        let greatest = stated_maximum_range(self.options.maximum_range.or(self.maximum_range));
        let scan =
            RangeScan::new(time, bearings, ranges, [0.0, greatest]).map_err(|error| line.blame(error))?;
        self.pending = Some((scan.with_odometry(odometry), line.number));
        Ok(())
    }

    /// Takes in the particles of a scan.
    fn update(&mut self, line: Line<'_>, mut fields: Fields<'_>) -> Result<(), Error> {
        let count = self.count(&mut fields)?;
        let (mut poses, mut log_weights) = (Vec::new(), Vec::new());
        for _ in 0..count {
            poses.push(pose(&mut fields)?);
            log_weights.push(fields.finite("the logarithm of a weight")?);
        }
        if fields.word().is_some() {
            return Err(line.refuse(ErrorKind::Format, &format!("goes on after {count} particles")));
        }
        let Some((scan, _)) = self.pending.take() else {
            return Err(line.refuse(ErrorKind::Format, "has an SM_UPDATE without a LASER_READING before it"));
        };
        self.steps.push(FilterStep { scan, poses, log_weights, stated_effective: None, resampled: None });
        Ok(())
    }

    /// Takes in a resampling.
    fn resample(&mut self, line: Line<'_>, mut fields: Fields<'_>) -> Result<(), Error> {
        let count = self.count(&mut fields)?;
        let mut resampled = Vec::new();
        for _ in 0..count {
            let index = fields.count("a resampled particle")?;
            if usize::try_from(index).map_or(true, |index| index >= count) {
                let refused = fields.out_of_range("a resampled particle", index, "a particle, from 0");
                return Err(refused.followed_by(&format!(" to {}", count - 1)));
            }
            resampled.push(index as usize);
        }
        if fields.word().is_some() {
            return Err(line.refuse(ErrorKind::Format, &format!("goes on after {count} particles")));
        }
        let step = self.steps.last_mut().filter(|_| self.pending.is_none());
        let step = step.ok_or_else(|| before_update(line))?;
        if step.resampled.is_some() {
            return Err(line.refuse(ErrorKind::Format, "resamples a second time after one SM_UPDATE"));
        }
        step.resampled = Some(resampled);
        Ok(())
    }
}

/// Takes a pose.
fn pose(fields: &mut Fields<'_>) -> Result<Pose, Error> {
    Ok(Pose::new(fields.finite("x")?, fields.finite("y")?, fields.finite("theta")?)?)
}

/// Creates the error of a line that speaks of particles of a scan before they are known.
fn before_update(line: Line<'_>) -> Error {
    line.refuse(ErrorKind::Format, "comes before the SM_UPDATE of its scan")
}
