//! The messages of scans: `sensor_msgs/LaserScan`.

use super::delivery::Message;
use super::fields::{Fields, Header};
use crate::error::Error;
use crate::scans::{Bearings, FARTHEST, RangeScan, ScanOptions};

/// A message of type `sensor_msgs/LaserScan`.
pub(super) struct ScanMessage<'a> {
    /// The time of the first beam, and the frame of the laser.
    pub(super) header: Header<'a>,
    /// The scan; `None` if it has no beam.
    pub(super) scan: Option<RangeScan>,
    /// The time from the first beam to the last, in seconds.
    pub(super) duration: f64,
    /// Whether neither the laser nor the caller has a greatest range.
    pub(super) is_limitless: bool,
}

impl<'a> ScanMessage<'a> {
    /// The name of its type.
    pub(super) const KIND: &'static str = "sensor_msgs/LaserScan";

    /// Reads a message. The bearing of the last beam is not asked for: drivers disagree whether it is that of a beam.
    ///
    /// # Errors
    /// An [`Error`] with the byte in the message at which it is not one, or no scan of [`RangeScan::new`].
    pub(super) fn read(message: &Message<'a>, options: &ScanOptions) -> Result<Self, Error> {
        let mut fields = Fields::new(message)?;
        let header = fields.header()?;
        let place = fields.place(4);
        let [start, _last_bearing, increment] = [fields.f32()?, fields.f32()?, fields.f32()?].map(f64::from);
        let [time_increment, _scan_time] = [fields.f32()?, fields.f32()?];
        let [least, own] = [fields.f32()?, fields.f32()?].map(f64::from);
        // REP 117: a laser may see without a limit; what does not return from there says nothing of how far space is free.
        let (greatest, is_limitless) = match (own == f64::INFINITY, options.maximum_range) {
            (true, None) => (FARTHEST, true),
            (true, Some(wanted)) => (wanted, false),
            (false, wanted) => (wanted.map_or(own, |wanted| wanted.min(own)), false),
        };
        // Memory follows the numbers, not the count.
        let mut ranges = Vec::new();
        for _ in 0..fields.u32()? {
            let range = f64::from(fields.f32()?);
            // REP 117: finite beyond the greatest range is an error code, such as that range and a metre; infinity is no return.
            let is_error = range.is_finite() && range > own || is_limitless && range == f64::INFINITY;
            ranges.push(if is_error { f64::NAN } else { range });
        }
        let duration = f64::from(time_increment) * ranges.len().saturating_sub(1) as f64;
        if ranges.is_empty() {
            return Ok(Self { header, scan: None, duration, is_limitless });
        }
        let scan =
            RangeScan::new(header.time, Bearings::Even { start, increment }, ranges, [least, greatest]);
        Ok(Self { header, scan: Some(scan.map_err(|error| error.at(place))?), duration, is_limitless })
    }
}
