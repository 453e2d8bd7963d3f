//! The curves of a filter's log against time.

use super::steps::Row;
use crate::output::Number;
use crate::plots::{Chart, ChartPanel, Colour, Curve, Marks, Scale, Shape};

/// Creates the chart of rows of a filter of `of` particles: EMMI with the particles' own mean, the entropy of the expected map, and the particles that count
/// with those that a resampling leaves. Where it leaves few, a line goes through all panels.
pub fn chart(rows: &[Row], of: usize, title: String) -> Chart<3> {
    let first = rows.first().map_or(0.0, |row| row.time);
    let curve = |name: &str, colour, marks, of: &dyn Fn(&Row) -> Option<f64>| Curve {
        name: name.to_owned(),
        colour,
        marks,
        points: rows.iter().filter_map(|row| Some((row.time - first, of(row)?))).collect(),
    };
    let panel =
        |vertical, curves| ChartPanel { vertical, scale: Scale::Linear, curves, marks: marks(rows, of) };
    let line = |name, colour, shape, of| curve(name, colour, Marks::Spaced(shape), of);
    let means = vec![
        line("EMMI", Colour::Blue, Shape::Circle, &|row| row.expected.mean_information.map(Number::widen)),
        line("mean of the particles' own", Colour::Grey, Shape::Square, &|row| {
            row.mean_of_particles.map(Number::widen)
        }),
    ];
    let entropy = vec![line("entropy of the expected map", Colour::Orange, Shape::Triangle, &|row| {
        Some(row.expected.entropy.widen() / 1e3)
    })];
    let particles = vec![
        line("effective particles", Colour::Green, Shape::Diamond, &|row| Some(row.effective)),
        curve("particles left by a resampling", Colour::Purple, Marks::Alone, &|row| {
            row.left.map(|left| left as f64)
        }),
    ];
    Chart {
        title,
        horizontal: "time since the first scan (s)",
        scale: Scale::Linear,
        panels: [
            panel("mean information (bits / cell)", means),
            panel("entropy (kbit)", entropy),
            panel("particles", particles),
        ],
    }
}

/// Marks the resamplings that leave few particles. A name that would be written over the one before is left out.
fn marks(rows: &[Row], of: usize) -> Vec<(f64, &'static str)> {
    let (first, last) = (rows.first().map_or(0.0, |row| row.time), rows.last().map_or(0.0, |row| row.time));
    let mut named: Option<f64> = None;
    let mark = |row: &Row| {
        let (time, name) = (row.time - first, few(row.left?, of)?);
        let is_free = named.is_none_or(|named| time - named > NAME * (last - first));
        named = if is_free { Some(time) } else { named };
        Some((time, if is_free { name } else { "" }))
    };
    rows.iter().filter_map(mark).collect()
}

/// The width of a name, as a part of that of the panel.
const NAME: f64 = 0.15;

/// Names a resampling that leaves few of so many particles: up to three, and not all.
fn few(left: usize, of: usize) -> Option<&'static str> {
    match left {
        _ if left >= of => None,
        1 => Some("1 left"),
        2 => Some("2 left"),
        3 => Some("3 left"),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::few;

    #[test]
    fn few_are_up_to_three_and_not_all() {
        assert_eq!(
            [1, 2, 3, 4].map(|left| few(left, 30)),
            [Some("1 left"), Some("2 left"), Some("3 left"), None]
        );
        assert_eq!([1, 2, 3].map(|left| few(left, 3)), [Some("1 left"), Some("2 left"), None]);
        assert_eq!(few(1, 1), None);
    }
}
