//! The heat map: the right colour in the right place.

mod common;

use common::*;

/// The corner of the map in the picture, and the side of a cell of a small map, in pixels.
const CORNER: u32 = 84;
const CELL: u32 = 40;

fn heat_map(folder: &Folder, map: &str) -> Pixels {
    let picture = folder.text_path("picture.png");
    stdout(&["map", map, "--heat-map", &picture]);
    Pixels::of_png(&read(&picture))
}

#[test]
fn every_cell_has_its_colour() {
    let folder = Folder::new();
    let image = heat_map(&folder, &folder.ros_map("room", 5, &GREYS, "scale"));
    // The upper row of the image is the upper row of the map, so row 0 is at the bottom.
    for ((row, column), p) in (0..3).flat_map(|y| (0..5).map(move |x| (y, x))).zip(occupancies(&GREYS)) {
        let expected = if p == 0.5 {
            [190; 3]
        } else {
            colorous::VIRIDIS.eval_continuous(1.0 - entropy(p)).into_array()
        };
        for (dx, dy) in [(0, 0), (CELL / 2, CELL / 2), (CELL - 1, CELL - 1)] {
            let pixel = image.at(CORNER + column * CELL + dx, CORNER + row * CELL + dy);
            assert_eq!(pixel, expected, "row {row} from above, column {column}");
        }
    }
    // A frame around it.
    assert_eq!(image.at(CORNER - 1, CORNER), [0; 3]);
    assert_eq!(image.at(CORNER + 5 * CELL, CORNER), [0; 3]);
    assert_eq!(image.at(CORNER, CORNER + 3 * CELL), [0; 3]);
}

/// The pixels of the ticks below the map, from its left edge, and beside it, from its bottom.
fn ticks(image: &Pixels, columns: u32, rows: u32) -> [Vec<u32>; 2] {
    let (width, height) = (columns * CELL, rows * CELL);
    let black = |x: u32, y: u32| image.at(x, y) == [0; 3];
    [
        (0..width).filter(|x| black(CORNER + x, CORNER + height + 4)).collect(),
        (0..height).filter(|y| black(CORNER - 5, CORNER + height - 1 - y)).collect(),
    ]
}

/// A tick stands where its value lies between the first pixel and the last: each axis by its own extent and origin.
#[test]
fn ticks_stand_at_round_places_of_each_axis() {
    let folder = Folder::new();
    let map = folder.ros_map("room", 5, &GREYS, "scale");
    let yaml = text(&read(&map)).to_owned();
    let place = |value: f64, origin: f64, extent: f64, cells: u32| {
        ((value - origin) / extent * f64::from(cells * CELL - 1)).round() as u32
    };
    for (origin, x_values, y_values) in [
        // 1 m by 0.6 m.
        ([0.0, 0.0], &[0.0, 0.5, 1.0][..], &[0.0, 0.2, 0.4, 0.6][..]),
        ([-0.7, 2.35], &[-0.5, 0.0], &[2.4, 2.6, 2.8]),
        // Too far out to label: from the corner.
        ([5e5, -7e6], &[0.0, 0.5, 1.0], &[0.0, 0.2, 0.4, 0.6]),
    ] {
        let moved = yaml.replace("[0.0, 0.0,", &format!("[{:?}, {:?},", origin[0], origin[1]));
        std::fs::write(&map, moved).unwrap();
        let [x_origin, y_origin] = if origin[0] > 1e3 { [0.0; 2] } else { origin };
        let expected = [
            x_values.iter().map(|&x| place(x, x_origin, 1.0, 5)).collect::<Vec<_>>(),
            y_values.iter().map(|&y| place(y, y_origin, 0.6, 3)).collect(),
        ];
        assert_eq!(ticks(&heat_map(&folder, &map), 5, 3), expected, "{origin:?}");
    }
}

#[test]
fn the_legend_runs_from_0_to_1_bit() {
    let folder = Folder::new();
    let image = heat_map(&folder, &folder.ros_map("room", 5, &GREYS, "scale"));
    let x = CORNER + 5 * CELL + 40;
    let column: Vec<_> = (0..image.height).map(|y| image.at(x, y)).collect();
    let place = |colour: [u8; 3]| column.iter().position(|&pixel| pixel == colour);
    let (highest, lowest) = (
        place(colorous::VIRIDIS.eval_continuous(1.0).into_array()).unwrap(),
        place(colorous::VIRIDIS.eval_continuous(0.0).into_array()).unwrap(),
    );
    assert_eq!(highest, CORNER as usize);
    for y in [highest + 30, highest + 110, lowest - 40] {
        let bits = (lowest - y) as f64 / (lowest - highest) as f64;
        assert_eq!(column[y], colorous::VIRIDIS.eval_continuous(bits).into_array(), "{bits} bits");
    }
    assert!(place([190; 3]).unwrap() > lowest, "the swatch of unknown cells");
}

#[test]
fn a_large_map_is_reduced_and_a_thin_one_drawn() {
    let folder = Folder::new();
    let mut greys = vec![255; 4001 * 3];
    greys[0] = 127;
    let image = heat_map(&folder, &folder.ros_map("large", 4001, &greys, "scale"));
    assert!(image.width < 2200 && image.height < 500, "{:?}", (image.width, image.height));
    assert_eq!(image.at(CORNER, CORNER), colorous::VIRIDIS.eval_continuous(1.0).into_array());
    let image = heat_map(&folder, &folder.ros_map("thin", 1, &[0; 3000], "scale"));
    assert!(image.height > 1500 && image.height < 2200, "{:?}", (image.width, image.height));
}

#[test]
fn the_same_bytes_on_every_run_whatever_the_map_is_called() {
    let folder = Folder::new();
    let map = folder.ros_map("Überblick (Σ)", 5, &GREYS, "scale");
    let picture = folder.text_path("picture.png");
    let draw = || {
        stdout(&["map", &map, "--heat-map", &picture]);
        read(&picture)
    };
    assert_eq!(draw(), draw());
}
