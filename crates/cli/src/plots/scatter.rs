//! Points of several kinds in a plane.

use super::chart::{Colour, Scale};
use super::drawing::{Drawing, LABEL};
use super::frame::{Side, frame};
use plotters::coord::Shift;
use plotters::prelude::*;

/// Narrow enough for its letters to be read on a telephone.
const SIZE: (u32, u32) = (640, 460);
/// The margin about the points, as a part of their span.
const MARGIN: f64 = 0.04;
/// The radius of a point, in pixels.
const RADIUS: i32 = 4;

/// Points against two axes, with a legend beside them.
#[derive(Debug)]
pub struct Scatter {
    /// The title.
    pub title: String,
    /// The title of the horizontal axis.
    pub horizontal: String,
    /// The scale of that axis.
    pub scale: Scale,
    /// The title of the vertical axis.
    pub vertical: String,
    /// The points by kinds; at least one point among them.
    pub clouds: Vec<Cloud>,
}

/// Points of one kind.
#[derive(Debug)]
pub struct Cloud {
    /// The name in the legend.
    pub name: String,
    /// The colour.
    pub colour: Colour,
    /// True if points are filled, false if they are rings.
    pub filled: bool,
    /// The points.
    pub points: Vec<(f64, f64)>,
}

impl Drawing for Scatter {
    const SIZE: (u32, u32) = SIZE;

    fn title(&self) -> String {
        self.title.clone()
    }

    fn draw_below_title<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let all = || self.clouds.iter().flat_map(|cloud| &cloud.points);
        let horizontal = self.scale.axis(all().map(|&(x, _)| self.scale.place(x)), MARGIN);
        let vertical = Scale::Linear.axis(all().map(|&(_, y)| y), MARGIN);
        let (width, _) = paper.dim_in_pixel();
        let (plot, legend) = paper.split_horizontally(width - 112);
        let mut chart = frame(
            &plot,
            Side { axis: horizontal, title: &self.horizontal, label: &|place| self.scale.label(place) },
            Side { axis: vertical, title: &self.vertical, label: &|place| Scale::Linear.label(place) },
        )?;
        for (at, cloud) in (0..).zip(&self.clouds) {
            let style = |colour: RGBColor| {
                if cloud.filled { colour.filled() } else { colour.stroke_width(2) }
            };
            let style = style(cloud.colour.rgb());
            let points = cloud.points.iter().map(|&(x, y)| (self.scale.place(x), y));
            chart.draw_series(points.map(|point| Circle::new(point, RADIUS, style)))?;
            let line = 40 + 24 * at;
            legend.draw(&Circle::new((4, line), RADIUS, style))?;
            let label = LABEL.into_font().color(&BLACK);
            legend.draw(&Text::new(cloud.name.clone(), (14, line - 8), label))?;
        }
        Ok(())
    }
}
