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
