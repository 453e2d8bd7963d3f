//! Cartographer's saved states: a real one by the figures of an independent decoder, and such as must be refused.

use mean_information::Tally;
use mean_information::map::Encoding;
use mean_information::map::encoding::Probability;
use mean_information_files::pbstream::{Submap, read};
use mean_information_files::{Error, ErrorKind, Options, Place, read_submaps};
use mean_information_test_support::formats::pbstream::{
    first_record, grid, integer, message, state, stream, submap, submap_of,
};
use mean_information_test_support::formats::shared_data;

/// Width, height, known cells, cells above 1/2, mean information.
const RACE: [(usize, usize, u64, u64, f64); 9] = [
    (637, 251, 77576, 3488, 0.325903),
    (611, 248, 72480, 3051, 0.361848),
    (634, 257, 79639, 3081, 0.337895),
    (508, 244, 71653, 3408, 0.437468),
    (415, 243, 47596, 2746, 0.379584),
    (723, 252, 81215, 3370, 0.309269),
    (765, 251, 79463, 3531, 0.314174),
    (800, 800, 64168, 2424, 0.388944),
    (1600, 1600, 55284, 2125, 0.269382),
];

fn tally(submap: &Submap) -> Tally<f32> {
    let mut tally = Tally::new();
    for &(p, count) in &submap.counts.values {
        tally.add_many(Probability::<f32>::cell(p).unwrap(), count);
    }
    tally
}

#[test]
fn a_real_state_has_the_figures_of_another_decoder() {
    let Some(data) = shared_data() else { return };
    let submaps =
        read_submaps(&data.join("cartographer/JFR_racingv5.pbstream"), &Options::default()).unwrap();
    assert_eq!(submaps.len(), RACE.len());
    let mut all = Tally::new();
    for (number, (submap, (width, height, known, occupied, information))) in
        submaps.iter().zip(RACE).enumerate()
    {
        let tally = tally(submap);
        assert_eq!((submap.counts.width, submap.counts.height), (width, height));
        assert_eq!((tally.observed(), tally.occupied()), (known, occupied), "{number}");
        assert_eq!(tally.cells(), (width * height) as u64);
        let found = f64::from(tally.mean_information());
        assert!((found - information).abs() < 1e-5, "{number}: {found}");
        assert_eq!((submap.trajectory, submap.index, submap.is_finished), (0, number as u64, number < 7));
        assert_eq!(submap.clamp, [1.0 - 0.9_f32, 0.9]);
        all.merge(&tally);
    }
    assert_eq!((all.observed(), all.occupied()), (629_074, 27_224));
    let found = f64::from(all.mean_information());
    assert!((found - 0.346166).abs() < 1e-5, "{found}");
}

fn submaps(bytes: &[u8]) -> Result<Vec<Submap>, Error> {
    read(bytes, bytes.len() as u64, &Options { max_cells: Some(1000), ..Options::default() })
}

fn refused(bytes: &[u8], kind: ErrorKind) -> String {
    let error = submaps(bytes).unwrap_err();
    assert_eq!(error.kind(), kind, "{error}");
    error.to_string()
}

#[test]
fn values_become_probabilities_in_single_precision() {
    let costs = [&[0x35][..], &0.25_f32.to_le_bytes(), &[0x3d], &0.75_f32.to_le_bytes()].concat();
    let cells = [0, 1, 32767, 32768 + 1, 32768, 20000];
    let found = submaps(&state(&[submap(&grid(&cells, &costs))])).unwrap();
    let [submap] = &*found else { panic!("{found:?}") };
    assert_eq!((submap.trajectory, submap.index, submap.is_finished), (2, 5, true));
    assert_eq!((submap.resolution, submap.clamp), (0.25, [0.25, 0.75]));
    let mut values = submap.counts.values.clone();
    values.sort_by(|a, b| a.0.total_cmp(&b.0));
    // 1 - (0.25 + 19999 * 0.5 / 32766) = 0.4448208
    let [(least, 1), (middle, 1), (0.5, 2), (greatest, 2)] = *values else { panic!("{values:?}") };
    for (found, exact) in [(least, 0.25), (middle, 0.444_820_8), (greatest, 0.75)] {
        assert!((f64::from(found) - exact).abs() < 1e-6, "{found} {exact}");
    }
}

#[test]
fn states_that_are_none() {
    assert!(refused(b"P5 3 2 255\n", ErrorKind::Format).contains("no saved state of Cartographer"));
    let whole = state(&[submap(&grid(&[7; 6], b""))]);
    let error = submaps(&whole[..whole.len() - 9]).unwrap_err();
    let first = first_record();
    assert_eq!((error.kind(), error.place()), (ErrorKind::CutShort, Some(&Place::Byte(first))));
    assert!(error.to_string().starts_with(&format!("record at byte {first}: claims ")), "{error}");
    for (cells, kind, words) in [
        (&[7; 5][..], ErrorKind::Format, "submap 2, 5: has 5 cells, allowed are 3 x 2"),
        (&[7, 7, 65536, 7, 7, 7], ErrorKind::OutOfRange, "cell 2 is 65536, allowed is 0 to 65535"),
        (&[u64::MAX; 6], ErrorKind::OutOfRange, "cell 0 is -1, allowed is 0 to 65535"),
    ] {
        let line = refused(&state(&[submap(&grid(cells, b""))]), kind);
        assert_eq!(line, format!("record at byte {first}: {words}"));
    }
    let tsdf = message(5, &[]);
    let line = refused(&state(&[submap(&grid(&[7; 6], &tsdf))]), ErrorKind::Unsupported);
    assert!(line.contains("signed distances (TSDF)"), "{line}");
    let space = message(3, &[&message(3, &[b""])]);
    assert!(refused(&state(&[space]), ErrorKind::Unsupported).contains("three dimensions"));
    let costs = [&[0x35][..], &0.75_f32.to_le_bytes(), &[0x3d], &0.25_f32.to_le_bytes()].concat();
    let line = refused(&state(&[submap(&grid(&[7; 6], &costs))]), ErrorKind::OutOfRange);
    assert!(
        line.contains("the range of costs is 0.75 to 0.25, allowed is an interval within 0 to 1"),
        "{line}"
    );
    let line = refused(&state(&[message(3, &[&[0x0a, 0x7f]])]), ErrorKind::Format);
    assert!(line.contains("has a field of 127 bytes, but its message has at most 0"), "{line}");
    assert!(refused(&state(&[vec![0x0b]]), ErrorKind::Format).contains("wire type 3"));
    let many = message(3, &[&integer(1, 1 << 40), &integer(2, 1 << 40)]);
    let large = message(4, &[&message(1, &[&[0x09], &0.25_f64.to_le_bytes(), &many])]);
    assert!(refused(&state(&[submap(&large)]), ErrorKind::TooLarge).contains("more than the limit of 1000"));
}

#[test]
fn a_submap_is_counted_once() {
    let grid = grid(&[7; 6], b"");
    let with = |other| state(&[submap_of([2, 5], &grid), submap_of(other, &grid)]);
    for other in [[2, 6], [3, 5], [5, 2]] {
        assert_eq!(submaps(&with(other)).unwrap().len(), 2);
    }
    let line = refused(&with([2, 5]), ErrorKind::Format);
    assert!(line.ends_with(": submap 2, 5: stands here again, allowed is once in a state"), "{line}");
}

#[test]
fn the_header_says_which_format() {
    let record = submap(&grid(&[7; 6], b""));
    for version in [1, 2] {
        assert_eq!(submaps(&stream(&[integer(1, version), record.clone()])).unwrap().len(), 1);
    }
    let line = refused(&stream(&[integer(1, 3), record.clone()]), ErrorKind::Unsupported);
    assert_eq!(line, "record at byte 8: is of format version 3, allowed are 1 and 2");
    // Before Cartographer 1.0 a state begins with its pose graph.
    for old in [record.clone(), message(4, &[&integer(3, 0)]), vec![]] {
        let line = refused(&stream(&[old, record.clone()]), ErrorKind::Unsupported);
        assert!(line.starts_with("record at byte 8: has no header, as states from before"), "{line}");
        assert!(line.contains("`cartographer_pbstream migrate OLD NEW`"), "{line}");
    }
}
