//! What is measured of a map, as rows of JSON and CSV, and the port protocol: what the command `meaninfo` and its page in a
//! browser both say, to the byte. No arguments are parsed, nothing is printed and no picture drawn. Of this library nothing is
//! promised: what stays is the command, and the keys of its JSON.
//!
//! ```
//! use mean_information_files::Memory;
//! use mean_information_report::{MeasuredMap, Reading, record, records};
//! use std::path::Path;
//!
//! let mut files = Memory::new();
//! files.add("map.pgm", b"P5\n2 2\n255\n\x00\x7f\xff\x40".to_vec());
//! let yaml = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n\
//!             mode: scale\noccupied_thresh: 1\nfree_thresh: 0\n";
//! files.add("map.yaml", yaml.as_bytes().to_vec());
//!
//! let maps = MeasuredMap::read_from(&files, Path::new("map.yaml"), &Reading::default())?;
//! let json = record::to_json(&records(&maps).into());
//! assert!(json.contains("\"mean_information\": 0.72957"), "{json}");
//! # Ok::<(), mean_information_report::Refused>(())
//! ```
//!
//! A module depends only on those above it:
//!
//! | module | holds |
//! |---|---|
//! | [`hex_float`] | hexadecimal floats |
//! | [`protocol`] | the messages between `meaninfo check` and a port |
//! | [`port`] | the library as a port |
//! | [`mod@one_line`] | text of others in one line |
//! | [`number`] | numbers in the precision they were computed in |
//! | [`record`] | rows of named values, as JSON and CSV |
//! | [`words`] | refusals and warnings, in words that name the option that mends them |
//! | [`clamp`] | the occupancies of a tree that only tells free from occupied |
//! | [`measures`] | what is measured of a map |
//! | [`submaps`] | the submaps of saved states, apart or together |
//! | [`uses`] | the files that have a use for an option |
//! | [`octree`] | what is measured of an octree, at each depth |
//! | [`measured_map`] | a map of any of these kinds, measured: a row |
//! | [`sweep`] | the measures against the size of cells |
//! | `cell_cache` | cells by their stored value |
//! | [`squares`] | the information of squares of cells, and its colours |
//! | [`worst`] | the cells and the square of cells that leave the most doubt |

mod cell_cache;
pub mod clamp;
pub mod hex_float;
pub mod measured_map;
pub mod measures;
pub mod number;
pub mod octree;
pub mod one_line;
pub mod port;
pub mod protocol;
pub mod record;
pub mod squares;
pub mod submaps;
pub mod sweep;
pub mod uses;
pub mod words;
pub mod worst;

pub use clamp::Clamp;
pub use measured_map::{MeasuredMap, Reading, records};
pub use measures::{Measures, NotMeaningful};
pub use number::Number;
pub use one_line::one_line;
pub use record::{Record, Value};
pub use words::Refused;

/// The README, whose example is compiled.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
