//! What the plots of curves share: the frame with its axes, the curves, the legend.

use super::axis::Axis;
use super::drawing::LABEL;
use super::marks::{Marks, Shape};
use plotters::coord::Shift;
use plotters::prelude::*;

/// The part of an axis above its highest tick, where the legend of one curve meets it not.
pub(super) const LEGEND_ROOM: f64 = 0.2;

impl Axis {
    /// Returns the axis of a mean information, which is from 0 to 1 bit, with room for a legend.
    pub(super) fn of_bits() -> Self {
        Self { range: 0.0..1.0 + LEGEND_ROOM, ticks: vec![0.0, 0.2, 0.4, 0.6, 0.8, 1.0] }
    }
}

/// A side of the frame: its axis, with a title and labels.
pub(super) struct Side<'a> {
    pub(super) axis: Axis,
    pub(super) title: &'a str,
    pub(super) label: &'a dyn Fn(f64) -> String,
}

pub(super) type Frame<'a, B> = ChartContext<'a, B, Cartesian2d<Axis, Axis>>;
pub(super) type BackendError<E> = DrawingAreaErrorKind<E>;

/// Draws the frame, its axes and the lines at their ticks.
pub(super) fn frame<'a, B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    horizontal: Side,
    vertical: Side,
) -> Result<Frame<'a, B>, BackendError<B::ErrorType>> {
    let mut frame = ChartBuilder::on(area)
        .margin(12)
        .margin_right(28)
        .set_label_area_size(LabelAreaPosition::Left, 104)
        .set_label_area_size(LabelAreaPosition::Bottom, 56)
        .build_cartesian_2d(horizontal.axis, vertical.axis)?;
    frame
        .configure_mesh()
        .max_light_lines(0)
        .bold_line_style(RGBColor(220, 220, 220))
        .axis_style(BLACK)
        .label_style(LABEL)
        .axis_desc_style(LABEL)
        .x_desc(horizontal.title)
        .y_desc(vertical.title)
        .x_label_formatter(&|x| (horizontal.label)(*x))
        .y_label_formatter(&|y| (vertical.label)(*y))
        .draw()?;
    Ok(frame)
}

/// Draws a line through the points, with its marks, and its line in the legend, if it has a name.
pub(super) fn curve<'a, B: DrawingBackend + 'a>(
    frame: &mut Frame<'a, B>,
    name: &str,
    colour: RGBColor,
    marks: Marks,
    points: &[(f64, f64)],
) -> Result<(), BackendError<B::ErrorType>> {
    let is_line = marks != Marks::Alone;
    let connected = points.iter().copied().filter(|_| is_line);
    let line = frame.draw_series(LineSeries::new(connected, colour.stroke_width(2)))?;
    if !name.is_empty() {
        line.label(name).legend(move |at| {
            EmptyElement::at(at)
                + PathElement::new(
                    if is_line { vec![(0, 0), (20, 0)] } else { vec![] },
                    colour.stroke_width(2),
                )
                + Circle::new((10, 0), if marks.is_dotted() { 4 } else { 0 }, colour.filled())
                + Polygon::new(marks.outline((10, 0)), colour.filled())
        });
    }
    let marked = |point| EmptyElement::at(point) + Polygon::new(marks.outline((0, 0)), colour.filled());
    match marks {
        Marks::None => {}
        Marks::Each(Shape::Circle) | Marks::Alone => {
            frame.draw_series(points.iter().map(|&point| Circle::new(point, 4, colour.filled())))?;
        }
        Marks::Each(_) => frame.draw_series(points.iter().copied().map(marked)).map(drop)?,
        Marks::Spaced(shape) => frame.draw_series(shape.spaced(points).map(marked)).map(drop)?,
    }
    Ok(())
}

/// Draws the names of the curves in the upper right corner.
pub(super) fn legend<'a, B: DrawingBackend + 'a>(
    frame: &mut Frame<'a, B>,
) -> Result<(), BackendError<B::ErrorType>> {
    frame
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE)
        .border_style(RGBColor(160, 160, 160))
        .label_font(LABEL)
        .draw()
}
