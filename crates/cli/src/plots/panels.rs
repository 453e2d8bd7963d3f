//! Maps side by side, all of one piece of the world: white is free, black is occupied, blue-grey is unknown.

use super::bitmap::Bitmap;
use super::drawing::drawing_failure;
use super::map_picture::block;
use super::svg::Svg;
use super::timed_path::{TimedPath, colour as path_colour};
use crate::failure::Failure;
use crate::output::short;
use base64::Engine;
use base64::prelude::BASE64_STANDARD;
use mean_information::Real;
use mean_information::map::{Encoding, Geometry, Grid};

const WIDTH: u32 = 900;
const GAP: f64 = 16.0;
/// The height of a title and a line of text above a map.
const TITLES: f64 = 50.0;
/// The height of the scale below a map.
const SCALE: f64 = 44.0;
/// The pixels a side, about, of a map, whose cells are drawn as squares of pixels: viewers that smooth what they enlarge
/// would blur it.
const PIXELS: usize = 1000;
/// The least length of the scale's bar, in pixels.
const LEAST_BAR: f64 = 24.0;
const UNKNOWN: [u8; 3] = [176, 190, 206];
const PATH: &str = "#BE4B00";

/// A map with its title and what is to be said of it.
#[derive(Debug)]
pub struct MapPanel {
    title: String,
    text: String,
    /// The upper row first.
    png: Vec<u8>,
    /// Left, lower, right and upper end of the map, in metres.
    extent: [f64; 4],
    /// The places of the sensor, in metres.
    places: Vec<[f64; 2]>,
    path: TimedPath,
}

impl MapPanel {
    /// Creates the panel of a grid.
    ///
    /// # Errors
    /// None is known, but for a grid without cells.
    pub fn new<E: Encoding>(grid: &Grid<E>, title: &str, text: String) -> Result<Self, Failure> {
        let size = [grid.width(), grid.height()];
        let block = block(size);
        let mut squares = Vec::new();
        for first in (0..size[1]).step_by(block) {
            for left in (0..size[0]).step_by(block) {
                let rows = (first..first + block).filter_map(|row| grid.row(row));
                let cells = rows.flat_map(|row| &row[left..(left + block).min(size[0])]);
                let known = cells.filter_map(|&stored| E::occupancy(stored).map(Real::widen));
                let (sum, count) =
                    known.filter(|&p| p != 0.5).fold((0.0, 0_u32), |(sum, count), p| (sum + p, count + 1));
                squares.push(colour((count > 0).then(|| sum / f64::from(count))));
            }
        }
        Self::of_squares(size, grid.geometry(), &squares, title, text)
    }

    /// Creates the panel of a map of `width` x `height` cells, from a colour for each square of [`block`] cells, row by row
    /// from the lowest.
    ///
    /// # Errors
    /// None is known, but for a map without cells.
    pub(super) fn of_squares(
        [width, height]: [usize; 2],
        geometry: &Geometry,
        squares: &[[u8; 3]],
        title: &str,
        text: String,
    ) -> Result<Self, Failure> {
        let block = block([width, height]);
        let [columns, rows] = [width, height].map(|cells| cells.div_ceil(block));
        let zoom = (PIXELS / columns.max(rows).max(1)).max(1);
        let mut picture = Bitmap::new((columns * zoom) as u32, (rows * zoom) as u32);
        let rows = squares.chunks(columns.max(1)).rev().flat_map(|row| std::iter::repeat_n(row, zoom));
        for (y, row) in (0..).zip(rows) {
            for (column, &colour) in row.iter().enumerate() {
                for x in column * zoom..(column + 1) * zoom {
                    picture.paint(x as i32, y, colour);
                }
            }
        }
        let (side, [left, lower]) = (geometry.resolution(), geometry.origin());
        let extent = [left, lower, left + width as f64 * side, lower + height as f64 * side];
        let png = picture.png().map_err(drawing_failure)?;
        Ok(Self {
            title: title.to_owned(),
            text,
            png,
            extent,
            places: Vec::new(),
            path: TimedPath::default(),
        })
    }

    /// Marks where the sensor was.
    #[must_use]
    pub fn with_places(self, places: Vec<[f64; 2]>) -> Self {
        Self { places, ..self }
    }

    /// Draws the path of the sensor; the first position has a dot, some others have one with their time.
    #[must_use]
    pub fn with_path(self, path: TimedPath) -> Self {
        Self { path, ..self }
    }
}

/// Returns the grey of an occupancy; `None` and 1/2 are unknown.
pub(super) fn colour(occupancy: Option<f64>) -> [u8; 3] {
    match occupancy {
        Some(p) if p != 0.5 => [(255.0 * (1.0 - p)).round() as u8; 3],
        _ => UNKNOWN,
    }
}

/// Draws the panels in rows of `columns`, each with a scale.
pub fn panels(panels: &[MapPanel], columns: usize) -> Vec<Vec<Svg>> {
    let ends =
        |k: usize, first: f64, of: fn(f64, f64) -> f64| panels.iter().map(|p| p.extent[k]).fold(first, of);
    let [left, lower] = [0, 1].map(|k| ends(k, f64::INFINITY, f64::min));
    let [right, upper] = [2, 3].map(|k| ends(k, f64::NEG_INFINITY, f64::max));
    let world = [left, lower, right, upper];
    let width = WIDTH / columns as u32;
    panels.chunks(columns).map(|row| row.iter().map(|panel| panel.draw(world, width)).collect()).collect()
}

impl MapPanel {
    /// Draws the panel with this part of the world, in metres.
    fn draw(&self, [left, lower, right, upper]: [f64; 4], whole_width: u32) -> Svg {
        let width = f64::from(whole_width) - GAP;
        let x = GAP / 2.0;
        // Pixels per metre.
        let scale = width / (right - left);
        let height = scale * (upper - lower);
        let mut sheet = Svg::new(whole_width, (TITLES + height + SCALE) as u32);
        sheet.add_text(x + width / 2.0, 20.0, "bold", &self.title);
        sheet.add_text(x + width / 2.0, 42.0, "normal", &self.text);
        let [r, g, b] = UNKNOWN;
        sheet.add(&format!(
            r#"<rect x="{x:.2}" y="{TITLES:.2}" width="{width:.2}" height="{height:.2}" fill="rgb({r},{g},{b})"/>"#
        ));
        let at = |[px, py]: [f64; 2]| [x + scale * (px - left), TITLES + scale * (upper - py)];
        let ([image_x, image_y], [far_x, far_y]) =
            (at([self.extent[0], self.extent[3]]), at([self.extent[2], self.extent[1]]));
        sheet.add(&format!(
            r#"<image x="{image_x:.2}" y="{image_y:.2}" width="{:.2}" height="{:.2}" preserveAspectRatio="none" style="image-rendering:pixelated" href="data:image/png;base64,{}"/>"#,
            far_x - image_x,
            far_y - image_y,
            BASE64_STANDARD.encode(&self.png)
        ));
        let dot = |[px, py]: [f64; 2]| format!(r#"<circle cx="{px:.2}" cy="{py:.2}" r="5" fill="{PATH}"/>"#);
        for place in self.places.iter().map(|&place| at(place)) {
            sheet.add(&dot(place));
        }
        self.draw_path(&mut sheet, at);
        let y = TITLES + height + GAP;
        let metres = round_length(LEAST_BAR / scale);
        let bar = scale * metres;
        sheet.add(&format!(
            r##"<path d="M{x} {:.2}v10M{x} {y:.2}h{bar:.2}m0 -5v10" stroke="#000000" fill="none"/>"##,
            y - 5.0
        ));
        // The text is set about its middle; a digit is about 10 pixels wide.
        let text = format!("{} m", short(metres));
        sheet.add_text(x + bar + 9.0 + 5.0 * text.len() as f64, y + 6.0, "normal", &text);
        if !self.places.is_empty() {
            sheet.add(&dot([x + width - 62.0, y]));
            sheet.add_text(x + width - 26.0, y + 6.0, "normal", "robot");
        }
        sheet
    }

    /// Draws the path of the sensor; `at` has the place of a position on the sheet.
    fn draw_path(&self, sheet: &mut Svg, at: impl Fn([f64; 2]) -> [f64; 2]) {
        let css = |[r, g, b]: [u8; 3]| format!("rgb({r},{g},{b})");
        for (colour, positions) in self.path.pieces() {
            let points: Vec<_> = positions.into_iter().map(&at).collect();
            let points: Vec<_> = points.iter().map(|[px, py]| format!("{px:.1},{py:.1}")).collect();
            sheet.add(&format!(
                r#"<polyline points="{}" fill="none" stroke="{}" stroke-linejoin="round"/>"#,
                points.join(" "),
                css(colour)
            ));
        }
        let dark = css(path_colour(0.0));
        let dot = |[px, py]: [f64; 2], radius: f64| {
            format!(r#"<circle cx="{px:.2}" cy="{py:.2}" r="{radius}" fill="{dark}"/>"#)
        };
        if let Some(first) = self.path.first() {
            sheet.add(&dot(at(first), 4.0));
        }
        for (position, text) in self.path.dots() {
            let [px, py] = at(position);
            sheet.add(&dot([px, py], 2.5));
            // A rim of white, so that the time can be read on any colour.
            sheet.add(&format!(
                r#"<text x="{:.1}" y="{:.1}" font-family="sans-serif" font-size="13" fill="{dark}" stroke="rgb(255,255,255)" stroke-width="3" paint-order="stroke">{text}</text>"#,
                px + 5.0,
                py + 4.5
            ));
        }
    }
}

/// Returns the least of 1, 2, 5, 10, 20, 50, ... that is not below `least`, in metres.
fn round_length(least: f64) -> f64 {
    let decades = std::iter::successors(Some(1.0), |decade| Some(decade * 10.0)).take(300);
    decades
        .flat_map(|decade| [decade, 2.0 * decade, 5.0 * decade])
        .find(|&length| length >= least)
        .unwrap_or(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plots::Sheet;
    use mean_information::map::encoding::Probability;

    /// Two maps of one world: each image lies where its map does, on the same scale.
    #[test]
    fn maps_lie_where_they_are() {
        let map = |origin, width: usize| {
            let geometry = Geometry::new(0.5, origin).unwrap();
            let cells = vec![0.25; width * 2];
            let grid = Grid::<Probability<f64>>::new(width, 2, geometry, cells).unwrap();
            MapPanel::new(&grid, "a map", "of cells".to_owned()).unwrap()
        };
        let rows = panels(&[map([1.0, 2.0], 4).with_places(vec![[2.0, 2.5]]), map([3.0, 1.0], 6)], 2);
        let text = Sheet::new(rows, "two maps".to_owned()).file();
        let document = roxmltree::Document::parse(&text).unwrap();
        let number =
            |node: &roxmltree::Node, name: &str| node.attribute(name).unwrap().parse::<f64>().unwrap();
        let nodes = |tag: &'static str| document.descendants().filter(move |node| node.has_tag_name(tag));
        let images: Vec<_> = nodes("image").collect();
        // The world is 5 m by 2 m, in panels of 434 pixels: 86.8 pixels per metre.
        let scale = (f64::from(WIDTH) / 2.0 - GAP) / 5.0;
        for (image, [x, y, width]) in images.iter().zip([[0.0, 0.0, 2.0], [2.0, 1.0, 3.0]]) {
            for (name, expected) in [
                ("x", GAP / 2.0 + x * scale),
                ("y", TITLES + y * scale),
                ("width", width * scale),
                ("height", scale),
            ] {
                assert!((number(image, name) - expected).abs() <= 0.011, "{name} {}", number(image, name));
            }
        }
        assert_eq!(nodes("svg").skip(1).map(|svg| number(&svg, "x")).collect::<Vec<_>>(), [0.0, 450.0]);
        let circle = nodes("circle").next().unwrap();
        assert!((number(&circle, "cx") - GAP / 2.0 - scale).abs() <= 0.01);
        assert!((number(&circle, "cy") - TITLES - scale / 2.0).abs() <= 0.01);
        assert!(images[0].attribute("href").unwrap().starts_with("data:image/png;base64,iVBOR"));
    }

    #[test]
    fn bars_are_round_and_long_enough() {
        let lengths = [0.01, 1.0, 1.1, 4.0, 5.5, 31.0, 199.0].map(round_length);
        assert_eq!(lengths, [1.0, 1.0, 2.0, 5.0, 10.0, 50.0, 200.0]);
    }

    #[test]
    fn unknown_is_no_grey() {
        assert_eq!(colour(Some(0.0)), [255; 3]);
        assert_eq!(colour(Some(1.0)), [0; 3]);
        assert_eq!(colour(Some(0.5_f64.next_up())), [127; 3]);
        assert_eq!((colour(Some(0.5)), colour(None)), (UNKNOWN, UNKNOWN));
    }
}
