//! ROS maps: a yaml file that describes an image, the loaders' rules that turn grey levels into cells, and cells into grey
//! levels that they read as they were meant.

mod description;
mod doubts;
mod nav2;
mod probability;
mod ros1;
mod saving;
mod shading;

pub use description::Description;
pub use saving::{QUANTISATION, SavedMap, save};

use super::image::{Colours, Image};
use super::size::Size;
use super::{Cells, Fault, Map, Mode, Options, Problem, Semantics};
use doubts::Suspect;
use mean_information::map::Grid;
use mean_information::map::encoding::{Percent, Probability};
use shading::paint;
use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

/// The grey level that map savers write for unknown.
const SAVED_UNKNOWN: u8 = 205;

/// Reads the map that the yaml file at `path` describes.
pub(super) fn read(path: &Path, file: File, options: &Options) -> Result<Map, Problem> {
    let description = Description::read(file, options.semantics).map_err(|fault| fault.in_file(path))?;
    let image = path.parent().unwrap_or(Path::new("")).join(&description.image);
    let (file, _) = super::open(&image)?;
    let mut map = read_image(BufReader::with_capacity(super::size::CHUNK, file), &description, options)
        .map_err(|fault| fault.in_file(&image))?;
    map.files.push(image);
    Ok(map)
}

/// Reads the image of a map.
///
/// # Errors
/// A [`Fault`] of the image, or of the image under this description.
pub fn read_image(
    input: impl BufRead + Seek,
    description: &Description,
    options: &Options,
) -> Result<Map, Fault> {
    let mode = options.mode.unwrap_or(description.mode);
    let colours = match (mode, options.semantics) {
        (Mode::Probability, _) => Colours::Meant,
        (_, Semantics::Nav2) => Colours::MeantIn8Bits,
        (_, Semantics::Ros1) => Colours::Sdl,
    };
    let image = Image::open(input, colours, options.max_cells)?;
    let layout = image.layout();
    let [x, y, yaw] = description.origin;
    let geometry = layout.size.placed(description.resolution, [x, y], yaw)?;

    let Size { width, height } = layout.size;
    let mut warnings = Vec::new();
    let (cells, suspects) = if mode == Mode::Probability {
        let shading = probability::shading(description, &layout, options.unknown)?;
        let (cells, suspects) = paint(image, &shading)?;
        let grid = Grid::<Probability<f64>>::new(width, height, geometry, cells)?;
        (Cells::Probability64(grid), suspects)
    } else {
        let shading = match options.semantics {
            Semantics::Nav2 => nav2::shading(description, mode, &layout),
            Semantics::Ros1 => ros1::shading(description, mode, &layout),
        };
        warnings.extend(doubts::of_image(options.semantics, &image));
        let (cells, suspects) = paint(image, &shading)?;
        (Cells::Percent(Grid::<Percent>::new(width, height, geometry, cells)?), suspects)
    };
    let spoken_of = |(suspect, count): (Suspect, u64)| suspect.warning(count, &layout, mode, description);
    warnings.extend(suspects.into_iter().filter_map(spoken_of));
    Ok(Map { cells, resolution: Some(description.resolution), warnings, files: Vec::new() })
}
