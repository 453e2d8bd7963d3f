//! The list of operations.

use super::operation::{Argument, Operation, Outcome, Shape, Which};

/// Creates an argument that is a float.
const fn float(name: &'static str) -> Argument {
    Argument { name, shape: Shape::Float }
}

const P: &[Argument] = &[float("p")];
const L: &[Argument] = &[float("l")];
const CELLS: &[Argument] = &[Argument { name: "cells", shape: Shape::List }];
const ROOM: &[Argument] = &[float("range"), float("sigma")];

const OCCUPANCY: &str = "p from 0 to 1";
const LOG_ODDS: &str = "l any number, infinities too";
const OCCUPANCIES: &str = "each cell from 0 to 1";
const POSITIVE: &str = "range, sigma positive and finite";

/// Creates an operation whose result is a float, correctly rounded.
const fn rounded(
    which: Which,
    name: &'static str,
    arguments: &'static [Argument],
    domain: &'static str,
    equation: &'static str,
    function: &'static str,
) -> Operation {
    let (result, tolerance_ulp) = (Outcome::Float, 0.5);
    Operation { name, arguments, result, domain, equation, function, tolerance_ulp, which }
}

/// Widens the tolerance for a sum, a quotient of sums or an integral: 2 ulp.
const fn summed(operation: Operation) -> Operation {
    Operation { tolerance_ulp: 2.0, ..operation }
}

/// The list of all operations, in the order of the report.
pub const OPERATIONS: &[Operation] = &[
    rounded(
        Which::CellEntropy,
        "cell.entropy",
        P,
        OCCUPANCY,
        "H(p) = -p log2 p - (1-p) log2 (1-p), in bits",
        "cell::entropy",
    ),
    rounded(
        Which::CellInformation,
        "cell.information",
        P,
        OCCUPANCY,
        "I(p) = 1 - H(p), in bits",
        "cell::information",
    ),
    rounded(
        Which::CellEntropyFromLogOdds,
        "cell.entropy_from_log_odds",
        L,
        LOG_ODDS,
        "H(p) in bits for p = 1 / (1 + e^-l)",
        "cell::entropy_from_log_odds",
    ),
    rounded(
        Which::CellInformationFromLogOdds,
        "cell.information_from_log_odds",
        L,
        LOG_ODDS,
        "I(p) = 1 - H(p) in bits for p = 1 / (1 + e^-l)",
        "cell::information_from_log_odds",
    ),
    rounded(
        Which::CellOccupancyFromLogOdds,
        "cell.occupancy_from_log_odds",
        L,
        LOG_ODDS,
        "p = 1 / (1 + e^-l)",
        "cell::occupancy_from_log_odds",
    ),
    summed(rounded(
        Which::MapEntropy,
        "map.entropy",
        CELLS,
        OCCUPANCIES,
        "sum of H(p) over all cells, in bits; an unknown cell, p = 1/2, has 1 bit; 0 without cells",
        "Tally::entropy",
    )),
    summed(rounded(
        Which::MapInformation,
        "map.information",
        CELLS,
        OCCUPANCIES,
        "sum of I(p) = 1 - H(p) over all cells, in bits; 0 without cells",
        "Tally::information",
    )),
    summed(rounded(
        Which::MapMeanInformation,
        "map.mean_information",
        CELLS,
        OCCUPANCIES,
        "sum of I(p) over all cells / number of cells with p != 1/2, in bits; 0 if there is none",
        "Tally::mean_information",
    )),
    Operation {
        result: Outcome::Count,
        tolerance_ulp: 0.0,
        ..rounded(
            Which::MapObserved,
            "map.observed",
            CELLS,
            OCCUPANCIES,
            "number of cells with p != 1/2",
            "Tally::observed",
        )
    },
    rounded(
        Which::SensorOccupancy,
        "sensor.occupancy",
        &[float("rho"), float("range"), float("sigma")],
        "rho any number, infinities too; range, sigma positive and finite",
        "p = exp(-((rho - range) / (sigma sqrt 2))^2) for rho <= range + sigma sqrt(ln 4), 1/2 beyond",
        "GaussianSensor::occupancy",
    ),
    summed(rounded(
        Which::GridPolar,
        "grid.polar.mean_information",
        &[float("range"), float("sigma"), float("resolution")],
        "range, sigma, resolution positive and finite",
        "mean of I(p(rho)) over rho = (k + 1/2) resolution, k = 0, 1, ..., with p != 1/2; p by sensor.occupancy; \
         0 if there is none",
        "PolarRoom::tally",
    )),
    summed(rounded(
        Which::GridCartesian,
        "grid.cartesian.mean_information",
        &[float("range"), float("sigma"), float("resolution"), float("offset_x"), float("offset_y")],
        "range, sigma, resolution positive and finite; offsets finite",
        "mean of I(p(rho)) over rho = resolution sqrt((i + offset_x)^2 + (j + offset_y)^2), i and j integers, \
         with p != 1/2; p by sensor.occupancy; 0 if there is none",
        "CartesianRoom::tally",
    )),
    rounded(
        Which::FuseLogOdds,
        "fuse.log_odds",
        CELLS,
        "each cell from 0 to 1; not 0 and 1 together",
        "p = prod p_i / (prod p_i + prod (1 - p_i)): log-odds add; 1/2 without observations",
        "fusion::fuse",
    ),
    summed(rounded(
        Which::ExpectedMeanInformation,
        "expected.mean_information",
        &[
            Argument { name: "weights", shape: Shape::List },
            Argument { name: "particles", shape: Shape::Rows },
        ],
        "weights not negative, finite, not all 0; one particle for each, all of one length; cells from 0 to 1",
        "mean information of the map p = sum w_i p_i / sum w_i, exactly; a cell is observed if p != 1/2, exactly",
        "ExpectedMap::tally",
    )),
    summed(rounded(
        Which::LimitRadial,
        "limit.radial",
        ROOM,
        POSITIVE,
        "1 - int H(e^(-t^2/2)) dt / (a + b), t from -a to b, a = range / sigma, b = sqrt(ln 4), in bits",
        "limit::closed_form",
    )),
    summed(rounded(
        Which::LimitArea,
        "limit.area",
        ROOM,
        POSITIVE,
        "1 - 2 int (a + t) H(e^(-t^2/2)) dt / (a + b)^2, t, a and b as for limit.radial, in bits",
        "limit::closed_form",
    )),
];

/// Finds the operation of a name.
///
/// ```
/// use mean_information::operations::find;
/// assert_eq!(find("limit.area").map(|operation| operation.tolerance_ulp), Some(2.0));
/// assert_eq!(find("limit.volume"), None);
/// ```
pub fn find(name: &str) -> Option<&'static Operation> {
    OPERATIONS.iter().find(|operation| operation.name == name)
}
