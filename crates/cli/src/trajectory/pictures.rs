//! Pictures of a comparison: the mean information as scans come, and the maps with their contradictions.

use super::common::Common;
use super::comparison::Comparison;
use super::measure::Measured;
use crate::failure::Failure;
use crate::output::Number;
use crate::plots::{
    Chart, ChartPanel, Colour, ConflictMap, Curve, Drawing, HeatMap, MapPanel, Marks, Picture, Scale, Shape,
    Sheet, Svg, TimedPath, conflict_scale, panels,
};
use mean_information::scan::Pose;

/// The colours of curves, in their order.
const COLOURS: [Colour; 5] = [Colour::Blue, Colour::Orange, Colour::Green, Colour::Purple, Colour::Brown];
/// The most curves that a legend has room for; those that follow are grey.
const CURVES: usize = 6;
/// The most points of a curve.
const POINTS: usize = 640;

/// The data that pictures are drawn from.
#[derive(Clone, Copy, Debug)]
pub struct Pictures<'a> {
    /// The rows.
    pub comparison: &'a Comparison,
    /// The scans and poses.
    pub common: &'a Common<'a>,
    /// The measures, with what was wanted for pictures.
    pub measured: &'a [Measured],
}

impl Pictures<'_> {
    /// Draws the curves of the mean information against time, and below them how far each is above the first.
    ///
    /// # Errors
    /// None is known.
    pub fn series(&self, picture: Picture) -> Result<Vec<u8>, Failure> {
        match self.curves() {
            (all, None) => all.draw(picture),
            (all, Some(differences)) => both(all, differences).draw(picture),
        }
    }

    /// Returns the curves as a part of a page.
    pub(super) fn series_svg(&self) -> Result<Svg, Failure> {
        match self.curves() {
            (all, None) => Svg::of_plot(&all),
            (all, Some(differences)) => Svg::of_plot(&both(all, differences)),
        }
    }

    /// Returns the chart of all curves, and the panel of their differences from the first if there are others.
    fn curves(&self) -> (Chart<1>, Option<ChartPanel>) {
        let of = |first: Option<&[f64]>| -> Vec<Curve> {
            let labels = self.comparison.labels.iter().cloned().zip(self.measured).enumerate();
            labels
                .skip(usize::from(first.is_some()))
                .map(|(index, (label, measured))| self.curve(index, label, &measured.series, first))
                .collect()
        };
        let panel =
            |vertical, curves| ChartPanel { vertical, scale: Scale::Linear, curves, marks: Vec::new() };
        let all = Chart {
            title: "mean information as scans come".to_owned(),
            horizontal: "time since the first scan (s)",
            scale: Scale::Linear,
            panels: [panel("mean information (bits / cell)", of(None))],
        };
        let differences = of(self.measured.first().map(|first| first.series.as_slice()));
        (all, (!differences.is_empty()).then(|| panel("less the first (bits / cell)", differences)))
    }

    /// Returns a curve of values, or of how far they are above those of the first.
    fn curve(&self, index: usize, label: String, values: &[f64], first: Option<&[f64]>) -> Curve {
        let scans = &self.common.scans;
        let times = scans.iter().map(|scan| scan.time() - scans[0].time());
        let value = |scan: usize| values[scan] - first.map_or(0.0, |first| first[scan]);
        let all: Vec<_> = times.zip(0..values.len()).map(|(time, scan)| (time, value(scan))).collect();
        let stride = all.len().div_ceil(POINTS).max(1);
        let mut points: Vec<_> = all.iter().copied().step_by(stride).collect();
        // The last point is the row of the table.
        points.extend(all.last().filter(|_| !(all.len() - 1).is_multiple_of(stride)));
        // The panel below has the colours and marks of that above.
        let is_named = first.is_none() && index <= CURVES;
        if index < CURVES {
            let shape = Shape::ALL[(index + index / COLOURS.len()) % Shape::ALL.len()];
            let name = if is_named { label } else { String::new() };
            Curve { name, colour: COLOURS[index % COLOURS.len()], marks: Marks::Spaced(shape), points }
        } else {
            let others = self.measured.len() - CURVES;
            let name = if is_named { format!("{others} more") } else { String::new() };
            Curve { name, colour: Colour::Grey, marks: Marks::None, points }
        }
    }

    /// Returns the heat map of each trajectory, in one PNG file.
    ///
    /// # Errors
    /// None is known.
    pub fn heat_maps(&self) -> Result<Vec<u8>, Failure> {
        let resolution = self.comparison.used.setup.resolution;
        let maps = self.each().map(|(label, index)| {
            let (grid, _) = self.measured[index].pictures.as_ref()?;
            let titles = [label, self.comparison.rows[index].measures.summary()];
            Some((HeatMap::of_grid(grid, Some(resolution)), titles))
        });
        HeatMap::png_of_several(maps.flatten().collect())
    }

    /// Returns where the scans of each trajectory contradict one another, in one PNG file.
    ///
    /// # Errors
    /// None is known.
    pub fn conflicts(&self) -> Result<Vec<u8>, Failure> {
        let titles = |(label, index): (String, usize)| {
            [
                label,
                format!(
                    "where scans contradict one another; agreement {:.4}",
                    self.comparison.rows[index].agreement
                ),
            ]
        };
        let maps: Vec<_> = self.conflict_maps().into_iter().zip(self.each().map(titles)).collect();
        ConflictMap::png_of_several(&maps)
    }

    /// Draws the map of each trajectory with the path of the laser, on one scale of metres, in one SVG file; the numbers are those
    /// of the table.
    ///
    /// # Errors
    /// None is known.
    pub fn maps(&self) -> Result<Vec<u8>, Failure> {
        let mut maps = Vec::new();
        for ((label, index), poses) in self.each().zip(&self.common.poses) {
            let Some((grid, _)) = &self.measured[index].pictures else { continue };
            let row = &self.comparison.rows[index];
            let against = row.difference.as_ref().map_or(String::new(), |difference| {
                format!(": {:+.4} ± {:.4}", difference.value(), difference.standard_error())
            });
            let panel = MapPanel::new(grid, &label, self.mean_in_words(index) + &against)?;
            maps.push(panel.with_path(self.timed(poses)));
        }
        let described = "The map of each trajectory, with the path of the laser.".to_owned();
        Ok(Sheet::new(panels(&maps, 2), described).file().into_bytes())
    }

    /// Returns the mean information of a row as pictures have it.
    fn mean_in_words(&self, index: usize) -> String {
        let mean = self.comparison.rows[index].measures.mean_information;
        format!("{:.4} bits per cell", mean.map_or(0.0, Number::widen))
    }

    /// Returns the panels of a page: each trajectory's map beside its contradictions; and the scale of these, in nats.
    pub(super) fn panels(&self) -> Result<(Vec<MapPanel>, f64), Failure> {
        let mut panels = Vec::new();
        for ((label, index), conflicts) in self.each().zip(self.conflict_maps()) {
            let Some((grid, _)) = &self.measured[index].pictures else { continue };
            let agreement = self.comparison.rows[index].agreement;
            panels.push(MapPanel::new(grid, &label, self.mean_in_words(index))?);
            panels.push(conflicts.panel("its contradictions", format!("agreement {agreement:.4}"))?);
        }
        Ok((panels, self.scale()))
    }

    fn conflict_maps(&self) -> Vec<ConflictMap> {
        let top = self.scale();
        let maps = self.measured.iter().zip(&self.common.poses).filter_map(|(measured, poses)| {
            let (grid, layer) = measured.pictures.as_ref()?;
            Some(ConflictMap::new(grid, layer, top, self.timed(poses)))
        });
        maps.collect()
    }

    /// Returns the path of the laser over the scans of all trajectories.
    fn timed(&self, poses: &[Pose]) -> TimedPath {
        let times = self.common.scans.iter().map(|scan| scan.time() - self.common.scans[0].time());
        TimedPath::new(times.zip(poses.iter().map(Pose::position)).collect())
    }

    fn scale(&self) -> f64 {
        conflict_scale(self.measured.iter().filter_map(|measured| Some(&measured.pictures.as_ref()?.1)))
    }

    fn each(&self) -> impl Iterator<Item = (String, usize)> {
        self.comparison.labels.iter().cloned().zip(0..)
    }
}

/// Puts the differences below the curves.
fn both(all: Chart<1>, differences: ChartPanel) -> Chart<2> {
    let Chart { title, horizontal, scale, panels: [values] } = all;
    Chart { title, horizontal, scale, panels: [values, differences] }
}
