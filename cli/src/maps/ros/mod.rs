//! ROS maps: a yaml file that describes an image, and the loaders' rules that turn grey levels into cells.

mod description;
mod nav2;
mod probability;
mod ros1;
mod shading;

pub use description::Description;

use super::image::{Colours, Image};
use super::{Cells, Fault, Map, Mode, Options, Problem, Semantics};
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
    let file = super::open(&image)?;
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

    let mut warnings = Vec::new();
    let cells = if mode == Mode::Probability {
        let shading = probability::shading(description, &layout, options.unknown)?;
        let (cells, _) = paint(image, &shading)?;
        Cells::Probability64(Grid::<Probability<f64>>::new(
            layout.size.width,
            layout.size.height,
            geometry,
            cells,
        )?)
    } else {
        let shading = match options.semantics {
            Semantics::Nav2 => nav2::shading(description, mode, &layout),
            Semantics::Ros1 => ros1::shading(description, mode, &layout),
        };
        warnings.extend(doubts(options.semantics, &image));
        let (cells, watched) = paint(image, &shading)?;
        if watched > 0 {
            warnings.push(watched_warning(mode, description.free_thresh, watched));
        }
        Cells::Percent(Grid::<Percent>::new(layout.size.width, layout.size.height, geometry, cells)?)
    };
    Ok(Map { cells, resolution: Some(description.resolution), warnings, files: Vec::new() })
}

/// Where the loader itself would read something else, or where we do not know what it reads.
fn doubts<R: BufRead + Seek>(semantics: Semantics, image: &Image<R>) -> Option<String> {
    let white = image.layout().white;
    match (semantics, image) {
        (Semantics::Nav2, Image::Png(png)) if png.is_cut() => Some(
            "the image has 16 bits: nav2_map_server may take its levels for others by 1 of 255".to_owned(),
        ),
        (Semantics::Ros1, Image::Pgm(_)) if white > 255 => Some(format!(
            "ROS 1's map_server refuses a PGM of maximum value {white}; its levels are read as of 255"
        )),
        (Semantics::Nav2, Image::Pgm(_)) if white != 255 && white != 65535 => Some(format!(
            "the PGM's maximum value is {white}: nav2_map_server may take its levels for others"
        )),
        (Semantics::Ros1, Image::Png(png)) if png.is_indices() => Some(
            "the image has a palette: as in ROS 1's map_server, its indices are read as grey levels"
                .to_owned(),
        ),
        _ => None,
    }
}

fn watched_warning(mode: Mode, free_thresh: f64, count: u64) -> String {
    if mode == Mode::Raw {
        format!("{count} cells outside 0 to 100 that do not say unknown (-1 or 255) are read as unknown")
    } else {
        format!(
            "{count} cells of grey {SAVED_UNKNOWN}, which map savers write for unknown, read as free under \
             free_thresh {free_thresh}; a free_thresh of 0.196 keeps them unknown"
        )
    }
}
