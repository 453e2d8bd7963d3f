//! The committed seeds of the fuzz targets, replayed on their properties.

use crate::bag_seeds;
use crate::support::Random;
use crate::tree_seeds;
use image::{DynamicImage, GrayImage, ImageFormat};
use mean_information_test_support::formats::{GridMap, gzip, npy, pgm, raw_png, yaml, zlib};
use mean_information_test_support::properties;
use std::fs;
use std::io::{Cursor, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};
use zip::CompressionMethod;
use zip::write::{SimpleFileOptions, ZipWriter};

type Target = (&'static str, fn(&[u8]), fn() -> Vec<(&'static str, Vec<u8>)>);

const TARGETS: [Target; 21] = [
    ("yaml", properties::yaml, yaml_seeds),
    ("pgm", properties::pgm, pgm_seeds),
    ("png", properties::png, png_seeds),
    ("decoded", properties::decoded, decoded_seeds),
    ("npy", properties::npy, npy_seeds),
    ("npz", properties::npz, npz_seeds),
    ("gridmap", properties::gridmap, gridmap_seeds),
    ("bag", properties::bag, bag_seeds::bag),
    ("db3", properties::db3, bag_seeds::db3),
    ("bag_folder", properties::bag_folder, bag_seeds::bag_folder),
    ("pbstream", properties::pbstream, bag_seeds::pbstream),
    ("octree", properties::octree, tree_seeds::octree),
    ("carmen_log", properties::carmen_log, carmen_log_seeds),
    ("filter_log", properties::filter_log, tree_seeds::filter_log),
    ("trajectory", properties::trajectory, trajectory_seeds),
    ("grid", properties::grid, grid_seeds),
    ("room", properties::room, room_seeds),
    ("integrate", properties::integrate, integrate_seeds),
    ("stack", properties::stack, stack_seeds),
    ("scan", properties::scan, scan_seeds),
    ("expected", properties::expected, expected_seeds),
];

fn folder(target: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../fuzz/seeds").join(target)
}

#[test]
fn every_seed_keeps_the_properties() {
    for (target, property, seeds) in TARGETS {
        let files: Vec<_> = fs::read_dir(folder(target)).unwrap().map(|file| file.unwrap().path()).collect();
        assert!(files.len() >= seeds().len(), "seeds of {target} are missing: run write_the_seeds");
        for file in files {
            println!("{}", file.display());
            property(&fs::read(file).unwrap());
        }
    }
}

/// `cargo test -p mean-information-files --test files -- --ignored write_the_seeds` makes the seeds again.
#[test]
#[ignore = "writes fuzz/seeds"]
fn write_the_seeds() {
    for (target, _, seeds) in TARGETS {
        fs::create_dir_all(folder(target)).unwrap();
        for (name, bytes) in seeds() {
            fs::write(folder(target).join(name), bytes).unwrap();
        }
    }
}

/// Changes some bytes of each seed of a file format, again and again, where no fuzzer is at hand: `cargo test -p
/// mean-information-files --test files -- --ignored --nocapture mutated`.
#[test]
#[ignore = "takes more than two minutes"]
fn mutated_seeds_keep_the_properties() {
    let mut random = Random::new(77);
    for (target, property, seeds) in &TARGETS[..15] {
        let (started, mut runs) = (Instant::now(), 0);
        while started.elapsed() < Duration::from_secs(8) {
            for (_, mut bytes) in seeds() {
                for _ in 0..=random.below(4) {
                    let at = random.below(bytes.len().max(1) as u32) as usize;
                    match random.below(4) {
                        0 => bytes.truncate(at),
                        1 => bytes.insert(at, random.below(256) as u8),
                        _ if bytes.is_empty() => {}
                        2 => bytes[at] = random.below(256) as u8,
                        _ => bytes[at] ^= 1 << random.below(8),
                    }
                }
                property(&bytes);
                runs += 1;
            }
        }
        println!("{target}: {runs} runs");
    }
}

fn yaml_seeds() -> Vec<(&'static str, Vec<u8>)> {
    [
        ("plain", yaml("map.pgm", "negate: 0\n")),
        ("everything", yaml("\"map.png\"", "negate: true # white\nmode: Scale\nmap_type: {a: [1, {b: c}]}\n? [x, y]\n: |\n  z\n")),
        ("flow", "{image: m, resolution: 5e-2, origin: [-3.5, 2, .5], negate: 0, occupied_thresh: 1, free_thresh: 0}".to_owned()),
        ("bomb", yaml("map.pgm", "negate: 0\na: &a [x, x]\nb: &b [*a, *a]\nc: [*b, *b]\n")),
        ("tabs", yaml("map.pgm", "negate:\t0\t# tab\nmode: trinary\nnegate: 1\n")),
        ("crossing", yaml("~/map.pgm", "negate: 0\n").replace("0.196", "65")),
        ("documents", format!("%YAML 1.2\n---\n{}...\n---\n- 7\n", yaml("map.pgm", "negate: 0\n"))),
    ]
    .map(|(name, text)| (name, text.into_bytes()))
    .to_vec()
}

fn pgm_seeds() -> Vec<(&'static str, Vec<u8>)> {
    vec![
        ("raw", pgm(3, 2, 255, &[0, 205, 254, 255, 100, 127])),
        ("raw_of_100", pgm(3, 2, 100, &[0, 20, 25, 100, 99, 50])),
        ("raw_of_16_bits", pgm(3, 2, 65535, &[0, 205, 65535, 32768, 100, 127])),
        ("plain", b"P2 # a comment\n3 2\n255\n0 205 254 # grey\n255 100 127\n".to_vec()),
        ("claims_more", b"P5 200 300 255\n0123456789".to_vec()),
    ]
}

fn png_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let idat = |data: &[u8]| ("IDAT", zlib(data));
    vec![
        ("grey", raw_png(3, 2, 8, 0, 0, &[idat(&[0, 0, 205, 254, 1, 255, 100, 127])])),
        (
            "grey_of_2_bits",
            raw_png(3, 2, 2, 0, 0, &[("tRNS", vec![0, 2]), idat(&[0, 0b0001_1000, 0, 0b1110_0100])]),
        ),
        ("grey_of_16_bits", raw_png(1, 2, 16, 0, 0, &[idat(&[0, 205, 205, 2, 1, 7])])),
        ("grey_alpha", raw_png(2, 1, 8, 4, 0, &[idat(&[0, 205, 255, 7, 254])])),
        (
            "rgb",
            raw_png(2, 1, 8, 2, 0, &[("tRNS", vec![0, 1, 0, 2, 0, 3]), idat(&[0, 1, 2, 3, 200, 100, 50])]),
        ),
        ("rgba", raw_png(2, 1, 8, 6, 0, &[idat(&[4, 1, 2, 3, 255, 200, 100, 50, 0])])),
        (
            "palette",
            raw_png(
                3,
                1,
                1,
                3,
                0,
                &[("PLTE", vec![9, 8, 7, 200, 200, 200]), ("tRNS", vec![0]), idat(&[0, 0b0100_0000])],
            ),
        ),
        ("palette_missing", raw_png(2, 1, 2, 3, 0, &[idat(&[0, 0b0110_0000])])),
        (
            "palette_of_19_bytes",
            raw_png(3, 1, 1, 3, 0, &[("PLTE", vec![7; 19]), ("tRNS", vec![0]), idat(&[0, 0b0100_0000])]),
        ),
        ("interlaced", raw_png(2, 2, 8, 0, 1, &[idat(&[0, 1, 0, 2, 0, 3, 4])])),
        ("claims_more", raw_png(1 << 31, 1 << 31, 8, 0, 0, &[idat(&[0, 1, 2])])),
    ]
}

fn decoded_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let encoded = |image: &DynamicImage, format| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    };
    let grey = GrayImage::from_raw(3, 2, vec![0, 205, 254, 255, 100, 127]).unwrap();
    let grey = DynamicImage::from(grey);
    let colour = DynamicImage::from(grey.to_rgb8());
    let clear = DynamicImage::from(grey.to_rgba8());
    vec![
        ("bmp_grey", encoded(&grey, ImageFormat::Bmp)),
        ("bmp_rgb", encoded(&colour, ImageFormat::Bmp)),
        ("gif", encoded(&clear, ImageFormat::Gif)),
        ("jpeg", encoded(&grey, ImageFormat::Jpeg)),
        ("pam", encoded(&colour, ImageFormat::Pnm)),
        ("ppm_raw", b"P6 2 1 255\nabcdef".to_vec()),
        ("ppm_plain", b"P3 # c\n2 1 100\n100 100 100 0 0 0\n".to_vec()),
        ("pbm", b"P1 3 2\n0 1 0 1 1 0\n".to_vec()),
        ("pbm_raw", b"P4 3 2\n\x40\xc0".to_vec()),
        ("tga", encoded(&grey, ImageFormat::Tga)),
        ("tiff_grey", encoded(&grey, ImageFormat::Tiff)),
        (
            "tiff_16_bits",
            encoded(&DynamicImage::from(grey.to_luma_alpha16()).to_rgb16().into(), ImageFormat::Tiff),
        ),
        ("webp", encoded(&clear, ImageFormat::WebP)),
    ]
}

fn npz_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let doubles: Vec<u8> = [0.25, 0.5, 1.0, 0.0].into_iter().flat_map(f64::to_le_bytes).collect();
    let archive = |names: &[&str], method| {
        let mut archive = ZipWriter::new(Cursor::new(Vec::new()));
        for name in names {
            archive.start_file(*name, SimpleFileOptions::default().compression_method(method)).unwrap();
            archive.write_all(&npy("'<f8'", false, "(2, 2)", &doubles)).unwrap();
        }
        archive.finish().unwrap().into_inner()
    };
    vec![
        ("stored", archive(&["a.npy"], CompressionMethod::Stored)),
        ("deflated", archive(&["a.npy"], CompressionMethod::Deflated)),
        ("two", archive(&["a.npy", "b.npy"], CompressionMethod::Deflated)),
        ("none", archive(&[], CompressionMethod::Stored)),
    ]
}

fn npy_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let doubles: Vec<u8> = [0.25, 0.5, 1.0, 0.0].into_iter().flat_map(f64::to_le_bytes).collect();
    let floats: Vec<u8> = [0.25_f32, 0.5, f32::NAN, 1.5].into_iter().flat_map(f32::to_be_bytes).collect();
    vec![
        ("doubles", npy("'<f8'", false, "(2, 2)", &doubles)),
        ("floats_by_columns", npy("'>f4'", true, "(1, 4)", &floats)),
        ("bytes", npy("'|i1'", false, "(2L, 3L)", &[0, 100, 255, 50, 7, 128])),
        ("records", npy("[('p', '<f8')]", false, "(2, 2)", &doubles)),
        ("three_dimensions", npy("'<f8'", false, "(2, 1, 2)", &doubles)),
        ("wide_integers", npy("'>i2'", true, "(1, 3)", &[0, 7, 1, 44, 255, 255])),
        ("truths", npy("'|b1'", false, "(1, 3)", &[0, 1, 2])),
        ("claims_more", npy("'<f8'", false, "(18446744073709551615, 2)", &doubles)),
    ]
}

fn gridmap_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let small = GridMap::small().bytes();
    let mut old = small.clone();
    old[32] = 2;
    vec![
        ("plain", small.clone()),
        ("version_2", old),
        ("zipped", gzip(&small)),
        ("cut", small[..57].to_vec()),
    ]
}

fn carmen_log_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let front = format!("FLASER 180{} 1 2 0.5 1.5 2 0.25 976052890.25 host 0.5\n", " 2.5".repeat(180));
    let robot =
        "ROBOTLASER1 0 -0.5 1 0.5 20 0.01 0 3 2.25 nan -inf 2 7 8 3.25 2 0 3 2 0 0 0 0 0 0 7.5 host 0.75\n";
    let parameters = "PARAM laser_front_laser_resolution 45\nPARAM robot_front_laser_max 40\n\
                      PARAM robot_frontlaser_offset 0.25\nODOM 1 2 0.5 0 0 0 2.25 host 0.5\n\
                      FLASER 3 2.5 81.83 0 1 2 0.5 1.5 2 0.25 2.5 host 0.75\nHELLO\nFLASER 3 2.5";
    [
        ("front_laser", front),
        ("robot_laser", [robot, &robot.replace("7.5 host", "8.5 host")].concat()),
        ("parameters", parameters.to_owned()),
        ("claims_more", robot.replace("0 3 2.25", "0 18446744073709551615 2.25")),
        ("no_beam", "FLASER 0 1 2 0.5 1.5 2 0.25 2.5 host 0.75\n".to_owned()),
    ]
    .map(|(name, text)| (name, text.into_bytes()))
    .to_vec()
}

fn trajectory_seeds() -> Vec<(&'static str, Vec<u8>)> {
    [
        ("plain", "# time x y z qx qy qz qw\n1.5 2 3 0 0 0 0.6 0.8\n2.5 2 4 0 0 0 -0.6 0.8\n"),
        ("tilted", "1.5\t2 3 0.5 0.6 0 0 0.8\r\n\r\n2.5 2 3 0 0 0 1 0"),
        ("unsorted", "1.5 2 3 0 0 0 0 1\n1.25 2 3 0 0 0 0 1\n"),
        ("far", "-1.7e308 1.7e308 -1.7e308 0 0 0 0 1\n1.7e308 -1.7e308 5e-324 0 0 0 1 -0\n"),
        ("cut", "1.5 2 3 0 0 0 0 1\n2.5 2 3 0 0"),
        ("subnormal", "1.5 5e-324 3 0 0 0 0 1\n2.5 5e-324 3 0 0 0 0 1\n"),
    ]
    .map(|(name, text)| (name, text.as_bytes().to_vec()))
    .to_vec()
}

/// Log-odds such as -5.05e-15, at which two logarithms gave an entropy above 1.
#[rustfmt::skip]
const NEAR_UNKNOWN: [u8; 34] = [
    5, 3, 2, 1, 0, 3, 188, 251, 3, 188, 188, 246, 188, 251, 3, 188, 188, 246, 0, 0, 4, 3, 253, 2, 2, 0, 0, 0, 4, 3, 253, 2, 2, 0,
];

/// Log-odds whose information lies so close to a midpoint that only the comparison in many bits decides.
const NEAR_TIES: [f64; 2] = [-7.640966620509248e-142, 3.2817701744914864e-132];

fn grid_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let doubles = |cells: &[f64]| cells.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let floats = |cells: &[f32]| cells.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    let of = |encoding: u8, cells: &[u8]| [&[encoding, 3, 2, 2, 4], cells].concat();
    let p = [0.25, 0.5, 1.0, 1e-300, 0.5000000000000001, 0.9999999999999999];
    let l = [f64::INFINITY, f64::NEG_INFINITY, 0.0, -37.5, 1e-200, 2.0];
    vec![
        ("percent", of(0, &[0, 100, 255, 50, 7, 93])),
        ("mrpt", of(1, &[128, 129, 255, 0, 1, 127])),
        ("probability_f32", of(2, &floats(&p.map(|p| p as f32)))),
        ("probability_f64", of(3, &doubles(&p))),
        ("log_odds_f32", of(4, &floats(&l.map(|l| l as f32)))),
        ("log_odds_f64", of(5, &doubles(&l))),
        ("log_odds_near_unknown", NEAR_UNKNOWN.to_vec()),
        ("log_odds_near_ties", of(5, &doubles(&[NEAR_TIES, NEAR_TIES, NEAR_TIES].concat()))),
        ("bad", of(3, &doubles(&[0.25, f64::NAN, 2.0]))),
    ]
}

fn room_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let of = |mode: u8, per_side: u8, numbers: [f64; 5]| {
        let numbers = numbers.into_iter().flat_map(|x| match mode & 1 {
            0 => x.to_le_bytes().to_vec(),
            _ => (x as f32).to_le_bytes().to_vec(),
        });
        [mode, per_side].into_iter().chain(numbers).collect()
    };
    vec![
        ("paper", of(0, 0, [2.0, 0.2, 0.16, 0.5, 0.5])),
        ("paper_f32", of(1, 0, [2.0, 0.2, 0.16, 0.0, 0.0])),
        ("averaged", of(0, 4, [2.0, 0.2, 0.64, 0.3, -7.75])),
        ("beyond_the_largest_float", of(0, 0, [1.7e308, 1e305, 1.1e307, 0.5, 0.25])),
        ("far_and_sharp", of(0, 0, [1000.0, 0.001, 40.0, 1e-300, 0.25])),
        ("near_and_blurred", of(1, 2, [0.001, 1000.0, 80.0, -0.5, 0.5])),
        ("countable", of(2, 0, [0.7, 0.3, 0.9, 0.125, 1e9])),
        ("countable_f32", of(3, 0, [3e-39, 0.3, 0.9, 0.125, 7.0])),
        ("too_fine", of(0, 0, [2.0, 0.2, 1e-300, 0.5, 0.5])),
        ("bad", of(0, 3, [2.0, -0.2, f64::NAN, f64::INFINITY, 0.5])),
    ]
}

fn integrate_seeds() -> Vec<(&'static str, Vec<u8>)> {
    // Format and rule, kind of integrand, points, limit; the tolerances, the points, what the integrand is made of.
    let of = |head: [u8; 4], floats: &[f64]| {
        let tail: Vec<u8> = if head[0].is_multiple_of(2) {
            floats.iter().flat_map(|&x| (x as f32).to_le_bytes()).collect()
        } else {
            floats.iter().flat_map(|x| x.to_le_bytes()).collect()
        };
        [&head[..], &tail].concat()
    };
    let points = [-1.5, 0.25, 3.0];
    vec![
        (
            "polynomial_f32",
            of([0, 0, 3, 40], &[&[0.0, 1e-4][..], &points, &[2.0, -3.0, 0.5, 7.0, -0.25]].concat()),
        ),
        (
            "polynomial_f64",
            of([3, 0, 3, 40], &[&[1e-9, 1e-10][..], &points, &[2.0, -3.0, 0.5, 7.0]].concat()),
        ),
        ("peak", of([5, 1, 3, 255], &[&[0.0, 1e-8][..], &points, &[0.25, 1e-7]].concat())),
        ("jump", of([1, 2, 2, 255], &[0.0, 1e-6, -1.5, 3.0, 0.7, 5.0])),
        ("infinite", of([7, 3, 2, 99], &[0.0, 1e-6, -1.5, 3.0, 0.7, 5.0])),
        ("power", of([1, 4, 3, 255], &[0.0, 1e-6, -1.5, 0.0, 3.0])),
        ("huge", of([9, 0, 2, 200], &[0.0, 1e-6, -1e308, 1e308, 0.25])),
        ("vanishing", of([11, 1, 2, 200], &[1e-300, 1e-6, 1.0, 1.0000000000000002, 0.25, 3.0])),
        ("out_of_order", of([3, 0, 3, 200], &[0.0, 0.5, 3.0, f64::NAN, -1.5, 0.25])),
        ("no_tolerance", of([3, 0, 2, 200], &[-1.0, 1e-30, 3.0, 4.0])),
    ]
}

fn stack_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let doubles: Vec<u8> = [0.25, 0.5, 1.0, 0.0, 0.75, 0.5].into_iter().flat_map(f64::to_le_bytes).collect();
    vec![
        ("doubles", npy("'<f8'", false, "(3, 1, 2)", &doubles)),
        ("by_columns", npy("'>f8'", true, "(1, 3, 2)", &doubles)),
        ("bytes", npy("'|i1'", true, "(3, 2, 2)", &[0, 100, 255, 50, 7, 128, 93, 1, 2, 3, 4, 5])),
        ("weights", npy("'<f8'", false, "(6,)", &doubles)),
        ("no_cells", npy("'<f8'", false, "(18446744073709551615, 0, 2)", &[])),
        ("claims_more", npy("'<f8'", false, "(4294967296, 4294967296, 2)", &doubles)),
    ]
}

/// Multiples of 1/64 as the target reads them.
fn in_64ths(numbers: &[f64]) -> Vec<u8> {
    numbers.iter().flat_map(|x| ((x * 64.0) as i16).to_le_bytes()).collect()
}

fn scan_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let two_scans: [f64; 18] =
        [0.25, 0.125, 0.5, 0.5, 0.0, 8.0, 0.0, 2.0, 1.5, 0.0, 0.75, 0.5, 0.25, 8.0, 0.5, 1.0, -0.5, 3.0];
    let any: Vec<u8> = two_scans.iter().flat_map(|x| x.to_le_bytes()).collect();
    let corners = [0.25, 0.5, 0.25, 0.25, 0.0, 8.0, 0.0, 2.0];
    let far: Vec<u8> =
        [0.05, 0.1, 1e300, 1.0, 1.0, 9e5, 0.7, 8e5].iter().flat_map(|x: &f64| x.to_le_bytes()).collect();
    vec![
        ("two_scans", [&[0, 2], &in_64ths(&two_scans)[..]].concat()),
        ("two_scans_of_steps", [&[2, 2], &in_64ths(&two_scans)[..]].concat()),
        ("any_bits", [&[1, 2], &any[..]].concat()),
        ("along_a_line", [&[2, 1], &in_64ths(&corners)[..]].concat()),
        ("far", [&[1, 1], &far[..]].concat()),
    ]
}

fn expected_seeds() -> Vec<(&'static str, Vec<u8>)> {
    let maps = |write: fn(&[f64]) -> Vec<u8>| {
        let one = |weight, offset, cells: &[f64]| [write(&[weight]), vec![offset], write(cells)].concat();
        [one(0.5, 0, &[0.25, 0.5, 0.75]), one(1.5, 254, &[0.5, 0.5, 0.125]), one(0.0, 1, &[0.0, 0.5, 0.5])]
            .concat()
    };
    let any = |numbers: &[f64]| numbers.iter().flat_map(|x| x.to_le_bytes()).collect::<Vec<u8>>();
    vec![
        ("aligned", [&[2, 0], &maps(in_64ths)[..]].concat()),
        ("any_bits", [&[2, 1], &maps(any)[..]].concat()),
        ("bad_weight", [&[0, 1], &any(&[f64::NAN])[..], &[0], &any(&[0.25])[..]].concat()),
    ]
}
