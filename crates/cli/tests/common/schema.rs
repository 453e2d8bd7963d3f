//! The schemas of `schemas/`, to which the JSON of every command that a test runs is held.

use jsonschema::{Registry, Validator};
use serde_json::Value;
use std::collections::BTreeSet;
use std::fs;

/// The folder of the schemas.
pub(crate) const SCHEMAS: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../schemas");
/// The place that they refer to one another from.
const BASE: &str = "file:///schemas/";

/// Returns the name of the schema of what these arguments print; `None` if it is no JSON.
pub(crate) fn schema_of<'a>(arguments: &[&'a str]) -> Option<&'a str> {
    let has = |option: &str| arguments.contains(&option);
    if !arguments.windows(2).any(|pair| pair == ["--format", "json"]) {
        return None;
    }
    match *arguments.first()? {
        "emmi" if has("--filter") => Some("emmi-filter"),
        "check" if has("--list") => Some("check-list"),
        command => Some(command),
    }
}

/// Reads a schema.
pub(crate) fn schema(name: &str) -> Value {
    let path = format!("{SCHEMAS}/{name}.json");
    serde_json::from_str(&fs::read_to_string(&path).expect(&path)).expect(&path)
}

/// Compiles a schema, with what it shares with others.
pub(crate) fn validator(name: &str) -> Validator {
    let shared = Registry::new().add(format!("{BASE}common.json"), schema("common")).unwrap();
    let shared = shared.prepare().unwrap();
    jsonschema::options().with_base_uri(BASE).with_registry(&shared).build(&schema(name)).expect(name)
}

/// Checks that JSON is as its schema says.
pub(crate) fn assert_schema(name: &str, json: &str) {
    let json: Value = serde_json::from_str(json).expect(name);
    let wrong: Vec<_> = validator(name)
        .iter_errors(&json)
        .map(|error| format!("{name}.json: {}: {error}", error.instance_path()))
        .collect();
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

/// Returns the keys that a schema requires of the objects at a pointer, in the order in which they are printed.
pub(crate) fn required(name: &str, pointer: &str) -> Vec<String> {
    let schema = schema(name);
    let keys = schema.pointer(pointer).and_then(|object| object["required"].as_array());
    keys.expect(name).iter().map(|key| key.as_str().unwrap().to_owned()).collect()
}

/// Checks that objects of indented JSON, whose keys are indented by `depth` spaces, have the keys of the objects at a pointer of
/// a schema, in its order.
pub(crate) fn assert_order(json: &str, depth: usize, name: &str, pointer: &str) {
    let (found, required) = (super::keys(json, depth), required(name, pointer));
    assert!(!found.is_empty() && found.len().is_multiple_of(required.len()), "{name}: {found:?}");
    for keys in found.chunks(required.len()) {
        assert_eq!(keys, required, "{name}");
    }
}

/// Checks that every key of a schema is seen in one of these.
pub(crate) fn assert_every_key(name: &str, seen: &[Value]) {
    let schema = schema(name);
    let mut found = BTreeSet::new();
    for json in seen {
        note_keys(&schema, json, "", &mut found);
    }
    assert_eq!(found, all_keys(&schema, ""), "{name}");
}

/// Notes the properties of a schema that JSON has, by pointers into the schema.
fn note_keys(schema: &Value, json: &Value, pointer: &str, found: &mut BTreeSet<String>) {
    match json {
        Value::Array(items) => {
            for item in items {
                note_keys(&schema["items"], item, &format!("{pointer}/items"), found);
            }
        }
        Value::Object(object) => {
            for (key, value) in object {
                let pointer = format!("{pointer}/properties/{key}");
                note_keys(&schema["properties"][key], value, &pointer, found);
                found.insert(pointer);
            }
        }
        _ => {}
    }
}

/// Returns the properties of a schema, by pointers into it.
fn all_keys(schema: &Value, pointer: &str) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    if schema.get("items").is_some() {
        all.extend(all_keys(&schema["items"], &format!("{pointer}/items")));
    }
    for (key, property) in schema["properties"].as_object().into_iter().flatten() {
        let pointer = format!("{pointer}/properties/{key}");
        all.extend(all_keys(property, &pointer));
        all.insert(pointer);
    }
    all
}
