//! Images that are decoded whole, against the same pixels as PGM or PNG.

use crate::support::{measure, percents, read_twice, refusal_of};
use image::codecs::jpeg::JpegEncoder;
use image::{DynamicImage, GrayImage, ImageBuffer, ImageFormat, Rgb, RgbImage, RgbaImage};
use mean_information_files::{Map, Mode, Options, Semantics, Warning};
use mean_information_test_support::formats::{Folder, pgm, yaml};
use std::io::Cursor;

const GREYS: [u8; 12] = [0, 0, 254, 254, 205, 205, 100, 90, 205, 254, 0, 255];

fn encoded(image: &DynamicImage, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn read_image(name: &str, bytes: &[u8], options: &Options) -> Map {
    let folder = Folder::new();
    folder.write(name, bytes);
    read_twice(&folder.write("map.yaml", yaml(name, "negate: 0\n")), options).unwrap()
}

#[test]
fn every_format_is_read_as_its_greys() {
    let grey = GrayImage::from_raw(4, 3, GREYS.to_vec()).unwrap();
    let colour = RgbImage::from_fn(4, 3, |x, y| Rgb([grey[(x, y)].0[0]; 3]));
    let (grey, colour) = (DynamicImage::from(grey), DynamicImage::from(colour));
    let reference = pgm(4, 3, 255, &GREYS.map(u16::from));
    for semantics in [Semantics::Nav2, Semantics::Nav2Humble, Semantics::Ros1] {
        for mode in [Mode::Trinary, Mode::Scale, Mode::Raw] {
            let options = Options { semantics, mode: Some(mode), ..Options::default() };
            let expected = read_image("map.pgm", &reference, &options);
            for (name, image, format) in [
                ("map.bmp", &grey, ImageFormat::Bmp),
                ("map.bmp", &colour, ImageFormat::Bmp),
                ("map.ppm", &colour, ImageFormat::Pnm),
                ("map.tiff", &grey, ImageFormat::Tiff),
                ("map.gif", &colour, ImageFormat::Gif),
                ("map.webp", &colour, ImageFormat::WebP),
                ("map.tga", &grey, ImageFormat::Tga),
                ("map.tga", &colour, ImageFormat::Tga),
            ] {
                // SDL_image gives ROS 1 every TIFF with alpha, which trinary mode averages.
                // Of a GIF it has the indices.
                if semantics == Semantics::Ros1 && matches!(format, ImageFormat::Tiff | ImageFormat::Gif) {
                    continue;
                }
                let map = read_image(name, &encoded(image, format), &options);
                assert_eq!(percents(&map), percents(&expected), "{name} {mode:?} {semantics:?}");
            }
        }
    }
}

#[test]
fn a_jpeg_warns_that_decoders_differ() {
    let grey = GrayImage::from_fn(16, 8, |x, _| [if x < 8 { 0 } else { 254 }].into());
    let mut bytes = Vec::new();
    JpegEncoder::new_with_quality(&mut bytes, 100).encode_image(&grey).unwrap();
    let map = read_image("map.jpg", &bytes, &Options::default());
    assert_eq!((measure(&map).free, measure(&map).occupied), (64, 64));
    assert_eq!(map.warnings, [Warning::JpegLevels]);
}

#[test]
fn ros_1_averages_the_alpha_of_every_tiff() {
    let grey = DynamicImage::from(GrayImage::from_raw(4, 3, GREYS.to_vec()).unwrap());
    let tiff = encoded(&grey, ImageFormat::Tiff);
    let ros1 = Options { semantics: Semantics::Ros1, ..Options::default() };
    // (3 * 205 + 255) / 4 is 217.5: free, as is every grey from there.
    assert_eq!(measure(&read_image("map.tif", &tiff, &ros1)).free, 7);
    assert_eq!(measure(&read_image("map.tif", &tiff, &Options::default())).free, 4);
}

#[test]
fn sixteen_bits_and_alpha_are_kept() {
    let deep = ImageBuffer::<image::Luma<u16>, _>::from_raw(2, 1, vec![52685_u16, 1]).unwrap();
    let tiff = encoded(&DynamicImage::from(deep), ImageFormat::Tiff);
    let probability = Options { mode: Some(Mode::Probability), unknown: Some(52685.0), ..Options::default() };
    assert_eq!(measure(&read_image("map.tif", &tiff, &probability)).unknown, 1);
    let clear = RgbaImage::from_raw(2, 1, vec![0, 0, 0, 255, 0, 0, 0, 7]).unwrap();
    let webp = encoded(&DynamicImage::from(clear), ImageFormat::WebP);
    let map = read_image("map.webp", &webp, &Options::default());
    assert_eq!(map.warnings, [Warning::TransparentReadAsUnknown { count: 1 }]);
}

/// A BMP of 4 pixels of so many bits a row with this palette, and indices in rows of 4 bytes from the bottom.
fn bmp(bits: u8, palette: &[[u8; 3]], indices: &[u8]) -> Vec<u8> {
    let start = 54 + (4_u32 << bits);
    let mut bytes = b"BM".to_vec();
    bytes.extend((start + indices.len() as u32).to_le_bytes());
    bytes.extend([0; 4]);
    bytes.extend(start.to_le_bytes());
    bytes.extend(40_u32.to_le_bytes());
    bytes.extend(4_u32.to_le_bytes());
    bytes.extend((indices.len() as u32 / 4).to_le_bytes());
    bytes.extend([1, 0, bits, 0]);
    bytes.extend([0; 24]);
    bytes.extend((0..1 << bits).flat_map(|k: usize| {
        let [r, g, b] = palette.get(k).copied().unwrap_or([k as u8; 3]);
        [b, g, r, 0]
    }));
    bytes.extend(indices);
    bytes
}

#[test]
fn a_bmp_with_a_palette_is_indices_to_ros_1() {
    let plain = bmp(8, &[], &[0, 205, 254, 255]);
    for semantics in [Semantics::Nav2, Semantics::Ros1] {
        let options = Options { semantics, ..Options::default() };
        assert_eq!(percents(&read_image("map.bmp", &plain, &options)), [100, -1, 0, 0]);
    }
    let colours = [[254; 3], [0; 3]];
    for (bits, indices) in [(1, [0b0101_0000, 0, 0, 0]), (4, [0x01, 0x01, 0, 0]), (8, [0, 1, 0, 1])] {
        indices_to_ros_1("map.bmp", &bmp(bits, &colours, &indices));
    }
    // Compressed: a run of one pixel each, and the end.
    let mut runs = bmp(8, &colours, &[1, 0, 1, 1, 1, 0, 1, 1, 0, 1]);
    (runs[22], runs[30], runs[34]) = (1, 1, 10);
    indices_to_ros_1("map.bmp", &runs);
}

#[test]
fn a_gif_is_indices_to_ros_1() {
    let image = RgbImage::from_fn(4, 1, |x, _| Rgb([if x % 2 == 0 { 254 } else { 0 }; 3]));
    indices_to_ros_1("map.gif", &encoded(&DynamicImage::from(image), ImageFormat::Gif));
}

/// Reads four pixels of two colours, light and dark: to ROS 1 both are of a small number, and dark.
fn indices_to_ros_1(name: &str, image: &[u8]) {
    let nav2 = read_image(name, image, &Options::default());
    assert_eq!((percents(&nav2), &nav2.warnings[..]), (&[0, 100, 0, 100][..], &[][..]));
    let ros1 = read_image(name, image, &Options { semantics: Semantics::Ros1, ..Options::default() });
    assert_eq!((percents(&ros1), &ros1.warnings[..]), (&[100; 4][..], &[Warning::PaletteIndices][..]));
}

#[test]
fn what_follows_a_decoded_image_is_said_where_it_has_an_end() {
    let grey = DynamicImage::from(GrayImage::from_raw(4, 3, GREYS.to_vec()).unwrap());
    let colour = DynamicImage::from(grey.to_rgb8());
    let plain = bmp(4, &[[254; 3], [0; 3]], &[0x01, 0x01, 0, 0]);
    for (name, image, has_end) in [
        ("map.bmp", plain, true),
        ("map.bmp", encoded(&colour, ImageFormat::Bmp), true),
        ("map.gif", encoded(&colour, ImageFormat::Gif), true),
        ("map.jpg", encoded(&grey, ImageFormat::Jpeg), true),
        ("map.webp", encoded(&colour, ImageFormat::WebP), true),
        ("map.tiff", encoded(&grey, ImageFormat::Tiff), false),
        ("map.tga", encoded(&grey, ImageFormat::Tga), false),
    ] {
        for semantics in [Semantics::Nav2, Semantics::Ros1] {
            let options = Options { semantics, ..Options::default() };
            let says = |more: &[u8]| {
                let map = read_image(name, &[&image, more].concat(), &options);
                map.warnings.contains(&Warning::BytesAfterImage)
            };
            assert_eq!(
                [says(b""), says(&[0; 2]), says(b"more")],
                [false, false, has_end],
                "{name} {semantics:?}"
            );
        }
    }
}

#[test]
fn bitmaps_and_other_largest_samples_are_scaled() {
    let map = read_image("map.pbm", b"P1 3 1\n0 1 0\n", &Options::default());
    assert_eq!(percents(&map), [0, 100, 0]);
    // 10, 32 and 38 of 100 are 25.5, 81.6 and 96.9 of 255: SDL rounds down, GraphicsMagick to 16 bits; what was nav2 rounds.
    let grey = |sample| format!("{sample} {sample} {sample} ");
    let ppm = format!("P3 3 1 100\n{}", [10, 32, 38].map(grey).concat());
    for (semantics, levels) in [
        (Semantics::Nav2, [25, 81, 96]),
        (Semantics::Nav2Humble, [26, 82, 97]),
        (Semantics::Ros1, [25, 81, 96]),
    ] {
        let raw = Options { semantics, mode: Some(Mode::Raw), ..Options::default() };
        assert_eq!(percents(&read_image("map.ppm", ppm.as_bytes(), &raw)), levels, "{semantics:?}");
    }
}

#[test]
fn what_claims_more_than_it_holds_takes_no_memory() {
    let folder = Folder::new();
    let map = folder.write("map.yaml", yaml("map.bmp", "negate: 0\n"));
    let mut huge = bmp(8, &[], &[0; 4]);
    huge[18..22].copy_from_slice(&16000_u32.to_le_bytes());
    huge[22..26].copy_from_slice(&16000_u32.to_le_bytes());
    folder.write("map.bmp", &huge);
    let refused = refusal_of(&map, &Options::default());
    assert!(
        refused.contains(
            "claims 16000 x 16000 pixels, 768000000 bytes when decoded, more than 4096 for each of the 1082 bytes it has; \
             convert it to PNG if it is meant"
        ),
        "{refused}"
    );
    let refused = refusal_of(&map, &Options { max_cells: Some(1000), ..Options::default() });
    assert!(refused.contains("more than the limit of 1000"), "{refused}");
    // Colours of 16 bits with alpha take twice the bytes that a cell of the limit has.
    let deep = ImageBuffer::<image::Rgba<u16>, _>::from_raw(5, 3, vec![0_u16; 60]).unwrap();
    folder.write("map.bmp", encoded(&DynamicImage::from(deep), ImageFormat::Tiff));
    let refused = refusal_of(&map, &Options { max_cells: Some(29), ..Options::default() });
    assert!(
        refused.contains("claims 5 x 3 pixels, 120 bytes when decoded, more than 4 for each"),
        "{refused}"
    );
    read_twice(&map, &Options { max_cells: Some(30), ..Options::default() }).unwrap();
    let whole = bmp(8, &[], &[0; 4]);
    folder.write("map.bmp", &whole[..whole.len() - 2]);
    assert!(refusal_of(&map, &Options::default()).contains("cut short"));
}
