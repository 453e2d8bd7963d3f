//! The mean information of occupancy maps, on a page in a browser: the library, the readers of `crates/files` and the rows of
//! `crates/report` as WebAssembly. It computes nothing itself.
//!
//! The page asks in JSON, and is answered in JSON or in the bytes of a picture. Files stay where they are: they are read through
//! one imported function, a piece at a time, so that memory follows what is kept of a map and not how long its file is.
//!
//! A module depends only on those above it:
//!
//! | module | holds |
//! |---|---|
//! | `files` | the files that were dropped on the page, as a source |
//! | `request` | what the page asks |
//! | `room` | the circular room, and one cell |
//! | `session` | the maps that were measured, and the one that is looked at |
//! | `exports` | what JavaScript calls: all `unsafe` |

mod exports;
mod files;
mod request;
mod room;
mod session;
