//! `meaninfo paper`: the figures, the page and the table, all of it; and what is refused.

mod common;

use common::schema::assert_every_key;
use common::*;
use serde_json::Value;
use std::fs;

const FIGURES: [&str; 6] =
    ["figure-1.svg", "figure-2.svg", "figure-3.svg", "figure-4.svg", "figure-5.svg", "loop-closure.svg"];

/// The README in one line.
fn readme() -> String {
    let readme = read(concat!(env!("CARGO_MANIFEST_DIR"), "/../../README.md"));
    text(&readme).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Half a minute with optimization, minutes without; a part of it is a unit test of `src/paper/mod.rs`.
#[test]
#[cfg_attr(
    debug_assertions,
    ignore = "takes minutes: cargo test --release --package mean-information-cli --test paper"
)]
fn the_report_is_reproduced() {
    let folder = Folder::new();
    let out = folder.text_path("paper");
    let table = stdout(&["paper", "--out", &out]);
    let json = stdout(&["paper", "--format", "json", "--out", &folder.text_path("again")]);
    let json: Value = serde_json::from_str(&json).unwrap();
    assert_every_key("paper", std::slice::from_ref(&json));

    // The same bytes on every run.
    let mut names: Vec<_> =
        fs::read_dir(&out).unwrap().map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, [&FIGURES[..5], &["index.html"], &FIGURES[5..]].concat());
    for name in &names {
        let [first, second] = ["paper", "again"].map(|run| read(folder.path(run).join(name)));
        assert!(first == second, "{name}");
    }

    // The pictures of the chapter on the figures.
    for name in FIGURES {
        let kept = read(format!("{}/../../docs/figures/{name}", env!("CARGO_MANIFEST_DIR")));
        assert!(
            read(folder.path("paper").join(name)) == kept,
            "meaninfo paper --out docs/figures draws another {name}"
        );
    }

    // Every claim was checked and none failed; those that the limit and finer cells correct are corrected.
    let claims = json["claims"].as_array().unwrap();
    let verdicts = |verdict: &str| claims.iter().filter(|claim| claim["verdict"] == verdict).count();
    assert_eq!((verdicts("fail"), verdicts("corrected")), (0, 6));
    assert_eq!(verdicts("pass"), 15, "{claims:?}");
    assert!(readme().contains("its 21 claims, each with what was measured: 15 pass, 6 are corrected."));
    let measured = |part: &str| {
        let claim = claims.iter().find(|claim| claim["claim"].as_str().unwrap().contains(part)).unwrap();
        claim["measured"].as_str().unwrap().to_owned()
    };
    // The limits of maths and the values of the grids, by other tools (docs/erratum.md).
    assert!(measured("polar map tends").contains("0.789507 at 2.5 mm"));
    assert!(measured("grids of the experiment").contains("0.652511"));
    assert!(measured("no analytical primitive").contains("0.7893368880256514"));
    // The seeded rooms and filters, with the exceptions there are.
    assert!(measured("Misalignment").contains("lower in 100 of 100 random rooms"));
    let shows = |k: usize| json["figures"][k]["shows"].as_str().unwrap();
    assert!(
        shows(0).contains("aligned 0.9037, misaligned 0.8735") && shows(0).contains("In 321 cells of (d)")
    );
    assert!(shows(0).contains("Alone 0.7727 and 0.7729") && shows(0).contains("29 cm and 6 degrees"));
    assert!(measured("more observed cells").contains("19131 over 18733"));
    assert!(measured("tends to a maximum value").contains("0.9571 at 1 cm and 0.9517 at 5 mm"));
    assert!(measured("practical cell sizes").contains("within 0.0185"));
    assert!(shows(1).contains("from 0.832 at 1 m to 0.966 at 0.1 m") && shows(1).contains("196887-fold"));
    let moved = "100 if one is moved by 20 cm, 100 if one is moved by 10 cm, 100 if one is moved by 5 cm, 62 if one is \
                 moved by 2 cm, 55 if one is moved by 1 cm";
    assert!(measured("respectively well aligned").contains(moved));
    assert!(measured("closing a large loop").contains("in 12 of 13 runs"));
    assert!(measured("better suited").contains("in 13 of 13 runs"));
    assert!(measured("better suited").contains("more in EMMI in 11."));
    assert!(measured("better suited").contains("910 bits, where a margin of 1 m of unknown cells adds 5240"));
    assert!(
        measured("closing a large loop").contains("own mean in 12; but in 12 it had risen as much before")
    );

    // A page that needs nothing else, with each figure in it and described.
    let page = String::from_utf8(read(folder.path("paper").join("index.html"))).unwrap();
    let body = page.strip_prefix("<!DOCTYPE html>\n").unwrap();
    let document = roxmltree::Document::parse(body).unwrap();
    let nodes = |tag: &'static str| document.descendants().filter(move |node| node.tag_name().name() == tag);
    links_and_formulas(&document);
    assert_eq!((nodes("script").count(), nodes("link").count(), page.matches("url(").count()), (0, 0, 0));
    assert!(page.contains("prefers-color-scheme: dark") && page.contains("width=device-width"));
    let described =
        nodes("div").filter_map(|div| div.attribute("aria-label")).filter(|label| label.len() > 80);
    let described: Vec<_> = described.collect();
    assert_eq!(described.len(), FIGURES.len());
    assert_eq!(nodes("tr").count(), claims.len() + 1);
    for (name, figure) in FIGURES.iter().zip(json["figures"].as_array().unwrap()) {
        assert_eq!(figure["file"], *name);
        let svg = String::from_utf8(read(folder.path("paper").join(name))).unwrap();
        let svg = roxmltree::Document::parse(&svg).unwrap();
        assert!(described.contains(&svg.root_element().attribute("aria-label").unwrap()), "{name}");
        let drawn = |document: &roxmltree::Document| {
            let nodes = document
                .descendants()
                .filter(|node| node.has_tag_name("image") || node.has_tag_name("polyline"));
            nodes.map(|node| format!("{:?}", node.attributes().collect::<Vec<_>>())).collect::<Vec<_>>()
        };
        let (of_file, of_page) = (drawn(&svg), drawn(&document));
        assert!(!of_file.is_empty() && of_file.iter().all(|element| of_page.contains(element)), "{name}");
    }
    for claim in claims {
        assert!(table.contains(claim["verdict"].as_str().unwrap()));
    }

    // The map of the report has the same claims, with the same verdicts, in the same order.
    let map = fs::read_to_string("../../docs/paper.md").unwrap();
    let (_, listed) = map.split_once("\n## Claims").unwrap();
    let listed = listed.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| |"));
    let listed: Vec<Vec<_>> =
        listed.map(|line| line.trim_matches('|').split('|').map(str::trim).collect()).collect();
    let text = |claim: &Value, key: &str| claim[key].as_str().unwrap().to_owned();
    assert_eq!(
        listed.iter().map(|row| [row[0], row[1], row[6]].map(str::to_owned)).collect::<Vec<_>>(),
        claims
            .iter()
            .map(|claim| ["place", "claim", "verdict"].map(|key| text(claim, key)))
            .collect::<Vec<_>>()
    );
}

/// Nothing that a browser would load, links that lead to chapters, and under every figure a formula with the chapter that
/// derives it.
fn links_and_formulas(document: &roxmltree::Document) {
    for node in document.descendants() {
        for attribute in node.attributes().filter(|a| ["href", "src"].contains(&a.name())) {
            let (_, chapter) = attribute.value().split_once("/mean_information/book/").unwrap_or_default();
            let chapter = chapter.strip_suffix("/index.html").unwrap_or("README");
            let leads = attribute.value().starts_with("https://docs.rs/mean-information/")
                && fs::exists(format!("../../docs/{chapter}.md")).unwrap();
            assert!(leads || ["data:", "#"].iter().any(|local| attribute.value().starts_with(local)));
        }
    }
    let sections = document.descendants().filter(|node| node.has_tag_name("section"));
    let figures: Vec<_> = sections.filter(|node| node.attribute("id") != Some("claims")).collect();
    assert_eq!(figures.len(), FIGURES.len());
    for tag in ["math", "a"] {
        assert!(
            figures.iter().all(|figure| figure.descendants().any(|node| node.has_tag_name(tag))),
            "{tag}"
        );
    }
}

/// Before anything is computed.
#[test]
fn a_folder_that_cannot_be_made_is_refused() {
    let folder = Folder::new();
    fs::write(folder.path("file"), "").unwrap();
    for (out, what) in [("no/such/folder", "does not exist"), ("file", "is not a folder")] {
        let line = refusal(&["paper", "--out", &folder.text_path(out)]);
        assert!(line.contains(out) && line.contains(what), "{line}");
    }
    assert_eq!(folder.names(), ["file"]);
}
