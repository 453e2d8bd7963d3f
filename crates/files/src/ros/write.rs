//! Grids as ROS maps: a yaml file and a grey image in mode `scale`, whose thresholds 0 and 1 keep every level.
//!
//! Grey `v` is occupancy `(255 - v) / 255`. A cell gets the level nearest to its occupancy, within 1/510, with one
//! exception: what is unknown must be read as unknown and nothing else, under both loaders' roundings to percent.
//!
//! | cell | grey | nav2: `round(100 p)` | ROS 1: `trunc(1 + 98 p)` |
//! |---|---|---|---|
//! | unknown | 127 | 50 | 50 |
//! | `p > 1/2` | at most 124 | at least 51 | at least 51 |
//! | `p < 1/2` | at least 129 | at most 49 | at most 49 |
//!
//! So an observed cell is off by at most 7/510 (grey 124 is 131/255, 7/510 above 1/2), and the number of observed cells is
//! kept.

use crate::error::{Error, ErrorKind};
use mean_information::Real;
use mean_information::map::{Encoding, Geometry, Grid};
use std::io::Write;

/// Unknown.
const UNKNOWN: u8 = 127;
/// The greys of observed cells next to it.
const LEAST_OCCUPIED: u8 = 124;
const LEAST_FREE: u8 = 129;

/// The most by which the occupancy of a grey level is off that of its cell: 7/510, and that only next to 1/2; elsewhere
/// it is 1/510.
pub const QUANTISATION: f64 = 7.0 / 510.0;

/// Writes the description of a grid whose image will lie beside the yaml file under the name `image`; the lines of
/// `comment` come first.
///
/// ```
/// use mean_information::map::Geometry;
/// use mean_information_files::ros::write_description;
///
/// let mut yaml = Vec::new();
/// write_description(&Geometry::new(0.05, [-1.25, 3.5])?, "map.pgm", "A sample.", &mut yaml)?;
/// let text = String::from_utf8(yaml)?;
/// assert!(text.starts_with("# A sample.\n") && text.contains("origin: [-1.25, 3.5, 0.0]\nmode: scale\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// An [`Error`] for a name with control characters, which yaml cannot hold, and where `output` fails.
pub fn write_description(
    geometry: &Geometry,
    image: &str,
    comment: &str,
    mut output: impl Write,
) -> Result<(), Error> {
    if image.chars().any(char::is_control) {
        let message = "has control characters in its name; give a plain one";
        return Err(Error::new(ErrorKind::Unsupported, message).with_value(image));
    }
    let comment = comment.lines().fold(String::new(), |text, line| text + "# " + line + "\n");
    let [x, y] = geometry.origin();
    // In quotes a quote is doubled.
    let image = image.replace('\'', "''");
    write!(
        output,
        "{comment}# Grey v is occupancy (255 - v) / 255, rounded to whole percent. Grey {UNKNOWN} is 50 percent, which means unknown.\n\
         image: '{image}'\n\
         resolution: {:?}\n\
         origin: [{x:?}, {y:?}, {:?}]\n\
         mode: scale\n\
         negate: 0\n\
         free_thresh: 0.0\n\
         occupied_thresh: 1.0\n",
        geometry.resolution(),
        geometry.yaw()
    )
    .map_err(Error::of_writer)
}

/// Writes the image of a grid: binary PGM, the upper row first.
///
/// # Errors
/// An [`Error`] for a grid without cells, which is no image, and where `output` fails.
pub fn write_image<E: Encoding>(grid: &Grid<E>, mut output: impl Write) -> Result<(), Error> {
    if grid.cells().is_empty() {
        return Err(Error::new(ErrorKind::Unsupported, "would have no cells"));
    }
    let mut write = |bytes: &[u8]| output.write_all(bytes).map_err(Error::of_writer);
    write(format!("P5\n{} {}\n255\n", grid.width(), grid.height()).as_bytes())?;
    let mut greys = Vec::with_capacity(grid.width());
    for row in (0..grid.height()).rev().filter_map(|row| grid.row(row)) {
        greys.clear();
        greys.extend(row.iter().map(|&stored| grey(E::occupancy(stored).map(Real::widen))));
        write(&greys)?;
    }
    Ok(())
}

/// Returns the grey level of an occupancy.
fn grey(occupancy: Option<f64>) -> u8 {
    let Some(p) = occupancy else { return UNKNOWN };
    let level = (255.0 * (1.0 - p)).round() as u8;
    if p > 0.5 {
        level.min(LEAST_OCCUPIED)
    } else if p < 0.5 {
        level.max(LEAST_FREE)
    } else {
        UNKNOWN
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cells::Cells;
    use crate::options::{Options, Semantics};
    use crate::ros::{Description, read_image};
    use mean_information::map::encoding::Probability;
    use std::io::Cursor;

    /// The two files of a map.
    struct Saved {
        yaml: Vec<u8>,
        image: Vec<u8>,
    }

    fn save(grid: &Grid<Probability<f64>>, image: &str, comment: &str) -> Result<Saved, Error> {
        let mut saved = Saved { yaml: Vec::new(), image: Vec::new() };
        write_description(grid.geometry(), image, comment, &mut saved.yaml)?;
        write_image(grid, &mut saved.image)?;
        Ok(saved)
    }

    fn read_back(saved: &Saved, semantics: Semantics) -> Vec<i8> {
        let description = Description::read(&saved.yaml[..], semantics).unwrap();
        let options = Options { semantics, ..Options::default() };
        let map = read_image(Cursor::new(&saved.image), &description, &options).unwrap();
        assert_eq!(map.warnings, []);
        let Cells::Percent(grid) = map.cells else { panic!("{:?}", map.cells) };
        grid.cells().to_vec()
    }

    /// Every sixteenth of a grey level, and the neighbours of 1/2, under both loaders.
    #[test]
    fn the_state_of_every_cell_survives_and_its_occupancy_nearly() {
        let mut cells: Vec<f64> = (0..=4080).map(|k| f64::from(k) / 4080.0).collect();
        cells.extend([0.5_f64.next_up(), 0.5_f64.next_down(), f64::MIN_POSITIVE, 1.0_f64.next_down()]);
        let geometry = Geometry::new(0.05, [-1.25, 3.5]).unwrap();
        let grid = Grid::<Probability<f64>>::new(cells.len(), 1, geometry, cells.clone()).unwrap();
        let saved = save(&grid, "it's a map.pgm", "two\nlines").unwrap();
        for semantics in [Semantics::Nav2, Semantics::Ros1] {
            for (&p, percent) in cells.iter().zip(read_back(&saved, semantics)) {
                assert_eq!(percent == 50, p == 0.5, "{p} {percent}");
                assert_eq!(percent > 50, p > 0.5, "{p} {percent}");
            }
        }
        let greys = &saved.image[saved.image.len() - cells.len()..];
        for (&p, &grey) in cells.iter().zip(greys).filter(|&(&p, _)| p != 0.5) {
            let off = ((255.0 - f64::from(grey)) / 255.0 - p).abs();
            let bound = if (0.492..0.516).contains(&p) { QUANTISATION } else { 1.0 / 510.0 };
            // A few roundings of numbers up to 1.
            assert!(off <= bound + 4.0 * f64::EPSILON, "{p} {grey}");
        }
        let description = Description::read(&saved.yaml[..], Semantics::Nav2).unwrap();
        assert_eq!((&*description.image, description.resolution), ("it's a map.pgm", 0.05));
        assert_eq!(description.origin, [-1.25, 3.5, 0.0]);
    }

    /// Row 0 of a grid is the lowest, that of an image the uppermost.
    #[test]
    fn the_upper_row_comes_first() {
        let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
        let grid = Grid::<Probability<f64>>::new(2, 2, geometry, vec![0.0, 0.25, 0.5, 1.0]).unwrap();
        let saved = save(&grid, "map.pgm", "").unwrap();
        assert_eq!(saved.image, *b"P5\n2 2\n255\n\x7f\x00\xff\xbf");
        assert_eq!(read_back(&saved, Semantics::Nav2), [0, 25, 50, 100]);
    }

    #[test]
    fn what_cannot_be_saved() {
        let geometry = Geometry::new(0.05, [0.0; 2]).unwrap();
        let grid = |cells: Vec<f64>| Grid::<Probability<f64>>::new(cells.len(), 1, geometry, cells).unwrap();
        let refused = save(&grid(vec![0.25]), "a\nb.pgm", "").err().unwrap();
        assert_eq!((refused.kind(), refused.value()), (ErrorKind::Unsupported, Some("a\nb.pgm")));
        let refused = save(&grid(vec![]), "map.pgm", "").err().unwrap();
        assert_eq!(refused.to_string(), "would have no cells");
        // No room for the bytes.
        let refused = write_image(&grid(vec![0.25]), &mut [0; 5][..]).unwrap_err();
        assert_eq!(refused.kind(), ErrorKind::Io);
    }
}
