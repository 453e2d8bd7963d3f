//! Pictures: the information of every cell, where scans contradict one another, and curves. Drawn into memory, with the same bytes
//! on every run and machine.

mod axis;
mod bitmap;
mod canvas;
mod chart;
mod conflict_map;
mod convergence;
mod drawing;
mod frame;
mod heat_map;
mod map_picture;
mod marks;
mod panels;
mod scale;
mod scatter;
mod series;
mod side_by_side;
mod svg;
mod sweep;
mod timed_path;

pub use chart::{Chart, ChartPanel, Colour, Curve, Scale};
pub use conflict_map::{ConflictMap, conflict_scale};
pub use convergence::ConvergencePlot;
pub use drawing::{Drawing, Picture, require_png, require_svg, title};
pub use heat_map::HeatMap;
pub use marks::{Marks, Shape};
pub use panels::{MapPanel, panels};
pub use scatter::{Cloud, Scatter};
pub use series::SeriesPlot;
pub use svg::{Sheet, Svg};
pub use sweep::SweepPlot;
pub use timed_path::TimedPath;
