//! A ROS map from its two files.

use super::description::Description;
use super::missing_image::missing_image;
use super::pixel_table::TableIndex;
use super::sink::{Found, Sink};
use super::suspects::{SuspectGrey, grades_clipped, greys_thresholded, of_image, two_greys};
use super::{nav2, nav2_humble, probability, ros1};
use crate::error::{Error, ErrorKind};
use crate::image::{Colours, Image, Rest};
use crate::map::Map;
use crate::options::{Mode, Options, Semantics};
use crate::source::{Source, open};
use crate::warning::Warning;
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
    description.thresholds(options.mode.unwrap_or(description.mode))?;
    let image = path.parent().unwrap_or(Path::new("")).join(&description.image);
    let opened = match open(source, &image) {
        Err(error) if error.kind() == ErrorKind::NotFound => {
            return Err(missing_image(source, path, &description.image, &image, error));
        }
        opened => opened,
    };
    let read = opened.and_then(|file| read_image_as(file.input, &description, options));
    let named = || format!(" (the image that {} names)", path.display());
    let mut map = read.map_err(|error| error.followed_by(&named()).in_file(&image))?;
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
    let thresholds = description.thresholds(mode)?;
    let colours = match (mode, options.semantics) {
        (Mode::Probability, _) => Colours::Meant,
        (_, Semantics::Nav2) => Colours::MagickLevels,
        (_, Semantics::Nav2Humble) => Colours::Magick,
        (_, Semantics::Ros1) => Colours::Sdl,
    };
    let image = Image::open(input, &description.image, colours, K::max_pixels(options))?;
    let layout = image.layout();
    let [x, y, yaw] = description.origin;
    let geometry = layout.size.placed(description.resolution, [x, y], yaw)?;

    let mut warnings = description.warnings.clone();
    warnings.extend(thresholds.into_iter().flat_map(|thresholds| thresholds.warnings(options.semantics)));
    warnings.extend(image.is_jpeg().then_some(Warning::JpegLevels));
    let (cells, found) = if mode == Mode::Probability {
        let table = probability::table(description, &layout, options.unknown)?;
        let (cells, found) = K::take::<Probability<f64>>(image, &table, geometry)?;
        warnings.extend(two_greys(&found.sums, |sum| table.cell(TableIndex::Opaque(sum))));
        (cells, found)
    } else {
        let table = match options.semantics {
            Semantics::Nav2 => nav2::table,
            Semantics::Nav2Humble => nav2_humble::table,
            Semantics::Ros1 => ros1::table,
        };
        warnings.extend(of_image(options.semantics, &image));
        let table = table(description, mode, thresholds, &layout);
        let (cells, found) = K::take::<Percent>(image, &table, geometry)?;
        if let (Mode::Scale, Some(thresholds), Some(white)) = (mode, thresholds, found.white) {
            let percent = |sum| table.cell(TableIndex::Opaque(sum));
            warnings.extend(grades_clipped(&found.sums, white, thresholds, percent));
        }
        (cells, found)
    };
    let Found { suspects, sums, white, rest } = found;
    let warning = |(suspect, count): (SuspectGrey, u64)| suspect.warning(count, &layout, mode, description);
    warnings.extend(suspects.into_iter().filter_map(warning));
    if let (Mode::Trinary, Some(white)) = (mode, white) {
        warnings.extend(greys_thresholded(&sums, white, &layout));
    }
    warnings.extend(match rest {
        Rest::Nothing => None,
        Rest::More => Some(Warning::BytesAfterImage),
        Rest::LineEnd => Some(Warning::PgmLineEnd),
    });
    Ok(Map { cells, resolution: Some(description.resolution), warnings, files: Vec::new() })
}
