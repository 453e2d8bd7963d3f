//! What operations make of the entropies of their cells.

use super::{Answer, FloatFormat};
use mean_information_report::hex_float;
use mean_information_report::protocol::{Argument, Arguments};

/// What an operation makes of the entropies of its cells.
#[derive(Clone, Copy)]
pub(super) enum Measure {
    Entropy,
    Information,
    MeanInformation,
}

impl Measure {
    /// Returns the measure of an operation; of others none.
    pub(super) fn of(op: &str) -> Option<Self> {
        match op {
            "cell.entropy" | "map.entropy" => Some(Self::Entropy),
            "cell.information" | "map.information" => Some(Self::Information),
            "map.mean_information" => Some(Self::MeanInformation),
            _ => None,
        }
    }

    /// Returns the measure of cells whose entropy is given for all of them together.
    pub(super) fn value_of_all(self, cells: &[f64], entropy: impl Fn(&[f64]) -> f64) -> f64 {
        match self {
            Self::Entropy => entropy(cells),
            Self::Information => cells.len() as f64 - entropy(cells),
            Self::MeanInformation => {
                let observed: Vec<_> = cells.iter().copied().filter(|p| *p != 0.5).collect();
                (observed.len() as f64 - entropy(&observed)) / observed.len().max(1) as f64
            }
        }
    }

    /// Returns the measure of cells of the given entropies.
    pub(super) fn value(self, cells: &[f64], entropy: impl Fn(f64) -> f64) -> f64 {
        let sum = |value: &dyn Fn(f64) -> f64| cells.iter().map(|&p| value(p)).sum::<f64>();
        match self {
            Self::Entropy => sum(&entropy),
            Self::Information => sum(&|p| 1.0 - entropy(p)),
            Self::MeanInformation => {
                let observed = cells.iter().filter(|p| **p != 0.5).count();
                sum(&|p| if p == 0.5 { 0.0 } else { 1.0 - entropy(p) }) / observed.max(1) as f64
            }
        }
    }
}

/// Returns the cells of a map, or the one cell.
pub(super) fn occupancies(arguments: &Arguments) -> Option<Vec<f64>> {
    let float = |text: &String| hex_float::parse::<f64>(text).ok();
    match (arguments.get("p"), arguments.get("cells")) {
        (Some(Argument::Float(p)), _) => Some(vec![float(p)?]),
        (_, Some(Argument::List(cells))) => cells.iter().map(float).collect(),
        _ => None,
    }
}

/// Returns how far floats added up one by one may be from a sum `value`.
pub(super) fn width(answer: &Answer<Vec<f64>>, value: f64) -> f64 {
    let epsilon = match answer.format {
        FloatFormat::F32 => f64::from(f32::EPSILON),
        FloatFormat::F64 => f64::EPSILON,
    };
    epsilon * answer.asked.len() as f64 * (3.0 + value.abs())
}
