//! The heat map: the information of every cell of a map, unknown cells apart.

use super::bitmap::Bitmap;
use super::canvas::Canvas;
use super::cell_cache::CellCache;
use super::drawing::{LABEL, TITLE, drawing_failure};
use super::scale::ticks;
use crate::failure::Failure;
use mean_information::Real;
use mean_information::cell::State;
use mean_information::map::{Encoding, Grid};
use mean_information_files::{Map, with_grid};
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// The most pixels of the map's longer side.
const LARGEST: usize = 2000;
/// Small maps are enlarged as far as they fit into this many pixels,
const COMFORTABLE: usize = 800;
/// but a cell never gets more pixels a side than this.
const LARGEST_CELL: usize = 40;
/// No colour of the scale is grey.
const UNKNOWN: [u8; 3] = [190, 190, 190];
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
pub struct HeatMap {
    columns: usize,
    rows: usize,
    /// Cells per side of a square.
    block: usize,
    /// Pixels per side of a square.
    zoom: usize,
    /// Row by row from the lowest; `None` where every cell is unknown, else the mean information of the observed ones.
    squares: Vec<Option<f64>>,
    /// Along x and y.
    axes: [MapAxis; 2],
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

impl HeatMap {
    /// Colours the cells of `map`.
    pub fn new(map: &Map) -> Self {
        with_grid!(&map.cells, grid => Self::of_grid(grid, map.resolution))
    }

    fn of_grid<E: Encoding>(grid: &Grid<E>, resolution: Option<f64>) -> Self {
        let longer = grid.width().max(grid.height()).max(1);
        let block = longer.div_ceil(LARGEST);
        let columns = grid.width().div_ceil(block);
        let rows = grid.height().div_ceil(block);
        let side = resolution.unwrap_or(1.0);
        let origin = resolution.map(|_| grid.geometry().origin());
        let yaw = grid.geometry().yaw();
        let mut cache = CellCache::new();
        Self {
            columns,
            rows,
            block,
            zoom: (COMFORTABLE / longer).clamp(1, LARGEST_CELL),
            squares: (0..rows).flat_map(|row| row_of_squares(grid, &mut cache, row * block, block)).collect(),
            axes: [
                MapAxis::new("x", origin.map(|[x, _]| x), grid.width() as f64 * side, yaw),
                MapAxis::new("y", origin.map(|[_, y]| y), grid.height() as f64 * side, yaw),
            ],
        }
    }

    /// Draws the picture, under two lines of title.
    ///
    /// # Errors
    /// None is known, but for a map without cells.
    pub fn to_png(&self, titles: &[String; 2]) -> Result<Vec<u8>, Failure> {
        if self.squares.is_empty() {
            return Err(drawing_failure("the map has no cells"));
        }
        let layout = Layout::of(self, titles);
        let mut image = Bitmap::new(layout.size.0, layout.size.1);
        self.paint_squares(&mut image, &layout);
        paint_bar(&mut image, &layout);
        self.write_labels(&mut image, &layout, titles).map_err(drawing_failure)?;
        image.png().map_err(drawing_failure)
    }

    fn paint_squares(&self, image: &mut Bitmap, layout: &Layout) {
        for y in 0..layout.height {
            let row = self.rows - 1 - y as usize / self.zoom;
            for x in 0..layout.width {
                let square = self.squares[row * self.columns + x as usize / self.zoom];
                let colour = square.map_or(UNKNOWN, colour);
                image.paint(LEFT + x, TOP + y, colour);
            }
        }
    }

    fn write_labels(
        &self,
        image: &mut Bitmap,
        layout: &Layout,
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

        let (right, bottom) = (LEFT + layout.width, TOP + layout.height);
        paper.draw(&Text::new(titles[0].as_str(), (LEFT, 12), TITLE.into_font().color(&BLACK)))?;
        label((LEFT, 36), HPos::Left, VPos::Top, &titles[1])?;
        label((LEFT, 56), HPos::Left, VPos::Top, &self.reduction())?;

        frame(LEFT, TOP, layout.width, layout.height)?;
        let [x_axis, y_axis] = &self.axes;
        for (x, text) in x_axis.ticks(layout.width, 60) {
            let x = LEFT + x;
            line((x, bottom), (x, bottom + 5))?;
            label((x, bottom + 7), HPos::Center, VPos::Top, &text)?;
        }
        for (y, text) in y_axis.ticks(layout.height, 40) {
            let y = bottom - 1 - y;
            line((LEFT - 6, y), (LEFT - 1, y))?;
            label((LEFT - 9, y), HPos::Right, VPos::Center, &text)?;
        }
        label((i32::midpoint(LEFT, right), bottom + 32), HPos::Center, VPos::Top, &x_axis.label)?;
        upwards((18, i32::midpoint(TOP, bottom)), &y_axis.label)?;

        frame(layout.bar_left, TOP, BAR_WIDTH, layout.bar_height)?;
        let bar_right = layout.bar_left + BAR_WIDTH;
        for (bits, text) in [(0.0, "0"), (0.25, "0.25"), (0.5, "0.5"), (0.75, "0.75"), (1.0, "1")] {
            let y = TOP + layout.bar_height - 1 - along(bits, 1.0, layout.bar_height);
            line((bar_right, y), (bar_right + 5, y))?;
            label((bar_right + 8, y), HPos::Left, VPos::Center, text)?;
        }
        upwards((bar_right + 62, TOP + layout.bar_height / 2), "information (bits per cell)")?;
        frame(layout.bar_left, layout.swatch_top(), BAR_WIDTH, SWATCH)?;
        label((bar_right + 8, layout.swatch_top() + SWATCH / 2), HPos::Left, VPos::Center, "unknown")
    }

    /// Returns what a square of colour stands for.
    fn reduction(&self) -> String {
        match (self.block, self.zoom) {
            (1, 1) => "one pixel per cell".to_owned(),
            (1, zoom) => format!("{zoom} × {zoom} pixels per cell"),
            (block, _) => format!("one pixel per {block} × {block} cells: the mean of those observed"),
        }
    }
}

/// The row of squares that starts at row `first` of the grid.
fn row_of_squares<E: Encoding>(
    grid: &Grid<E>,
    cache: &mut CellCache<E>,
    first: usize,
    block: usize,
) -> Vec<Option<f64>> {
    let mut sums = vec![(0.0, 0_u32); grid.width().div_ceil(block)];
    for row in (first..first + block).filter_map(|row| grid.row(row)) {
        for ((sum, observed), cells) in sums.iter_mut().zip(row.chunks(block)) {
            let known =
                cells.iter().filter_map(|&stored| cache.cell(stored)).filter(|c| c.state() != State::Unknown);
            for cell in known {
                *sum += cell.information().widen();
                *observed += 1;
            }
        }
    }
    sums.into_iter().map(|(sum, observed)| (observed > 0).then(|| sum / f64::from(observed))).collect()
}

/// The colour of `bits` of information, in `0..=1`.
fn colour(bits: f64) -> [u8; 3] {
    colorous::VIRIDIS.eval_continuous(bits).into_array()
}

/// The colour bar, and the swatch of unknown cells.
fn paint_bar(image: &mut Bitmap, layout: &Layout) {
    let rows_of_bar = (0..layout.bar_height).map(|y| {
        let bits = f64::from(layout.bar_height - 1 - y) / f64::from(layout.bar_height - 1);
        (TOP + y, colour(bits))
    });
    let rows_of_swatch = (0..SWATCH).map(|y| (layout.swatch_top() + y, UNKNOWN));
    for (y, colour) in rows_of_bar.chain(rows_of_swatch) {
        for x in layout.bar_left..layout.bar_left + BAR_WIDTH {
            image.paint(x, y, colour);
        }
    }
}

/// The pixel of `x` on an axis of `0..=end`.
fn along(x: f64, end: f64, pixels: i32) -> i32 {
    (x / end * f64::from(pixels - 1)).round() as i32
}

/// The places of the parts of the picture, in pixels.
struct Layout {
    width: i32,
    height: i32,
    bar_left: i32,
    bar_height: i32,
    size: (u32, u32),
}

impl Layout {
    fn of(map: &HeatMap, titles: &[String; 2]) -> Self {
        let (width, height) = ((map.columns * map.zoom) as i32, (map.rows * map.zoom) as i32);
        let bar_left = LEFT + width + GAP;
        let bar_height = (height - SWATCH - 16).clamp(LEAST_BAR, 500);
        let below_top = (height + BOTTOM).max(bar_height + SWATCH + 40);
        // A character of a title is about 10 pixels wide.
        let titles = titles.iter().map(|title| title.chars().count() as i32 * 10).max().unwrap_or(0);
        let size = ((bar_left + BAR_WIDTH + RIGHT).max(LEFT + titles), TOP + below_top);
        Self { width, height, bar_left, bar_height, size: (size.0 as u32, size.1 as u32) }
    }

    fn swatch_top(&self) -> i32 {
        TOP + self.bar_height + 16
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::map::Geometry;
    use mean_information::map::encoding::Probability;

    #[test]
    fn a_square_is_the_mean_of_the_observed_cells_under_it() {
        let geometry = Geometry::new(0.2, [0.0; 2]).unwrap();
        let cells = vec![0.0, 0.5, 0.5, 0.25, 0.5, 0.5];
        let grid = Grid::<Probability<f64>>::new(3, 2, geometry, cells).unwrap();
        // H(1/4) = 2 - (3/4) log2 3.
        let information = 0.75 * libm::log2(3.0) - 1.0;
        let squares = row_of_squares(&grid, &mut CellCache::new(), 0, 2);
        assert_eq!(squares.len(), 2);
        assert!(squares[0].is_some_and(|bits| (bits - f64::midpoint(1.0, information)).abs() < 1e-15));
        assert_eq!(squares[1], None);
        assert_eq!(row_of_squares(&grid, &mut CellCache::new(), 1, 3).len(), 1);
    }

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

    #[test]
    fn at_most_2000_pixels_a_side() {
        for (width, block, columns) in [(1999, 1, 1999), (2000, 1, 2000), (2001, 2, 1001), (6001, 4, 1501)] {
            let geometry = Geometry::new(0.2, [0.0; 2]).unwrap();
            let grid = Grid::<Probability<f32>>::new(width, 2, geometry, vec![0.25; 2 * width]).unwrap();
            let map = HeatMap::of_grid(&grid, None);
            assert_eq!((map.block, map.columns, map.zoom), (block, columns, 1), "{width}");
        }
    }
}
