//! What the loaders' libraries make of images otherwise than meant: alpha in BMP, the order of bytes, palettes, 16 bits; as
//! GraphicsMagick 1.3.40 and SDL_image 1.2.12 were seen to.

use crate::support::{percents, read_twice};
use image::{ImageFormat, Rgb, RgbImage};
use mean_information_files::{Map, Mode, Options, Semantics, Warning};
use mean_information_test_support::formats::{Folder, raw_png, yaml, zlib};
use std::io::Cursor;

fn read(name: &str, bytes: &[u8], semantics: Semantics, mode: Mode) -> Map {
    let folder = Folder::new();
    folder.write(name, bytes);
    let options = Options { semantics, mode: Some(mode), ..Options::default() };
    read_twice(&folder.write("map.yaml", yaml(name, "negate: 0\n")), &options).unwrap()
}

/// A BMP of one row of so many bits a pixel; `masks` follow the header of 40 bytes where there are any.
fn bmp(bits: u8, masks: &[u32], row: &[u8]) -> Vec<u8> {
    let start = 54 + 4 * masks.len() as u32;
    let width = row.len() as u32 * 8 / u32::from(bits);
    let mut bytes = b"BM\0\0\0\0\0\0\0\0".to_vec();
    bytes.extend([start, 40, width, 1].map(u32::to_le_bytes).concat());
    bytes.extend([1, 0, bits, 0, if masks.is_empty() { 0 } else { 3 }, 0, 0, 0]);
    bytes.extend([0; 20]);
    bytes.extend(masks.iter().flat_map(|mask| mask.to_le_bytes()));
    bytes.extend(row);
    bytes.extend(vec![0; row.len().next_multiple_of(4) - row.len()]);
    bytes
}

const ALL: [Semantics; 3] = [Semantics::Nav2, Semantics::Nav2Humble, Semantics::Ros1];

/// The fourth byte of a plain BMP of 32 bits is alpha, also where the writer left it 0: then a map is all unknown to nav2.
#[test]
fn the_fourth_byte_of_a_bmp_is_alpha() {
    let row = [254, 254, 254, 255, 254, 254, 254, 0, 0, 0, 0, 255];
    let masks = [0xff_0000, 0xff00, 0xff];
    // (3 * 254 + 0) / 4 is 190.5, (3 * 0 + 255) / 4 is 63.75.
    for (semantics, plain, masked) in [
        (Semantics::Nav2, [0, -1, 100], [0, 0, 100]),
        (Semantics::Nav2Humble, [0, -1, 100], [0, 0, 100]),
        (Semantics::Ros1, [0, -1, 100], [0, -1, 100]),
    ] {
        let map = read("map.bmp", &bmp(32, &[], &row), semantics, Mode::Trinary);
        assert_eq!(percents(&map), plain, "{semantics:?}");
        let map = read("map.bmp", &bmp(32, &masks, &row), semantics, Mode::Trinary);
        assert_eq!(percents(&map), masked, "{semantics:?}, with masks");
    }
    let unset = [254, 254, 254, 0].repeat(4);
    let map = read("map.bmp", &bmp(32, &[], &unset), Semantics::Nav2, Mode::Trinary);
    assert_eq!(
        (percents(&map), &map.warnings[..]),
        (&[-1; 4][..], &[Warning::TransparentReadAsUnknown { count: 4 }][..])
    );
}

/// In mode scale ROS 1 takes the last byte of a pixel for its alpha: red in BMP and TGA, blue in PPM.
#[test]
fn the_last_byte_to_ros_1_is_red_where_blue_comes_first() {
    let pixels = RgbImage::from_raw(2, 1, vec![0, 150, 150, 150, 150, 0]).unwrap();
    for (name, format, first_is_clear) in [
        ("map.bmp", ImageFormat::Bmp, true),
        ("map.tga", ImageFormat::Tga, true),
        ("map.ppm", ImageFormat::Pnm, false),
    ] {
        let mut bytes = Cursor::new(Vec::new());
        pixels.write_to(&mut bytes, format).unwrap();
        let map = read(name, &bytes.into_inner(), Semantics::Ros1, Mode::Scale);
        let clear = percents(&map).iter().map(|&percent| percent == -1).collect::<Vec<_>>();
        assert_eq!(clear, [first_is_clear, !first_is_clear], "{name}");
    }
}

/// As those of BMP and GIF, palettes of bitmaps and of TGA are indices to ROS 1.
#[test]
fn bitmaps_and_palettes_of_tga_are_indices_to_ros_1() {
    let mut tga = vec![2, 1, 1, 0, 0, 2, 0, 24, 0, 0, 0, 0, 3, 0, 1, 0, 8, 0x20];
    tga.extend(b"id");
    tga.extend([254, 254, 254, 0, 0, 0, 0, 1, 0]);
    for (name, image) in
        [("map.pbm", b"P1 3 1\n0 1 0\n".to_vec()), ("map.pbm", b"P4 3 1\n\x40".to_vec()), ("map.tga", tga)]
    {
        for semantics in [Semantics::Nav2, Semantics::Nav2Humble] {
            let map = read(name, &image, semantics, Mode::Trinary);
            assert_eq!((percents(&map), &map.warnings[..]), (&[0, 100, 0][..], &[][..]), "{name}");
        }
        let map = read(name, &image, Semantics::Ros1, Mode::Trinary);
        assert_eq!(
            (percents(&map), &map.warnings[..]),
            (&[100; 3][..], &[Warning::PaletteIndices][..]),
            "{name}"
        );
    }
}

/// nav2 has the grey of 16 bits, rounded down to 8: 25699 is 99.996 of 257, and its high byte is 100.
#[test]
fn sixteen_bits_are_rounded_down_by_nav2_and_cut_by_ros_1() {
    let row = [0, 25699_u16.to_be_bytes()[0], 25699_u16.to_be_bytes()[1]];
    let grey = raw_png(1, 1, 16, 0, 0, &[("IDAT", zlib(&row))]);
    for (semantics, level) in [(Semantics::Nav2, 99), (Semantics::Nav2Humble, 100), (Semantics::Ros1, 100)] {
        let map = read("map.png", &grey, semantics, Mode::Raw);
        assert_eq!((percents(&map), &map.warnings[..]), (&[level][..], &[][..]), "{semantics:?}");
    }
    // Colours are cut before, which is said.
    let colour = raw_png(1, 1, 16, 2, 0, &[("IDAT", zlib(&[&row[..1], &row[1..].repeat(3)].concat()))]);
    for semantics in ALL {
        let map = read("map.png", &colour, semantics, Mode::Raw);
        let warnings: &[Warning] = if semantics == Semantics::Nav2 { &[Warning::SixteenBits] } else { &[] };
        assert_eq!((percents(&map), &map.warnings[..]), (&[100][..], warnings), "{semantics:?}");
    }
}

/// The grey that `--unknown` would take is one of the image's own depth.
#[test]
fn the_saved_unknown_of_16_bits_is_named_in_16_bits() {
    let row = [&[0][..], &(205 * 257_u16).to_be_bytes(), &[255, 255]].concat();
    let image = raw_png(2, 1, 16, 0, 0, &[("IDAT", zlib(&row))]);
    for semantics in ALL {
        let map = read("map.png", &image, semantics, Mode::Scale);
        let found = &map.warnings[..];
        assert!(
            matches!(found, [Warning::SavedUnknownReadAs { grey: 52685, .. }]),
            "{semantics:?} {found:?}"
        );
    }
}

/// libtiff, which SDL_image reads by, multiplies colours by their alpha: 254 by 128/255 is 127.
#[test]
fn colours_of_a_tiff_are_multiplied_by_their_alpha_to_ros_1() {
    let pixels = image::RgbaImage::from_raw(2, 1, vec![99, 99, 99, 255, 254, 254, 254, 128]).unwrap();
    let mut bytes = Cursor::new(Vec::new());
    pixels.write_to(&mut bytes, ImageFormat::Tiff).unwrap();
    let map = read("map.tif", &bytes.into_inner(), Semantics::Ros1, Mode::Raw);
    assert_eq!(percents(&map), [99, -1]);
    let mut dark = image::RgbaImage::from_raw(1, 1, vec![180, 180, 180, 128]).unwrap();
    let mut bytes = Cursor::new(Vec::new());
    dark.write_to(&mut bytes, ImageFormat::Tiff).unwrap();
    assert_eq!(percents(&read("map.tif", &bytes.into_inner(), Semantics::Ros1, Mode::Raw)), [90]);
    dark.put_pixel(0, 0, image::Rgba([90, 90, 90, 255]));
    let mut bytes = Cursor::new(Vec::new());
    dark.write_to(&mut bytes, ImageFormat::Tiff).unwrap();
    assert_eq!(percents(&read("map.tif", &bytes.into_inner(), Semantics::Ros1, Mode::Raw)), [90]);
}

/// A JPEG of 8 x 8 pixels of four inks.
#[rustfmt::skip]
const INKS: [u8; 177] = [
    0xff, 0xd8, 0xff, 0xee, 0x00, 0x0e, 0x41, 0x64, 0x6f, 0x62, 0x65, 0x00, 0x64, 0x00, 0x00, 0x00, 0x00, 0x00,
    0xff, 0xdb, 0x00, 0x43, 0x00, 0x10, 0x0b, 0x0c, 0x0e, 0x0c, 0x0a, 0x10, 0x0e, 0x0d, 0x0e, 0x12, 0x11, 0x10,
    0x13, 0x18, 0x28, 0x1a, 0x18, 0x16, 0x16, 0x18, 0x31, 0x23, 0x25, 0x1d, 0x28, 0x3a, 0x33, 0x3d, 0x3c, 0x39,
    0x33, 0x38, 0x37, 0x40, 0x48, 0x5c, 0x4e, 0x40, 0x44, 0x57, 0x45, 0x37, 0x38, 0x50, 0x6d, 0x51, 0x57, 0x5f,
    0x62, 0x67, 0x68, 0x67, 0x3e, 0x4d, 0x71, 0x79, 0x70, 0x64, 0x78, 0x5c, 0x65, 0x67, 0x63, 0xff, 0xc0, 0x00,
    0x14, 0x08, 0x00, 0x08, 0x00, 0x08, 0x04, 0x43, 0x11, 0x00, 0x4d, 0x11, 0x00, 0x59, 0x11, 0x00, 0x4b, 0x11,
    0x00, 0xff, 0xc4, 0x00, 0x15, 0x00, 0x01, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x07, 0x06, 0xff, 0xc4, 0x00, 0x14, 0x10, 0x01, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00,
    0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0x00, 0xff, 0xda, 0x00, 0x0e, 0x04, 0x43, 0x00, 0x4d,
    0x00, 0x59, 0x00, 0x4b, 0x00, 0x00, 0x3f, 0x00, 0x40, 0x20, 0x10, 0x14, 0xef, 0xff, 0xd9,
];

/// Where a loader takes the levels of an image for others, or refuses it, this is said, and only there.
#[test]
fn what_a_loader_takes_otherwise_or_refuses_is_said() {
    let lossless = |image: RgbImage| {
        let mut bytes = Cursor::new(Vec::new());
        image.write_to(&mut bytes, ImageFormat::WebP).unwrap();
        bytes.into_inner()
    };
    let pam = b"P7\nWIDTH 1\nHEIGHT 1\nDEPTH 1\nMAXVAL 255\nTUPLTYPE GRAYSCALE\nENDHDR\n\0".to_vec();
    for (name, image, kind, said) in [
        ("map.bmp", bmp(16, &[], &[0, 0, 0, 0]), "a BMP of 16 bits", ALL.to_vec()),
        (
            "map.jpg",
            INKS.to_vec(),
            "a JPEG of four inks (CMYK)",
            vec![Semantics::Nav2Humble, Semantics::Ros1],
        ),
        ("map.pam", pam, "PAM", vec![Semantics::Ros1]),
        ("map.ppm", b"P6 1 1 1000\n\0\0\0\0\0\0".to_vec(), "a PPM of 16 bits", vec![Semantics::Ros1]),
        ("map.webp", lossless(RgbImage::from_pixel(1, 1, Rgb([0; 3]))), "WebP but", vec![Semantics::Ros1]),
        ("map.bmp", bmp(24, &[], &[0, 0, 0]), "", Vec::new()),
        ("map.ppm", b"P6 1 1 255\n\0\0\0".to_vec(), "", Vec::new()),
    ] {
        for semantics in ALL {
            let map = read(name, &image, semantics, Mode::Trinary);
            let about = map.warnings.iter().find_map(|warning| match warning {
                Warning::LevelsDiffer { of } | Warning::RefusedByRos1 { of } => Some(*of),
                _ => None,
            });
            assert_eq!(about.is_some(), said.contains(&semantics), "{name} {semantics:?} {:?}", map.warnings);
            assert!(about.is_none_or(|of| of.starts_with(kind)), "{name} {about:?}");
        }
    }
}
