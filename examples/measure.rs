//! Measures a map from a mapping program, whole and in parts: `cargo run --example measure`.

use mean_information::Error;
use mean_information::cell::entropy;
use mean_information::map::{Geometry, Grid, encoding::Percent};

/// Six rows of a `nav_msgs/OccupancyGrid` of 5 cm cells: percentages, -1 for unknown, row 0 at the bottom.
const ROWS: [[i8; 10]; 6] = [
    [-1, -1, 98, 97, 99, 99, 98, -1, -1, -1],
    [-1, 97, 3, 2, 1, 1, 2, 96, -1, -1],
    [-1, 96, 2, 1, 0, 0, 1, 61, 12, 30],
    [-1, 98, 2, 1, 0, 1, 2, 55, 18, 50],
    [-1, 97, 4, 2, 1, 2, 3, 95, -1, -1],
    [-1, -1, 95, 97, 98, 96, 97, -1, -1, -1],
];

fn measure() -> Result<f64, Error> {
    let geometry = Geometry::new(0.05, [0.0, 0.0])?;
    let map = Grid::<Percent>::new(10, 6, geometry, ROWS.concat())?;

    let tally = map.tally();
    println!("mean information  {} bits per observed cell", tally.mean_information());
    println!("information       {} bits", tally.information());
    println!("entropy           {} bits, unknown cells and all", tally.entropy());
    println!("observed          {} of {} cells", tally.observed(), tally.cells());
    println!("free, occupied    {}, {}", tally.free(), tally.occupied());

    // The same from parts: measure them anywhere, merge them in any order.
    let row = |cells: &[i8; 10]| Grid::<Percent>::new(10, 1, geometry, cells.to_vec()).map(|row| row.tally());
    let mut merged = row(&ROWS[5])?;
    for cells in &ROWS[..5] {
        merged.merge(&row(cells)?);
    }
    assert_eq!(merged, tally);

    // The cell with the largest entropy below 1 bit.
    let cells = (0..6).flat_map(|row| (0..10).map(move |column| (row, column)));
    let entropies = cells.map(|(row, column)| map.occupancy(row, column).map_or(1.0, entropy));
    let known = entropies.zip(map.cells()).filter(|(entropy, _)| *entropy < 1.0);
    let (entropy, percent) =
        known.fold((0.0, 0), |worst, (entropy, &p)| if entropy > worst.0 { (entropy, p) } else { worst });
    println!("least certain     a cell of {percent} percent: {entropy} bits of entropy");
    Ok(tally.mean_information())
}

fn main() -> Result<(), Error> {
    measure().map(drop)
}

#[test]
fn it_is_the_same_everywhere() {
    assert_eq!(measure(), Ok(0.7747806663623155));
}
