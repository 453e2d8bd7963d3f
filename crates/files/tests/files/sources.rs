//! Files from memory, and what the sources of the package do not say.

use crate::support::{Nobody, percents};
use mean_information_files::{
    Contents, Counted, ErrorKind, Memory, Options, read_array_type_from, read_map_contents_from,
    read_map_from,
};
use mean_information_test_support::formats::{Folder, npy, pgm, yaml};
use std::fs;
use std::path::{Path, PathBuf};

/// A page is handed files without their folders.
#[test]
fn a_map_in_memory_is_the_map_on_the_disk() {
    let image = pgm(3, 2, 255, &[0, 255, 205, 10, 20, 30]);
    for name in ["room.pgm", "./room.pgm", "maps/room.pgm", "/home/robot/maps/room.pgm"] {
        let mut files = Memory::new();
        files.add("room.yaml", yaml(name, "negate: 0\n"));
        files.add("room.pgm", image.clone());
        let map = read_map_from(&files, Path::new("room.yaml"), &Options::default()).unwrap();
        assert_eq!(percents(&map), [100, 100, 100, 100, 0, -1]);
        let map =
            read_map_contents_from(&files, Path::new("room.yaml"), &Options::default(), &mut Nobody).unwrap();
        let Contents::Counted(Counted::Percent(counts)) = map.cells else { panic!("{map:?}") };
        assert_eq!((counts.width, counts.height), (3, 2));
        let of = |percent| counts.values.iter().filter(|&&(p, _)| p == percent).map(|&(_, n)| n).sum::<u64>();
        assert_eq!([100, 0, -1].map(of), [4, 1, 1]);
    }
    let folder = Folder::new();
    folder.write("room.pgm", image);
    let path = folder.write("room.yaml", yaml("room.pgm", "negate: 0\n"));
    let map = mean_information_files::read_map(&path, &Options::default()).unwrap();
    assert_eq!(percents(&map), [100, 100, 100, 100, 0, -1]);
}

/// Who asks before a map is read decides by it what its numbers may mean.
#[test]
fn the_type_of_an_array_is_known_before_its_cells_are_read() {
    let mut files = Memory::new();
    for (name, element) in
        [("f8", "float64"), ("f4", "float32"), ("i1", "int8"), ("u1", "uint8"), ("b1", "bool")]
    {
        let order = if name.ends_with('1') { '|' } else { '<' };
        files.add("map.NPY", npy(&format!("'{order}{name}'"), false, "(2, 3)", &[]));
        let found = read_array_type_from(&files, Path::new("map.NPY")).unwrap();
        assert_eq!(found.as_deref(), Some(element));
    }
    assert_eq!(read_array_type_from(&files, Path::new("none.yaml")).unwrap(), None);
    let refused = read_array_type_from(&files, Path::new("none.npy")).unwrap_err();
    assert_eq!((refused.kind(), refused.file()), (ErrorKind::NotFound, Some(Path::new("none.npy"))));
}

/// The Rust files of a folder and those within it.
fn sources(folder: &Path) -> Vec<PathBuf> {
    let paths = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    paths.flat_map(|path| if path.is_dir() { sources(&path) } else { vec![path] }).collect()
}

/// Who calls is a command, a wheel or a page: each has its own words for options, and its own place to print.
#[test]
fn no_word_of_a_command_line_is_in_the_sources_and_nothing_is_printed() {
    let files = sources(&Path::new(env!("CARGO_MANIFEST_DIR")).join("src"));
    assert!(files.len() > 25, "{files:?}");
    for file in files {
        let text = fs::read_to_string(&file).unwrap();
        for (number, line) in text.lines().enumerate() {
            let at = format!("{}:{}: {line}", file.display(), number + 1);
            let option = line.match_indices("--").any(|(at, _)| {
                let before = line[..at].chars().next_back();
                let after = line[at + 2..].chars().next();
                before != Some('-') && after.is_some_and(|c| c.is_ascii_alphabetic())
            });
            assert!(!option, "an option: {at}");
            for word in
                ["print!", "println!", "eprint!", "eprintln!", "dbg!", "stdout", "stderr", "meaninfo "]
            {
                assert!(!line.contains(word), "{word}: {at}");
            }
        }
    }
}
