//! A picture of a map: squares of colour in a frame with axes in metres, and the key to the colours beside it.

use super::bitmap::Bitmap;
use super::canvas::Canvas;
use super::drawing::{LABEL, TITLE, drawing_failure};
use super::scale::ticks;
use super::timed_path::{TimedPath, colour as path_colour};
use crate::failure::Failure;
use mean_information::map::Geometry;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The most pixels of the map's longer side.
const LARGEST: usize = 2000;
/// Small maps are enlarged as far as they fit into this many pixels,
const COMFORTABLE: usize = 800;
/// but a cell never gets more pixels a side than this.
const LARGEST_CELL: usize = 40;
const TOP: i32 = 84;
const LEFT: i32 = 84;
const BOTTOM: i32 = 64;
/// The gap between the map and the colour bar, in pixels.
const GAP: i32 = 32;
const BAR_WIDTH: i32 = 22;
/// The room right of the colour bar, in pixels: tick labels, and the legend's title.
const RIGHT: i32 = 96;
/// The legend's title needs this much.
const LEAST_BAR: i32 = 250;
const SWATCH: i32 = 22;

/// A map as squares of colour: one per cell, or one per block of cells if it is large.
#[derive(Debug)]
pub(super) struct MapPicture {
    pub(super) columns: usize,
    rows: usize,
    /// Cells per side of a square.
    pub(super) block: usize,
    /// Pixels per side of a square.
    pub(super) zoom: usize,
    /// Row by row from the lowest.
    pub(super) squares: Vec<[u8; 3]>,
    /// Along x and y.
    axes: [MapAxis; 2],
    /// The lower left corner, in metres.
    corner: [f64; 2],
    key: Key,
    path: TimedPath,
}

/// The key to the colours.
#[derive(Debug)]
pub(super) struct Key {
    /// The title of the bar.
    pub(super) title: &'static str,
    /// The colours of the bar, from 0 to 1.
    pub(super) gradient: fn(f64) -> [u8; 3],
    /// The ticks of the bar, from 0 to 1.
    pub(super) ticks: Vec<(f64, String)>,
    /// The colours that are not on the bar.
    pub(super) swatches: Vec<(&'static str, [u8; 3])>,
    /// The meaning of a square of several cells.
    pub(super) reduction: &'static str,
}

/// An axis of the map, in metres or in cells.
#[derive(Debug, PartialEq)]
struct MapAxis {
    start: f64,
    extent: f64,
    label: String,
}

impl MapAxis {
    /// Creates an axis from the origin, or from the map's corner if the file has no metres, if the map is turned against
    /// the axes of the world, or if it lies so far out that labels would be all digits.
    fn new(name: &str, origin: Option<f64>, extent: f64, yaw: f64) -> Self {
        let (start, label) = match origin {
            None => (0.0, format!("{name} (cells)")),
            Some(origin) if yaw == 0.0 && origin.abs() <= 50.0 * extent => (origin, format!("{name} (m)")),
            Some(_) => (0.0, format!("{name} from corner (m)")),
        };
        Self { start, extent, label }
    }

    /// The ticks at the pixels of an axis so long, from its start.
    fn ticks(&self, pixels: i32, spacing: i32) -> impl Iterator<Item = (i32, String)> {
        ticks(self.start, self.start + self.extent, (pixels / spacing) as usize)
            .into_iter()
            .map(move |(x, text)| (along(x - self.start, self.extent, pixels), text))
    }
}

/// Returns how many cells a square of a map of this size has along a side.
pub(super) fn block([width, height]: [usize; 2]) -> usize {
    width.max(height).max(1).div_ceil(LARGEST)
}

impl MapPicture {
    /// Creates the picture of a map of `width` x `height` cells, with a colour for each square of [`block`] cells.
    pub(super) fn new(
        [width, height]: [usize; 2],
        geometry: &Geometry,
        resolution: Option<f64>,
        squares: Vec<[u8; 3]>,
        key: Key,
    ) -> Self {
        let block = block([width, height]);
        let side = resolution.unwrap_or(1.0);
        let origin = resolution.map(|_| geometry.origin());
        let yaw = geometry.yaw();
        Self {
            columns: width.div_ceil(block),
            rows: height.div_ceil(block),
            block,
            zoom: (COMFORTABLE / width.max(height).max(1)).clamp(1, LARGEST_CELL),
            squares,
            axes: [
                MapAxis::new("x", origin.map(|[x, _]| x), width as f64 * side, yaw),
                MapAxis::new("y", origin.map(|[_, y]| y), height as f64 * side, yaw),
            ],
            corner: geometry.origin(),
            key,
            path: TimedPath::default(),
        }
    }

    /// Draws a cell of `zoom` x `zoom` pixels, if a square is one cell.
    pub(super) fn with_zoom(self, zoom: usize) -> Self {
        Self { zoom, ..self }
    }

    /// Draws a path.
    pub(super) fn with_path(self, path: TimedPath) -> Self {
        Self { path, ..self }
    }

    /// Draws the picture, under two lines of title.
    ///
    /// # Errors
    /// None is known, but for a map without cells.
    pub(super) fn draw(&self, titles: &[String; 2]) -> Result<Bitmap, Failure> {
        if self.squares.is_empty() {
            return Err(drawing_failure("the map has no cells"));
        }
        let places = Places::of(self, titles);
        let mut image = Bitmap::new(places.size.0, places.size.1);
        self.paint_squares(&mut image, &places);
        self.paint_key(&mut image, &places);
        self.write_labels(&mut image, &places, titles).map_err(drawing_failure)?;
        self.draw_path(&mut image, &places).map_err(drawing_failure)?;
        Ok(image)
    }

    fn paint_squares(&self, image: &mut Bitmap, places: &Places) {
        for y in 0..places.height {
            let row = self.rows - 1 - y as usize / self.zoom;
            for x in 0..places.width {
                let colour = self.squares[row * self.columns + x as usize / self.zoom];
                image.paint(LEFT + x, TOP + y, colour);
            }
        }
    }

    /// Paints the colour bar, and the swatches below it.
    fn paint_key(&self, image: &mut Bitmap, places: &Places) {
        let rows_of_bar = (0..places.bar_height).map(|y| {
            let part = f64::from(places.bar_height - 1 - y) / f64::from(places.bar_height - 1);
            (TOP + y, (self.key.gradient)(part))
        });
        let swatches = (0..).zip(&self.key.swatches);
        let rows_of_swatches = swatches
            .flat_map(|(k, &(_, colour))| (0..SWATCH).map(move |y| (places.swatch_top(k) + y, colour)));
        for (y, colour) in rows_of_bar.chain(rows_of_swatches) {
            for x in places.bar_left..places.bar_left + BAR_WIDTH {
                image.paint(x, y, colour);
            }
        }
    }

    fn write_labels(
        &self,
        image: &mut Bitmap,
        places: &Places,
        titles: &[String; 2],
    ) -> Result<(), DrawingAreaErrorKind<std::convert::Infallible>> {
        let paper = Canvas::new(image).into_drawing_area();
        let label = |at: (i32, i32), h: HPos, v: VPos, text: &str| {
            paper.draw(&Text::new(text, at, LABEL.into_font().color(&BLACK).pos(Pos::new(h, v))))
        };
        let upwards = |at: (i32, i32), text: &str| {
            let style = LABEL.into_font().transform(FontTransform::Rotate270).color(&BLACK);
            paper.draw(&Text::new(text, at, style.pos(Pos::new(HPos::Center, VPos::Center))))
        };
        let line = |from: (i32, i32), to: (i32, i32)| paper.draw(&PathElement::new(vec![from, to], BLACK));
        let frame = |left: i32, top: i32, width: i32, height: i32| {
            let (right, bottom) = (left + width, top + height);
            let corners = [
                (left - 1, top - 1),
                (right, top - 1),
                (right, bottom),
                (left - 1, bottom),
                (left - 1, top - 1),
            ];
            paper.draw(&PathElement::new(corners, BLACK))
        };

        let (right, bottom) = (LEFT + places.width, TOP + places.height);
        paper.draw(&Text::new(titles[0].as_str(), (LEFT, 12), TITLE.into_font().color(&BLACK)))?;
        label((LEFT, 36), HPos::Left, VPos::Top, &titles[1])?;
        label((LEFT, 56), HPos::Left, VPos::Top, &self.reduction())?;

        frame(LEFT, TOP, places.width, places.height)?;
        let [x_axis, y_axis] = &self.axes;
        for (x, text) in x_axis.ticks(places.width, 60) {
            let x = LEFT + x;
            line((x, bottom), (x, bottom + 5))?;
            label((x, bottom + 7), HPos::Center, VPos::Top, &text)?;
        }
        for (y, text) in y_axis.ticks(places.height, 40) {
            let y = bottom - 1 - y;
            line((LEFT - 6, y), (LEFT - 1, y))?;
            label((LEFT - 9, y), HPos::Right, VPos::Center, &text)?;
        }
        label((i32::midpoint(LEFT, right), bottom + 32), HPos::Center, VPos::Top, &x_axis.label)?;
        upwards((18, i32::midpoint(TOP, bottom)), &y_axis.label)?;

        frame(places.bar_left, TOP, BAR_WIDTH, places.bar_height)?;
        let bar_right = places.bar_left + BAR_WIDTH;
        for (part, text) in &self.key.ticks {
            let y = TOP + places.bar_height - 1 - along(*part, 1.0, places.bar_height);
            line((bar_right, y), (bar_right + 5, y))?;
            label((bar_right + 8, y), HPos::Left, VPos::Center, text)?;
        }
        upwards((bar_right + 62, TOP + places.bar_height / 2), self.key.title)?;
        for (k, (name, _)) in (0..).zip(&self.key.swatches) {
            let top = places.swatch_top(k);
            frame(places.bar_left, top, BAR_WIDTH, SWATCH)?;
            label((bar_right + 8, top + SWATCH / 2), HPos::Left, VPos::Center, name)?;
        }
        Ok(())
    }

    fn draw_path(
        &self,
        image: &mut Bitmap,
        places: &Places,
    ) -> Result<(), DrawingAreaErrorKind<std::convert::Infallible>> {
        let paper = Canvas::new(image).into_drawing_area();
        let [x_axis, y_axis] = &self.axes;
        // From the corner, wherever the labels of an axis begin.
        let at = |&[x, y]: &[f64; 2]| {
            let (x, y) = (x - self.corner[0], y - self.corner[1]);
            (
                LEFT + along(x, x_axis.extent, places.width),
                TOP + places.height - 1 - along(y, y_axis.extent, places.height),
            )
        };
        let style = |[r, g, b]: [u8; 3]| RGBColor(r, g, b).stroke_width(1);
        for (colour, positions) in self.path.pieces() {
            paper.draw(&PathElement::new(positions.iter().map(at).collect::<Vec<_>>(), style(colour)))?;
        }
        let dark = style(path_colour(0.0));
        if let Some(first) = self.path.first() {
            paper.draw(&Circle::new(at(&first), 5, dark.filled()))?;
        }
        for (position, text) in self.path.dots() {
            let (x, y) = at(&position);
            paper.draw(&Circle::new((x, y), 3, dark.filled()))?;
            // A rim of white, so that the time can be read on any colour.
            for (dx, dy, colour) in
                [(-1, 0, WHITE), (1, 0, WHITE), (0, -1, WHITE), (0, 1, WHITE), (0, 0, BLACK)]
            {
                let font = LABEL.into_font().color(&colour).pos(Pos::new(HPos::Left, VPos::Center));
                paper.draw(&Text::new(text.as_str(), (x + 6 + dx, y + dy), font))?;
            }
        }
        Ok(())
    }

    /// Returns what a square of colour stands for.
    fn reduction(&self) -> String {
        match (self.block, self.zoom) {
            (1, 1) => "one pixel per cell".to_owned(),
            (1, zoom) => format!("{zoom} × {zoom} pixels per cell"),
            (block, _) => format!("one pixel per {block} × {block} cells: {}", self.key.reduction),
        }
    }
}

/// The pixel of `x` on an axis of `0..=end`.
fn along(x: f64, end: f64, pixels: i32) -> i32 {
    (x / end * f64::from(pixels - 1)).round() as i32
}

/// The places of the parts of the picture, in pixels.
struct Places {
    width: i32,
    height: i32,
    bar_left: i32,
    bar_height: i32,
    size: (u32, u32),
}

impl Places {
    fn of(map: &MapPicture, titles: &[String; 2]) -> Self {
        let (width, height) = ((map.columns * map.zoom) as i32, (map.rows * map.zoom) as i32);
        let bar_left = LEFT + width + GAP;
        let swatches = map.key.swatches.len() as i32 * (SWATCH + 16);
        let bar_height = (height - swatches).clamp(LEAST_BAR, 500);
        let below_top = (height + BOTTOM).max(bar_height + swatches + 24);
        // A character of a title is about 10 pixels wide.
        let titles = titles.iter().map(|title| title.chars().count() as i32 * 10).max().unwrap_or(0);
        let size = ((bar_left + BAR_WIDTH + RIGHT).max(LEFT + titles), TOP + below_top);
        Self { width, height, bar_left, bar_height, size: (size.0 as u32, size.1 as u32) }
    }

    fn swatch_top(&self, k: i32) -> i32 {
        TOP + self.bar_height + 16 + k * (SWATCH + 16)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn axes_start_at_the_origin_where_that_can_be_read() {
        let axis = |origin, yaw| MapAxis::new("y", origin, 10.0, yaw);
        let of = |axis: MapAxis| (axis.start, axis.label);
        assert_eq!(of(axis(Some(-3.5), 0.0)), (-3.5, "y (m)".to_owned()));
        for corner in [axis(Some(-3.5), 0.1), axis(Some(501.0), 0.0), axis(Some(-4e6), 0.0)] {
            assert_eq!(of(corner), (0.0, "y from corner (m)".to_owned()));
        }
        assert_eq!(of(axis(None, 0.0)), (0.0, "y (cells)".to_owned()));
    }
}
