//! The maps that were measured, and the one that is looked at.

use crate::files::{Dropped, ReadPiece};
use crate::request::{Choices, Drawn, Format, Request};
use crate::room::{NoRoom, Room, of_occupancy, one_cell};
use mean_information::Real;
use mean_information::map::{Encoding, Grid};
use mean_information_files::{Cells, Map, octree, read_map_from, with_grid};
use mean_information_report::octree::MeasuredDepths;
use mean_information_report::squares::{UNKNOWN, colour, squares};
use mean_information_report::sweep::Sweep;
use mean_information_report::worst::Worst;
use mean_information_report::{MeasuredMap, Number, Record, Refused, Value, port, record, records};
use serde_json::json;
use std::path::Path;

/// The opaque alpha of pictures.
const OPAQUE: u8 = 255;

/// The worst cells that are listed.
const LISTED: usize = 10;

/// The state between requests.
pub(crate) struct Session {
    read: ReadPiece,
    files: Dropped,
    /// The rows of each map, by its file's name, in the order in which they were first measured.
    rows: Vec<(String, Vec<MeasuredMap>)>,
    open: Open,
    room: Option<Room>,
}

/// What is looked at.
enum Open {
    Nothing,
    Map(String, Map),
    /// An octree, whose cells lie in no rectangle.
    Tree(Sweep),
}

impl Session {
    /// Creates the session of a page whose files are read by `read`.
    pub(crate) fn new(read: ReadPiece) -> Self {
        let files = Dropped::new(Vec::new(), read);
        Self { read, files, rows: Vec::new(), open: Open::Nothing, room: None }
    }

    /// Answers a request.
    ///
    /// # Errors
    /// A refusal, as JSON: its `message` is one line, and `missing_image` the image that a yaml file names and that is not
    /// among the files; of a room also the `field` that is to be changed.
    pub(crate) fn ask(&mut self, request: &[u8]) -> Result<Vec<u8>, String> {
        let request = serde_json::from_slice(request).map_err(|error| {
            // The request is the page's: where it went wrong says nothing to who looks at it.
            let words = error.to_string();
            refusal(words.split(" at line ").next().unwrap_or_default())
        })?;
        match request {
            Request::Squares { of, columns, rows, block } => self.squares(of, columns, rows, block),
            Request::Colours {} => Ok(colours()),
            request => self.text(request).map(String::into_bytes),
        }
    }

    /// Answers a request for text.
    fn text(&mut self, request: Request) -> Result<String, String> {
        match request {
            Request::Files { files } => {
                self.files = Dropped::new(files, self.read);
                Ok(String::new())
            }
            Request::Measure { name, reading } => {
                let place = self.rows.iter().position(|(measured, _)| *measured == name);
                let rows = self.measured(&name, &reading).inspect_err(|_| {
                    place.map(|at| self.rows.remove(at));
                })?;
                let text = record::to_json(&records(&rows).into());
                match place {
                    Some(at) => self.rows[at].1 = rows,
                    None => self.rows.push((name, rows)),
                }
                Ok(text)
            }
            Request::Check { name } => self.measured(&name, &Choices::default()).map(|_| String::new()),
            Request::Forget {} => {
                self.rows.clear();
                self.open = Open::Nothing;
                Ok(String::new())
            }
            Request::Rows { format } => {
                let rows = records(self.rows.iter().flat_map(|(_, rows)| rows));
                Ok(match format {
                    Format::Json => record::to_json(&rows.into()),
                    Format::Csv => record::to_csv(&rows),
                })
            }
            Request::Open { name, reading } => self.open(name, &reading),
            Request::Sweep {} => self.sweep(),
            Request::Cell { of, column, row } => self.cell(of, column, row),
            Request::Worst { side } => Ok(record::to_json(&Value::Record(worst_of(self.cells()?, side)))),
            Request::Room { range, sigma, resolution } => {
                let room = Room::new(&range, &sigma, &resolution).map_err(|why| of_field(&why))?;
                let text = record::to_json(&Value::Record(room.record.clone()));
                self.room = Some(room);
                Ok(text)
            }
            Request::Occupancy { p } => {
                let record = one_cell(&p).map_err(|why| refusal(&why))?;
                Ok(record::to_json(&Value::Record(record)))
            }
            Request::Port { line } => Ok(port::answer(line.as_bytes()).unwrap_or_default()),
            Request::Squares { .. } | Request::Colours {} => Err(refusal("a picture is no text")),
        }
    }

    /// Returns the rows of a map.
    fn measured(&self, name: &str, reading: &Choices) -> Result<Vec<MeasuredMap>, String> {
        let rows = MeasuredMap::read_from(&self.files, Path::new(name), &reading.reading());
        let mut rows = rows.map_err(|refused| of_file(&refused))?;
        if let (Some(image), [row]) = (&reading.image, &mut rows[..]) {
            row.name.clone_from(image);
        }
        Ok(rows)
    }

    fn open(&mut self, name: String, reading: &Choices) -> Result<String, String> {
        // The cells of the map before make room first.
        self.open = Open::Nothing;
        let (reading, path) = (reading.reading(), Path::new(&name));
        if octree::has_name(path) {
            let depths = MeasuredDepths::read(&self.files, path, reading.clamp)
                .map_err(|refused| of_file(&refused))?;
            self.open = Open::Tree(Sweep::of_depths(name, depths));
            return Ok(json!({ "cells": false }).to_string());
        }
        let map =
            read_map_from(&self.files, path, &reading.options).map_err(|error| of_file(&error.into()))?;
        let text = with_grid!(&map.cells, grid => {
            let ([x, y], yaw) = (grid.geometry().origin(), grid.geometry().yaw());
            json!({
                "cells": true, "width": grid.width(), "height": grid.height(), "resolution_m": map.resolution,
                "x": x, "y": y, "yaw": yaw, "percent": matches!(map.cells, Cells::Percent(_)),
            })
        });
        self.open = Open::Map(name, map);
        Ok(text.to_string())
    }

    fn sweep(&self) -> Result<String, String> {
        let json = match &self.open {
            Open::Nothing => return Err(refusal("no map is open")),
            Open::Tree(sweep) => sweep.json(),
            Open::Map(name, map) => {
                Sweep::of(name.clone(), map, |_| {}).map_err(|error| refusal(&error.to_string()))?.json()
            }
        };
        Ok(record::to_json(&json))
    }

    fn squares(
        &self,
        of: Drawn,
        [left, right]: [usize; 2],
        [bottom, top]: [usize; 2],
        block: usize,
    ) -> Result<Vec<u8>, String> {
        let drawn = match of {
            Drawn::Map => {
                with_grid!(self.cells()?, grid => painted(grid, [left, right], [bottom, top], block))
            }
            Drawn::Room => painted(&self.room()?.grid, [left, right], [bottom, top], block),
        };
        Ok(drawn)
    }

    fn cell(&self, of: Drawn, column: usize, row: usize) -> Result<String, String> {
        let record = match of {
            Drawn::Map => with_grid!(self.cells()?, grid => looked_at(grid, column, row)),
            Drawn::Room => looked_at(&self.room()?.grid, column, row),
        };
        let record = record.ok_or_else(|| refusal("there is no such cell"))?;
        Ok(record::to_json(&Value::Record(record)))
    }

    fn cells(&self) -> Result<&Cells, String> {
        match &self.open {
            Open::Map(_, map) => Ok(&map.cells),
            _ => Err(refusal("no map of cells is open")),
        }
    }

    fn room(&self) -> Result<&Room, String> {
        self.room.as_ref().ok_or_else(|| refusal("no room is drawn"))
    }
}

/// Returns the pixels of a part of a grid, row by row from the top.
fn painted<E: Encoding>(
    grid: &Grid<E>,
    [left, right]: [usize; 2],
    [bottom, top]: [usize; 2],
    block: usize,
) -> Vec<u8> {
    let block = block.max(1);
    let (right, top) = (right.min(grid.width()), top.min(grid.height()));
    let columns = right.saturating_sub(left).div_ceil(block);
    let pixels: Vec<[u8; 4]> = squares(grid, left..right, bottom..top, block)
        .map(|bits| {
            let [red, green, blue] = bits.map_or(UNKNOWN, colour);
            [red, green, blue, OPAQUE]
        })
        .collect();
    pixels.chunks(columns.max(1)).rev().flatten().flatten().copied().collect()
}

/// Returns the record of a cell of a grid, with its place.
fn looked_at<E: Encoding>(grid: &Grid<E>, column: usize, row: usize) -> Option<Record> {
    let &stored = grid.row(row)?.get(column)?;
    // In the encoding, whose log-odds say more than the float of an occupancy.
    let cell = E::cell(stored)?;
    let Record(mut entries) = of_occupancy(E::occupancy(stored)?);
    let computed = |x: E::Float| Value::Computed(Some(Number::new(x)));
    entries[1].1 = computed(cell.entropy());
    entries[2].1 = computed(cell.information());
    entries.push(("unknown", Value::Flag(E::occupancy(stored)? == E::Float::HALF)));
    Some(Record(entries))
}

/// Returns the record of what leaves the most doubt in a map: cells, and the square of `side` cells a side.
fn worst_of(cells: &Cells, side: usize) -> Record {
    let worst = Worst::of_cells(cells, LISTED, side);
    let count = |x: usize| Value::Count(x as u64);
    let place = |[row, column]: [usize; 2]| [("column", count(column)), ("row", count(row))];
    let listed = worst.cells.iter().filter_map(|&at| {
        let Record(entries) = with_grid!(cells, grid => looked_at(grid, at[1], at[0]))?;
        Some(Record(place(at).into_iter().chain(entries).collect()))
    });
    let mut entries = vec![("cells", Value::Records(listed.collect())), ("equal", Value::Count(worst.equal))];
    if let Some(square) = worst.square {
        let computed = |x| Value::Computed(Some(x));
        let mut of_square: Vec<_> = place([square.rows.start, square.columns.start]).into();
        of_square.extend([
            ("width", count(square.columns.len())),
            ("height", count(square.rows.len())),
            ("observed", Value::Count(square.observed)),
            ("entropy", computed(square.entropy)),
            ("mean_information", computed(square.mean_information)),
        ]);
        entries.push(("square", Value::Record(Record(of_square))));
    }
    Record(entries)
}

/// Returns the colours of the scale, and that of unknown.
fn colours() -> Vec<u8> {
    let scale = (0..=255).map(|k| colour(f64::from(k) / 255.0));
    scale.chain([UNKNOWN]).flatten().collect()
}

/// Returns a refusal as JSON.
fn refusal(message: &str) -> String {
    json!({ "message": message, "missing_image": null }).to_string()
}

/// Returns the refusal of a room as JSON, with the field that is to be changed.
fn of_field(refused: &NoRoom) -> String {
    json!({ "message": refused.message, "missing_image": null, "field": refused.field }).to_string()
}

/// Returns the refusal of a file as JSON.
fn of_file(refused: &Refused) -> String {
    json!({ "message": refused.to_string(), "missing_image": refused.missing_image }).to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    const YAML: &[u8] = b"image: map.pgm\nresolution: 0.05\norigin: [1, 2, 0]\nnegate: 0\nmode: scale\n\
        occupied_thresh: 1\nfree_thresh: 0\n";
    const PGM: &[u8] = b"P5\n2 2\n255\n\x00\x7f\xff\x40";

    fn read(file: u32, at: u64, into: &mut [u8]) -> Option<usize> {
        let bytes = [YAML, PGM].get(file as usize)?.get(at as usize..)?;
        let length = bytes.len().min(into.len());
        into[..length].copy_from_slice(&bytes[..length]);
        Some(length)
    }

    fn with_files() -> Session {
        let mut session = Session::new(read);
        let files = json!([
            { "name": "map.yaml", "length": YAML.len() }, { "name": "map.pgm", "length": PGM.len() },
        ]);
        ask(&mut session, &json!({ "files": { "files": files } })).unwrap();
        session
    }

    fn ask(session: &mut Session, request: &serde_json::Value) -> Result<Vec<u8>, String> {
        session.ask(request.to_string().as_bytes())
    }

    fn text(session: &mut Session, request: &serde_json::Value) -> String {
        String::from_utf8(ask(session, request).unwrap()).unwrap()
    }

    #[test]
    fn a_map_is_measured_looked_at_and_forgotten() {
        let mut session = with_files();
        let reading = json!({});
        let rows = text(&mut session, &json!({ "measure": { "name": "map.yaml", "reading": reading } }));
        assert!(rows.contains("\"mean_information\": 0.72957"), "{rows}");
        assert_eq!(text(&mut session, &json!({ "rows": { "format": "json" } })), rows);
        let opened = text(&mut session, &json!({ "open": { "name": "map.yaml", "reading": reading } }));
        assert!(opened.contains("\"width\":2") && opened.contains("\"x\":1.0"), "{opened}");
        let squares = json!({ "squares": { "of": "map", "columns": [0, 2], "rows": [0, 2], "block": 1 } });
        let pixels = ask(&mut session, &squares).unwrap();
        // From the top: occupied and unknown, then free and grey 64.
        let [certain, unknown] = [colour(1.0), UNKNOWN].map(|[r, g, b]| [r, g, b, OPAQUE]);
        assert_eq!([&pixels[..4], &pixels[4..8], &pixels[8..12]], [certain, unknown, certain]);
        let cell = text(&mut session, &json!({ "cell": { "of": "map", "column": 1, "row": 0 } }));
        assert!(cell.contains("\"p\": 0.75,") && cell.contains("\"unknown\": false"), "{cell}");
        assert!(text(&mut session, &json!({ "sweep": {} })).contains("\"k\": 2"));
        // One cell is neither certain nor unknown: the worst, and the square that begins lowest and holds it.
        let worst: serde_json::Value =
            serde_json::from_str(&text(&mut session, &json!({ "worst": { "side": 1 } }))).unwrap();
        assert_eq!(worst["cells"].as_array().map(Vec::len), Some(1));
        assert_eq!((&worst["cells"][0]["column"], &worst["cells"][0]["p"]), (&json!(1), &json!(0.75)));
        assert_eq!((&worst["equal"], &worst["square"]["column"]), (&json!(1), &json!(1)));
        assert_eq!(worst["square"]["entropy"], worst["cells"][0]["entropy"]);
        ask(&mut session, &json!({ "forget": {} })).unwrap();
        assert_eq!(text(&mut session, &json!({ "rows": { "format": "json" } })), "[]\n");
        assert!(ask(&mut session, &squares).is_err());
    }

    #[test]
    fn a_map_that_is_measured_again_takes_its_place_and_a_refused_one_leaves() {
        let mut session = with_files();
        let measure = |name, mode| json!({ "measure": { "name": name, "reading": { "mode": mode } } });
        let rows = json!({ "rows": { "format": "json" } });
        let first = text(&mut session, &measure("map.yaml", "scale"));
        text(&mut session, &measure("folder/map.yaml", "scale"));
        let again = text(&mut session, &measure("map.yaml", "raw"));
        assert_ne!(first, again);
        let both: serde_json::Value = serde_json::from_str(&text(&mut session, &rows)).unwrap();
        let names: Vec<_> = both.as_array().unwrap().iter().map(|row| &row["map"]).collect();
        assert_eq!(names, ["map.yaml", "folder/map.yaml"]);
        assert_eq!(json!([both[0]]), serde_json::from_str::<serde_json::Value>(&again).unwrap());
        // A check keeps nothing, and says what is wrong.
        ask(&mut session, &json!({ "check": { "name": "map.yaml" } })).unwrap();
        ask(&mut session, &json!({ "check": { "name": "none.yaml" } })).unwrap_err();
        assert_eq!(text(&mut session, &rows).matches("\"map\"").count(), 2);
        // What was refused leaves no numbers of before.
        let cut = json!([
            { "name": "map.yaml", "length": YAML.len() }, { "name": "map.pgm", "length": PGM.len() - 1 },
        ]);
        ask(&mut session, &json!({ "files": { "files": cut } })).unwrap();
        ask(&mut session, &measure("map.yaml", "raw")).unwrap_err();
        let left: serde_json::Value = serde_json::from_str(&text(&mut session, &rows)).unwrap();
        assert_eq!(left, json!([both[1]]));
    }

    #[test]
    fn a_refusal_is_a_line_and_names_the_image_that_lacks() {
        let mut session = with_files();
        let measure = |name| json!({ "measure": { "name": name, "reading": { "mode": "scale" } } });
        let refused = ask(&mut session, &measure("other.yaml")).unwrap_err();
        assert!(
            refused.contains("other.yaml: cannot be read") && refused.contains("\"missing_image\":null"),
            "{refused}"
        );
        let alone = json!({ "files": { "files": [{ "name": "map.yaml", "length": YAML.len() }] } });
        ask(&mut session, &alone).unwrap();
        let refused = ask(&mut session, &measure("map.yaml")).unwrap_err();
        assert!(refused.contains("\"missing_image\":\"map.pgm\""), "{refused}");
        for request in [
            json!({ "nothing": {} }),
            json!(3),
            json!({ "measure": { "name": "a", "reading": { "mode": "x" } } }),
        ] {
            assert!(ask(&mut session, &request).is_err(), "{request}");
        }
        let comma = json!({ "measure": { "name": "map.yaml", "reading": { "resolution": "0,05" } } });
        let refused = ask(&mut session, &comma).unwrap_err();
        let expected = r#""0,05" is not a number; its mark is the point: 0.05"#;
        let refused: serde_json::Value = serde_json::from_str(&refused).unwrap();
        assert_eq!(refused["message"], expected);
    }
}
