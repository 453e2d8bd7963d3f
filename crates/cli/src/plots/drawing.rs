//! How a plot becomes a picture: white paper, a title in bold, what the plot draws below it; as SVG or as PNG.

use super::bitmap::Bitmap;
use super::canvas::Canvas;
use crate::failure::Failure;
use crate::output::escaped;
use mean_information_report::one_line;
use plotters::coord::Shift;
use plotters::prelude::*;
use std::ffi::OsStr;
use std::path::Path;

/// The form of a picture.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Picture {
    /// Scalable, with text as text.
    Svg,
    /// Pixels.
    Png,
}

impl Picture {
    /// Returns the form that the name of a file asks for.
    ///
    /// # Errors
    /// A name that ends neither in `.svg` nor in `.png`.
    pub fn by_name(path: &Path) -> Result<Self, Failure> {
        match path.extension().map(OsStr::to_ascii_lowercase) {
            Some(ending) if ending == "svg" => Ok(Self::Svg),
            Some(ending) if ending == "png" => Ok(Self::Png),
            _ => Err(Failure::Usage(format!("{}: a picture's name ends in .svg or .png", path.display()))),
        }
    }
}

/// A plot, drawn the same way whatever the form of the picture.
pub trait Drawing {
    /// The width and the height, in pixels.
    const SIZE: (u32, u32);

    /// Returns the title.
    fn title(&self) -> String;

    /// Draws all but the title on the paper below it.
    ///
    /// # Errors
    /// Those of the paper.
    fn draw_below_title<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>>;

    /// Draws the whole plot on white paper.
    ///
    /// # Errors
    /// Those of the paper.
    fn draw_on<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        paper.fill(&WHITE)?;
        self.draw_below_title(&paper.titled(&self.title(), TITLE.into_font().color(&BLACK))?)
    }

    /// Returns the bytes of the picture.
    ///
    /// # Errors
    /// None is known.
    fn draw(&self, picture: Picture) -> Result<Vec<u8>, Failure> {
        match picture {
            Picture::Svg => {
                let mut text = String::new();
                self.draw_on(&SVGBackend::with_string(&mut text, Self::SIZE).into_drawing_area())
                    .map_err(drawing_failure)?;
                // For those who do not see it, in a page that does not describe it.
                let label = escaped(&self.title());
                Ok(text
                    .replacen("<svg ", &format!("<svg role=\"img\" aria-label=\"{label}\" "), 1)
                    .into_bytes())
            }
            Picture::Png => {
                let mut picture = Bitmap::new(Self::SIZE.0, Self::SIZE.1);
                self.draw_on(&Canvas::new(&mut picture).into_drawing_area()).map_err(drawing_failure)?;
                picture.png().map_err(drawing_failure)
            }
        }
    }
}

/// Refuses the name of a heat map that does not end in `.png`.
///
/// # Errors
/// Such a name.
pub fn require_png(path: &Path) -> Result<(), Failure> {
    match Picture::by_name(path) {
        Ok(Picture::Png) => Ok(()),
        _ => Err(Failure::Usage(format!("{}: the name of a heat map ends in .png", path.display()))),
    }
}

/// Refuses the name of a picture with text as text that does not end in `.svg`.
///
/// # Errors
/// Such a name.
pub fn require_svg(path: &Path) -> Result<(), Failure> {
    match Picture::by_name(path) {
        Ok(Picture::Svg) => Ok(()),
        _ => Err(Failure::Usage(format!("{}: the name of this picture ends in .svg", path.display()))),
    }
}

/// Returns what a picture calls a map: the name of its file, as much of it as fits and without the two characters that
/// XML cannot hold.
pub fn title(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let name = one_line(&name).replace(['\u{fffe}', '\u{ffff}'], "?");
    match name.char_indices().nth(48) {
        Some((end, _)) => name[..end].to_owned() + "...",
        None => name,
    }
}

/// The font of labels; pictures of pixels have that of [`Canvas`] instead.
pub(super) const LABEL: (&str, i32) = ("sans-serif", 17);
/// The font of titles.
pub(super) const TITLE: (&str, i32, FontStyle) = ("sans-serif", 21, FontStyle::Bold);

/// Wraps an error of drawing into memory, which fails only where a plot has no room, and its caller prevents that.
pub(super) fn drawing_failure(error: impl std::fmt::Display) -> Failure {
    Failure::Drawing(error.to_string())
}
