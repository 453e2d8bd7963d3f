//! Pictures put together as SVG: plots and maps placed on one sheet.

use super::{Drawing, Picture};
use crate::failure::Failure;

/// A picture of so many pixels, without its outermost tags.
#[derive(Clone, Debug)]
pub struct Svg {
    width: u32,
    height: u32,
    body: String,
}

impl Svg {
    /// An empty sheet.
    pub fn new(width: u32, height: u32) -> Self {
        Self {
            width,
            height,
            body: format!(r##"<rect width="{width}" height="{height}" fill="#FFFFFF"/>"##) + "\n",
        }
    }

    /// A plot.
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

    /// Pictures below each other.
    pub fn stacked(pictures: &[Self]) -> Self {
        let width = pictures.iter().map(|picture| picture.width).max().unwrap_or(0);
        let mut sheet = Self::new(width, pictures.iter().map(|picture| picture.height).sum());
        let mut top = 0;
        for picture in pictures {
            sheet.place(picture, 0, top);
            top += picture.height;
        }
        sheet
    }

    /// Puts a picture on the sheet.
    pub fn place(&mut self, picture: &Self, x: u32, y: u32) {
        let Self { width, height, body } = picture;
        self.add(&format!(
            "<svg x=\"{x}\" y=\"{y}\" width=\"{width}\" height=\"{height}\" viewBox=\"0 0 {width} {height}\">\n{body}</svg>"
        ));
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

    /// The file, or the element of a page, with a description for those who do not see it.
    pub fn document(&self, description: &str) -> String {
        let Self { width, height, body } = self;
        let description = escaped(description);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{width}\" height=\"{height}\" \
             viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{description}\">\n{body}</svg>\n"
        )
    }
}

/// The text with the characters of markup escaped, for XML and HTML, within elements and attributes.
pub fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pictures_are_placed_and_described() {
        let mut picture = Svg::new(30, 20);
        picture.add_text(12.0, 7.5, "bold", "a < b & \"c\"");
        let sheet = Svg::stacked(&[Svg::new(40, 50), picture]);
        let text = sheet.document("what <it> shows");
        let document = roxmltree::Document::parse(&text).unwrap();
        let root = document.root_element();
        assert_eq!((root.attribute("width"), root.attribute("height")), (Some("40"), Some("70")));
        assert_eq!(
            (root.attribute("role"), root.attribute("aria-label")),
            (Some("img"), Some("what <it> shows"))
        );
        let inner: Vec<_> = root.children().filter(|node| node.has_tag_name("svg")).collect();
        assert_eq!((inner.len(), inner[1].attribute("y")), (2, Some("50")));
        let texts: Vec<_> = root.descendants().filter(|node| node.has_tag_name("text")).collect();
        assert_eq!(texts[0].text(), Some("a < b & \"c\""));
    }
}
