//! Makes the sample map `maps/room.yaml` and `maps/room.pgm` again, in the folder named or in `maps`:
//! `cargo run --example sample_room`.

mod map;
mod room;

use std::path::PathBuf;
use std::{env, fs, io};

fn main() -> io::Result<()> {
    let default = concat!(env!("CARGO_MANIFEST_DIR"), "/../maps");
    let folder = env::args_os().nth(1).map_or(PathBuf::from(default), PathBuf::from);
    fs::create_dir_all(&folder)?;
    fs::write(folder.join("room.yaml"), map::YAML)?;
    fs::write(folder.join("room.pgm"), map::pgm())
}
