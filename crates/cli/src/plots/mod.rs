//! Pictures: the information of every cell, and the measures against cell size. Drawn into memory, with the same bytes
//! on every run and machine.

mod axis;
mod bitmap;
mod canvas;
mod cell_cache;
mod chart;
mod convergence;
mod drawing;
mod frame;
mod heat_map;
mod panels;
mod scale;
mod series;
mod svg;
mod sweep;

pub use chart::{Chart, Colour, Curve, Panel, Scale};
pub use convergence::ConvergencePlot;
pub use drawing::{Drawing, Picture, require_png, title};
pub use heat_map::HeatMap;
pub use panels::{MapPanel, panels};
pub use series::SeriesPlot;
pub use svg::{Sheet, Svg};
pub use sweep::SweepPlot;
