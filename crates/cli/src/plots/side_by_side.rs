//! Pictures of several maps in one.

use super::bitmap::Bitmap;
use super::conflict_map::ConflictMap;
use super::drawing::drawing_failure;
use super::heat_map::HeatMap;
use super::map_picture::MapPicture;
use crate::failure::Failure;

/// The number of maps beside each other.
const COLUMNS: usize = 2;

impl HeatMap {
    /// Draws several maps in one picture, each under its two lines of title.
    ///
    /// # Errors
    /// None is known, but for a map without cells.
    pub fn png_of_several(maps: Vec<(Self, [String; 2])>) -> Result<Vec<u8>, Failure> {
        png(maps.into_iter().map(|(map, titles)| (map.into_picture(), titles)).collect())
    }
}

impl ConflictMap {
    /// Draws several maps in one picture, each under its two lines of title.
    ///
    /// # Errors
    /// None is known, but for a map without cells.
    pub fn png_of_several(maps: &[(Self, [String; 2])]) -> Result<Vec<u8>, Failure> {
        png(maps.iter().map(|(map, titles)| (map.picture(), titles.clone())).collect())
    }
}

/// Draws pictures beside and below each other, their cells as large as those of the one with the smallest.
fn png(maps: Vec<(MapPicture, [String; 2])>) -> Result<Vec<u8>, Failure> {
    let zoom = maps.iter().map(|(map, _)| map.zoom).min().unwrap_or(1);
    let pictures = maps.into_iter().map(|(map, titles)| map.with_zoom(zoom).draw(&titles));
    let pictures = pictures.collect::<Result<Vec<_>, _>>()?;
    let width = |row: &[Bitmap]| row.iter().map(|picture| picture.size().0).sum::<u32>();
    let height = |row: &[Bitmap]| row.iter().map(|picture| picture.size().1).max().unwrap_or(0);
    let rows = || pictures.chunks(COLUMNS);
    let mut whole = Bitmap::new(rows().map(width).max().unwrap_or(0), rows().map(height).sum());
    let mut top = 0;
    for row in rows() {
        let mut left = 0;
        for picture in row {
            whole.place(picture, [left, top]);
            left += picture.size().0;
        }
        top += height(row);
    }
    whole.png().map_err(drawing_failure)
}
