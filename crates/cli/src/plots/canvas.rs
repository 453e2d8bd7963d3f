//! A bitmap that plots are drawn on.
//!
//! Why not the bitmap backend of `plotters`: its text needs a font of the system or a rasteriser of outlines, whose
//! pixels depend on the font found and on the processor's vector instructions. Here glyphs come from the tables of
//! `noto-sans-mono-bitmap`, and lines are smoothed by their distance from each pixel (`+ - * /` and square roots only),
//! so that a picture has the same bytes on every machine.

use super::bitmap::Bitmap;
use noto_sans_mono_bitmap::{FontWeight, RasterHeight, RasterizedChar, get_raster, get_raster_width};
use plotters_backend::text_anchor::{HPos, VPos};
use plotters_backend::{
    BackendColor, BackendCoord, BackendStyle, BackendTextStyle, DrawingBackend, DrawingErrorKind, FontStyle,
    FontTransform,
};
use std::convert::Infallible;

type Drawn = Result<(), DrawingErrorKind<Infallible>>;

/// A picture as plotters draws on it.
pub(super) struct Canvas<'a> {
    picture: &'a mut Bitmap,
}

impl<'a> Canvas<'a> {
    /// Draws on `picture`.
    pub(super) fn new(picture: &'a mut Bitmap) -> Self {
        Self { picture }
    }

    /// Mixes `color` into the pixel, if there is one.
    fn mix(&mut self, (x, y): BackendCoord, color: BackendColor, coverage: f64) {
        let Some(pixel) = self.picture.pixel(x, y) else { return };
        let alpha = color.alpha * coverage;
        let (r, g, b) = color.rgb;
        for (old, new) in pixel.iter_mut().zip([r, g, b]) {
            *old = (f64::from(*old) * (1.0 - alpha) + f64::from(new) * alpha).round() as u8;
        }
    }

    /// Fills a shape given by the signed distance of a point from its edge, negative inside, within a box of corners.
    fn fill(&mut self, corners: [BackendCoord; 2], color: BackendColor, distance: impl Fn(f64, f64) -> f64) {
        let (width, height) = self.get_size();
        let [(left, top), (right, bottom)] = corners;
        for y in top.max(0)..=bottom.min(height as i32 - 1) {
            for x in left.max(0)..=right.min(width as i32 - 1) {
                let coverage = (0.5 - distance(f64::from(x), f64::from(y))).clamp(0.0, 1.0);
                if coverage > 0.0 {
                    self.mix((x, y), color, coverage);
                }
            }
        }
    }
}

impl DrawingBackend for Canvas<'_> {
    type ErrorType = Infallible;

    fn get_size(&self) -> (u32, u32) {
        self.picture.size()
    }

    fn ensure_prepared(&mut self) -> Drawn {
        Ok(())
    }

    fn present(&mut self) -> Drawn {
        Ok(())
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Drawn {
        self.mix(point, color, 1.0);
        Ok(())
    }

    fn draw_line<S: BackendStyle>(&mut self, from: BackendCoord, to: BackendCoord, style: &S) -> Drawn {
        let radius = f64::from(style.stroke_width()) / 2.0;
        let reach = style.stroke_width() as i32;
        let corners = [
            (from.0.min(to.0) - reach, from.1.min(to.1) - reach),
            (from.0.max(to.0) + reach, from.1.max(to.1) + reach),
        ];
        self.fill(corners, style.color(), |x, y| distance_from_segment((x, y), from, to) - radius);
        Ok(())
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Drawn {
        let mut points = path.into_iter();
        let Some(mut from) = points.next() else { return Ok(()) };
        for to in points {
            self.draw_line(from, to, style)?;
            from = to;
        }
        Ok(())
    }

    fn draw_circle<S: BackendStyle>(
        &mut self,
        center: BackendCoord,
        radius: u32,
        style: &S,
        filled: bool,
    ) -> Drawn {
        let reach = (radius + style.stroke_width()) as i32;
        let corners = [(center.0 - reach, center.1 - reach), (center.0 + reach, center.1 + reach)];
        let (radius, half_stroke) = (f64::from(radius), f64::from(style.stroke_width()) / 2.0);
        self.fill(corners, style.color(), |x, y| {
            let from_edge = distance_from_segment((x, y), center, center) - radius;
            if filled { from_edge } else { from_edge.abs() - half_stroke }
        });
        Ok(())
    }

    fn draw_text<S: BackendTextStyle>(&mut self, text: &str, style: &S, at: BackendCoord) -> Drawn {
        let font = Font::of(style);
        let (width, height) = font.size_of(text);
        let left = match style.anchor().h_pos {
            HPos::Left => 0,
            HPos::Center => -width / 2,
            HPos::Right => -width,
        };
        let top = match style.anchor().v_pos {
            VPos::Top => 0,
            VPos::Center => -height / 2,
            VPos::Bottom => -height,
        };
        for (place, c) in (0..).zip(text.chars()) {
            let glyph = font.glyph(c);
            for (y, row) in (0..).zip(glyph.iter().flat_map(RasterizedChar::rows)) {
                for (x, &coverage) in (0..).zip(row) {
                    let (dx, dy) = style.transform().transform(left + place * font.advance() + x, top + y);
                    self.mix((at.0 + dx, at.1 + dy), style.color(), f64::from(coverage) / 255.0);
                }
            }
        }
        Ok(())
    }

    fn estimate_text_size<S: BackendTextStyle>(
        &self,
        text: &str,
        style: &S,
    ) -> Result<(u32, u32), DrawingErrorKind<Infallible>> {
        let (width, height) = Font::of(style).size_of(text);
        Ok(match style.transform() {
            FontTransform::Rotate90 | FontTransform::Rotate270 => (height as u32, width as u32),
            _ => (width as u32, height as u32),
        })
    }
}

fn distance_from_segment((x, y): (f64, f64), from: BackendCoord, to: BackendCoord) -> f64 {
    let along = (f64::from(to.0 - from.0), f64::from(to.1 - from.1));
    let (dx, dy) = (x - f64::from(from.0), y - f64::from(from.1));
    let length2 = along.0 * along.0 + along.1 * along.1;
    let t = if length2 == 0.0 { 0.0 } else { ((dx * along.0 + dy * along.1) / length2).clamp(0.0, 1.0) };
    let (dx, dy) = (dx - t * along.0, dy - t * along.1);
    (dx * dx + dy * dy).sqrt()
}

/// The font at hand that is nearest to what a style asks for.
#[derive(Clone, Copy)]
struct Font {
    weight: FontWeight,
    height: RasterHeight,
}

impl Font {
    fn of<S: BackendTextStyle>(style: &S) -> Self {
        Self {
            weight: if matches!(style.style(), FontStyle::Bold) {
                FontWeight::Bold
            } else {
                FontWeight::Regular
            },
            height: if style.size() > 18.0 { RasterHeight::Size20 } else { RasterHeight::Size16 },
        }
    }

    fn advance(self) -> i32 {
        get_raster_width(self.weight, self.height) as i32
    }

    fn size_of(self, text: &str) -> (i32, i32) {
        (text.chars().count() as i32 * self.advance(), self.height.val() as i32)
    }

    fn glyph(self, c: char) -> Option<RasterizedChar> {
        get_raster(c, self.weight, self.height).or_else(|| get_raster('?', self.weight, self.height))
    }
}
