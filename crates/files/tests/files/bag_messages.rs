//! Messages of maps, put together byte by byte in MCAP: both orders of bytes, both serialisations, and what is refused.

use mean_information_files::bags::{Change, MapSeries, MapTopic, read_stream};
use mean_information_files::{Error, ErrorKind, Options, Place, Warning};
use mean_information_test_support::formats::bag::{Writer, mcap_of, record, text};

const TOPICS: [(u16, &str, &str); 2] =
    [(7, "/map", "nav_msgs/msg/OccupancyGrid"), (8, "/map_updates", "map_msgs/msg/OccupancyGridUpdate")];

/// A bag whose topic 7 is `/map` and 8 `/map_updates`; of the messages, the topic and the bytes.
fn mcap(encoding: &str, messages: &[(u16, Vec<u8>)]) -> Vec<u8> {
    mcap_of(encoding, &TOPICS, messages)
}

/// Writes the fields of maps.
trait MapWriter {
    fn grid(self, resolution: f32, size: [u32; 2], count: u32, cells: &[u8]) -> Vec<u8>;
    fn update(self, at: [i32; 2], size: [u32; 2], cells: &[u8]) -> Vec<u8>;
}

impl MapWriter for Writer {
    fn grid(mut self, resolution: f32, [width, height]: [u32; 2], count: u32, cells: &[u8]) -> Vec<u8> {
        self.header([5, 6], "odom");
        for x in [1_u32, 2] {
            self.number(x.to_le_bytes());
        }
        self.number(resolution.to_le_bytes());
        for x in [width, height] {
            self.number(x.to_le_bytes());
        }
        self.doubles(&[0.5, -2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
        self.number(count.to_le_bytes());
        self.bytes.extend(cells);
        self.bytes
    }

    fn update(mut self, [x, y]: [i32; 2], [width, height]: [u32; 2], cells: &[u8]) -> Vec<u8> {
        self.header([5, 6], "odom");
        for x in [x, y] {
            self.number(x.to_le_bytes());
        }
        for x in [width, height] {
            self.number(x.to_le_bytes());
        }
        self.number((cells.len() as u32).to_le_bytes());
        self.bytes.extend(cells);
        self.bytes
    }
}

const CELLS: [u8; 6] = [0, 100, 255, 50, 7, 93];

fn grid() -> Vec<u8> {
    Writer::new(false, false).grid(0.25, [3, 2], 6, &CELLS)
}

fn update(at: [i32; 2], size: [u32; 2], cells: &[u8]) -> (u16, Vec<u8>) {
    (8, Writer::new(false, false).update(at, size, cells))
}

/// Cells, and the difference to the map before.
type Row = (Vec<i8>, Change);

/// The maps of a bag.
fn maps(bytes: &[u8], options: &Options) -> (Vec<Row>, Result<Vec<Warning>, Error>) {
    let mut maps = Vec::new();
    let mut series = MapSeries::new(&MapTopic::default(), options, |map| {
        assert_eq!((map.time_ns, map.geometry.resolution()), (2500, 0.25));
        assert_eq!((map.geometry.origin(), map.geometry.yaw()), ([0.5, -2.0], 0.0));
        maps.push((map.cells.to_vec(), map.change));
    });
    let read = read_stream(bytes, bytes.len() as u64, options, &mut series);
    let read = read.map(|warnings| [warnings, series.warnings()].concat());
    (maps, read)
}

fn refused(bytes: &[u8]) -> (Error, String) {
    let error = maps(bytes, &Options { max_cells: Some(1000), ..Options::default() }).1.unwrap_err();
    let line = error.to_string();
    (error, line)
}

fn place(topic: &str, number: u64, byte: u64) -> Place {
    Place::Message { topic: topic.to_owned(), number, byte: Some(byte) }
}

#[test]
fn both_orders_of_bytes_and_both_serialisations() {
    let cells: Vec<i8> = CELLS.iter().map(|cell| cell.cast_signed()).collect();
    for (encoding, big_endian, ros1) in [("cdr", false, false), ("cdr", true, false), ("ros1", false, true)] {
        let writer = || Writer::new(big_endian, ros1);
        let messages = [
            (7, writer().grid(0.25, [3, 2], 6, &CELLS)),
            (8, writer().update([1, 0], [2, 2], &[100, 1, 7, 2])),
        ];
        let (maps, warnings) = maps(&mcap(encoding, &messages), &Options::default());
        assert_eq!(warnings.unwrap(), []);
        let updated = vec![0, 100, 1, 50, 7, 2];
        assert_eq!(
            maps,
            [(cells.clone(), Change::First), (updated, Change::Cells(2))],
            "{encoding} {big_endian}"
        );
    }
}

#[test]
fn an_update_before_any_map_is_passed_over() {
    let bytes =
        mcap("cdr", &[update([0, 0], [1, 1], &[1]), (7, grid()), (7, grid()), update([0, 0], [0, 0], &[])]);
    let (maps, warnings) = maps(&bytes, &Options::default());
    let changes: Vec<_> = maps.iter().map(|map| map.1).collect();
    assert_eq!(changes, [Change::First, Change::Cells(0), Change::Cells(0)]);
    let warnings = warnings.unwrap();
    assert_eq!(warnings, [Warning::UpdatesBeforeMap { count: 1 }]);
    assert_eq!(warnings[0].to_string(), "1 updates come before the first map and are passed over");
}

#[test]
fn updates_that_leave_the_map() {
    for (at, size) in [([-1, 0], [1, 1]), ([2, 1], [2, 1]), ([0, 1], [1, 2]), ([3, 0], [u32::MAX, 1])] {
        let (error, line) = refused(&mcap("cdr", &[(7, grid()), update(at, size, &[])]));
        assert_eq!(
            (error.kind(), error.place()),
            (ErrorKind::OutOfRange, Some(&place("/map_updates", 1, 24)))
        );
        assert!(line.starts_with("message 1 of /map_updates, byte 24 of it: updates "), "{line}");
        assert!(line.ends_with(", allowed is a rectangle within the map's 3 x 2 cells"), "{line}");
    }
}

#[test]
fn grids_that_are_none() {
    let writer = || Writer::new(false, false);
    let (error, line) =
        refused(&mcap("cdr", &[(7, grid()), (7, writer().grid(0.25, [3, 2], 5, &CELLS[..5]))]));
    assert_eq!(error.place(), Some(&place("/map", 2, 100)));
    assert_eq!(line, "message 2 of /map, byte 100 of it: has 5 cells, allowed are 3 x 2 = 6");
    let (error, line) = refused(&mcap("cdr", &[(7, writer().grid(0.25, [3, 2], 6, &CELLS[..5]))]));
    assert_eq!((error.kind(), error.place()), (ErrorKind::Format, Some(&place("/map", 1, 104))));
    assert_eq!(line, "message 1 of /map, byte 104 of it: has a field of 6 bytes, but 5 are left");
    let (error, line) =
        refused(&mcap("cdr", &[(7, writer().grid(0.25, [3, 2], 6, &[0, 100, 101, 0, 0, 0]))]));
    assert_eq!((error.kind(), error.place()), (ErrorKind::OutOfRange, Some(&place("/map", 1, 106))));
    assert!(
        line.starts_with("message 1 of /map, byte 106 of it: cell 2 is 101, allowed is a percentage"),
        "{line}"
    );
    let (error, _) = refused(&mcap("cdr", &[(7, writer().grid(-0.25, [3, 2], 6, &CELLS))]));
    assert_eq!((error.kind(), error.place()), (ErrorKind::OutOfRange, Some(&place("/map", 1, 32))));
    let (error, line) = refused(&mcap("cdr", &[(7, writer().grid(0.25, [1 << 31, 1 << 31], 6, &CELLS))]));
    assert_eq!(error.kind(), ErrorKind::TooLarge);
    assert!(line.contains("claims 2147483648 x 2147483648"), "{line}");
}

#[test]
fn serialisations_that_are_none() {
    let (error, line) = refused(&mcap("json", &[(7, b"{}".to_vec())]));
    assert_eq!(error.kind(), ErrorKind::Unsupported);
    assert_eq!(line, "message 1 of /map: has another serialisation, allowed are cdr and ros1");
    let (_, line) = refused(&mcap("cdr", &[(7, vec![0, 7, 0])]));
    let allowed = "allowed are CDR's [00, 00, ..] and [00, 01, ..]";
    assert_eq!(line, format!("message 1 of /map, byte 0 of it: begins with [00, 07, 00], {allowed}"));
    let (_, line) = refused(&mcap("cdr", &[(7, vec![0x28, 0xb5, 0x2f, 0xfd, 0])]));
    assert!(line.contains("is compressed by itself"), "{line}");
    let mut latin = grid();
    latin[16] = 0xe9;
    let (_, line) = refused(&mcap("cdr", &[(7, latin)]));
    assert!(
        line.starts_with("message 1 of /map, byte 16 of it: has a text that is not UTF-8: \u{fffd}dom"),
        "{line}"
    );
}

#[test]
fn messages_longer_than_a_map_are_refused_before_they_are_read() {
    let mut whole = mcap("cdr", &[]);
    whole.truncate(whole.len() - 13);
    let claiming = |length: u64| {
        [&whole[..], &[5], &u64::to_le_bytes(22 + length), &7_u16.to_le_bytes(), &[0; 20], b"some"].concat()
    };
    let mut bytes = claiming(1 << 21);
    bytes.resize(bytes.len() + (1 << 21), 0);
    let (error, line) = refused(&bytes);
    assert_eq!(error.kind(), ErrorKind::TooLarge);
    assert_eq!(line, "message 1 of /map: claims 2097152 bytes, more than the limit of 1049576");
    // What the file does not hold is no matter of a limit: it is cut short there.
    let (read, warnings) = maps(&claiming(1 << 40), &Options { max_cells: Some(1000), ..Options::default() });
    assert!(read.is_empty());
    let [Warning::BagCutShort { messages: 0, .. }] = warnings.unwrap()[..] else { panic!("not cut short") };
}

#[test]
fn chunks_that_lie() {
    let head = |size: u64, name: &[u8], packed: &[u8]| {
        let length = (packed.len() as u64).to_le_bytes();
        record(6, &[&[0; 16], &size.to_le_bytes(), &[1, 0, 0, 0], &text(name), &length, packed])
    };
    let bag = |chunk: Vec<u8>| {
        let mut bytes = mcap("cdr", &[]);
        let end = bytes.split_off(bytes.len() - 13);
        [bytes, chunk, end].concat()
    };
    let inner = record(9, &[b"12345"]);
    let start = mcap("cdr", &[]).len() as u64 - 13;
    for (chunk, expected) in [
        (head(14, b"", &inner), "is a chunk whose checksum is 00000001, but that of its bytes is"),
        (head(15, b"", &inner), "is a chunk that claims 15 bytes and has 14"),
        (head(13, b"", &inner), "is a chunk of 13 bytes with a record of kind 9 and 5 bytes"),
        (head(14, b"snappy", &inner), "is compressed by snappy, allowed are zstd, lz4 and none"),
        (head(14, b"zstd", &inner), "cannot be read: "),
        (head(14, b"lz4", &inner), "cannot be read: "),
    ] {
        let (error, line) = refused(&bag(chunk));
        assert_eq!(error.place(), Some(&Place::Byte(start)), "{line}");
        assert!(line.starts_with(&format!("record at byte {start}: {expected}")), "{line}");
    }
}

#[test]
fn topics_that_nobody_or_two_declare() {
    let (_, line) = refused(&mcap("cdr", &[(9, grid())]));
    assert!(line.ends_with("has a message of topic number 9, which no record declares before it"), "{line}");
    let mut bytes = mcap("cdr", &[]);
    bytes.truncate(bytes.len() - 13);
    bytes.extend(record(4, &[&[7, 0], &[8, 0], &text(b"/other"), &text(b"cdr"), &[0; 4]]));
    let (error, line) = refused(&bytes);
    assert_eq!(error.kind(), ErrorKind::Format);
    assert!(
        line.contains("gives the number 7 to two topics, /map of type nav_msgs/OccupancyGrid and /other"),
        "{line}"
    );
}

/// A topic that says that it has maps, and has text: the length of the text stands where the map has its time.
#[test]
fn messages_of_another_type_than_their_topic_says() {
    let mut text = Writer::new(false, false);
    text.name("not a map at all");
    let (error, line) = refused(&mcap("cdr", &[(7, grid()), (7, text.bytes)]));
    assert_eq!(error.kind(), ErrorKind::Format);
    assert!(matches!(error.place(), Some(Place::Message { number: 2, byte: Some(_), .. })), "{error:?}");
    assert!(line.starts_with("message 2 of /map, byte 16 of it: has a field of "), "{line}");
}

/// Which topic is meant is known when the bag is read, once: the first that may be is followed.
#[test]
fn the_topic_that_is_meant_is_found_while_the_bag_is_read() {
    let topics = [
        (9, "/costmap", TOPICS[0].2),
        (5, "/b_updates", TOPICS[1].2),
        (7, "/a", TOPICS[0].2),
        (8, "/a_updates", TOPICS[1].2),
        (4, "/b", TOPICS[0].2),
    ];
    let read = |topics: &[(u16, &str, &str)], wanted: &MapTopic, messages: &[(u16, Vec<u8>)]| {
        let bytes = mcap_of("cdr", topics, messages);
        let mut changes = Vec::new();
        let mut series = MapSeries::new(wanted, &Options::default(), |map| changes.push(map.change));
        read_stream(&*bytes, bytes.len() as u64, &Options::default(), &mut series).unwrap();
        let topic = series.topic().map(str::to_owned).map_err(|error| (error.kind(), error.to_string()));
        let warnings = series.warnings();
        drop(series);
        (topic, warnings, changes)
    };
    let (of_a, of_b) = (update([0, 0], [1, 1], &[9]), (5, update([0, 0], [1, 1], &[9]).1));
    let messages = [of_b, (9, grid()), (7, grid()), of_a, (4, grid())];
    let (topic, _, _) = read(&topics, &MapTopic::default(), &messages);
    let words = "has several topics of maps; topics of its maps are: /a, /b, /costmap".to_owned();
    assert_eq!(topic, Err((ErrorKind::Choice, words)));
    let changes = [Change::First, Change::Cells(1)];
    // Of updates of another topic nothing is said.
    let (topic, warnings, found) = read(&topics[..4], &MapTopic::default(), &messages[..4]);
    assert_eq!((topic.as_deref(), &*warnings, &*found), (Ok("/a"), &[][..], &changes[..]));
    let (topic, warnings, found) = read(&topics, &MapTopic::named("/b"), &messages);
    let early = [Warning::UpdatesBeforeMap { count: 1 }];
    assert_eq!((topic.as_deref(), &*warnings, &*found), (Ok("/b"), &early[..], &changes[..1]));
    let (topic, _, found) = read(&topics, &MapTopic::named("/costmap"), &messages);
    assert!(topic.is_err_and(|(_, line)| line.contains("carries costmaps")) && found.is_empty());
    let (topic, _, _) = read(&topics, &MapTopic::named("/a"), &messages[..2]);
    assert_eq!(topic, Err((ErrorKind::Format, "has no message of topic /a".to_owned())));
}
