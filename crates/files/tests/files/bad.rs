//! ROS maps and file names that must be refused, with the file, what is wrong and what is allowed.

use crate::support::{Nobody, read_twice, refusal, refusal_of};
use mean_information_files::scans::ScanOptions;
use mean_information_files::{
    ErrorKind, Mode, Options, Semantics, read_map, read_map_contents, read_scans, read_trajectory,
};
use mean_information_test_support::formats::{Folder, pgm, raw_png, yaml, zlib};
use std::fs;

fn refused_image(name: &str, image: &[u8]) -> String {
    let folder = Folder::new();
    folder.write(name, image);
    let map = folder.write("map.yaml", yaml(name, "negate: 0\n"));
    let refused = refusal_of(&map, &Options::default());
    assert!(refused.contains(name), "the image is named: {refused}");
    let named = format!("(the image that {} names)", map.display());
    assert!(refused.ends_with(&named), "and what names it: {refused}");
    refused
}

#[test]
fn names_that_are_no_map() {
    let options = Options::default();
    let folder = Folder::new();
    for name in ["map.yaml", "map.npy", "map.gridmap"] {
        assert!(refusal_of(&folder.path(name), &options).contains("cannot be read"), "{name}");
        fs::create_dir(folder.path(name)).unwrap();
        let refused = refusal_of(&folder.path(name), &options);
        let words = "is a folder that holds no bag, no .mcap, .db3 or .bag file; allowed are files, and folders of bags";
        assert!(refused.contains(words), "{refused}");
    }
    // What another command takes is named for what it is.
    for (name, words) in [
        ("run.log", "run.log: is a log of scans by its name, and a map is wanted here"),
        ("run.gfs", "run.gfs: is the log of a particle filter by its name, and a map is wanted here"),
        ("run.TUM", "run.TUM: is a trajectory by its name, and a map is wanted here"),
    ] {
        let path = folder.write(name, "text");
        assert!(refusal_of(&path, &options).ends_with(words));
        assert_eq!(read_map(&path, &options).unwrap_err().kind(), ErrorKind::OtherKind);
    }
    for (name, words) in [
        ("a.yaml", "a.yaml: is a map by its name, and a log of scans is wanted here"),
        ("a.npz:key", "a.npz:key: is a map by its name, and a log of scans is wanted here"),
        ("a.PGM", "a.PGM: is the image of a map by its name, and a log of scans is wanted here"),
        ("a.tum", "a.tum: is a trajectory by its name, and a log of scans is wanted here"),
    ] {
        let refused = read_scans(&folder.write(name, "text"), &ScanOptions::default()).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::OtherKind);
        assert!(refused.to_string().ends_with(words), "{refused}");
    }
    // Any name may be that of a trajectory, if it holds one.
    let refused = read_trajectory(&folder.write("b.yaml", "image: b.pgm\n")).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::OtherKind);
    assert!(refused.to_string().ends_with("b.yaml: is a map by its name, and a trajectory is wanted here"));
    read_trajectory(&folder.write("c.yaml", "1.5 2 3 0 0 0 0 1\n")).unwrap();
    assert!(refusal("map.txt", "text", &options).contains("allowed are .yaml, .yml, .npy, .npz, .gridmap"));
    assert!(refusal("map", "text", &options).contains("allowed are .yaml"));
    assert!(refusal("map.pgm", "P5 1 1 255 x", &options).contains("give the yaml file"));
    assert!(refusal("map\nof\ttwo lines.txt", "text", &options).contains("map\\nof\\ttwo lines.txt"));
    #[cfg(unix)]
    assert!(refusal_of("/dev/zero".as_ref(), &options).contains("not a regular file"));
}

#[test]
fn descriptions_that_are_no_description() {
    let good = yaml("image.pgm", "negate: 0\n");
    let without =
        |key: &str| good.split_inclusive('\n').filter(|line| !line.starts_with(key)).collect::<String>();
    let with = |key: &str, value: &str| format!("{}{key}: {value}\n", without(key));
    let mut cases = vec![
        (String::new(), "the key image is missing"),
        ("# nothing\n".into(), "the key image is missing"),
        ("just text".into(), "no map description"),
        ("- image: image.pgm".into(), "no map description"),
        (format!("{good}a: [1, 2"), "malformed YAML in line"),
        (format!("{good}\t- x"), "malformed YAML in line"),
        (format!("{good}other: &a [1]\n"), "anchor or alias"),
        (format!("{good}other: *a\n"), "malformed YAML in line 7"),
        (with("image", "''"), "image is empty"),
        (with("image", "\"a\\0b\""), "allowed is a path without the character NUL"),
        (with("image", "[image.pgm]"), "image is a list"),
        (with("image", "{a: b}"), "image is a mapping"),
        (with("negate", "maybe"), "negate is \"maybe\", allowed are 0, 1, true and false"),
        (format!("{good}mode: probability\n"), "mode is \"probability\", allowed are trinary, scale and raw"),
        (format!("{good}mode: \n"), "mode is"),
        (with("origin", "0"), "origin is one value"),
        (with("origin", "[0, 0]"), "origin has 2 items, allowed is a list of three numbers"),
        (with("origin", "[0, 0, 0, 0]"), "origin has 4 items"),
        (with("origin", "[0, [0], 0]"), "origin is a mapping or nested"),
        (with("origin", "[0, .inf, 0]"), "y of the origin is \".inf\""),
        (with("origin", "[0, 0, north]"), "yaw of the origin is \"north\""),
        (with("origin", "[0, 0, -nan]"), "radians, finite; write 0.0 for a map that is not turned"),
        (with("origin", "[.nan, 0, 0]"), "metres, finite; write 0.0 where the place does not matter"),
        (with("resolution", "0,05"), "write a point, not a comma"),
        ("x".repeat(65_537), "above 65536 bytes"),
        (format!("{good}deep: {}", "[".repeat(60_000)), "malformed YAML"),
        (format!("{good}deep: {}", "{a: ".repeat(15_000)), "malformed YAML"),
        (format!("{good}{}", "- ".repeat(30_000)), "malformed YAML"),
    ];
    let missing: Vec<String> = ["image", "resolution", "origin", "negate", "occupied_thresh", "free_thresh"]
        .map(|key| format!("the key {key} is missing"))
        .to_vec();
    for words in &missing {
        let key = words.split(' ').nth(2).unwrap();
        cases.push((without(key), words));
    }
    for value in ["0", "-0.05", ".nan", "nan", ".inf", "-.INF", "inf", "1e999", "five", "", "0x10", "[1]"] {
        cases.push((with("resolution", value), "resolution is"));
        if !["0", "-0.05"].contains(&value) {
            cases.push((with("free_thresh", value), "free_thresh is"));
            cases.push((with("occupied_thresh", value), "occupied_thresh is"));
        }
    }
    for (text, words) in cases {
        let refused = refusal("map.yaml", &text, &Options::default());
        assert!(refused.contains(words), "{text}\n{refused}\n{words}");
    }
    assert!(
        refusal("map.yaml", [good.as_bytes(), &[0xff, 0xfe]].concat(), &Options::default()).contains("UTF-8")
    );
    let ros1 = Options { semantics: Semantics::Ros1, ..Options::default() };
    assert!(refusal("map.yaml", with("negate", "true"), &ros1).contains("allowed are 0 and 1"));
}

/// The billion laughs: ten aliases of ten aliases, and so on.
#[test]
fn a_yaml_bomb_is_refused() {
    let mut bomb = vec!["a0: &a0 [lol, lol]".to_owned()];
    for k in 1..10 {
        let items = vec![format!("*a{}", k - 1); 10].join(", ");
        bomb.push(format!("a{k}: &a{k} [{items}]"));
    }
    let refused = refusal("map.yaml", yaml("image.pgm", &bomb.join("\n")), &Options::default());
    assert!(refused.contains("anchor or alias"), "{refused}");
}

#[test]
fn images_that_do_not_hold_what_they_claim() {
    let four = [1, 2, 3, 4];
    let good = pgm(2, 2, 255, &four);
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (Vec::new(), "the file is empty"),
        (good[..good.len() - 1].to_vec(), "cut short"),
        (b"P2 2 2 255 1 2 3".to_vec(), "holds 3 pixels, its header claims 4"),
        (b"P2 2 2 255 1 2 x 4".to_vec(), "a number is malformed"),
        (b"P2 2 2 100 1 2 101 4".to_vec(), "image row 1, column 0 is above the maximum value 100"),
        (b"P2 2 2 100 1 2 99999999999 4".to_vec(), "a number is malformed"),
        (pgm(2, 2, 3, &four), "image row 1, column 1 is above the maximum value 3"),
        (pgm(2, 2, 300, &[300, 301, 0, 0]), "image row 0, column 1 is above the maximum value 300"),
        (b"P5 0 2 255\n".to_vec(), "the width in the header is 0"),
        (b"P5 2 0 255\n".to_vec(), "the height in the header is 0"),
        (b"P5 2 2 0\n1234".to_vec(), "the maximum value in the header is 0"),
        (b"P5 2 2 65536\n1234".to_vec(), "the maximum value in the header is 65536, allowed is 1 to 65535"),
        (b"P5 2".to_vec(), "the header ends before the height"),
        (b"P5 -2 2 255\n1234".to_vec(), "a number is malformed"),
        (b"P5 200000000 1 255\n1234".to_vec(), "cut short"),
        (b"P5 1 200000000 65535\n1234".to_vec(), "cut short"),
    ];
    for (image, words) in cases {
        let refused = refused_image("image.pgm", &image);
        assert!(refused.contains(words), "{refused}: {words}");
    }
}

#[test]
fn pngs_that_do_not_hold_what_they_claim() {
    let idat = |data: &[u8]| ("IDAT", zlib(data));
    let rows = [0, 1, 2, 3, 0, 4, 5, 6];
    let good = raw_png(3, 2, 8, 0, 0, &[idat(&rows)]);
    let cases: Vec<(Vec<u8>, &str)> = vec![
        (good[..8].to_vec(), "cut short"),
        (good[..30].to_vec(), "cut short"),
        (good[..good.len() - 20].to_vec(), "cut short"),
        (good[..good.len() - 4].to_vec(), "cut short"),
        (raw_png(3, 2, 8, 0, 0, &[]), "malformed PNG"),
        (raw_png(3, 2, 8, 0, 0, &[idat(&rows[..7])]), "malformed PNG"),
        (raw_png(3, 2, 8, 0, 0, &[idat(&rows[..4])]), "malformed PNG"),
        (raw_png(3, 2, 8, 0, 0, &[("IDAT", vec![1, 2, 3])]), "malformed PNG"),
        (raw_png(3, 2, 8, 3, 0, &[idat(&rows)]), "malformed PNG"),
        (raw_png(3, 2, 5, 0, 0, &[idat(&rows)]), "malformed PNG"),
        (raw_png(0, 2, 8, 0, 0, &[idat(&rows)]), "malformed PNG"),
        (raw_png(1 << 27, 1, 8, 0, 0, &[idat(&rows)]), "more than the 16 MiB allowed"),
        (raw_png(1, 1 << 27, 8, 0, 0, &[idat(&rows)]), "malformed PNG"),
        (raw_png(1 << 14, 1 << 14, 8, 0, 1, &[idat(&rows)]), "save it without interlacing"),
    ];
    for (image, words) in cases {
        let refused = refused_image("image.png", &image);
        assert!(refused.contains(words), "{refused}: {words}");
    }
    let mut flipped = good;
    flipped[50] ^= 1;
    assert!(refused_image("image.png", &flipped).contains("malformed PNG"));
}

#[test]
fn an_image_larger_than_its_yaml_can_mean_is_refused() {
    let folder = Folder::new();
    folder.write("image.pgm", pgm(2, 2, 255, &[1, 2, 3, 4]));
    for resolution in ["1e308", "1e160", "1e-170"] {
        let text = yaml("image.pgm", "negate: 0\n").replace("0.05", resolution);
        let refused = refusal_of(&folder.write("map.yaml", text), &Options::default());
        assert!(refused.contains("larger or smaller than a number can say"), "{refused}");
    }
}

#[test]
fn an_unknown_grey_that_the_image_cannot_hold_is_refused() {
    let folder = Folder::new();
    folder.write("image.pgm", pgm(2, 2, 100, &[1, 2, 3, 4]));
    let map = folder.write("map.yaml", yaml("image.pgm", "negate: 0\n"));
    let options = Options { mode: Some(Mode::Probability), unknown: Some(101.0), ..Options::default() };
    assert!(
        refusal_of(&map, &options)
            .contains("unknown grey level 101 is none of this image; allowed is 0 to 100")
    );
}

#[test]
fn the_limit_on_cells_can_be_raised_and_lowered() {
    let folder = Folder::new();
    folder.write("image.pgm", pgm(3, 5, 255, &[0; 15]));
    let map = folder.write("map.yaml", yaml("image.pgm", "negate: 0\n"));
    let read = |max_cells| read_twice(&map, &Options { max_cells: Some(max_cells), ..Options::default() });
    assert!(read(15).is_ok());
    assert!(read(14).unwrap_err().to_string().contains("3 x 5 = 15 cells, more than the limit of 14"));
}

/// Cells that are kept take memory, pixels that are counted none: those have other limits.
#[test]
fn counted_pixels_have_a_limit_of_their_own() {
    let idat = || ("IDAT", zlib(&[0]));
    let folder = Folder::new();
    for (name, image, kept, counted) in [
        (
            "above.pgm",
            b"P5 16385 16384 255\n1234".to_vec(),
            // No limit is a matter of what the file does not hold.
            "cut short",
            "cut short",
        ),
        ("equal.pgm", b"P5 16384 16384 255\n1234".to_vec(), "cut short", "cut short"),
        ("huge.pgm", b"P2 2147483648 2147483648 255\n1 2".to_vec(), "cut short", "holds 2 pixels"),
        (
            "endless.pgm",
            b"P5 4294967295 4294967295 255\n1".to_vec(),
            "cut short",
            "cells, more than the limit of 9223372036854775807",
        ),
        ("above.png", raw_png(16385, 16384, 8, 0, 0, &[idat()]), "limit of 268435456", "malformed PNG"),
        ("equal.png", raw_png(1 << 17, 1 << 17, 8, 0, 0, &[idat()]), "limit of 268435456", "malformed PNG"),
        (
            "huge.png",
            raw_png(1 << 17, (1 << 17) + 1, 8, 0, 0, &[idat()]),
            "limit of 268435456",
            "claims 131072 x 131073 = 17180000256 cells, more than the limit of 17179869184",
        ),
    ] {
        folder.write(name, image);
        let map = folder.write("map.yaml", yaml(name, "negate: 0\n"));
        let refused = read_map(&map, &Options::default()).unwrap_err().to_string();
        assert!(refused.contains(name) && refused.contains(kept), "{refused}: {kept}");
        let refused = read_map_contents(&map, &Options::default(), &mut Nobody).unwrap_err().to_string();
        assert!(refused.contains(name) && refused.contains(counted), "{refused}: {counted}");
    }
    // What is said holds for both.
    folder.write("above.pgm", b"P5 16385 16384 255\n1234");
    let map = folder.write("map.yaml", yaml("above.pgm", "negate: 0\n"));
    let options = Options { max_cells: Some(1 << 29), ..Options::default() };
    assert!(refusal_of(&map, &options).contains("cut short"));
    let above = fs::File::options().write(true).open(folder.path("above.pgm")).unwrap();
    above.set_len(1 << 29).unwrap();
    let options = Options { max_cells: Some(1 << 28), ..Options::default() };
    assert!(refusal_of(&map, &options).contains("limit of 268435456"));
}
