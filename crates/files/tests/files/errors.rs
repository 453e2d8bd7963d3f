//! Errors that a caller branches on: every kind, with its file, place, value, what is allowed, and cause.

use mean_information_files::ros::{Description, write_image};
use mean_information_files::{
    Disk, Error, ErrorKind, Memory, Mode, Options, Place, Semantics, Source, gridmap, npy, read_map,
    read_map_from, read_weights_from,
};
use mean_information_test_support::formats::{Folder, GridMap, npy as array, pgm, raw_png, yaml, zlib};
use std::error::Error as _;
use std::io;
use std::path::Path;

/// What a caller sees of an error: kind, file, place, value, allowed.
fn parts(error: &Error) -> (ErrorKind, Option<&str>, Option<Place>, Option<&str>, Option<&str>) {
    let file = error.file().map(|file| file.to_str().unwrap());
    (error.kind(), file, error.place().cloned(), error.value(), error.allowed())
}

/// The refusal of a ROS map whose image holds these bytes.
fn refused_image(image: &[u8], options: &Options) -> Error {
    let mut files = Memory::new();
    files.add("map.yaml", yaml("image", "negate: 0\n"));
    files.add("image", image);
    read_map_from(&files, Path::new("map.yaml"), options).unwrap_err()
}

/// The refusal of an array of doubles.
fn refused_array(shape: &str, cells: &[f64], options: &Options) -> Error {
    let data: Vec<u8> = cells.iter().flat_map(|x| x.to_le_bytes()).collect();
    let bytes = array("'<f8'", false, shape, &data);
    npy::read(&bytes[..], bytes.len() as u64, options).unwrap_err()
}

#[test]
fn a_missing_file_is_not_found_and_its_cause_is_kept() {
    let folder = Folder::new();
    let path = folder.path("map.yaml");
    let refused = read_map(&path, &Options::default()).unwrap_err();
    assert_eq!(parts(&refused), (ErrorKind::NotFound, path.to_str(), None, None, None));
    let cause: &io::Error = refused.source().unwrap().downcast_ref().unwrap();
    assert_eq!(cause.kind(), io::ErrorKind::NotFound);
    // Of an image the yaml file is named, where it must be mended.
    folder.write("map.yaml", yaml("hall.pgm", "negate: 0\n"));
    let refused = read_map(&path, &Options::default()).unwrap_err();
    let place = Some(Place::Key("image"));
    assert_eq!(parts(&refused), (ErrorKind::NotFound, path.to_str(), place, Some("hall.pgm"), None));
    let refused = read_map_from(&Memory::new(), Path::new("map.npy"), &Options::default()).unwrap_err();
    assert_eq!(parts(&refused), (ErrorKind::NotFound, Some("map.npy"), None, None, None));
}

#[test]
fn a_folder_is_not_a_file() {
    let folder = Folder::new();
    let refused = Disk.open(&folder.path("")).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::NotAFile);
    assert!(refused.allowed().is_some_and(|allowed| allowed == "files"));
}

/// A reader or a writer that fails.
struct Broken;

impl io::Read for Broken {
    fn read(&mut self, _: &mut [u8]) -> io::Result<usize> {
        Err(io::Error::new(io::ErrorKind::ConnectionReset, "the cable was pulled"))
    }
}

impl io::Write for Broken {
    fn write(&mut self, _: &[u8]) -> io::Result<usize> {
        Err(io::ErrorKind::StorageFull.into())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn the_errors_of_readers_and_writers_are_kept_whole() {
    let cause_of = |error: &Error| error.source().unwrap().downcast_ref::<io::Error>().unwrap().kind();
    let refused = npy::read(Broken, 100, &Options::default()).unwrap_err();
    assert_eq!((refused.kind(), cause_of(&refused)), (ErrorKind::Io, io::ErrorKind::ConnectionReset));
    assert_eq!(refused.to_string(), "cannot be read: the cable was pulled");

    let bytes = array("'|i1'", false, "(2, 3)", &[0, 100, 50, 7, 7, 7]);
    let map = npy::read(&bytes[..], bytes.len() as u64, &Options::default()).unwrap();
    let mean_information_files::Cells::Percent(grid) = &map.cells else { panic!("{map:?}") };
    let refused = write_image(grid, Broken).unwrap_err();
    assert_eq!((refused.kind(), cause_of(&refused)), (ErrorKind::Io, io::ErrorKind::StorageFull));
    assert_eq!(npy::write(grid, Broken).unwrap_err().kind(), ErrorKind::Io);
}

#[test]
fn a_file_that_ends_early_is_cut_short() {
    let whole = GridMap::small().bytes();
    let refused = gridmap::read(&whole[..58], &Options::default()).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::CutShort);
    let cause: &io::Error = refused.source().unwrap().downcast_ref().unwrap();
    assert_eq!(cause.kind(), io::ErrorKind::UnexpectedEof);
    let refused = refused_image(b"P2 2 2 255 1 2 3", &Options::default());
    assert_eq!(parts(&refused), (ErrorKind::CutShort, Some("image"), None, Some("3"), Some("4")));
    let refused = refused_array("(2, 3)", &[0.25; 5], &Options::default());
    assert_eq!((refused.kind(), refused.value()), (ErrorKind::CutShort, Some("168")));
}

#[test]
fn a_broken_format_has_its_place() {
    let text = format!("{}a: [1, 2", yaml("image", "negate: 0\n"));
    let refused = Description::read(text.as_bytes(), Semantics::Nav2).unwrap_err();
    assert!(
        matches!((refused.kind(), refused.place()), (ErrorKind::Format, Some(Place::Line(8)))),
        "{refused:?}"
    );
    assert!(refused.source().is_some());
    let refused = Description::read(&b"image: \xff"[..], Semantics::Nav2).unwrap_err();
    assert_eq!((refused.kind(), refused.place()), (ErrorKind::Format, Some(&Place::Key("image"))));
    let refused = Description::read(&b"image: a\n"[..], Semantics::Nav2).unwrap_err();
    assert_eq!((refused.kind(), refused.place()), (ErrorKind::Format, Some(&Place::Key("resolution"))));
    let refused = refused_image(&raw_png(3, 2, 8, 0, 0, &[("IDAT", zlib(&[0; 7]))]), &Options::default());
    assert_eq!(refused.kind(), ErrorKind::Format);
    assert!(refused.source().is_some());
    let refused = npy::read(&b"PK\x03\x04"[..], 4, &Options::default()).unwrap_err();
    assert_eq!((refused.kind(), refused.place()), (ErrorKind::Format, Some(&Place::Byte(0))));
}

#[test]
fn what_is_not_read_is_unsupported() {
    let refused = refused_image(b"%PDF-1.7", &Options::default());
    let allowed = Some("PGM, PNG, BMP, PPM, PBM, JPEG, TIFF, GIF, WebP and TGA");
    let place = Some(Place::Byte(0));
    assert_eq!(parts(&refused), (ErrorKind::Unsupported, Some("image"), place, Some("%PDF"), allowed));
    let bytes = GridMap { version: 8, ..GridMap::small() }.bytes();
    let refused = gridmap::read(&bytes[..], &Options::default()).unwrap_err();
    assert_eq!(parts(&refused), (ErrorKind::Unsupported, None, None, Some("8"), Some("2 to 7")));
    let mut files = Memory::new();
    files.add("map.bmp", "BM");
    let refused = read_map_from(&files, Path::new("map.bmp"), &Options::default()).unwrap_err();
    assert_eq!((refused.kind(), refused.value()), (ErrorKind::Unsupported, Some("map.bmp")));
}

#[test]
fn a_value_out_of_range_is_there_with_its_place() {
    let refused = refused_array("(2, 3)", &[0.25, 0.5, 1.0, 0.0, -0.125, 2.0], &Options::default());
    let place = Some(Place::Cell { map: None, row: 1, column: 1 });
    let allowed = Some("a probability from 0 to 1");
    assert_eq!(parts(&refused), (ErrorKind::OutOfRange, None, place, Some("-0.125"), allowed));
    let cause: &mean_information::Error = refused.source().unwrap().downcast_ref().unwrap();
    assert!(matches!(cause, mean_information::Error::Cell { row: 1, column: 1, .. }));

    let refused = refused_image(&pgm(2, 2, 300, &[300, 7, 301, 0]), &Options::default());
    assert_eq!(refused.place(), Some(&Place::Pixel { row: 1, column: 0 }));
    let options = Options { mode: Some(Mode::Probability), unknown: Some(256.0), ..Options::default() };
    let refused = refused_image(&pgm(1, 2, 255, &[3, 7]), &options);
    assert_eq!((refused.value(), refused.allowed()), (Some("256"), Some("0 to 255")));
    let text = yaml("image", "negate: 0\n").replace("0.125", "north");
    let refused = Description::read(text.as_bytes(), Semantics::Nav2).unwrap_err();
    let place = Some(Place::Key("origin"));
    assert_eq!(parts(&refused), (ErrorKind::OutOfRange, None, place, Some("north"), Some("radians, finite")));

    let mut files = Memory::new();
    files.add("w.npy", array("'<i8'", false, "(2,)", &[7_i64, 1 << 60].map(i64::to_le_bytes).concat()));
    let refused = read_weights_from(&files, Path::new("w.npy"), &Options::default()).unwrap_err();
    assert_eq!((refused.kind(), refused.place()), (ErrorKind::OutOfRange, Some(&Place::Item(1))));
    assert_eq!(refused.value(), Some("1152921504606846976"));
}

#[test]
fn a_cell_of_a_stack_has_the_number_of_its_map() {
    struct Nothing;
    impl npy::MapsVisitor for Nothing {
        type Output = ();
        fn visit<E: mean_information_files::Readable>(self, _: Vec<mean_information::map::Grid<E>>) {}
    }
    let bytes = array("'|i1'", false, "(3, 1, 2)", &[0, 100, 50, 7, 3, 101]);
    let refused = npy::read_stack(&bytes[..], bytes.len() as u64, &Options::default(), Nothing).unwrap_err();
    assert_eq!(refused.place(), Some(&Place::Cell { map: Some(2), row: 0, column: 1 }));
    assert!(refused.to_string().starts_with("particle 2: cell at row 0, column 1 is 101"), "{refused}");
}

/// A limit can be raised; what memory cannot number, none can hold.
#[test]
fn too_large_and_out_of_memory_are_two_kinds() {
    let options = Options { max_cells: Some(5), ..Options::default() };
    let refused = refused_array("(2, 3)", &[0.25; 6], &options);
    assert_eq!(parts(&refused), (ErrorKind::TooLarge, None, None, Some("6"), Some("the limit of 5")));
    assert_eq!(refused.to_string(), "claims 3 x 2 = 6 cells, more than the limit of 5");
    let options = Options { max_cells: Some(u64::MAX), ..Options::default() };
    let refused = refused_image(b"P5 4294967295 4294967295 255\n", &options);
    assert_eq!(refused.kind(), ErrorKind::OutOfMemory);
    let lacking = Vec::<u64>::new().try_reserve(usize::MAX).unwrap_err();
    let refused = Error::from(lacking);
    assert_eq!(refused.kind(), ErrorKind::OutOfMemory);
    assert!(refused.source().unwrap().is::<std::collections::TryReserveError>());
}

#[test]
fn options_that_contradict_one_another_are_refused() {
    let options = Options { unknown: Some(127.0), mode: Some(Mode::Scale), ..Options::default() };
    let refused = refused_image(&pgm(1, 2, 255, &[3, 7]), &options);
    assert_eq!((refused.kind(), refused.file()), (ErrorKind::Options, Some(Path::new("map.yaml"))));
    assert_eq!(refused.place(), Some(&Place::Option("unknown")));
}

/// A file keeps its name when the error passes through who read another one.
#[test]
fn the_first_file_that_is_named_stays() {
    let refused = refused_image(b"", &Options::default()).in_file(Path::new("other"));
    assert_eq!(
        refused.to_string(),
        "image: the file is empty; allowed are PGM, PNG, BMP, PPM, PBM, JPEG, TIFF, GIF, WebP and TGA images (the \
         image that map.yaml names)"
    );
    assert!(refused.message().starts_with("the file is empty; allowed are PGM"));
    let named = Error::from(io::Error::from(io::ErrorKind::UnexpectedEof)).in_file(Path::new("two\nlines"));
    assert!(named.to_string().starts_with("two\\nlines: the file ends"), "{named}");
}
