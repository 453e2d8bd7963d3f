//! Curves in panels over one horizontal axis.

use super::axis::{Axis, power_of_ten};
use super::drawing::{Drawing, LABEL};
use super::frame::{Side, curve, frame};
use super::marks::Marks;
use super::scale::{logarithmic_ticks, ticks};
use crate::output::short;
use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

/// Narrow enough for its letters to be read on a telephone.
const WIDTH: u32 = 640;
const PANEL_HEIGHT: u32 = 350;
const TITLE_HEIGHT: u32 = 36;
/// The height of a line of the legend.
const LINE: i32 = 22;
/// The margin on either side of the legend.
const SIDE: i32 = 28;
/// The margin on either side of the points, as a part of their span.
const MARGINS: [f64; 2] = [0.02, 0.06];

/// Panels below each other.
#[derive(Debug)]
pub struct Chart<const PANELS: usize> {
    /// The title.
    pub title: String,
    /// The title of the horizontal axis.
    pub horizontal: &'static str,
    /// The scale of that axis.
    pub scale: Scale,
    /// The panels, from top to bottom.
    pub panels: [ChartPanel; PANELS],
}

/// The scale of an axis.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Scale {
    /// Equal distances for equal differences.
    Linear,
    /// Equal distances for equal ratios; numbers must be positive.
    Logarithmic,
}

/// Curves with one vertical axis.
#[derive(Debug)]
pub struct ChartPanel {
    /// The title of the vertical axis.
    pub vertical: &'static str,
    /// The scale of the vertical axis.
    pub scale: Scale,
    /// The curves; at least one point among them.
    pub curves: Vec<Curve>,
    /// Places on the horizontal axis that are marked, with a name.
    pub marks: Vec<(f64, &'static str)>,
}

/// Points that are connected.
#[derive(Debug)]
pub struct Curve {
    /// The name in the legend; empty if it has none there.
    pub name: String,
    /// The colour.
    pub colour: Colour,
    /// The marks on its points.
    pub marks: Marks,
    /// The points, from left to right.
    pub points: Vec<(f64, f64)>,
}

/// The colours of curves, which are told apart on white and on black paper, and without seeing red or green.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Colour {
    /// The first.
    Blue,
    /// The second.
    Orange,
    /// The third.
    Grey,
    /// The fourth.
    Green,
    /// The fifth.
    Purple,
    /// The sixth.
    Brown,
}

impl Colour {
    pub(super) const fn rgb(self) -> RGBColor {
        match self {
            Self::Blue => RGBColor(0, 90, 170),
            Self::Orange => RGBColor(190, 75, 0),
            Self::Grey => RGBColor(110, 110, 110),
            Self::Green => RGBColor(0, 130, 90),
            Self::Purple => RGBColor(140, 60, 160),
            Self::Brown => RGBColor(125, 85, 20),
        }
    }
}

impl Scale {
    pub(super) fn place(self, x: f64) -> f64 {
        match self {
            Self::Linear => x,
            Self::Logarithmic => libm::log10(x),
        }
    }

    /// Returns the axis of numbers at these places, with a margin on either side as a part of their span.
    pub(super) fn axis(self, places: impl Iterator<Item = f64>, margin: f64) -> Axis {
        let (low, high) =
            places.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| (low.min(x), high.max(x)));
        let span = (high - low).max(1e-9);
        let range = low - margin * span..high + margin * span;
        let ticks = match self {
            Self::Linear => ticks(range.start, range.end, 7).into_iter().map(|(x, _)| x).collect(),
            Self::Logarithmic => logarithmic_ticks(&(range.start..=range.end)),
        };
        Axis { range, ticks }
    }

    pub(super) fn label(self, place: f64) -> String {
        match self {
            Self::Linear => short(place),
            Self::Logarithmic if place.fract() == 0.0 => power_of_ten(place as i32),
            Self::Logarithmic => short(libm::exp10(place)),
        }
    }
}

impl<const PANELS: usize> Drawing for Chart<PANELS> {
    const SIZE: (u32, u32) = (WIDTH, TITLE_HEIGHT + PANELS as u32 * PANEL_HEIGHT);

    fn title(&self) -> String {
        self.title.clone()
    }

    fn draw_below_title<B: DrawingBackend>(
        &self,
        paper: &DrawingArea<B, Shift>,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        for (area, panel) in paper.split_evenly((PANELS, 1)).iter().zip(&self.panels) {
            self.draw_panel(area, panel)?;
        }
        Ok(())
    }
}

impl<const PANELS: usize> Chart<PANELS> {
    fn draw_panel<B: DrawingBackend>(
        &self,
        area: &DrawingArea<B, Shift>,
        panel: &ChartPanel,
    ) -> Result<(), DrawingAreaErrorKind<B::ErrorType>> {
        let all = || self.panels.iter().flat_map(|panel| &panel.curves).flat_map(|curve| &curve.points);
        let own = || panel.curves.iter().flat_map(|curve| &curve.points);
        let horizontal = self.scale.axis(all().map(|&(x, _)| self.scale.place(x)), MARGINS[0]);
        let named: Vec<_> = panel.curves.iter().filter(|curve| !curve.name.is_empty()).collect();
        let area = &if named.is_empty() { area.clone() } else { legend(area, &named)? };
        let vertical = panel.scale.axis(own().map(|&(_, y)| panel.scale.place(y)), MARGINS[1]);
        let (bottom, top) = (vertical.range.start, vertical.range.end);
        let middle = f64::midpoint(horizontal.range.start, horizontal.range.end);
        let mut chart = frame(
            area,
            Side { axis: horizontal, title: self.horizontal, label: &|place| self.scale.label(place) },
            Side { axis: vertical, title: panel.vertical, label: &|place| panel.scale.label(place) },
        )?;
        for &(x, name) in &panel.marks {
            let x = self.scale.place(x);
            let line = [(x, bottom), (x, top)];
            chart.draw_series(DashedLineSeries::new(line, 5, 5, BLACK.stroke_width(1)))?;
            // On the side that has more room.
            let (side, away) = if x > middle { (HPos::Right, -6) } else { (HPos::Left, 6) };
            let style = LABEL.into_font().color(&BLACK).pos(Pos::new(side, VPos::Top));
            let foot = EmptyElement::at((x, bottom + 0.08 * (top - bottom)));
            chart.draw_series([foot + Text::new(name, (away, 0), style)])?;
        }
        for Curve { name, colour, marks, points } in &panel.curves {
            let points: Vec<_> =
                points.iter().map(|&(x, y)| (self.scale.place(x), panel.scale.place(y))).collect();
            curve(&mut chart, name, colour.rgb(), *marks, &points)?;
        }
        Ok(())
    }
}

/// Draws the names of curves in columns at the top of a panel, where they hide no curve; returns the rest of it.
fn legend<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    named: &[&Curve],
) -> Result<DrawingArea<B, Shift>, DrawingAreaErrorKind<B::ErrorType>> {
    let longest = named.iter().map(|curve| curve.name.chars().count()).max().unwrap_or(0);
    let width = WIDTH as usize - 2 * SIDE as usize;
    // A character is at most 10 pixels wide, and the line before a name 40.
    let columns = (width / (10 * longest + 40)).clamp(1, 3);
    let (names, rest) = area.split_vertically(LINE * named.len().div_ceil(columns) as i32 + 8);
    for (index, Curve { name, colour, marks, .. }) in named.iter().enumerate() {
        let column = (index % columns * width / columns) as i32;
        let (x, y) = (SIDE + column, LINE / 2 + 4 + LINE * (index / columns) as i32);
        let colour = colour.rgb();
        if *marks != Marks::Alone {
            names.draw(&PathElement::new([(x, y), (x + 20, y)], colour.stroke_width(2)))?;
        }
        if marks.is_dotted() {
            names.draw(&Circle::new((x + 10, y), 4, colour.filled()))?;
        }
        names.draw(&Polygon::new(marks.outline((x + 10, y)), colour.filled()))?;
        names.draw(&Text::new(name.clone(), (x + 28, y - 8), LABEL.into_font().color(&BLACK)))?;
    }
    Ok(rest)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::plots::{Picture, Shape};

    /// The horizontal places of the names of so many curves.
    fn places(curves: usize) -> Vec<u32> {
        let curve = |k: usize| Curve {
            name: format!("curve {k}"),
            colour: Colour::Blue,
            marks: Marks::Each(Shape::Circle),
            points: vec![(0.0, k as f64), (2.0, 0.5)],
        };
        let panel = ChartPanel {
            vertical: "bits",
            scale: Scale::Linear,
            curves: (0..curves).map(curve).collect(),
            marks: Vec::new(),
        };
        let chart =
            Chart { title: String::new(), horizontal: "metres", scale: Scale::Linear, panels: [panel] };
        let svg = String::from_utf8(chart.draw(Picture::Svg).unwrap()).unwrap();
        let place = |k| {
            let (before, _) = svg.split_once(&format!("\ncurve {k}\n")).unwrap();
            let (_, place) =
                before.rsplit_once(" x=\"").or_else(|| before.rsplit_once("<text x=\"")).unwrap();
            place.split_once('"').unwrap().0.parse().unwrap()
        };
        (0..curves).map(place).collect()
    }

    #[test]
    fn names_stand_above_in_columns() {
        let above = places(5);
        assert_eq!(above[..2], above[3..]);
        assert!(above[0] < above[1] && above[1] < above[2], "{above:?}");
    }
}
