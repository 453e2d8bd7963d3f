//! Messages of a bag, and how the readers of all containers hand them over.

use crate::error::{Error, ErrorKind, Place};
use std::collections::BTreeMap;
use std::io::{self, Read};

/// The bytes of a message beside its cells: its header, its names.
const BESIDE_CELLS: u64 = 1 << 20;
/// The most bytes of the names of topics and types of a bag, which chunks may hold compressed; real ones have thousands.
const MOST_NAMES: u64 = 1 << 24;
/// The bytes that a topic takes beside its names.
const OF_TOPIC: u64 = 256;

/// The serialisation of messages.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// CDR, as in ROS 2.
    Cdr,
    /// ROS 1's.
    Ros1,
    /// Another one.
    Other,
}

impl Encoding {
    /// Returns the encoding of a name, as containers have it.
    pub(super) fn named(name: &str) -> Self {
        match name {
            "cdr" => Self::Cdr,
            "ros1" => Self::Ros1,
            _ => Self::Other,
        }
    }
}

/// A topic of a bag.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Topic {
    /// The name, as in `/map`.
    pub name: String,
    /// The type of its messages, as in `nav_msgs/OccupancyGrid`, also where ROS 2 says `nav_msgs/msg/OccupancyGrid`.
    pub kind: String,
    /// The serialisation of its messages.
    pub encoding: Encoding,
}

impl Topic {
    /// Creates a topic.
    pub(super) fn new(name: String, kind: &str, encoding: Encoding) -> Self {
        Self { name, kind: kind.replacen("/msg/", "/", 1), encoding }
    }
}

/// A message of a bag.
#[derive(Clone, Copy, Debug)]
pub struct Message<'a> {
    /// The topic.
    pub topic: &'a Topic,
    /// The number among those of the topic, from 1.
    pub number: u64,
    /// The time at which it was recorded, in nanoseconds.
    pub time_ns: u64,
    /// The bytes, serialised.
    pub bytes: &'a [u8],
}

/// A use of the messages of a bag.
pub trait Visitor {
    /// Tells whether the messages of a topic are wanted. Called once for each topic of each file of a bag.
    fn wants(&mut self, topic: &Topic) -> bool;

    /// Takes a message of a topic that is wanted.
    ///
    /// # Errors
    /// An [`Error`], which ends the reading.
    fn take(&mut self, message: &Message<'_>) -> Result<(), Error>;
}

/// The messages of a bag on their way to a visitor.
pub(super) struct Delivery<'a> {
    visitor: &'a mut dyn Visitor,
    /// The topics of this file by the number that it gives them, and whether they are wanted.
    topics: BTreeMap<u64, (Topic, bool)>,
    /// The number of messages so far, by topic.
    counts: BTreeMap<String, u64>,
    /// The most bytes of a message.
    most: u64,
    /// The bytes of the names so far.
    names: u64,
    buffer: Vec<u8>,
}

impl<'a> Delivery<'a> {
    /// Creates a delivery of messages that hold at most `max_cells` cells.
    pub(super) fn new(visitor: &'a mut dyn Visitor, max_cells: u64) -> Self {
        let most = max_cells.saturating_add(BESIDE_CELLS);
        Self { visitor, topics: BTreeMap::new(), counts: BTreeMap::new(), most, names: 0, buffer: Vec::new() }
    }

    /// Counts the names that are kept, of topics and types.
    pub(super) fn keep_names(&mut self, names: &[&str]) -> Result<(), Error> {
        let bytes: u64 = names.iter().map(|name| name.len() as u64).sum();
        self.names = self.names.saturating_add(OF_TOPIC + 2 * bytes);
        if self.names <= MOST_NAMES {
            return Ok(());
        }
        let refused =
            Error::new(ErrorKind::OutOfMemory, "declares more topics and types than memory is kept for");
        Err(refused
            .with_value(self.names.to_string())
            .allowing(", allowed are ", format!("{MOST_NAMES} bytes")))
    }

    /// Returns the most bytes that a message of a wanted topic may have.
    #[cfg(feature = "sqlite")]
    pub(super) fn most(&self) -> u64 {
        self.most
    }

    /// Begins another file of the bag, which numbers its topics anew.
    pub(super) fn begin_file(&mut self) {
        self.topics.clear();
    }

    /// Declares the topic that the file calls `id`; a second time, it must be the same.
    pub(super) fn declare(&mut self, id: u64, topic: Topic) -> Result<(), Error> {
        match self.topics.get(&id) {
            Some((known, _)) if *known == topic => Ok(()),
            Some((known, _)) => {
                let both =
                    format!("{} of type {} and {} of {}", known.name, known.kind, topic.name, topic.kind);
                let message = format!("gives the number {id} to two topics, {both}");
                Err(Error::new(ErrorKind::Format, message).with_value(id.to_string()))
            }
            None => {
                self.keep_names(&[&topic.name, &topic.kind])?;
                let wanted = self.visitor.wants(&topic);
                self.topics.insert(id, (topic, wanted));
                Ok(())
            }
        }
    }

    /// Returns the numbers of the topics that are wanted.
    #[cfg(feature = "sqlite")]
    pub(super) fn wanted(&self) -> impl Iterator<Item = u64> {
        self.topics.iter().filter(|(_, (_, wanted))| *wanted).map(|(&id, _)| id)
    }

    /// Returns the number of messages so far.
    pub(super) fn messages(&self) -> u64 {
        self.counts.values().sum()
    }

    /// Reads the next `length` bytes of `input`, a message, and hands it over if it is wanted.
    pub(super) fn read(
        &mut self,
        id: u64,
        time_ns: u64,
        length: u64,
        input: &mut dyn Read,
    ) -> Result<(), Error> {
        let mut buffer = std::mem::take(&mut self.buffer);
        buffer.clear();
        match self.topics.get(&id) {
            Some((topic, true)) if length > self.most => {
                let words = format!("claims {length} bytes, more than the limit of {}", self.most);
                let refused = Error::new(ErrorKind::TooLarge, words).with_value(length.to_string());
                let number = self.counts.get(&topic.name).map_or(1, |count| count + 1);
                return Err(of_message(topic, number, refused));
            }
            Some((_, true)) => read_exactly(input, length, &mut buffer)?,
            _ => skip(input, length)?,
        }
        let handed = self.hand_over(id, time_ns, &buffer);
        self.buffer = buffer;
        handed
    }

    /// Hands over a message if it is wanted, and counts it.
    pub(super) fn hand_over(&mut self, id: u64, time_ns: u64, bytes: &[u8]) -> Result<(), Error> {
        let Some((topic, wanted)) = self.topics.get(&id) else {
            let message = format!("has a message of topic number {id}, which no record declares before it");
            return Err(Error::new(ErrorKind::Format, message).with_value(id.to_string()));
        };
        let count = match self.counts.get_mut(&topic.name) {
            Some(count) => count,
            None => self.counts.entry(topic.name.clone()).or_default(),
        };
        *count += 1;
        let message = Message { topic, number: *count, time_ns, bytes };
        if !wanted {
            return Ok(());
        }
        self.visitor.take(&message).map_err(|error| of_message(topic, message.number, error))
    }
}

/// Says which message an error is of, and at which byte of it.
pub(super) fn of_message(topic: &Topic, number: u64, error: Error) -> Error {
    let byte = match error.place() {
        Some(&Place::Byte(byte)) => Some(byte),
        _ => None,
    };
    let topic = topic.name.clone();
    let at = byte.map_or(String::new(), |byte| format!(", byte {byte} of it"));
    error.preceded_by(&format!("message {number} of {topic}{at}: ")).at(Place::Message {
        topic,
        number,
        byte,
    })
}

/// Reads `length` bytes into an empty buffer, which grows with what is there.
pub(super) fn read_exactly(input: &mut dyn Read, length: u64, buffer: &mut Vec<u8>) -> io::Result<()> {
    let read = input.take(length).read_to_end(buffer)?;
    if read as u64 == length { Ok(()) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
}

/// Passes over `length` bytes.
pub(super) fn skip(input: &mut dyn Read, length: u64) -> io::Result<()> {
    let passed = io::copy(&mut input.take(length), &mut io::sink())?;
    if passed == length { Ok(()) } else { Err(io::ErrorKind::UnexpectedEof.into()) }
}

/// Reads the next `N` bytes.
pub(super) fn array<const N: usize>(input: &mut dyn Read) -> io::Result<[u8; N]> {
    let mut bytes = [0; N];
    input.read_exact(&mut bytes)?;
    Ok(bytes)
}
