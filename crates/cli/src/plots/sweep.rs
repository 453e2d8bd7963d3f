//! Mean information and total entropy against cell size: the contrast behind Fig. 2d of the paper.

use super::axis::{Axis, power_of_ten};
use super::chart::Colour;
use super::drawing::Drawing;
use super::frame::{LEGEND_ROOM, Side, curve, frame, legend};
use super::marks::{Marks, Shape};
use crate::output::short;
use mean_information_report::sweep::{Step, Sweep};
use plotters::coord::Shift;
use plotters::prelude::*;

const SIZE: (u32, u32) = (900, 780);
const MEAN_INFORMATION: RGBColor = Colour::Blue.rgb();
const ENTROPY: RGBColor = Colour::Orange.rgb();

/// Two panels over one axis of cell sizes, which doubles from tick to tick.
#[derive(Debug)]
pub struct SweepPlot {
    title: String,
    cell_axis: String,
    cell_sizes: Vec<String>,
    /// The mean information of each step, in bits per observed cell.
    mean_information: Vec<(f64, f64)>,
    /// The entropy of each step, as the decimal logarithm of bits.
    entropy: Vec<(f64, f64)>,
    entropy_label: &'static str,
}

/// A curve, and its vertical axis.
struct Half<'a> {
    axis: Axis,
    axis_label: &'a str,
    label: &'a str,
    colour: RGBColor,
    points: &'a [(f64, f64)],
    tick_label: &'a dyn Fn(f64) -> String,
}

impl SweepPlot {
    /// Creates the plot of `sweep`.
    pub fn new(sweep: &Sweep, map: &str) -> Self {
        let size = |step: &Step| short(sweep.cell_size(step).unwrap_or(step.k as f64));
        let steps = || (0_u32..).map(f64::from).zip(&sweep.steps);
        let bits = |step: &Step| step.measures.entropy.widen();
        let some_zero = sweep.steps.iter().any(|step| bits(step) == 0.0);
        Self {
            title: format!("{map}: mean information and entropy by cell size"),
            cell_axis: match sweep.resolution {
                Some(_) => "cell size (m)".to_owned(),
                None => "cell size (cells of the map)".to_owned(),
            },
            cell_sizes: sweep.steps.iter().map(size).collect(),
            mean_information: steps()
                .filter_map(|(x, step)| Some((x, step.measures.mean_information?.widen())))
                .collect(),
            entropy: steps()
                .filter(|(_, step)| bits(step) > 0.0)
                .map(|(x, step)| (x, libm::log10(bits(step))))
                .collect(),
            entropy_label: if some_zero {
                "entropy of all cells, unknown ones at 1 bit (0 is not shown)"
            } else {
                "entropy of all cells, unknown ones at 1 bit"
            },
        }
    }
}

impl Drawing for SweepPlot {
    const SIZE: (u32, u32) = SIZE;

    fn title(&self) -> String {
        self.title.clone()
    }

    fn draw_below_title<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let (upper, lower) = paper.split_vertically(SIZE.1 as i32 / 2 - 26);
        self.draw_half(
            &upper,
            &Half {
                axis: Axis::of_bits(),
                axis_label: "mean information (bits / cell)",
                label: "mean information of the observed cells",
                colour: MEAN_INFORMATION,
                points: &self.mean_information,
                tick_label: &|bits| format!("{bits:.1}"),
            },
        )?;
        let lowest = self.entropy.iter().fold(f64::INFINITY, |low, &(_, y)| low.min(y.floor()));
        let highest = self.entropy.iter().fold(f64::NEG_INFINITY, |high, &(_, y)| high.max(y.ceil()));
        let decades = if lowest < highest { lowest as i32..=highest as i32 } else { 0..=1 };
        let stride = 1 + decades.clone().count() / 9;
        let (start, end) = (f64::from(*decades.start()), f64::from(*decades.end()));
        self.draw_half(
            &lower,
            &Half {
                axis: Axis {
                    range: start..end + LEGEND_ROOM * (end - start),
                    ticks: decades.step_by(stride).map(f64::from).collect(),
                },
                axis_label: "total entropy (bits)",
                label: self.entropy_label,
                colour: ENTROPY,
                points: &self.entropy,
                tick_label: &|exponent| power_of_ten(exponent as i32),
            },
        )
    }
}

impl SweepPlot {
    fn draw_half<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        half: &Half,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let last = self.cell_sizes.len() - 1;
        let stride = 1 + last / 12;
        let steps = Axis {
            range: -0.4..last as f64 + 0.4,
            ticks: (0..=last).step_by(stride).map(|step| step as f64).collect(),
        };
        let mut chart = frame(
            area,
            Side {
                axis: steps,
                title: &self.cell_axis,
                label: &|step| self.cell_sizes[step as usize].clone(),
            },
            Side { axis: half.axis.clone(), title: half.axis_label, label: half.tick_label },
        )?;
        curve(&mut chart, half.label, half.colour, Marks::Each(Shape::Circle), half.points)?;
        legend(&mut chart)
    }
}
