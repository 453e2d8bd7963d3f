//! Pictures: the information of every cell, and the measures against cell size. Drawn into memory, with the same bytes
//! on every run and machine.

mod axis;
mod bitmap;
mod canvas;
mod cell_cache;
mod chart;
mod convergence;
mod frame;
mod heat_map;
mod panels;
mod scale;
mod svg;
mod sweep;

pub use chart::{Chart, Colour, Curve, Panel, Scale};
pub use convergence::ConvergencePlot;
pub use heat_map::HeatMap;
pub use panels::{MapPanel, panels};
pub use svg::{Sheet, Svg, escaped};
pub use sweep::SweepPlot;

use crate::failure::Failure;
use crate::one_line::one_line;
use bitmap::Bitmap;
use canvas::Canvas;
use plotters::coord::Shift;
use plotters::prelude::{DrawingArea, DrawingAreaErrorKind, DrawingBackend, IntoDrawingArea, SVGBackend};
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
    /// The form that the name of a file asks for.
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
    /// Width and height, in pixels.
    const SIZE: (u32, u32);

    /// Draws it.
    ///
    /// # Errors
    /// Those of the paper it is drawn on.
    fn draw_on<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>>;

    /// The bytes of the picture.
    ///
    /// # Errors
    /// None is known.
    fn draw(&self, picture: Picture) -> Result<Vec<u8>, Failure> {
        match picture {
            Picture::Svg => {
                let mut text = String::new();
                self.draw_on(&SVGBackend::with_string(&mut text, Self::SIZE).into_drawing_area())
                    .map_err(drawing_failure)?;
                Ok(text.into_bytes())
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

/// What a picture calls a map: the name of its file, as much of it as fits and without the two characters that XML
/// cannot hold.
pub fn title(path: &Path) -> String {
    let name = path.file_name().unwrap_or(path.as_os_str()).to_string_lossy();
    let name = one_line(&name).replace(['\u{fffe}', '\u{ffff}'], "?");
    match name.char_indices().nth(48) {
        Some((end, _)) => name[..end].to_owned() + "...",
        None => name,
    }
}

/// The fonts of labels and of titles; pictures of pixels have [`canvas`]'s instead.
const LABEL: (&str, i32) = ("sans-serif", 17);
const TITLE: (&str, i32, plotters::style::FontStyle) = ("sans-serif", 21, plotters::style::FontStyle::Bold);

/// Drawing into memory fails only where a plot has no room, which its caller prevents.
fn drawing_failure(error: impl std::fmt::Display) -> Failure {
    Failure::Drawing(error.to_string())
}
