//! The files that people really have: each rule with bytes made on the spot, with a case that it holds for and one that it
//! does not hold for.

use crate::support::{measure, read_twice, refusal_of, warnings};
use mean_information_files::{Mode, Options, Semantics, Warning};
use mean_information_test_support::formats::{Folder, pgm, raw_png, yaml, zlib};
use std::path::PathBuf;

/// Free, occupied, unknown.
type Counts = (u64, u64, u64);

/// A map of a white, a black and a saved unknown cell.
fn saved() -> Vec<u8> {
    pgm(3, 1, 255, &[254, 0, 205])
}

/// Reads a yaml file beside an image.
fn read(text: impl AsRef<[u8]>, image: &[u8], options: &Options) -> (Counts, Vec<Warning>) {
    let folder = Folder::new();
    folder.write("map.pgm", image);
    let map = read_twice(&folder.write("map.yaml", text), options).unwrap();
    let measured = measure(&map);
    ((measured.free, measured.occupied, measured.unknown), map.warnings)
}

fn of(semantics: Semantics) -> Options {
    Options { semantics, ..Options::default() }
}

const ALL: [Semantics; 3] = [Semantics::Nav2, Semantics::Nav2Humble, Semantics::Ros1];

#[test]
fn a_plain_map_has_no_warning() {
    for semantics in ALL {
        let (counts, warnings) = read(yaml("map.pgm", "negate: 0\n"), &saved(), &of(semantics));
        assert_eq!((counts, warnings), ((1, 1, 1), Vec::new()));
    }
}

#[test]
fn thresholds_that_cross_are_read_and_who_wins_is_said() {
    let text = yaml("map.pgm", "negate: 0\n").replace("0.196", "0.9").replace("0.65", "0.1");
    // Black is above both thresholds, white below both, and grey 205 (0.196) between them.
    for (semantics, counts) in
        [(Semantics::Nav2, (2, 1, 0)), (Semantics::Nav2Humble, (1, 2, 0)), (Semantics::Ros1, (1, 2, 0))]
    {
        let (found, warnings) = read(&text, &saved(), &of(semantics));
        assert_eq!(found, counts, "{semantics:?}");
        let free_wins = semantics == Semantics::Nav2;
        let crossing = Warning::ThresholdsCross { free: 0.9, occupied: 0.1, free_wins };
        assert!(warnings.contains(&crossing), "{warnings:?}");
        assert!(crossing.to_string().ends_with(if free_wins { "read as free" } else { "read as occupied" }));
    }
    let equal = yaml("map.pgm", "negate: 0\n").replace("0.196", "0.65");
    let (_, warnings) = read(equal, &saved(), &of(Semantics::Nav2));
    assert!(matches!(warnings[0], Warning::ThresholdsCross { free_wins: true, .. }), "{warnings:?}");
}

#[test]
fn thresholds_above_1_may_be_percentages() {
    let text = yaml("map.pgm", "negate: 0\n").replace("0.196", "19.6").replace("0.65", "65");
    for semantics in ALL {
        let (counts, warnings) = read(&text, &saved(), &of(semantics));
        assert_eq!(
            (counts, &warnings[0]),
            ((3, 0, 0), &Warning::ThresholdsAbove1 { free: 19.6, occupied: 65.0 })
        );
        assert!(warnings[0].to_string().contains("thresholds above 1"));
        assert!(warnings[0].to_string().ends_with("if they are percentages, write 0.65 for 65"));
    }
}

#[test]
fn thresholds_are_not_asked_for_where_none_is_used() {
    let text = "image: map.pgm\nresolution: 0.05\norigin: [0, 0, 0]\nnegate: 0\n";
    for mode in [Mode::Raw, Mode::Probability] {
        let (_, found) =
            read(text, &pgm(2, 1, 255, &[0, 100]), &Options { mode: Some(mode), ..Options::default() });
        assert_eq!(found, []);
    }
    let (counts, _) = read(format!("{text}mode: raw\n"), &pgm(2, 1, 255, &[0, 100]), &Options::default());
    assert_eq!(counts, (1, 1, 0));
    let folder = Folder::new();
    folder.write("map.pgm", saved());
    let map = folder.write("map.yaml", text);
    for mode in [None, Some(Mode::Scale)] {
        let refused = refusal_of(&map, &Options { mode, ..Options::default() });
        assert!(refused.contains("map.yaml: the key occupied_thresh is missing"), "{refused}");
    }
}

#[test]
fn a_missing_image_is_told_with_the_yaml_file_the_key_and_the_path() {
    let folder = Folder::new();
    folder.write("map.pgm", saved());
    let refusal = |image: &str| {
        let quoted = format!("'{image}'");
        refusal_of(&folder.write("map.yaml", yaml(&quoted, "negate: 0\n")), &Options::default())
    };
    for (image, words) in [
        (
            "/home/robot/maps/map.pgm",
            "there is no file /home/robot/maps/map.pgm; map.pgm lies beside the yaml file",
        ),
        ("maps/map.pgm", "map.pgm lies beside the yaml file: write `image: map.pgm`"),
        ("~/maps/map.pgm", "; ~ is not replaced by a home folder"),
        ("$(find nav)/map.pgm", "; $(...) is replaced only in launch files"),
        ("$HOME/map.pgm", "; variables are not replaced"),
        (
            "C:\\maps\\map.pgm",
            "; it begins with a drive letter of Windows; map.pgm lies beside the yaml file",
        ),
        ("maps\\map.pgm", "; it has backslashes, which separate folders only on Windows"),
        ("package://nav/map.pgm", "; it is a URL, which no loader opens"),
        ("/maps/hall.pgm", "no hall.pgm lies beside the yaml file either"),
        ("hall.pgm", "write the path of the image from the folder of the yaml file"),
    ] {
        let refused = refusal(image);
        assert!(refused.contains("map.yaml: image is ") && refused.contains(words), "{refused}");
    }
    assert!(!refusal("hall.pgm").contains('~'));
}

#[test]
fn a_yaml_file_is_read_as_yaml_cpp_reads_it() {
    let good = yaml("map.pgm", "negate: 0\n");
    let latin_1 = [good.as_bytes(), b"# caf\xe9\nmode: trinary # \xff\n"].concat();
    let utf_16: Vec<u8> =
        [0xfeff].into_iter().chain(good.encode_utf16()).flat_map(u16::to_le_bytes).collect();
    for (text, expected) in [
        (
            format!("{good}free_thresh: 0.25\nimage: other.pgm\n").into_bytes(),
            "the key occurs twice: free_thresh",
        ),
        (format!("{good}---\n{good}").into_bytes(), "goes on after its first document"),
        (format!("{good}...\n---\n[a, b").into_bytes(), "goes on after its first document"),
        (good.replace("negate: 0", "negate:\t0 \t# tab").into_bytes(), "line 6 of the yaml file has a tab"),
        (good.replace("image: ", "image:\t").into_bytes(), "line 1 of the yaml file has a tab"),
        (good.replace("[-3.5, 2.25,", "[\t-3.5,\t2.25 ,").into_bytes(), "line 3 of the yaml file has a tab"),
        (good.replace(": ", ":\t").into_bytes(), "has a tab, which is read as a space, as in 5 more lines"),
        (latin_1, "comments of the yaml file are not UTF-8"),
        ([b"author: \"J\xfcrgen # x\"\n", good.as_bytes()].concat(), "or values not read here"),
    ] {
        let (counts, warnings) = read(&text, &saved(), &Options::default());
        assert_eq!(counts, (1, 1, 1));
        assert!(warnings[0].to_string().contains(expected), "{warnings:?}: {expected}");
    }
    for text in
        [utf_16, [b"\xef\xbb\xbf", good.as_bytes()].concat(), format!("%YAML 1.2\n---\n{good}...\n").into()]
    {
        assert_eq!(read(&text, &saved(), &Options::default()), ((1, 1, 1), Vec::new()));
    }
    // In quotes and in comments a tab stays.
    let (_, warnings) = read(format!("{good}other: '\t'\n# a\tb\n"), &saved(), &Options::default());
    assert_eq!(warnings, []);
}

/// A value that is read must be text, and none is repeated at length.
#[test]
fn values_that_are_refused_are_shown_in_short() {
    let good = yaml("map.pgm", "negate: 0\n");
    let folder = Folder::new();
    folder.write("map.pgm", saved());
    let latin_1 = [b"image: k\xfcche.pgm\n", good.as_bytes()].concat();
    let with = |resolution: &str| good.replace("0.05", resolution).into_bytes();
    for (text, words) in [
        (latin_1, "which is not UTF-8 text; save the file as UTF-8"),
        (
            with(&"9".repeat(400)),
            "resolution is \"99999999999999999999999999999999\"..., allowed is a positive number",
        ),
        (with("-1e-300"), "resolution is -1e-300, allowed is a positive number of metres"),
        (
            good.replace("resolution: ", "resolution:\u{a0}").into_bytes(),
            "a no-break space follows a colon; write a plain one",
        ),
    ] {
        let refused = refusal_of(&folder.write("map.yaml", text), &Options::default());
        let (_, line) = refused.split_once("map.yaml: ").unwrap();
        assert!(line.contains(words) && line.len() < 160, "{line}: {words}");
    }
    let huge = good.replace("0.196", "1e300").replace("0.65", "2e300");
    let (_, warnings) = read(huge, &saved(), &Options::default());
    assert!(warnings.iter().all(|warning| warning.to_string().len() < 160), "{warnings:?}");
    assert!(!warnings[0].to_string().contains("percentages"), "{warnings:?}");
}

/// An image with alpha, of a transparent, a half transparent and an opaque pixel of each of black, 205 and white.
fn with_alpha(alphas: [u8; 3]) -> Vec<u8> {
    let rows = alphas.map(|alpha| [&[0][..], &[0, alpha, 205, alpha, 254, alpha]].concat()).concat();
    raw_png(3, 3, 8, 4, 0, &[("IDAT", zlib(&rows))])
}

#[test]
fn cells_that_are_not_opaque_are_counted() {
    let mixed = with_alpha([0, 120, 255]);
    let text = yaml("map.pgm", "negate: 0\n");
    // Grey 205 is unknown anyway.
    let (counts, warnings) = read(&text, &mixed, &of(Semantics::Nav2));
    assert_eq!((counts, &warnings[..]), ((1, 1, 7), &[Warning::TransparentReadAsUnknown { count: 4 }][..]));
    assert!(warnings[0].to_string().contains("4 cells are not opaque (transparent), read as unknown"));
    for semantics in [Semantics::Nav2Humble, Semantics::Ros1] {
        let (_, warnings) = read(&text, &mixed, &of(semantics));
        assert_eq!(warnings, [Warning::AlphaAveraged { count: 6 }]);
        assert!(warnings[0].to_string().contains("transparent"));
    }
    for semantics in ALL {
        assert_eq!(read(&text, &with_alpha([255; 3]), &of(semantics)).1, []);
    }
    let probability = Options { mode: Some(Mode::Probability), unknown: Some(205.0), ..Options::default() };
    let warnings = [Warning::TwoGreys { levels: 2 }, Warning::TransparentReadAsUnknown { count: 4 }];
    assert_eq!(read(&text, &mixed, &probability).1, warnings);
    // nav2's saver writes unknown cells so in mode scale.
    let scale = Options { mode: Some(Mode::Scale), ..Options::default() };
    let (counts, warnings) = read(&text, &mixed, &scale);
    assert_eq!(counts, (2, 1, 6));
    assert!(
        matches!(warnings[..], [Warning::SavedUnknownReadAs { grey: 205, count: 1, .. }]),
        "{warnings:?}"
    );
}

/// 205 with an opaque alpha averages to 217.5, which is free.
#[test]
fn humble_averages_alpha_and_compares_strictly() {
    let text = yaml("map.pgm", "negate: 0\n");
    let opaque = with_alpha([255; 3]);
    assert_eq!(read(&text, &opaque, &of(Semantics::Nav2)).0, (3, 3, 3));
    assert_eq!(read(&text, &opaque, &of(Semantics::Nav2Humble)).0, (6, 3, 0));
    assert_eq!(read(&text, &opaque, &of(Semantics::Ros1)).0, (6, 3, 0));
    // Grey 51 is occupancy 0.8, and 204 is 0.2: equal to the thresholds in single precision and as ROS 1 computes it,
    // and 1 - 204/255 is below 0.2 in double precision.
    let text = text.replace("0.65", "0.8").replace("0.196", "0.2");
    let image = pgm(2, 1, 255, &[51, 204]);
    assert_eq!(read(&text, &image, &of(Semantics::Nav2)).0, (1, 1, 0));
    assert_eq!(read(&text, &image, &of(Semantics::Nav2Humble)).0, (1, 0, 1));
    assert_eq!(read(&text, &image, &of(Semantics::Ros1)).0, (0, 0, 2));
}

#[test]
fn many_greys_under_a_mode_of_three_states_are_said() {
    let text = yaml("map.pgm", "negate: 0\n");
    let graded: Vec<u16> = (0..100).map(|k| if k < 60 { 128 } else { 5 * (k - 55) + 1 }).collect();
    let (_, warnings) = read(&text, &pgm(10, 10, 255, &graded), &Options::default());
    let [Warning::GreysThresholded { unknown: Some(128), .. }] = warnings[..] else { panic!("{warnings:?}") };
    assert!(warnings[0].to_string().contains("grey levels"));
    // Where grades are kept, and for a few stray pixels, there is nothing to say.
    let of = |mode| Options { mode: Some(mode), unknown: None, ..Options::default() };
    let kept = text.replace("0.196", "0.0").replace("0.65", "1.0");
    assert_eq!(read(&kept, &pgm(10, 10, 255, &graded), &of(Mode::Scale)).1, []);
    // Occupancies of 0.65 and more are greys of 89 and less, of 0.196 and less 206 and more: 13 and 4 of them.
    let (_, warnings) = read(&text, &pgm(10, 10, 255, &graded), &of(Mode::Scale));
    let (free_thresh, occupied_thresh) = (0.196, 0.65);
    assert_eq!(warnings, [Warning::GradesClipped { levels: 17, count: 17, free_thresh, occupied_thresh }]);
    let words = "17 cells of 17 grey levels made certain by free_thresh 0.196 and occupied_thresh 0.65; thresholds of 0.0 and \
                 1.0 keep their grades";
    assert_eq!(warnings[0].to_string(), words);
    let stray: Vec<u16> =
        (0..100).map(|k| if k < 3 { 100 + k } else { [0, 205, 254][k as usize % 3] }).collect();
    assert_eq!(read(&text, &pgm(10, 10, 255, &stray), &Options::default()).1, []);
}

/// What thresholds left of a map does not become evidence by reading its greys as probabilities.
#[test]
fn two_greys_are_no_probabilities() {
    let text = yaml("map.pgm", "negate: 0\n");
    let options = |unknown| Options { mode: Some(Mode::Probability), unknown, ..Options::default() };
    let warnings =
        |greys: &[u16], unknown| read(&text, &pgm(greys.len(), 1, 255, greys), &options(unknown)).1;
    for (greys, levels) in [(&[0, 205, 254, 254][..], 2), (&[205, 254][..], 1), (&[0, 205, 0][..], 1)] {
        assert_eq!(warnings(greys, Some(205.0)), [Warning::TwoGreys { levels }]);
    }
    // A third grey, on either side; and nothing observed.
    for greys in [&[0, 3, 205, 254][..], &[0, 205, 250, 254], &[205, 205]] {
        assert_eq!(warnings(greys, Some(205.0)), []);
    }
    let words = "the image has 1 grey level beside unknown: it was thresholded before it was saved";
    assert_eq!(Warning::TwoGreys { levels: 1 }.to_string(), words);
}

#[test]
fn what_follows_an_image_is_passed_over_and_said() {
    let text = yaml("map.pgm", "negate: 0\n");
    let rows = [0, 254, 0, 205];
    let png = raw_png(3, 1, 8, 0, 0, &[("IDAT", zlib(&rows))]);
    let ppm = b"P6 3 1 255\n\xfe\xfe\xfe\0\0\0\xcd\xcd\xcd".to_vec();
    let plain = b"P2 3 1 255 254 0 205".to_vec();
    for (image, more) in [(saved(), b"P5"), (png, b"\0\0"), (ppm, b"P6"), (plain, b" 7")] {
        assert_eq!(read(&text, &image, &Options::default()), ((1, 1, 1), Vec::new()));
        let long = [&image[..], more].concat();
        assert_eq!(read(&text, &long, &Options::default()), ((1, 1, 1), vec![Warning::BytesAfterImage]));
    }
    assert_eq!(read(&text, &[&saved()[..], b"\n"].concat(), &Options::default()).1, []);
}

/// The loaders take LF for the first pixel.
#[test]
fn a_header_with_two_line_ends_moves_the_pixels() {
    let text = yaml("map.pgm", "negate: 0\n");
    let (counts, warnings) = read(&text, b"P5\r\n3 1\r\n255\r\n\xfe\xfe\xcd", &Options::default());
    assert_eq!((counts, &warnings[..]), ((2, 1, 0), &[Warning::PgmLineEnd][..]));
    assert!(warnings[0].to_string().contains("line ends"));
    // One that only begins with such a pixel.
    assert_eq!(read(&text, b"P5 3 1 255\r\n\xfe\xcd", &Options::default()), ((1, 1, 1), Vec::new()));
}

#[test]
fn what_is_no_image_is_named_with_a_way_out() {
    let folder = Folder::new();
    let map = folder.write("map.yaml", yaml("map.pgm", "negate: 0\n"));
    for (bytes, words) in [
        (&b"version https://git-lfs.github.com/spec/v1\noid sha256:4d\n"[..], "Git LFS pointer"),
        (b"%PDF-1.7", "is PDF, not an image"),
        (b"<!DOCTYPE html><html>", "is a web page"),
        (b"<svg xmlns='x'>", "is SVG or other XML"),
        (b"PK\x03\x04", "is a zip archive"),
        (b"\0\0\0\x1cftypavif", "is AVIF"),
        (b"nonsense", "it begins with \"nons\"; allowed are PGM, PNG, BMP"),
        (b"GIF89a", "malformed image"),
        (b"BM", "cut short"),
    ] {
        folder.write("map.pgm", bytes);
        let refused = refusal_of(&map, &Options::default());
        assert!(refused.contains("map.pgm: ") && refused.contains(words), "{refused}: {words}");
    }
    folder.write("map.pgm", "nonsense");
    assert!(refusal_of(&map, &Options::default()).contains("magick FILE map.png"));
    // A pointer in the place of any other file.
    for name in ["map.yaml", "map.npy", "map.gridmap", "map.npz"] {
        let file: PathBuf = folder.write(name, "version https://git-lfs.github.com/spec/v1\n");
        assert!(refusal_of(&file, &Options::default()).contains("git lfs pull"), "{name}");
    }
}

/// A warning is a sentence, without the words of a command line.
#[test]
fn no_warning_speaks_of_options() {
    let text = yaml("map.pgm", "negate: 0\n").replace("0.196", "0.9");
    let folder = Folder::new();
    folder.write("map.pgm", with_alpha([0, 120, 255]));
    let map = read_twice(&folder.write("map.yaml", text), &Options::default()).unwrap();
    assert!(warnings(&map).len() >= 2 && warnings(&map).iter().all(|words| !words.contains("--")));
}
