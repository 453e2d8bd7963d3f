//! The submaps of Cartographer's saved states, each by itself or counted together.

use crate::words::Refused;
use mean_information::map::encoding::Probability;
use mean_information_files::pbstream::Submap;
use mean_information_files::{Counts, Map, Options, Source, Warning, read_submaps_from};
use std::path::Path;

/// The counts of a submap, or of all.
pub type Counted = Map<Counts<Probability<f32>>>;

/// Tells whether a file is a saved state by its name.
pub fn is_state(path: &Path) -> bool {
    path.extension().is_some_and(|ending| ending.eq_ignore_ascii_case("pbstream"))
}

/// Reads the submaps of a saved state, each with its name; or, unless they are `apart`, all of them as one, whose width
/// and height are 0 and whose cells are not resampled: their counts are merged.
///
/// # Errors
/// A file that is no saved state, or has no submaps.
pub fn read(
    source: &impl Source,
    path: &Path,
    apart: bool,
    options: &Options,
) -> Result<Vec<(String, Counted)>, Refused> {
    let submaps = read_submaps_from(source, path, options)?;
    if submaps.is_empty() {
        return Err(Refused::new(path, "has no submaps"));
    }
    let name = path.display();
    let files = || vec![path.to_owned()];
    if apart {
        let named = |submap: Submap| {
            let state = if submap.is_finished { "" } else { ", unfinished" };
            let name = format!("{name} submap {}, {}{state}", submap.trajectory, submap.index);
            let resolution = Some(submap.resolution);
            let warnings = vec![clamped(submap.clamp)];
            (name, Map { cells: submap.counts, resolution, warnings, files: files() })
        };
        return Ok(submaps.into_iter().map(named).collect());
    }
    let first = submaps[0].resolution;
    let resolution = submaps.iter().all(|submap| submap.resolution == first).then_some(first);
    let widest = |[least, greatest]: [f32; 2], submap: &Submap| {
        [least.min(submap.clamp[0]), greatest.max(submap.clamp[1])]
    };
    let clamp = submaps.iter().fold([f32::INFINITY, f32::NEG_INFINITY], widest);
    let warnings = vec![Warning::SubmapsTogether { count: submaps.len() }, clamped(clamp)];
    let values = submaps.into_iter().flat_map(|submap| submap.counts.values).collect();
    let cells = Counts { width: 0, height: 0, values };
    Ok(vec![(name.to_string(), Map { cells, resolution, warnings, files: files() })])
}

/// Creates the warning of clamped probabilities.
fn clamped([least, greatest]: [f32; 2]) -> Warning {
    Warning::Clamped { least, greatest }
}
