//! Bags put together byte by byte in MCAP, whose messages are CDR in both orders of bytes or ROS 1's.

/// Writes a text after its length.
pub fn text(text: &[u8]) -> Vec<u8> {
    [&(text.len() as u32).to_le_bytes(), text].concat()
}

/// Writes a record of MCAP.
pub fn record(kind: u8, data: &[&[u8]]) -> Vec<u8> {
    let data = data.concat();
    [&[kind][..], &(data.len() as u64).to_le_bytes(), &data].concat()
}

/// A topic: its number, its name and its type.
pub type Topic<'a> = (u16, &'a str, &'a str);

/// Writes a bag of these topics; of the messages, the topic and the bytes, all recorded at 2500 ns.
pub fn mcap_of(encoding: &str, topics: &[Topic<'_>], messages: &[(u16, Vec<u8>)]) -> Vec<u8> {
    let timed: Vec<_> = messages.iter().map(|(id, message)| (*id, 2500, message.clone())).collect();
    mcap_at(encoding, topics, &timed)
}

/// Writes a bag of these topics; of the messages, the topic, the time in nanoseconds and the bytes.
pub fn mcap_at(encoding: &str, topics: &[Topic<'_>], messages: &[(u16, u64, Vec<u8>)]) -> Vec<u8> {
    let mut bytes = b"\x89MCAP0\r\n".to_vec();
    for (id, name, kind) in topics {
        bytes.extend(record(3, &[&id.to_le_bytes(), &text(kind.as_bytes()), &text(b"ros2msg"), &text(b"")]));
        let [name, encoding] = [*name, encoding].map(|name| text(name.as_bytes()));
        bytes.extend(record(4, &[&id.to_le_bytes(), &id.to_le_bytes(), &name, &encoding, &[0; 4]]));
    }
    for (id, time, message) in messages {
        bytes.extend(record(5, &[&id.to_le_bytes(), &[0; 4], &time.to_le_bytes(), &[0; 8], message]));
    }
    bytes.extend(record(15, &[&[0; 4]]));
    bytes
}

/// Writes fields as CDR or, without its four bytes of head, as ROS 1.
#[derive(Clone, Debug)]
pub struct Writer {
    /// The bytes that were written.
    pub bytes: Vec<u8>,
    big_endian: bool,
    ros1: bool,
}

impl Writer {
    /// Creates a writer of a message in this order of bytes, or of ROS 1.
    #[must_use]
    pub fn new(big_endian: bool, ros1: bool) -> Self {
        let bytes = if ros1 { vec![] } else { vec![0, u8::from(!big_endian), 0, 0] };
        Self { bytes, big_endian, ros1 }
    }

    /// Writes a header of seconds and nanoseconds, and a frame.
    pub fn header(&mut self, stamp: [u32; 2], frame: &str) {
        if self.ros1 {
            self.number(9_u32.to_le_bytes());
        }
        for x in stamp {
            self.number(x.to_le_bytes());
        }
        self.name(frame);
    }

    /// Writes a text, which CDR ends with a zero.
    pub fn name(&mut self, name: &str) {
        let end: &[u8] = if self.ros1 { b"" } else { b"\0" };
        self.number(((name.len() + end.len()) as u32).to_le_bytes());
        self.bytes.extend(name.as_bytes());
        self.bytes.extend(end);
    }

    /// Writes a number, given with its least significant byte first.
    pub fn number<const N: usize>(&mut self, mut bytes: [u8; N]) {
        if !self.ros1 {
            let end = 4 + (self.bytes.len() - 4).next_multiple_of(N);
            self.bytes.resize(end, 0xee);
        }
        if self.big_endian {
            bytes.reverse();
        }
        self.bytes.extend(bytes);
    }

    /// Writes numbers in single precision.
    pub fn floats(&mut self, numbers: &[f32]) {
        for x in numbers {
            self.number(x.to_le_bytes());
        }
    }

    /// Writes numbers in double precision.
    pub fn doubles(&mut self, numbers: &[f64]) {
        for x in numbers {
            self.number(x.to_le_bytes());
        }
    }
}
