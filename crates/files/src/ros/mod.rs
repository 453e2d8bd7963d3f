//! ROS maps: a yaml file that describes an image, the loaders' rules that turn grey levels into cells, and cells into grey
//! levels that they read as they were meant.

mod description;
mod missing_image;
mod nav2;
mod nav2_humble;
mod pixel_table;
mod probability;
mod reading;
mod ros1;
mod sink;
mod suspects;
mod text;
mod thresholds;
mod write;
mod yaml;

pub use description::Description;
pub(crate) use reading::read;
pub use reading::read_image;
pub(crate) use sink::Sink;
pub use write::{QUANTISATION, write_description, write_image};
