//! rosbag2's `.db3`: a table of topics and one of messages, in SQLite.

use super::delivery::{Delivery, Encoding, Topic};
use crate::error::{Error, ErrorKind};
use crate::warning::Warning;
use rusqlite::config::DbConfig;
use rusqlite::limits::Limit;
use rusqlite::{Connection, ErrorCode, OpenFlags, Row, Statement};
use std::path::Path;

/// The tables, each with the columns that are read.
const TABLES: [(&str, &[&str]); 2] = [
    ("topics", &["id", "name", "type", "serialization_format"]),
    ("messages", &["topic_id", "timestamp", "data"]),
];
/// The bytes of a row beside its message.
const BESIDE_MESSAGE: u64 = 1 << 10;
/// The most bytes of SQL in the file.
const MOST_SQL: i32 = 1 << 20;

/// The topics as they stand in the file, past any index.
const QUERY_TOPICS: &str =
    "SELECT id, name, type, serialization_format FROM topics NOT INDEXED ORDER BY rowid";

/// Returns the query of the messages of some topics as they stand in the file, past any index: rosbag2's `id` is the number of
/// a row. To sort them SQLite would write all of them to a temporary file.
fn query_of_messages(topics: impl Iterator<Item = u64>) -> String {
    let topics = topics.map(|id| id.to_string()).collect::<Vec<_>>().join(", ");
    format!(
        "SELECT topic_id, timestamp, data FROM messages NOT INDEXED WHERE topic_id IN ({topics}) ORDER BY rowid"
    )
}

/// Says that nobody writes the file, so that SQLite puts none beside it.
const IMMUTABLE: &str = "?immutable=1";

/// Reads a file of a bag.
pub(super) fn read_file(path: &Path, delivery: &mut Delivery<'_>) -> Result<Vec<Warning>, Error> {
    let mut log = path.as_os_str().to_owned();
    log.push("-wal");
    if Path::new(&log).metadata().is_ok_and(|log| log.len() > 0) {
        let log = log.to_string_lossy();
        let message = format!("was not closed: {log} beside it holds messages; open it once with sqlite3");
        return Err(Error::new(ErrorKind::Unsupported, message).with_value(log));
    }
    delivery.begin_file();
    let flags =
        OpenFlags::SQLITE_OPEN_READ_ONLY | OpenFlags::SQLITE_OPEN_URI | OpenFlags::SQLITE_OPEN_NO_MUTEX;
    let bag = Connection::open_with_flags(uri(path)?, flags).map_err(refused)?;
    let most = delivery.most().saturating_add(BESIDE_MESSAGE);
    let limits = [
        (Limit::SQLITE_LIMIT_LENGTH, i32::try_from(most).unwrap_or(i32::MAX)),
        (Limit::SQLITE_LIMIT_SQL_LENGTH, MOST_SQL),
    ];
    for (limit, most) in limits {
        bag.set_limit(limit, most).map_err(refused)?;
    }
    // The file is of a stranger: nothing in it is run, and its pages are checked.
    bag.set_db_config(DbConfig::SQLITE_DBCONFIG_DEFENSIVE, true).map_err(refused)?;
    bag.set_db_config(DbConfig::SQLITE_DBCONFIG_TRUSTED_SCHEMA, false).map_err(refused)?;
    bag.pragma_update(None, "cell_size_check", true).map_err(refused)?;
    check_tables(&bag)?;
    let mut topics = bag.prepare(QUERY_TOPICS).map_err(refused)?;
    declare(&mut topics, delivery)?;
    let mut messages = bag.prepare(&query_of_messages(delivery.wanted())).map_err(refused)?;
    hand_over(&mut messages, path, delivery)
}

/// Refuses tables that are views, virtual, or have columns which SQLite computes: those could hold what the file does not. And
/// those of which a column takes the name of the numbers of rows, by which they come.
fn check_tables(bag: &Connection) -> Result<(), Error> {
    for (table, columns) in TABLES {
        let is_table = "SELECT type = 'table' AND rootpage > 0 FROM sqlite_master WHERE lower(name) = ?1";
        let is_table = bag.query_row(is_table, [table], |row| row.get::<_, bool>(0));
        if matches!(is_table, Ok(false)) {
            let words = format!("has no table {table}, but a view or a virtual table of that name");
            return Err(
                Error::new(ErrorKind::Unsupported, words).allowing("; allowed are ", "rosbag2's tables")
            );
        }
        let count = |condition: &str| {
            let query = format!("SELECT count(*) FROM pragma_table_xinfo(?1) WHERE {condition}");
            bag.query_row(&query, [table], |row| row.get::<_, i64>(0)).map_err(refused)
        };
        let refused = |count: i64, words: &str| {
            let words = format!("{words} its table {table}");
            let refused = Error::new(ErrorKind::Unsupported, words).with_value(count.to_string());
            Err(refused
                .allowing("; allowed are ", format!("columns that are stored: {}", columns.join(", "))))
        };
        match count("hidden <> 0")? {
            0 => {}
            computed => return refused(computed, "computes columns of"),
        }
        match count("lower(name) = 'rowid'")? {
            0 => {}
            named => return refused(named, "has a column rowid in"),
        }
    }
    Ok(())
}

/// Declares the topics.
fn declare(topics: &mut Statement<'_>, delivery: &mut Delivery<'_>) -> Result<(), Error> {
    let mut rows = topics.query([]).map_err(refused)?;
    while let Some(row) = rows.next().map_err(refused)? {
        let text = |column| {
            row.get_ref(column).map_err(refused).and_then(|text| {
                super::fields::utf8(text.as_bytes().map_err(|_| of_another_type("topics", column))?)
            })
        };
        let topic = Topic::new(text(1)?.to_owned(), text(2)?, Encoding::named(text(3)?));
        delivery.declare(number(row, "topics", 0)?, topic)?;
    }
    Ok(())
}

/// Hands over the messages.
fn hand_over(
    messages: &mut Statement<'_>,
    path: &Path,
    delivery: &mut Delivery<'_>,
) -> Result<Vec<Warning>, Error> {
    let mut rows = messages.query([]).map_err(refused)?;
    loop {
        match rows.next() {
            Ok(None) => return Ok(Vec::new()),
            Ok(Some(row)) => {
                let [id, time] = [number(row, "messages", 0)?, number(row, "messages", 1)?];
                let data = row.get_ref(2).map_err(refused)?;
                let bytes = data.as_blob().map_err(|_| of_another_type("messages", 2))?;
                delivery.hand_over(id, time, bytes)?;
            }
            // The pages of what comes first are there: the file lost its end.
            Err(error) if is_damaged(&error) && delivery.messages() > 0 => {
                let byte = path.metadata()?.len();
                return Ok(vec![Warning::BagCutShort { byte, messages: delivery.messages() }]);
            }
            Err(error) => return Err(refused(error)),
        }
    }
}

/// Takes a number that is not negative.
fn number(row: &Row<'_>, table: &str, column: usize) -> Result<u64, Error> {
    let number =
        row.get_ref(column).map_err(refused)?.as_i64().map_err(|_| of_another_type(table, column))?;
    u64::try_from(number)
        .map_err(|_| Error::out_of_range(format!("column {column} of {table}"), number, "a number from 0"))
}

/// Refuses a column that holds something else.
fn of_another_type(table: &str, column: usize) -> Error {
    Error::new(ErrorKind::Format, format!("has a column {column} of {table} of another type than rosbag2's"))
}

/// Takes the refusal of SQLite.
#[allow(clippy::needless_pass_by_value, reason = "it is the end of the error")]
fn refused(error: rusqlite::Error) -> Error {
    if error.sqlite_error_code() == Some(ErrorCode::TooBig) {
        return Error::new(ErrorKind::TooLarge, "has a row of more bytes than the limit").caused_by(error);
    }
    Error::new(ErrorKind::Format, format!("is no bag of rosbag2 that SQLite reads: {error}")).caused_by(error)
}

/// Tells whether pages of the file are missing.
fn is_damaged(error: &rusqlite::Error) -> bool {
    matches!(error.sqlite_error_code(), Some(ErrorCode::DatabaseCorrupt | ErrorCode::SystemIoFailure))
}

/// Returns the file as a URI for SQLite.
fn uri(path: &Path) -> Result<String, Error> {
    let Some(text) = path.to_str() else {
        return Err(Error::new(ErrorKind::Unsupported, "has a name that is not UTF-8, which SQLite needs"));
    };
    let escaped = text.replace('%', "%25").replace('?', "%3f").replace('#', "%23");
    Ok(format!("file:{escaped}{IMMUTABLE}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn nothing_is_sorted() {
        let bag = Connection::open_in_memory().unwrap();
        let tables = "CREATE TABLE topics(id INTEGER, name TEXT, type TEXT, serialization_format TEXT);
            CREATE TABLE messages(id INTEGER, topic_id INTEGER, timestamp INTEGER, data BLOB);
            CREATE INDEX by_name ON topics(name, id); CREATE INDEX by_topic ON messages(topic_id, id);";
        bag.execute_batch(tables).unwrap();
        for query in [QUERY_TOPICS, &query_of_messages([3, 7].into_iter())] {
            let mut plan = bag.prepare(&format!("EXPLAIN QUERY PLAN {query}")).unwrap();
            let steps = plan.query_map([], |row| row.get::<_, String>(3)).unwrap();
            let steps: Vec<_> = steps.map(Result::unwrap).collect();
            assert!(matches!(&*steps, [one] if one.starts_with("SCAN ")), "{query}: {steps:?}");
        }
    }
}
