//! The scans of a bag, collected message by message, with the transforms and poses beside them.

use super::delivery::{Message, Topic, Visitor};
use super::fields::Header;
use super::scan::ScanMessage;
use super::stamped::{POSE_KINDS, PoseMessage};
use super::transforms::{TF_KINDS, Transforms};
use crate::error::{Error, ErrorKind};
use crate::scans::{Kept, RangeScan, ScanOptions, Selection};
use crate::trajectory::{Rigid, check_time};
use std::collections::{BTreeMap, BTreeSet};

/// What is taken of a bag.
#[derive(Debug)]
pub(super) struct Recording<'a> {
    options: &'a ScanOptions,
    selection: &'a Selection,
    /// The topics of scans.
    pub(super) scan_topics: BTreeSet<String>,
    /// The topics of poses.
    pub(super) pose_topics: BTreeSet<String>,
    /// The topic whose scans are kept.
    pub(super) topic: Option<String>,
    /// The frame of its scans.
    pub(super) laser: Option<String>,
    /// The scans, whose times ascend.
    pub(super) scans: Vec<RangeScan>,
    /// The poses of each topic that is wanted.
    pub(super) poses: BTreeMap<String, Poses>,
    /// The transforms, by what stands before `/tf` in the name of their topic.
    pub(super) transforms: BTreeMap<String, Transforms>,
    /// The number of scans at the time of the scan before.
    pub(super) same_time: u64,
    /// The number of scans without a beam.
    pub(super) empty: u64,
    /// The number of scans whose laser has no greatest range.
    pub(super) limitless: u64,
    /// The longest time between the first beam of a scan and its last, in seconds.
    pub(super) duration: f64,
    kept: Kept,
}

/// The poses of a topic.
#[derive(Debug, Default)]
pub(super) struct Poses {
    /// The frame of which they are, where the topic names it.
    pub(super) child: Option<String>,
    /// The times, in seconds, which ascend.
    pub(super) times: Vec<f64>,
    /// What was at these times.
    pub(super) rigid: Vec<Rigid>,
    /// The number of poses at the time of the pose before.
    pub(super) same_time: u64,
}

impl<'a> Recording<'a> {
    /// Creates a recording of nothing.
    pub(super) fn new(options: &'a ScanOptions, selection: &'a Selection) -> Self {
        Self {
            options,
            selection,
            scan_topics: BTreeSet::new(),
            pose_topics: BTreeSet::new(),
            topic: None,
            laser: None,
            scans: Vec::new(),
            poses: BTreeMap::new(),
            transforms: BTreeMap::new(),
            same_time: 0,
            empty: 0,
            limitless: 0,
            duration: 0.0,
            kept: Kept::default(),
        }
    }

    /// Takes a scan.
    fn scan(&mut self, message: &Message<'_>) -> Result<(), Error> {
        let ScanMessage { header, scan, duration, is_limitless } = ScanMessage::read(message, self.options)?;
        let laser = self.laser.get_or_insert_with(|| header.frame.to_owned());
        if *laser != header.frame {
            let words = format!("is a scan in frame {}, after those in frame {laser}", header.frame);
            let refused = Error::new(ErrorKind::Unsupported, words).with_value(header.frame);
            return Err(refused.allowing("; allowed is ", "one laser a topic").at(header.place));
        }
        let Some(scan) = scan else {
            self.empty += 1;
            return Ok(());
        };
        if is_repeated(&header, self.scans.last().map(RangeScan::time))? {
            self.same_time += 1;
            return Ok(());
        }
        self.duration = if duration.abs() > self.duration { duration.abs() } else { self.duration };
        self.limitless += u64::from(is_limitless);
        self.kept.add(scan.ranges().len() + RangeScan::BESIDE_RANGES)?;
        self.scans.push(scan);
        Ok(())
    }

    /// Takes a pose.
    fn pose(&mut self, message: &Message<'_>) -> Result<(), Error> {
        let PoseMessage { header, child, pose } = PoseMessage::read(message)?;
        let poses = self.poses.entry(message.topic.name.clone()).or_default();
        if is_repeated(&header, poses.times.last().copied())? {
            poses.same_time += 1;
            return Ok(());
        }
        let child = child.map(str::to_owned);
        if poses.times.is_empty() {
            poses.child = child;
        } else if poses.child != child {
            let name = |frame: Option<String>| frame.unwrap_or_else(|| "no name".to_owned());
            let words =
                format!("has a pose of frame {}, after those of {}", name(child), name(poses.child.clone()));
            return Err(Error::new(ErrorKind::Format, words).at(header.place));
        }
        self.kept.add(8)?;
        poses.times.push(header.time);
        poses.rigid.push(pose);
        Ok(())
    }
}

/// Tells whether a message has the time of the one before.
fn is_repeated(header: &Header<'_>, before: Option<f64>) -> Result<bool, Error> {
    if before == Some(header.time) {
        return Ok(true);
    }
    let jumped = |error: Error| {
        error.followed_by("; the clock jumps back there: part the bag").at(header.place.clone())
    };
    check_time(header.time, before).map_err(jumped)?;
    Ok(false)
}

/// Tells whether a topic of this name is listened to for transforms: not `/tf_old`, to which another run was renamed.
fn is_tf(topic: &str) -> bool {
    matches!(topic.rsplit('/').next(), Some("tf" | "tf_static"))
}

/// Returns the namespace of a topic of transforms, and whether they are static.
fn namespace(topic: &str) -> (&str, bool) {
    let (before, name) = topic.rsplit_once('/').unwrap_or(("", topic));
    (before, name == "tf_static")
}

impl Visitor for Recording<'_> {
    fn wants(&mut self, topic: &Topic) -> bool {
        let Topic { name, kind, .. } = topic;
        if kind == ScanMessage::KIND {
            self.scan_topics.insert(name.clone());
            if self.topic.is_none() && self.selection.topic.as_ref().is_none_or(|wanted| wanted == name) {
                self.topic = Some(name.clone());
            }
            return self.topic.as_ref() == Some(name);
        }
        if POSE_KINDS.contains(&&**kind) {
            self.pose_topics.insert(name.clone());
            return self.selection.pose_topics.contains(name);
        }
        TF_KINDS.contains(&&**kind) && is_tf(name)
    }

    fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
        let Topic { name, kind, .. } = message.topic;
        if kind == ScanMessage::KIND {
            self.scan(message)
        } else if TF_KINDS.contains(&&**kind) {
            let (namespace, is_static) = namespace(name);
            let transforms = self.transforms.entry(namespace.to_owned()).or_default();
            transforms.take(message, is_static, &mut self.kept)
        } else {
            self.pose(message)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::bags::Encoding;

    /// The bytes of a header, as ROS 1 has them.
    fn header(time: u32, frame: &str) -> Vec<u8> {
        let numbers = [9, time, 0, frame.len() as u32].map(u32::to_le_bytes);
        [numbers.as_flattened(), frame.as_bytes()].concat()
    }

    fn singles(numbers: &[f32]) -> Vec<u8> {
        numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
    }

    /// What is kept of a message is counted: of a scan its ranges and 24 numbers, of a transform 8, of a frame 32 and its names.
    #[test]
    fn what_is_kept_is_counted() {
        let limits = singles(&[0.0, 1.0, 0.25, 0.0, 0.0, 0.0, 8.0]);
        let scan =
            [header(1, "laser"), limits, 3_u32.to_le_bytes().into(), singles(&[1.0, 2.0, 3.0])].concat();
        let turn = [0.0_f64, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0].map(f64::to_le_bytes);
        let child = [&40_u32.to_le_bytes(), "c".repeat(40).as_bytes(), turn.as_flattened()].concat();
        let [first, second] = [1, 2].map(|time| [header(time, &"b".repeat(80)), child.clone()].concat());
        let transforms = [2_u32.to_le_bytes().into(), first, second].concat();
        let (options, selection) = (ScanOptions::default(), Selection::default());
        for (name, kind, bytes, numbers) in [
            ("/scan", ScanMessage::KIND, &scan, 24 + 3),
            ("/tf", TF_KINDS[0], &transforms, 2 * 8 + 32 + (2 * 40 + 80) / 8),
        ] {
            let topic = Topic { name: name.to_owned(), kind: kind.to_owned(), encoding: Encoding::Ros1 };
            let message = Message { topic: &topic, number: 1, time_ns: 0, bytes };
            for (room, kept) in [(numbers, Ok(())), (numbers - 1, Err(ErrorKind::OutOfMemory))] {
                let mut recording = Recording::new(&options, &selection);
                recording.kept = Kept::with_room(room);
                assert_eq!(recording.take(&message).map_err(|error| error.kind()), kept, "{name}");
            }
        }
    }
}
