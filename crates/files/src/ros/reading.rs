//! A ROS map from its two files.

use super::description::Description;
use super::sink::Sink;
use super::suspects::{SuspectGrey, of_image};
use super::{nav2, probability, ros1};
use crate::error::Error;
use crate::image::{Colours, Image};
use crate::map::Map;
use crate::options::{Mode, Options, Semantics};
use crate::source::Source;
use mean_information::map::encoding::{Percent, Probability};
use std::io::{BufRead, Seek};
use std::path::Path;

/// Reads the map that the yaml file at `path`, already opened as `input`, describes.
pub(crate) fn read<K: Sink>(
    source: &impl Source,
    path: &Path,
    input: impl BufRead,
    options: &Options,
) -> Result<Map<K>, Error> {
    let description = Description::read(input, options.semantics)?;
    let image = path.parent().unwrap_or(Path::new("")).join(&description.image);
    let read = source.open(&image).and_then(|file| read_image_as(file.input, &description, options));
    let mut map = read.map_err(|error| error.in_file(&image))?;
    map.files.push(image);
    Ok(map)
}

/// Reads the image of a map.
///
/// # Errors
/// An [`Error`] of the image, or of the image under this description.
pub fn read_image(
    input: impl BufRead + Seek,
    description: &Description,
    options: &Options,
) -> Result<Map, Error> {
    read_image_as(input, description, options)
}

/// Reads the image of a map, whose cells go where `K` puts them.
fn read_image_as<K: Sink>(
    input: impl BufRead + Seek,
    description: &Description,
    options: &Options,
) -> Result<Map<K>, Error> {
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
        let table = probability::table(description, &layout, options.unknown)?;
        K::take::<Probability<f64>>(image, &table, geometry)?
    } else {
        let table = match options.semantics {
            Semantics::Nav2 => nav2::table(description, mode, &layout),
            Semantics::Ros1 => ros1::table(description, mode, &layout),
        };
        warnings.extend(of_image(options.semantics, &image));
        K::take::<Percent>(image, &table, geometry)?
    };
    let warning = |(suspect, count): (SuspectGrey, u64)| suspect.warning(count, &layout, mode, description);
    warnings.extend(suspects.into_iter().filter_map(warning));
    Ok(Map { cells, resolution: Some(description.resolution), warnings, files: Vec::new() })
}
