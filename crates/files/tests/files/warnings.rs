//! Greys that may not mean what they are read as, and the words for them.

use crate::rules::{Rule, read_with, rules};
use crate::support::warnings;
use mean_information_files::{Mode, Options, Semantics, Warning};
use mean_information_test_support::formats::{Folder, pgm};

#[test]
fn warnings_count_cells_not_levels() {
    let folder = Folder::new();
    let mut samples = vec![205; 17];
    samples.extend([0, 100, 101, 254, 255]);
    folder.write("image.pgm", pgm(11, 2, 255, &samples));
    let free = Rule { free: 0.25, occupied: 0.65, negate: false };
    for semantics in [Semantics::Nav2, Semantics::Ros1] {
        for (mode, expected) in [
            (
                Mode::Trinary,
                "17 cells of grey 205, which map savers write for unknown, read as free under free_thresh 0.25; \
                 a free_thresh of 0.196 keeps that grey unknown",
            ),
            (
                Mode::Scale,
                "17 cells of grey 205, which map savers write for unknown, read as free; mode scale has no grey for \
                 unknown",
            ),
            (Mode::Raw, "19 cells outside 0 to 100 and other than unknown (-1 or 255), read as unknown"),
        ] {
            let options = Options { semantics, mode: Some(mode), ..Options::default() };
            let map = read_with(&folder, "image.pgm", free, &options);
            assert_eq!(warnings(&map)[0], expected, "{mode:?} {semantics:?}");
            let figures = match mode {
                Mode::Raw => Warning::OutOfRangeReadAsUnknown { count: 19 },
                mode => Warning::SavedUnknownReadAs {
                    grey: 205,
                    percent: 0,
                    count: 17,
                    mode,
                    free_thresh: (mode == Mode::Trinary).then_some(0.25),
                },
            };
            assert_eq!(map.warnings, [figures]);
        }
        let options = Options { semantics, ..Options::default() };
        let map = read_with(&folder, "image.pgm", rules()[0], &options);
        assert_eq!(map.warnings, []);
    }
}

/// The warnings of a PGM of 20 cells: some of grey 205, one black, the others white.
fn warnings_of_205(count: usize, rule: Rule, options: &Options) -> Vec<String> {
    let folder = Folder::new();
    let mut samples = vec![205; count];
    samples.push(0);
    samples.resize(20, 255);
    folder.write("image.pgm", pgm(5, 4, 255, &samples));
    warnings(&read_with(&folder, "image.pgm", rule, options))
}

/// The savers' unknown is spoken of where it reads as free (or occupied, if trinary), and in mode scale where it is over a
/// fifth of the cells, but not where it reads as unknown.
#[test]
fn grey_205_is_spoken_of_where_it_is_not_read_as_unknown() {
    let rule = |free, occupied, negate| Rule { free, occupied, negate };
    for (semantics, percent) in [(Semantics::Nav2, 12), (Semantics::Ros1, 12)] {
        let of = |mode| Options { semantics, mode: Some(mode), ..Options::default() };
        let (trinary, scale) = (of(Mode::Trinary), of(Mode::Scale));
        // Between the thresholds: unknown in trinary mode, a percentage in mode scale.
        let between = rule(0.1, 0.9, false);
        assert_eq!(warnings_of_205(17, between, &trinary), [""; 0]);
        assert_eq!(warnings_of_205(4, between, &scale), [""; 0]);
        let warnings = warnings_of_205(5, between, &scale);
        assert!(warnings.len() == 1 && warnings[0].starts_with("5 cells of grey 205"), "{warnings:?}");
        assert!(warnings[0].contains(&format!("read as {percent} percent; mode scale")), "{warnings:?}");
        // Grey 205 is 19.6 percent, and 50 percent here, which means unknown.
        let middle = rule(0.0, 100.0 / 255.0, false);
        assert_eq!(warnings_of_205(17, middle, &scale), [""; 0]);
        // White is occupied, and so is 205.
        let warnings = warnings_of_205(1, rule(0.1, 0.65, true), &trinary);
        let expected = "1 cell of grey 205, which map savers write for unknown, read as occupied";
        assert_eq!(warnings, [expected]);
        let warnings = warnings_of_205(1, rule(0.25, 0.65, false), &trinary);
        assert!(warnings.len() == 1 && warnings[0].starts_with("1 cell of grey 205"), "{warnings:?}");
        assert_eq!(warnings_of_205(0, rule(0.25, 0.65, false), &trinary), [""; 0]);
    }
}

#[test]
fn greys_that_often_mean_unknown_are_spoken_of_in_probability_mode() {
    let folder = Folder::new();
    let warnings_of = |max: u16, grey: u16, count: usize, unknown: Option<u16>| {
        let mut samples = vec![grey; count];
        // Others, of which no two are one grey of a state.
        samples.extend([0, max / 9, max - max / 9].into_iter().cycle().take(20 - count));
        folder.write("image.pgm", pgm(5, 4, max, &samples));
        let options =
            Options { mode: Some(Mode::Probability), unknown: unknown.map(f64::from), ..Options::default() };
        read_with(&folder, "image.pgm", rules()[0], &options).warnings
    };
    for grey in [127, 128, 205] {
        let warning = |grey, count| Warning::OftenUnknownObserved { grey, count };
        assert_eq!(warnings_of(255, grey, 5, None), [warning(grey, 5)]);
        assert_eq!(warnings_of(255, grey, 4, None), []);
        assert_eq!(warnings_of(255, grey, 15, Some(grey)), []);
        assert_eq!(warnings_of(65535, 257 * grey, 5, None), [warning(257 * grey, 5)]);
        assert_eq!(warnings_of(65535, 257 * grey + 1, 15, None), []);
        assert_eq!(warning(grey, 5).to_string(), format!("5 cells of grey {grey} counted as observed"));
    }
    assert_eq!(warnings_of(255, 126, 15, None), []);
    assert_eq!(warnings_of(100, 50, 15, None), []);
}

/// The grey that the command's option takes is of the image's own depth.
#[test]
fn the_saved_unknown_of_a_deep_image_has_its_own_grey() {
    let folder = Folder::new();
    folder.write("image.pgm", pgm(2, 1, 65535, &[205 * 257, 65535]));
    let options = Options { mode: Some(Mode::Scale), ..Options::default() };
    let rule = Rule { free: 0.25, occupied: 0.65, negate: false };
    let map = read_with(&folder, "image.pgm", rule, &options);
    let Warning::SavedUnknownReadAs { grey, percent, count, free_thresh, .. } = map.warnings[0] else {
        panic!("{:?}", map.warnings);
    };
    assert_eq!((grey, percent, count, free_thresh), (205 * 257, 0, 1, None));
}
