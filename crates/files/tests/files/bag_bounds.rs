//! Bags that claim, compute or hold compressed more than memory is kept for.

use crate::scan_bag::{PLAIN, TOPICS, log_of};
use mean_information_files::scans::Selection;
use mean_information_files::{Error, ErrorKind};
use mean_information_test_support::formats::bag::{mcap_of, record, text};

/// Reads the scans of a bag with more records before its end.
fn refused(records: &[Vec<u8>]) -> Error {
    let mut bytes = mcap_of("cdr", &TOPICS, &[PLAIN.scan(22), PLAIN.moving(), PLAIN.mount()]);
    let end = bytes.split_off(bytes.len() - 13);
    let bytes = [bytes, records.concat(), end].concat();
    log_of(&bytes, &Selection::default()).unwrap_err()
}

#[test]
fn names_of_topics_and_types_are_bounded_together() {
    let name = vec![b'a'; 1 << 20];
    let numbers = 100_u16..120;
    let topics: Vec<_> = numbers
        .clone()
        .map(|id| record(4, &[&id.to_le_bytes(), &[2, 0], &text(&name), &text(b"cdr"), &[0; 4]]))
        .collect();
    let kinds: Vec<_> =
        numbers.map(|id| record(3, &[&id.to_le_bytes(), &text(&name), &text(b""), &text(b"")])).collect();
    for records in [&topics, &kinds] {
        let error = refused(records);
        assert_eq!(error.kind(), ErrorKind::OutOfMemory);
        let words = "declares more topics and types than memory is kept for, allowed are 16777216 bytes";
        assert!(error.to_string().ends_with(words), "{error}");
    }
    // The same again takes nothing.
    let mut bytes = mcap_of("cdr", &TOPICS, &[PLAIN.scan(22), PLAIN.moving(), PLAIN.mount()]);
    let end = bytes.split_off(bytes.len() - 13);
    bytes.extend((0..20).flat_map(|_| [kinds[0].clone(), topics[0].clone()]).flatten());
    bytes.extend(end);
    assert_eq!(log_of(&bytes, &Selection::default()).unwrap().scans.len(), 1);
}

#[test]
fn the_name_of_a_compression_is_short() {
    let chunk = record(6, &[&[0; 28], &text(&[b'a'; 1000]), &[0; 8]]);
    let error = refused(&[chunk]);
    assert_eq!(error.kind(), ErrorKind::OutOfRange);
    let words = "the length of the compression's name is 1000, allowed is at most 64 bytes";
    assert!(error.to_string().ends_with(words), "{error}");
}

/// A text of a megabyte stands in a message with its beginning only.
#[test]
fn a_text_that_is_not_utf_8_is_shortened() {
    let error = refused(&[record(3, &[&[9, 0], &text(&vec![0xff; 1 << 20]), &text(b""), &text(b"")])]);
    assert_eq!((error.kind(), error.value()), (ErrorKind::Format, Some(&*"\u{fffd}".repeat(32))));
    assert!(error.to_string().len() < 1000, "{}", error.to_string().len());
}

#[cfg(feature = "sqlite")]
mod databases {
    use mean_information_files::bags::{MapSeries, MapTopic, Message, Topic, Visitor, read_bag};
    use mean_information_files::{Error, ErrorKind, Options};
    use mean_information_test_support::formats::Folder;
    use rusqlite::Connection;

    const TOPICS: &str =
        "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT, type TEXT, serialization_format TEXT);
        INSERT INTO topics VALUES (1, '/map', 'nav_msgs/msg/OccupancyGrid', 'cdr');";
    const MESSAGES: &str =
        "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER, data BLOB);";

    fn refused(statements: &[&str]) -> Error {
        let folder = Folder::new();
        let path = folder.write("x", b"").with_file_name("run.db3");
        Connection::open(&path).unwrap().execute_batch(&statements.concat()).unwrap();
        let options = Options { max_cells: Some(1000), ..Options::default() };
        let mut series = MapSeries::new(&MapTopic::default(), &options, |_| {});
        read_bag(&path, &options, &mut series).unwrap_err()
    }

    /// A few bytes of SQL may stand for rows without an end.
    #[test]
    fn views_and_columns_that_are_computed_are_refused() {
        let endless = "CREATE VIEW messages(id, topic_id, timestamp, data) AS
            WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n) SELECT i, 1, i, zeroblob(1000) FROM n;";
        let error = refused(&[TOPICS, endless]);
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        let words =
            "has no table messages, but a view or a virtual table of that name; allowed are rosbag2's tables";
        assert!(error.to_string().ends_with(words), "{error}");
        let computed = "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER, timestamp INTEGER,
            data BLOB GENERATED ALWAYS AS (zeroblob(1000000)) VIRTUAL);
            INSERT INTO messages(topic_id, timestamp) VALUES (1, 7);";
        let error = refused(&[TOPICS, computed]);
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(error.to_string().contains("computes columns of its table messages"), "{error}");
        assert!(refused(&[MESSAGES]).to_string().contains("no such table: topics"));
    }

    /// The bytes of the messages, in the order in which they come.
    #[derive(Default)]
    struct Taken(Vec<Vec<u8>>);

    impl Visitor for Taken {
        fn wants(&mut self, _: &Topic) -> bool {
            true
        }

        fn take(&mut self, message: &Message<'_>) -> Result<(), Error> {
            self.0.push(message.bytes.to_vec());
            Ok(())
        }
    }

    /// Messages come as they stand in the file.
    #[test]
    fn messages_are_not_sorted() {
        let folder = Folder::new();
        let path = folder.write("x", b"").with_file_name("run.db3");
        let unsorted = "CREATE TABLE messages(id INTEGER, topic_id INTEGER, timestamp INTEGER, data BLOB);
            INSERT INTO messages VALUES (3, 1, 7, x'61'), (1, 2, 8, x'62'), (2, 1, 9, x'63');
            INSERT INTO topics VALUES (2, '/b', 'x/msg/Y', 'cdr');";
        Connection::open(&path).unwrap().execute_batch(&[TOPICS, unsorted].concat()).unwrap();
        let mut taken = Taken::default();
        read_bag(&path, &Options::default(), &mut taken).unwrap();
        assert_eq!(taken.0, [b"a", b"b", b"c"]);
        // Tables of which rows cannot be had by their numbers.
        let named = "CREATE TABLE messages(rowid TEXT, topic_id INTEGER, timestamp INTEGER, data BLOB);";
        let error = refused(&[TOPICS, named]);
        assert_eq!(error.kind(), ErrorKind::Unsupported);
        assert!(error.to_string().contains("has a column rowid in its table messages"), "{error}");
        let keyed = MESSAGES.replace(';', " WITHOUT ROWID;");
        let error = refused(&[TOPICS, &keyed]);
        assert!(error.to_string().contains("no such column: rowid"), "{error}");
    }

    #[test]
    fn a_row_longer_than_a_map_is_refused() {
        for (bytes, kind, words) in [
            (2_000_000, ErrorKind::TooLarge, "has a row of more bytes than the limit"),
            (1_000_000, ErrorKind::OutOfRange, "message 1 of /map, byte "),
        ] {
            let insert = format!("INSERT INTO messages VALUES (1, 1, 7, zeroblob({bytes}));");
            let error = refused(&[TOPICS, MESSAGES, &insert]);
            assert_eq!(error.kind(), kind, "{error}");
            assert!(error.to_string().contains(words), "{error}");
        }
    }
}
