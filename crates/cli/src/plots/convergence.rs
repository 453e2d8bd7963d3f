//! Mean information of grids against cell size, with the limits and the proved bands about them: Fig. 5 of the paper, for
//! both kinds of grid.

use super::axis::Axis;
use super::chart::Colour;
use super::drawing::Drawing;
use super::frame::{Side, curve, frame, legend};
use super::marks::{Marks, Shape};
use super::scale::{logarithmic_ticks, round_step};
use crate::convergence::{Convergence, GridKind, Series};
use crate::output::short;
use plotters::coord::Shift;
use plotters::prelude::*;

/// Narrow enough for its letters to be read on a telephone.
const SIZE: (u32, u32) = (720, 560);
/// The part of the vertical axis above the curves, where the legend meets none.
const LEGEND_ROOM: f64 = 0.45;

/// A plot of one panel, the cell size on a logarithmic axis.
#[derive(Debug)]
pub struct ConvergencePlot<'a> {
    convergence: &'a Convergence,
}

impl<'a> ConvergencePlot<'a> {
    /// Creates the plot of `convergence`.
    pub fn new(convergence: &'a Convergence) -> Self {
        Self { convergence }
    }

    /// Returns the cell sizes of all rows as decimal logarithms, from the smallest.
    fn logarithms(&self) -> Vec<f64> {
        let rows = self.convergence.series.iter().flat_map(|series| &series.rows);
        let mut logarithms: Vec<f64> = rows.map(|row| libm::log10(row.resolution)).collect();
        logarithms.sort_by(f64::total_cmp);
        logarithms.dedup();
        logarithms
    }

    fn horizontal(&self) -> Axis {
        let logarithms = self.logarithms();
        let (first, last) = (logarithms[0], logarithms[logarithms.len() - 1]);
        let margin = 0.03 * (last - first) + 0.02;
        let range = first - margin..last + margin;
        Axis { ticks: logarithmic_ticks(&(range.start..=range.end)), range }
    }

    /// Returns the axis from below the lowest value and limit to above the highest, in steps of 1, 2 or 5 times a power of
    /// ten, but no tick above 1, which nothing exceeds; the bands are cut to the ticks.
    fn vertical(&self) -> Axis {
        let of_series = |series: &Series| {
            series.rows.iter().map(|row| row.mean_information).chain([series.limit]).collect::<Vec<_>>()
        };
        let values: Vec<f64> = self.convergence.series.iter().flat_map(of_series).collect();
        let low = values.iter().copied().fold(f64::INFINITY, f64::min);
        let high = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
        let span = (high - low).max(1e-3);
        let step = round_step(span);
        let (first, last) =
            ((low / step - 0.3).floor(), (high / step + 0.3).ceil().min((1.0 / step).round()));
        let ticks = (first as i64..=last as i64).map(|n| n as f64 * step).collect();
        Axis { range: first * step..(last + LEGEND_ROOM * (last - first)) * step, ticks }
    }
}

fn colour(kind: GridKind) -> RGBColor {
    match kind {
        GridKind::Polar => Colour::Blue.rgb(),
        GridKind::Cartesian => Colour::Orange.rgb(),
    }
}

/// Returns the mark of a kind of grid, by which it is told without its colour.
fn shape(kind: GridKind) -> Shape {
    match kind {
        GridKind::Polar => Shape::Circle,
        GridKind::Cartesian => Shape::Square,
    }
}

impl Drawing for ConvergencePlot<'_> {
    const SIZE: (u32, u32) = SIZE;

    fn title(&self) -> String {
        let Convergence { range, sigma, .. } = *self.convergence;
        format!("A circular room: range {} m, sigma {} m", short(range), short(sigma))
    }

    fn draw_below_title<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let (horizontal, vertical) = (self.horizontal(), self.vertical());
        let ends = [horizontal.range.start, horizontal.range.end];
        // The legend has the room above the ticks.
        let highest = vertical.ticks.last().map_or(vertical.range.end, |&tick| tick);
        let inside = |y: f64| y.clamp(vertical.range.start, highest);
        let mut chart = frame(
            paper,
            Side {
                axis: horizontal,
                title: "cell size (m)",
                label: &|logarithm| short(libm::exp10(logarithm)),
            },
            Side { axis: vertical.clone(), title: "mean information (bits / cell)", label: &short },
        )?;
        for series in &self.convergence.series {
            let above = series.band.iter().map(|&(x, bound)| (x, inside(series.limit + bound)));
            let below = series.band.iter().rev().map(|&(x, bound)| (x, inside(series.limit - bound)));
            chart.draw_series([Polygon::new(
                above.chain(below).collect::<Vec<_>>(),
                colour(series.kind).mix(0.12),
            )])?;
        }
        for series in &self.convergence.series {
            let colour = colour(series.kind);
            let limit = ends.map(|x| (x, series.limit));
            chart
                .draw_series(DashedLineSeries::new(limit, 9, 6, colour.stroke_width(2)))?
                .label(format!(
                    "limit of {} grids: {:.6}, with the proved band",
                    series.kind.adjective(),
                    series.limit
                ))
                .legend(move |at| {
                    EmptyElement::at(at)
                        + Rectangle::new([(0, -6), (20, 6)], colour.mix(0.12).filled())
                        + PathElement::new([(0, 0), (8, 0)], colour.stroke_width(2))
                        + PathElement::new([(12, 0), (20, 0)], colour.stroke_width(2))
                });
            let mut points: Vec<_> =
                series.rows.iter().map(|row| (libm::log10(row.resolution), row.mean_information)).collect();
            points.sort_by(|a, b| a.0.total_cmp(&b.0));
            let marks = Marks::Each(shape(series.kind));
            curve(&mut chart, &format!("{} grid", series.kind.adjective()), colour, marks, &points)?;
        }
        legend(&mut chart)
    }
}
