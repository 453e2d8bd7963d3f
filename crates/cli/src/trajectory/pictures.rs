//! Pictures of a comparison: the mean information as scans come, and the maps with their contradictions.

use super::common::Common;
use super::comparison::Comparison;
use super::measure::Measured;
use crate::failure::Failure;
use crate::plots::{
    Chart, Colour, ConflictMap, Curve, HeatMap, MapPanel, Marks, Panel, Scale, Shape, conflict_scale,
};
use mean_information::scan::Pose;
use mean_information_files::scans::RangeScan;

/// The colours of curves, in their order.
const COLOURS: [Colour; 5] = [Colour::Blue, Colour::Orange, Colour::Green, Colour::Purple, Colour::Brown];
/// The most curves that a legend has room for; those that follow are grey.
const CURVES: usize = 8;
/// The most points of a curve.
const POINTS: usize = 640;

/// What pictures are drawn from.
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
    /// Returns the curves of the mean information against time.
    pub fn series(&self) -> Chart<1> {
        let times: Vec<_> = self
            .common
            .scans
            .iter()
            .map(|scan| RangeScan::time(scan) - self.common.scans[0].time())
            .collect();
        let labels = self.comparison.labels();
        let curve = |(index, (label, measured)): (usize, (String, &Measured))| {
            let all = times.iter().copied().zip(measured.series.iter().copied()).collect::<Vec<_>>();
            let stride = all.len().div_ceil(POINTS).max(1);
            // The last point is the row of the table.
            let mut points: Vec<_> = all.iter().copied().step_by(stride).collect();
            points.extend(all.last().filter(|_| (all.len() - 1) % stride != 0));
            let own = index < CURVES;
            Curve {
                name: if own { label } else { format!("the other {}", self.measured.len() - CURVES) },
                colour: if own { COLOURS[index % COLOURS.len()] } else { Colour::Grey },
                marks: if own {
                    Marks::Spaced(Shape::ALL[(index + index / COLOURS.len()) % Shape::ALL.len()])
                } else {
                    Marks::None
                },
                points,
            }
        };
        Chart {
            title: "mean information as scans come".to_owned(),
            horizontal: "time since the first scan (s)",
            scale: Scale::Linear,
            panels: [Panel {
                vertical: "mean information (bits / cell)",
                scale: Scale::Linear,
                curves: labels.into_iter().zip(self.measured).enumerate().map(curve).collect(),
                marks: Vec::new(),
            }],
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

    /// Returns the panels of a page: each trajectory's map beside its contradictions; and the scale of these, in nats.
    pub(super) fn panels(&self) -> Result<(Vec<MapPanel>, f64), Failure> {
        let mut panels = Vec::new();
        for ((label, index), conflicts) in self.each().zip(self.conflict_maps()) {
            let Some((grid, _)) = &self.measured[index].pictures else { continue };
            let row = &self.comparison.rows[index];
            let mean = row.measures.mean_information.map_or(0.0, |x| x.widen());
            panels.push(MapPanel::new(grid, &label, format!("{mean:.4} bits per cell"))?);
            panels.push(conflicts.panel("its contradictions", format!("agreement {:.4}", row.agreement))?);
        }
        Ok((panels, self.scale()))
    }

    fn conflict_maps(&self) -> Vec<ConflictMap> {
        let top = self.scale();
        let maps = self.measured.iter().zip(&self.common.poses).filter_map(|(measured, poses)| {
            let (grid, layer) = measured.pictures.as_ref()?;
            Some(ConflictMap::new(grid, layer, top, poses.iter().map(Pose::position).collect()))
        });
        maps.collect()
    }

    fn scale(&self) -> f64 {
        conflict_scale(self.measured.iter().filter_map(|measured| Some(&measured.pictures.as_ref()?.1)))
    }

    fn each(&self) -> impl Iterator<Item = (String, usize)> {
        self.comparison.labels().into_iter().zip(0..)
    }
}
