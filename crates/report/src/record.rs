//! Rows of named values, which become JSON objects and CSV lines with the same keys in the same order.

use crate::number::Number;
use serde::ser::SerializeMap;
use serde::{Serialize, Serializer};

/// A value of a [`Record`].
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A name.
    Text(String),
    /// A count.
    Count(u64),
    /// Yes or no.
    Flag(bool),
    /// A number that was given, `None` if it is unknown.
    Given(Option<f64>),
    /// A number that was computed, `None` if there is none. It has a twin, its key with `_hex` appended, that holds the
    /// same number as a hexadecimal float.
    Computed(Option<Number>),
    /// Numbers that were computed, `None` where there is none, with a twin as above.
    Numbers(Vec<Option<Number>>),
    /// Sentences.
    Texts(Vec<String>),
    /// Several records.
    Records(Vec<Record>),
    /// A nested record.
    Record(Record),
}

impl From<Vec<Record>> for Value {
    fn from(records: Vec<Record>) -> Self {
        Self::Records(records)
    }
}

/// Values by name, in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Record(pub Vec<(&'static str, Value)>);

impl Record {
    /// Creates a record of computed numbers by their names.
    pub fn computed<const N: usize>(numbers: [(&'static str, f64); N]) -> Self {
        Self(numbers.map(|(name, number)| (name, Value::Computed(Some(Number::Double(number))))).into())
    }
}

impl Serialize for Value {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        match self {
            Self::Text(text) => text.serialize(serializer),
            Self::Count(count) => count.serialize(serializer),
            Self::Flag(flag) => flag.serialize(serializer),
            Self::Given(number) => number.serialize(serializer),
            Self::Computed(number) => number.serialize(serializer),
            Self::Numbers(numbers) => numbers.serialize(serializer),
            Self::Texts(texts) => texts.serialize(serializer),
            Self::Records(records) => records.serialize(serializer),
            Self::Record(record) => record.serialize(serializer),
        }
    }
}

impl Serialize for Record {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut map = serializer.serialize_map(None)?;
        for (key, value) in &self.0 {
            map.serialize_entry(key, value)?;
            match value {
                Value::Computed(number) => map.serialize_entry(&twin(key), &number.map(Number::hex))?,
                Value::Numbers(numbers) => {
                    let hex: Vec<_> = numbers.iter().map(|number| number.map(Number::hex)).collect();
                    map.serialize_entry(&twin(key), &hex)?;
                }
                _ => {}
            }
        }
        map.end()
    }
}

/// The key of a result's hexadecimal twin.
fn twin(key: &str) -> String {
    format!("{key}_hex")
}

/// Returns indented JSON with a newline at the end.
pub fn to_json(value: &Value) -> String {
    // Strings and numbers under string keys: serialisation cannot fail.
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

/// Returns a header and one line per record. What is unknown is an empty field; sentences and numbers of a list are
/// joined by `; `.
pub fn to_csv(records: &[Record]) -> String {
    let mut lines = records.iter().map(csv_fields).peekable();
    let header = lines.peek().map(|fields| fields.iter().map(|(key, _)| key.clone()).collect::<Vec<_>>());
    let mut writer = csv::Writer::from_writer(Vec::new());
    for line in
        header.into_iter().chain(lines.map(|fields| fields.into_iter().map(|(_, text)| text).collect()))
    {
        // Lines of equal length into memory: writing cannot fail.
        let _ = writer.write_record(&line);
    }
    writer.into_inner().ok().and_then(|bytes| String::from_utf8(bytes).ok()).unwrap_or_default()
}

fn csv_fields(record: &Record) -> Vec<(String, String)> {
    let mut fields = Vec::new();
    for (key, value) in &record.0 {
        let text = match value {
            Value::Text(text) => text.clone(),
            Value::Count(count) => count.to_string(),
            Value::Flag(flag) => flag.to_string(),
            Value::Given(number) => number.map(|x| Number::Double(x).to_string()).unwrap_or_default(),
            Value::Computed(number) => number.map(|x| x.to_string()).unwrap_or_default(),
            Value::Numbers(numbers) => joined(numbers, |x| x.to_string()),
            Value::Texts(texts) => texts.join("; "),
            // A line holds no lines.
            Value::Records(_) | Value::Record(_) => continue,
        };
        fields.push(((*key).to_owned(), text));
        match value {
            Value::Computed(number) => fields.push((twin(key), number.map(Number::hex).unwrap_or_default())),
            Value::Numbers(numbers) => fields.push((twin(key), joined(numbers, Number::hex))),
            _ => {}
        }
    }
    fields
}

/// Joins numbers in one field, separated by `; `; a missing one is empty.
fn joined(numbers: &[Option<Number>], text: fn(Number) -> String) -> String {
    let texts: Vec<String> = numbers.iter().map(|number| number.map(text).unwrap_or_default()).collect();
    texts.join("; ")
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(name: &str, number: Option<Number>) -> Record {
        Record(vec![
            ("map", Value::Text(name.to_owned())),
            ("bits", Value::Computed(number)),
            ("resolution_m", Value::Given(None)),
            ("warnings", Value::Texts(vec!["one".to_owned(), "two".to_owned()])),
        ])
    }

    #[test]
    fn single_precision_shows_its_own_digits_only() {
        let json = to_json(&Value::Record(record("a", Some(Number::new(0.1_f32)))));
        assert!(json.contains("\"bits\": 0.1,\n  \"bits_hex\": \"0x1.99999ap-4\",\n"), "{json}");
        let json = to_json(&Value::Record(record("a", Some(Number::new(f64::from(0.1_f32))))));
        assert!(json.contains("\"bits\": 0.10000000149011612,"), "{json}");
        assert_eq!(Number::new(0.1_f32).to_string(), "0.1");
        assert_eq!(Number::new(2.0_f32).to_string(), "2.0");
    }

    #[test]
    fn csv_quotes_names_and_leaves_unknown_numbers_empty() {
        let records = [record("a, \"b\"", Some(Number::new(1.5_f32))), record("c", None)];
        assert_eq!(
            to_csv(&records),
            "map,bits,bits_hex,resolution_m,warnings\n\"a, \"\"b\"\"\",1.5,0x1.8p+0,,one; two\nc,,,,one; two\n"
        );
        assert_eq!(to_csv(&[]), "");
    }
}
