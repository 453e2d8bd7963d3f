//! The vectors: arguments and exact results for every operation of [`operations`](crate::operations), computed by other
//! tools than this crate. `vectors/README.md` describes their form.

macro_rules! files {
    ($($operation:literal),* $(,)?) => {
        &[$(($operation, include_str!(concat!("../vectors/v1/", $operation, ".json")))),*]
    };
}

/// The name of each operation with the text of its file, JSON.
///
/// ```
/// use mean_information::{operations::OPERATIONS, vectors::FILES};
/// assert!(FILES.iter().map(|file| file.0).eq(OPERATIONS.iter().map(|operation| operation.name)));
/// assert!(FILES[0].1.contains("\"tolerance_ulp\": 0.5"));
/// ```
pub const FILES: &[(&str, &str)] = files![
    "cell.entropy",
    "cell.information",
    "cell.entropy_from_log_odds",
    "cell.information_from_log_odds",
    "cell.occupancy_from_log_odds",
    "map.entropy",
    "map.information",
    "map.mean_information",
    "map.observed",
    "sensor.occupancy",
    "grid.polar.mean_information",
    "grid.cartesian.mean_information",
    "fuse.log_odds",
    "expected.mean_information",
    "limit.radial",
    "limit.area",
];
