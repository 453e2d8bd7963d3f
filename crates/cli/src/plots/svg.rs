//! Pictures put together as SVG: plots and maps placed on one sheet.

use super::drawing::{Drawing, Picture};
use crate::failure::Failure;
use crate::output::escaped;

/// A picture of `width` x `height` pixels, without its outermost tags.
#[derive(Clone, Debug)]
pub struct Svg {
    width: u32,
    height: u32,
    body: String,
}

impl Svg {
    /// Creates an empty picture.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            body: format!(r##"<rect width="{width}" height="{height}" fill="#FFFFFF"/>"##) + "\n",
        }
    }

    /// Draws a plot as a picture.
    ///
    /// # Errors
    /// Those of drawing it.
    pub fn of_plot<D: Drawing>(plot: &D) -> Result<Self, Failure> {
        let (width, height) = D::SIZE;
        let text = String::from_utf8(plot.draw(Picture::Svg)?)
            .map_err(|_| Failure::Drawing("is not UTF-8 text".to_owned()))?;
        let inner = text.split_once('>').and_then(|(_, rest)| rest.rsplit_once("</svg>"));
        let body = inner.map(|(body, _)| body.trim_start().to_owned());
        let body = body.ok_or_else(|| Failure::Drawing("is no SVG".to_owned()))?;
        Ok(Self { width, height, body })
    }

    /// Adds an element.
    pub fn add(&mut self, element: &str) {
        self.body.push_str(element);
        self.body.push('\n');
    }

    /// Adds a line of text in the middle of `x`, its base line at `y`.
    pub fn add_text(&mut self, x: f64, y: f64, weight: &str, text: &str) {
        let text = escaped(text);
        self.add(&format!(
            r##"<text x="{x:.1}" y="{y:.1}" font-family="sans-serif" font-size="17" font-weight="{weight}" text-anchor="middle" fill="#000000">{text}</text>"##
        ));
    }

    /// Returns the element, with more attributes.
    fn element(&self, attributes: &str) -> String {
        let Self { width, height, body } = self;
        format!(
            "<svg{attributes} width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n{body}</svg>\n"
        )
    }
}

/// Pictures that make one: rows below each other in a file; on a page, as many beside each other as it is wide.
#[derive(Clone, Debug)]
pub struct Sheet {
    rows: Vec<Vec<Svg>>,
    description: String,
}

impl Sheet {
    /// Creates a sheet of rows, with a description for those who do not see them.
    pub fn new(rows: Vec<Vec<Svg>>, description: String) -> Self {
        Self { rows, description }
    }

    /// Returns the SVG file.
    pub fn file(&self) -> String {
        let size = |row: &[Svg]| {
            (
                row.iter().map(|svg| svg.width).sum::<u32>(),
                row.iter().map(|svg| svg.height).max().unwrap_or(0),
            )
        };
        let sizes: Vec<_> = self.rows.iter().map(|row| size(row)).collect();
        let width = sizes.iter().map(|&(width, _)| width).max().unwrap_or(0);
        let mut whole = Svg::new(width, sizes.iter().map(|&(_, height)| height).sum());
        let mut y = 0;
        for (row, (row_width, height)) in self.rows.iter().zip(sizes) {
            let mut x = (width - row_width) / 2;
            for picture in row {
                whole.add(&picture.element(&format!(" x=\"{x}\" y=\"{y}\"")));
                x += picture.width;
            }
            y += height;
        }
        let description = escaped(&self.description);
        whole.element(&format!(
            " xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"{description}\""
        ))
    }

    /// Returns the element of a page.
    pub fn element(&self) -> String {
        let description = escaped(&self.description);
        let row = |row: &Vec<Svg>| {
            let pictures: String = row.iter().map(|svg| svg.element("")).collect();
            format!("<div class=\"row\">\n{pictures}</div>\n")
        };
        let rows: String = self.rows.iter().map(row).collect();
        format!("<div class=\"sheet\" role=\"img\" aria-label=\"{description}\">\n{rows}</div>\n")
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_placed_and_described() {
        let mut picture = Svg::new(30, 20);
        picture.add_text(12.0, 7.5, "bold", "a < b & \"c\"");
        let rows = vec![vec![Svg::new(40, 50), Svg::new(20, 30)], vec![picture]];
        let sheet = Sheet::new(rows, "what <it> shows".to_owned());
        let file = sheet.file();
        let document = roxmltree::Document::parse(&file).unwrap();
        let root = document.root_element();
        assert_eq!((root.attribute("width"), root.attribute("height")), (Some("60"), Some("70")));
        assert_eq!(
            (root.attribute("role"), root.attribute("aria-label")),
            (Some("img"), Some("what <it> shows"))
        );
        let inner: Vec<_> = root.children().filter(|node| node.has_tag_name("svg")).collect();
        let places = inner.iter().map(|node| [node.attribute("x").unwrap(), node.attribute("y").unwrap()]);
        assert_eq!(places.collect::<Vec<_>>(), [["0", "0"], ["40", "0"], ["15", "50"]]);
        let texts: Vec<_> = root.descendants().filter(|node| node.has_tag_name("text")).collect();
        assert_eq!(texts[0].text(), Some("a < b & \"c\""));

        let element = sheet.element();
        let document = roxmltree::Document::parse(&element).unwrap();
        let root = document.root_element();
        assert_eq!(
            (root.attribute("role"), root.attribute("aria-label")),
            (Some("img"), Some("what <it> shows"))
        );
        let rows: Vec<_> = root.children().filter(|node| node.has_tag_name("div")).collect();
        let count = |row: &roxmltree::Node| row.children().filter(|node| node.has_tag_name("svg")).count();
        assert_eq!(rows.iter().map(count).collect::<Vec<_>>(), [2, 1]);
    }
}
