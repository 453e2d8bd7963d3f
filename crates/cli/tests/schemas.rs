//! The schemas of `schemas/`: one for each JSON, of which every key is seen, and none that allows anything.

mod common;

use common::schema::*;
use common::*;
use mean_information_report::protocol::{Argument, Request, Run};
use mean_information_test_support::formats::Node;
use serde_json::{Value, json};
use std::collections::BTreeSet;
use std::fs;

const SAMPLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/room");

/// The names of the schemas, of all but what they share.
fn names() -> BTreeSet<String> {
    let files = fs::read_dir(SCHEMAS).unwrap().map(|entry| entry.unwrap().file_name());
    let names = files.filter_map(|file| Some(file.to_str()?.strip_suffix(".json")?.to_owned()));
    names.filter(|name| name != "common").collect()
}

/// Runs commands, whose JSON `stdout` holds to the schema, and checks that together they show every key of it.
fn every_key_of(name: &str, runs: &[&[&str]]) {
    let seen = |arguments: &&[&str]| {
        let arguments = [*arguments, &["--format", "json"]].concat();
        assert_eq!(schema_of(&arguments), Some(name));
        serde_json::from_str(&stdout(&arguments)).unwrap()
    };
    assert_every_key(name, &runs.iter().map(seen).collect::<Vec<_>>());
}

/// The commands of `--help` that print JSON have a schema, and the index names each with its command.
#[test]
fn every_command_has_a_schema() {
    let help = stdout(&["--help"]);
    let (_, commands) = help.split_once("Commands:\n").unwrap();
    let commands = commands.lines().take_while(|line| !line.is_empty());
    let commands = commands.filter_map(|line| line.strip_prefix("  ")?.split_whitespace().next());
    let printing: BTreeSet<_> = commands
        .filter(|&command| command != "help" && stdout(&[command, "--help"]).contains("--format"))
        .map(str::to_owned)
        .collect();
    let beside = ["check-list", "emmi-filter", "port"].map(str::to_owned);
    assert_eq!(names(), printing.into_iter().chain(beside).collect());
    let index = fs::read_to_string(format!("{SCHEMAS}/README.md")).unwrap();
    for name in names() {
        assert!(index.contains(&format!("[`{name}.json`]({name}.json)")), "schemas/README.md lacks {name}");
        let title = schema(&name)["title"].as_str().unwrap().to_owned();
        let command = title.split('`').nth(1).unwrap();
        assert!(command.contains("--format json") || name == "port", "{title}");
    }
}

/// An object with a key that no schema names, without one that it needs, or with a twin that is no float is refused.
#[test]
fn schemas_refuse_what_is_not_printed() {
    let sample = stdout(&["map", &format!("{SAMPLE}.yaml"), "--format", "json"]);
    let sample: Value = serde_json::from_str(&sample).unwrap();
    let validator = validator("map");
    assert!(validator.is_valid(&sample));
    for (key, value) in [
        ("more", json!(1)),
        ("observed", json!(-1)),
        ("mean_information", json!(1.5)),
        ("mean_information_hex", json!("0x1.80p-1")),
        ("warnings", json!([1])),
    ] {
        let mut changed = sample.clone();
        changed[0][key] = value;
        assert!(!validator.is_valid(&changed), "{changed}");
    }
    let mut without = sample;
    without[0].as_object_mut().unwrap().remove("free");
    assert!(!validator.is_valid(&without));
}

/// Every object says of each key whether it must be there, and allows no other.
#[test]
fn objects_are_closed_and_need_their_keys() {
    fn check(schema: &Value, name: &str) {
        if let Some(properties) = schema["properties"].as_object() {
            assert_eq!(schema["additionalProperties"], false, "{name}");
            let needed = schema["required"].as_array().unwrap();
            let missing: Vec<_> =
                properties.keys().filter(|key| !needed.contains(&json!(key))).map(String::as_str).collect();
            let may_miss = match name {
                "map" => &["leaves", "observed_volume_m3", "observed_volume_m3_hex"][..],
                "sweep" => &["depth"],
                "check" => &["failed_elsewhere", "tests_elsewhere"],
                _ => &[],
            };
            assert!(missing.is_empty() || missing == may_miss, "{name}: {missing:?}");
            assert!(needed.iter().all(|key| properties.contains_key(key.as_str().unwrap())), "{name}");
            for property in properties.values() {
                check(property, name);
            }
        }
        if schema.get("items").is_some() {
            check(&schema["items"], name);
        }
    }
    for name in names() {
        check(&schema(&name), &name);
    }
}

#[test]
fn maps_and_their_series() {
    let folder = Folder::new();
    let tree = folder.write("tree.ot", Node::small().full(false));
    let map = format!("{SAMPLE}.yaml");
    let bag = concat!(env!("CARGO_MANIFEST_DIR"), "/../files/tests/bags/maps_lz4.bag");
    let tree = tree.to_str().unwrap();
    every_key_of("map", &[&["map", &map, tree]]);
    every_key_of("sweep", &[&["sweep", &map], &["sweep", tree]]);
    every_key_of("bag", &[&["bag", bag]]);
}

#[test]
fn rooms_and_limits() {
    let folder = Folder::new();
    let room = ["--range", "2", "--sigma", "0.1"];
    every_key_of("limit", &[&[&["limit"], &room[..]].concat()]);
    every_key_of("converge", &[&[&["converge"], &room[..], &["--resolutions", "0.5"]].concat()]);
    let prefix = folder.text_path("map");
    let small = ["simulate", "--poses", "2", "--beams", "60", "--resolution", "0.2", "--scans", "3"];
    every_key_of("simulate", &[&[&small[..], &["--out", &prefix]].concat()]);
}

#[test]
fn trajectories() {
    let [log, truth, odometry] =
        [".log", ".true.tum", ".odometry.tum"].map(|ending| format!("{SAMPLE}{ending}"));
    every_key_of("trajectory", &[&["trajectory", &log, &truth, &odometry, "--resolution", "0.4"]]);
}

/// The lines that a check sends, what this library answers as a port, and a welcome with claims; lines that are none of these.
#[test]
fn lines_of_the_protocol() {
    let hex = |text: &str| Argument::Float(text.to_owned());
    let run = |seq, op: &str, args: [(&str, Argument); 1]| {
        let args = args.map(|(name, value)| (name.to_owned(), value)).into();
        Request::Run(Run { seq, op: op.to_owned(), format: "f64".to_owned(), args })
    };
    let cells = ["0x1p-2", "0x1.8p-1", "nan"].map(str::to_owned).to_vec();
    let requests = [
        Request::Start { protocol: 1 },
        run(1, "cell.information", [("p", hex("0x1p-2"))]),
        run(2, "map.observed", [("cells", Argument::List(cells[..2].to_vec()))]),
        run(3, "map.observed", [("cells", Argument::List(cells.clone()))]),
        run(4, "expected.mean_information", [("particles", Argument::Rows(vec![cells]))]),
        Request::Stop,
    ];
    let sent: String = requests.iter().map(|request| request.line() + "\n").collect();
    let answered = meaninfo().arg("port").write_stdin(format!("no request\n{sent}")).output().unwrap().stdout;
    let validator = validator("port");
    let lines: Vec<_> = sent.lines().chain(text(&answered).lines()).collect();
    assert_eq!(lines.len(), 6 + 6, "{lines:?}");
    let claims = r#"{"protocol":1,"formats":["f64"],"ops":[],"claims":{"cell.*":3,"map.*":{"bits":2e-16}}}"#;
    for line in lines.into_iter().chain([claims, r#"{"seq":1,"skipped":"no f32"}"#]) {
        assert!(validator.is_valid(&serde_json::from_str(line).unwrap()), "{line}");
    }
    for line in [
        r#"{"cmd":"start","protocol":2}"#,
        r#"{"seq":1}"#,
        r#"{"seq":1,"result":"0x1p-1","error":"domain"}"#,
        r#"{"seq":1,"result":0.5}"#,
        r#"{"cmd":"run","seq":1,"op":"cell.information","format":"f64","args":{"p":0.25}}"#,
    ] {
        assert!(!validator.is_valid(&serde_json::from_str(line).unwrap()), "{line}");
    }
}

#[test]
fn operations() {
    every_key_of("check-list", &[&["check", "--list"]]);
}
