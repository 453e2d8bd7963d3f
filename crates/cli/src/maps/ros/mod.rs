//! ROS maps: a yaml file that describes an image, the loaders' rules that turn grey levels into cells, and cells into grey
//! levels that they read as they were meant.

mod counting;
mod description;
mod doubts;
mod keep;
mod nav2;
mod probability;
mod ros1;
mod saving;
mod shading;

pub use description::Description;
pub(in crate::maps) use keep::Keep;
pub use saving::{QUANTISATION, SavedMap, save};

use super::image::{Colours, Image};
use super::{Fault, Map, Mode, Options, Problem, Semantics};
use doubts::Suspect;
use mean_information::map::encoding::{Percent, Probability};
use std::fs::File;
use std::io::{BufRead, BufReader, Seek};
use std::path::Path;

/// The grey level that map savers write for unknown.
const SAVED_UNKNOWN: u8 = 205;

/// Reads the map that the yaml file at `path` describes.
pub(super) fn read<K: Keep>(path: &Path, file: File, options: &Options) -> Result<Map<K>, Problem> {
    let description = Description::read(file, options.semantics).map_err(|fault| fault.in_file(path))?;
    let image = path.parent().unwrap_or(Path::new("")).join(&description.image);
    let (file, _) = super::open(&image)?;
    let mut map = keep_image(BufReader::with_capacity(super::size::CHUNK, file), &description, options)
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
    keep_image(input, description, options)
}

fn keep_image<K: Keep>(
    input: impl BufRead + Seek,
    description: &Description,
    options: &Options,
) -> Result<Map<K>, Fault> {
    let mode = options.mode.unwrap_or(description.mode);
    let colours = match (mode, options.semantics) {
        (Mode::Probability, _) => Colours::Meant,
        (_, Semantics::Nav2) => Colours::MeantIn8Bits,
        (_, Semantics::Ros1) => Colours::Sdl,
    };
    let image = Image::open(input, colours, K::max_pixels(options))?;
    let layout = image.layout();
    let [x, y, yaw] = description.origin;
    let geometry = layout.size.placed(description.resolution, [x, y], yaw)?;

    let mut warnings = Vec::new();
    let (cells, suspects) = if mode == Mode::Probability {
        let shading = probability::shading(description, &layout, options.unknown)?;
        K::keep::<Probability<f64>>(image, &shading, geometry)?
    } else {
        let shading = match options.semantics {
            Semantics::Nav2 => nav2::shading(description, mode, &layout),
            Semantics::Ros1 => ros1::shading(description, mode, &layout),
        };
        warnings.extend(doubts::of_image(options.semantics, &image));
        K::keep::<Percent>(image, &shading, geometry)?
    };
    let spoken_of = |(suspect, count): (Suspect, u64)| suspect.warning(count, &layout, mode, description);
    warnings.extend(suspects.into_iter().filter_map(spoken_of));
    Ok(Map { cells, resolution: Some(description.resolution), warnings, files: Vec::new() })
}
