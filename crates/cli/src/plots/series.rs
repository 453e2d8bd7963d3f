//! Mean information and observed area of a bag's maps against time.

use super::axis::Axis;
use super::chart::Colour;
use super::drawing::Drawing;
use super::frame::{LEGEND_ROOM, Side, curve, frame, legend};
use super::marks::{Marks, Shape};
use super::scale::round_step;
use crate::output::short;
use crate::series::Series;
use mean_information_files::trajectory::seconds;
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (900, 780);
/// The most maps that have dots of their own.
const DOTS: usize = 60;

/// Two panels over one axis of time.
#[derive(Debug)]
pub struct SeriesPlot {
    title: String,
    /// Seconds after the first map.
    last: f64,
    /// Of each map that has one.
    mean_information: Vec<(f64, f64)>,
    /// In square metres.
    area: Vec<(f64, f64)>,
}

impl SeriesPlot {
    /// Creates the plot of `series`.
    pub fn new(series: &Series, title: String) -> Self {
        // From the least, as clocks may be set back.
        let first = series.rows.iter().map(|row| row.time_ns).min().unwrap_or(0);
        let rows = || series.rows.iter().map(|row| (seconds(row.time_ns - first), row));
        Self {
            title,
            last: rows().map(|(time, _)| time).fold(0.0, f64::max),
            mean_information: rows()
                .filter_map(|(time, row)| Some((time, row.measures.mean_information?.widen())))
                .collect(),
            area: rows()
                .filter_map(|(time, row)| Some((time, row.measures.observed_area(Some(row.resolution))?)))
                .collect(),
        }
    }

    /// Draws one panel.
    fn draw_half<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        axis: Axis,
        [title, label]: [&str; 2],
        colour: RGBColor,
        points: &[(f64, f64)],
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let time = ticks(self.last);
        let horizontal = Axis { range: -0.02 * time.range.end..1.02 * time.range.end, ticks: time.ticks };
        let mut chart = frame(
            area,
            Side { axis: horizontal, title: "time after the first map (s)", label: &short },
            Side { axis, title, label: &short },
        )?;
        let marks = if points.len() <= DOTS { Marks::Each(Shape::Circle) } else { Marks::None };
        curve(&mut chart, label, colour, marks, points)?;
        legend(&mut chart)
    }
}

/// Returns an axis from 0 to at least `end`, with at most six ticks in steps of 1, 2 or 5 times a power of ten.
fn ticks(end: f64) -> Axis {
    let end = if end > 0.0 && end.is_finite() { end } else { 1.0 };
    let step = round_step(end);
    let count = (end / step).ceil();
    Axis { range: 0.0..count * step, ticks: (0..=count as u32).map(|k| f64::from(k) * step).collect() }
}

impl Drawing for SeriesPlot {
    const SIZE: (u32, u32) = SIZE;

    fn title(&self) -> String {
        self.title.clone()
    }

    fn draw_below_title<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let (upper, lower) = paper.split_vertically(SIZE.1 as i32 / 2 - 26);
        let words = ["mean information (bits / cell)", "mean information of the observed cells"];
        self.draw_half(&upper, Axis::of_bits(), words, Colour::Blue.rgb(), &self.mean_information)?;
        let Axis { range, ticks } = ticks(self.area.iter().map(|&(_, area)| area).fold(0.0, f64::max));
        let area = Axis { range: 0.0..(1.0 + LEGEND_ROOM) * range.end, ticks };
        let words = ["observed area (m²)", "area of the observed cells"];
        self.draw_half(&lower, area, words, Colour::Orange.rgb(), &self.area)
    }
}
