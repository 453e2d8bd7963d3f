//! Every kind of image, written here, against the loaders' rules restated pixel by pixel from the stored samples.

use crate::png_kinds::{Kind, SIZE};
use crate::rules::{Rule, read_with, rules};
use crate::support::{Random, percents, probabilities, read_twice};
use approx::abs_diff_eq;
use mean_information_files::{Cells, Mode, Options, Semantics, Warning};
use mean_information_test_support::formats::{Folder, pgm, raw_png, yaml, zlib};
use std::borrow::Cow;

/// The pixels in the order of the grid's cells: the lowest image row first.
fn in_grid_order<T: Clone>(pixels: &[T], width: usize) -> Vec<T> {
    pixels.chunks(width).rev().flatten().cloned().collect()
}

#[test]
fn every_kind_of_png_under_both_loaders_and_all_modes() {
    let mut random = Random::new(5);
    let folder = Folder::new();
    let kinds = Kind::all(&mut random);
    assert_eq!(kinds.len(), 34);
    for kind in kinds {
        let pixels = kind.pixels(&mut random);
        folder.write("image.png", kind.encode(&pixels));
        let pixels = in_grid_order(&pixels, SIZE);
        for rule in rules() {
            for mode in [Mode::Trinary, Mode::Scale, Mode::Raw] {
                for semantics in [Semantics::Nav2, Semantics::Nav2Humble, Semantics::Ros1] {
                    let options = Options { semantics, mode: Some(mode), ..Options::default() };
                    let map = read_with(&folder, "image.png", rule, &options);
                    let expected: Vec<i8> = pixels
                        .iter()
                        .map(|pixel| match semantics {
                            Semantics::Nav2 => {
                                let (colour, white) = kind.by_nav2(pixel);
                                rule.nav2(mode, colour, white)
                            }
                            Semantics::Nav2Humble => {
                                let (colour, white) = kind.by_magick(pixel);
                                rule.nav2_humble(mode, colour, kind.has_alpha(), white)
                            }
                            _ => {
                                let (surface, alpha_mask) = kind.on_sdl_surface(pixel);
                                rule.ros1(mode, &surface, alpha_mask)
                            }
                        })
                        .collect();
                    let wrong = percents(&map).iter().zip(&expected).position(|(a, b)| a != b);
                    let wrong = wrong.map(|at| (pixels[at].clone(), percents(&map)[at], expected[at]));
                    assert_eq!(wrong, None, "{kind:?} {mode:?} {semantics:?} {}", rule.free);
                }
            }
            let options = Options { mode: Some(Mode::Probability), unknown: Some(1.0), ..Options::default() };
            let map = read_with(&folder, "image.png", rule, &options);
            for (pixel, &p) in pixels.iter().zip(probabilities(&map)) {
                let ([r, g, b, a], white) = kind.meant(pixel);
                let shade = f64::from(r + g + b) / f64::from(3 * white);
                let expected = if a < white || r + g + b == 3 {
                    0.5
                } else if rule.negate {
                    shade
                } else {
                    1.0 - shade
                };
                assert!(abs_diff_eq!(p, expected, epsilon = 1e-15), "{kind:?} {pixel:?} {p} {expected}");
                assert_eq!(p == 0.5, expected == 0.5, "{kind:?} {pixel:?}");
            }
        }
    }
}

#[test]
fn interlaced_images_hold_the_same_cells() {
    // The encoder does not interlace: this is a 5 x 3 image of 8-bit greys in Adam7, its passes written out by hand.
    let greys: [[u8; 5]; 3] = [[0, 10, 20, 30, 40], [50, 60, 70, 80, 90], [100, 205, 254, 255, 128]];
    let mut data = Vec::new();
    for (x0, y0, dx, dy) in
        [(0, 0, 8, 8), (4, 0, 8, 8), (0, 4, 4, 8), (2, 0, 4, 4), (0, 2, 2, 4), (1, 0, 2, 2), (0, 1, 1, 2)]
    {
        for row in greys.iter().skip(y0).step_by(dy) {
            let mut samples = row.iter().skip(x0).step_by(dx).peekable();
            if samples.peek().is_some() {
                data.push(0);
                data.extend(samples);
            }
        }
    }
    let image = raw_png(5, 3, 8, 0, 1, &[("IDAT", zlib(&data))]);
    let folder = Folder::new();
    folder.write("image.png", image);
    let options = Options { mode: Some(Mode::Probability), ..Options::default() };
    let map = read_with(&folder, "image.png", rules()[0], &options);
    let expected: Vec<f64> =
        in_grid_order(&greys.concat(), 5).iter().map(|&grey| f64::from(255 - grey) / 255.0).collect();
    assert_eq!(probabilities(&map), expected);
}

#[test]
fn pgm_of_every_depth_plain_and_raw() {
    let mut random = Random::new(7);
    let folder = Folder::new();
    for max in [1, 15, 100, 255, 256, 1000, 65535] {
        let samples: Vec<u16> = (0..11 * 13)
            .map(|k| if k < 2 { k * max } else { random.below(u32::from(max) + 1) as u16 })
            .collect();
        let plain: Vec<String> =
            samples.chunks(5).map(|row| format!("{row:?}").replace(['[', ']', ','], " ")).collect();
        let plain = format!("P2 # plain\n#\n11#w\n 13 {max}\n{} # end", plain.join("# five\n"));
        folder.write("raw.pgm", pgm(11, 13, max, &samples));
        folder.write("plain.pgm", plain);
        let ordered = in_grid_order(&samples, 11);
        for image in ["raw.pgm", "plain.pgm"] {
            let options = Options {
                mode: Some(Mode::Probability),
                unknown: Some(f64::from(max / 2)),
                ..Options::default()
            };
            let map = read_with(&folder, image, rules()[0], &options);
            for (&grey, &p) in ordered.iter().zip(probabilities(&map)) {
                let expected = if grey == max / 2 { 0.5 } else { f64::from(max - grey) / f64::from(max) };
                assert_eq!(p, expected, "{image} of {max}, {grey}");
            }
            for semantics in [Semantics::Nav2, Semantics::Nav2Humble, Semantics::Ros1] {
                let options = Options { semantics, mode: Some(Mode::Scale), ..Options::default() };
                let map = read_with(&folder, image, rules()[1], &options);
                let expected: Vec<i8> = ordered
                    .iter()
                    .map(|&grey| {
                        let level = u32::from(grey) * 255 / u32::from(max);
                        match semantics {
                            Semantics::Nav2 => rules()[1].nav2(Mode::Scale, [level, level, level, 255], 255),
                            Semantics::Nav2Humble => {
                                let grey = u32::from(grey);
                                rules()[1].nav2_humble(Mode::Scale, [grey, grey, grey, 0], false, max.into())
                            }
                            _ => rules()[1].ros1(Mode::Scale, &[level as u8], false),
                        }
                    })
                    .collect();
                assert_eq!(percents(&map), expected, "{image} of {max} {semantics:?}");
                let doubted = match semantics {
                    Semantics::Nav2 | Semantics::Nav2Humble => ![255, 65535].contains(&max),
                    _ => max > 255,
                };
                let warning = match semantics {
                    Semantics::Nav2 | Semantics::Nav2Humble => Warning::PgmMaximum { white: max },
                    _ => Warning::PgmMaximumRefused { white: max },
                };
                assert_eq!(map.warnings.contains(&warning), doubted, "{max} {semantics:?}");
            }
        }
    }
}

#[test]
fn a_palette_is_read_as_indices_by_ros1_and_this_is_said() {
    let folder = Folder::new();
    let palette = vec![200, 200, 200, 7, 8, 9];
    let data = zlib(&[0, 0b0100_0000]);
    folder.write("image.png", raw_png(3, 1, 1, 3, 0, &[("PLTE", palette), ("IDAT", data)]));
    let options = Options { semantics: Semantics::Ros1, mode: Some(Mode::Raw), ..Options::default() };
    let map = read_with(&folder, "image.png", rules()[0], &options);
    assert_eq!(percents(&map), [0, 1, 0]);
    assert_eq!(map.warnings, [Warning::PaletteIndices]);
    let map =
        read_with(&folder, "image.png", rules()[0], &Options { mode: Some(Mode::Raw), ..Options::default() });
    assert_eq!(percents(&map), [-1, 7, -1]);
}

/// nav2 subtracts the thresholds in double precision and rounds the difference to single: 37.499996 percent here, where
/// single precision throughout gives 37.5, hence 38.
#[test]
fn nav2_rounds_the_width_between_the_thresholds_once() {
    let folder = Folder::new();
    folder.write("image.pgm", pgm(1, 1, 255, &[153]));
    let options = Options { mode: Some(Mode::Scale), ..Options::default() };
    let rule = Rule { free: 0.1, occupied: 0.9, negate: false };
    let width = (0.9_f64 - 0.1) as f32;
    assert_ne!(width, 0.9_f32 - 0.1_f32, "the case tells the two apart");
    assert_eq!(percents(&read_with(&folder, "image.pgm", rule, &options)), [37]);
}

/// Decoders stop at the last row of the header.
#[test]
fn data_beyond_the_last_row_are_passed_over() {
    let folder = Folder::new();
    let rows = [0, 0, 255, 102, 0, 7, 8, 9, 0, 1];
    for (rows, interlace) in [(&rows[..4], 0), (&rows[..8], 0), (&rows, 0), (&rows[..6], 1), (&rows, 1)] {
        let width = if interlace == 1 { 1 } else { 3 };
        let beyond = ("IDAT", zlib(rows));
        folder.write("image.png", raw_png(width, 1, 8, 0, interlace, &[beyond]));
        let map = read_with(&folder, "image.png", rules()[2], &Options::default());
        folder.write("image.png", raw_png(width, 1, 8, 0, interlace, &[("IDAT", zlib(&rows[..4]))]));
        let expected = read_with(&folder, "image.png", rules()[2], &Options::default());
        assert_eq!(percents(&map), percents(&expected));
    }
}

/// Text says nothing of cells: too much of it, or broken, is passed over.
#[test]
fn text_in_a_png_is_passed_over() {
    let folder = Folder::new();
    let idat = || ("IDAT", zlib(&[0, 0, 255, 102]));
    let plain = raw_png(3, 1, 8, 0, 0, &[idat()]);
    folder.write("image.png", &plain);
    let expected = percents(&read_with(&folder, "image.png", rules()[2], &Options::default())).to_vec();
    let long = [b"Comment\0".as_slice(), &vec![b'x'; 17 << 20]].concat();
    for (name, data) in [
        ("tEXt", long.clone()),
        ("iTXt", [b"Comment\0\0\0\0\0".as_slice(), &long[8..]].concat()),
        ("zTXt", [b"Comment\0\0".as_slice(), &[7; 20]].concat()),
    ] {
        folder.write("image.png", raw_png(3, 1, 8, 0, 0, &[(name, data), idat()]));
        let map = read_with(&folder, "image.png", rules()[2], &Options::default());
        assert_eq!(percents(&map), expected, "{name}");
    }
}

#[test]
fn yaml_spellings() {
    let folder = Folder::new();
    folder.write("image.pgm", pgm(3, 2, 255, &[0, 255, 205, 10, 20, 30]));
    let read = |text: String| read_twice(&folder.write("map.yml", text), &Options::default());
    let plain = read(yaml("image.pgm", "negate: 0\n")).unwrap();
    assert_eq!(plain.resolution, Some(0.05));
    assert_eq!(percents(&plain), [100, 100, 100, 100, 0, -1]);
    let geometry = match &plain.cells {
        Cells::Percent(grid) => *grid.geometry(),
        other => panic!("{other:?}"),
    };
    assert_eq!((geometry.origin(), geometry.yaw()), ([-3.5, 2.25], 0.125));

    let absolute = folder.path("image.pgm").display().to_string();
    for (image, more) in [
        (Cow::from("\"image.pgm\""), "negate: false\n"),
        ("./image.pgm".into(), "negate: No\nmode: Trinary\n"),
        (
            absolute.into(),
            "negate: off # not\nmode: 'TRINARY'\nmap_type: {a: [1, {b: c}], 2: 3}\n? [x, y]\n: z\n",
        ),
        ("\timage.pgm".into(), "negate: \t0\nmode:\t'trinary'\t# tab\n"),
        ("image.pgm".into(), "negate: !!int 0\nunknown_key:\n  - 1\n  - deep: [2]\n"),
    ] {
        let text = yaml(&image, more);
        let map = read(text.clone()).unwrap_or_else(|problem| panic!("{text}{problem}"));
        assert_eq!(percents(&map), percents(&plain), "{text}");
    }
    let negated = read(yaml("image.pgm", "negate: Yes")).unwrap();
    assert_eq!(percents(&negated), [0, 0, 0, 0, 100, 100]);
    let scaled = read(yaml("image.pgm", "negate: 0\nmode: Scale")).unwrap();
    assert_eq!(percents(&scaled), [100, 100, 100, 100, 0, 0]);
    let flow = "{image: image.pgm, resolution: 5e-2, origin: [-3.5, +2.25, 125.0e-3], negate: 0, occupied_thresh: .65, free_thresh: 0.196}";
    assert_eq!(percents(&read(flow.to_owned()).unwrap()), percents(&plain));
}
