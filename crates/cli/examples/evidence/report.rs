//! The evidence as text, as JSON, and as plots.

use crate::measured::{DEFAULT, GAUSSIAN, MEAN_INFORMATION, MIDDLE, Measure, Model};
use crate::perturbed::Kind;
use crate::ranks::{Correlation, spearman};
use crate::relations::YARDSTICKS;
use crate::row::Row;
use crate::rule::{Pairs, Seen, ordered, pairs, seen, to_corrected};
use mean_information::scan::Difference;
use mean_information_cli::Failure;
use mean_information_cli::output::{Number, Record, Report, Value, table};
use mean_information_cli::plots::{Cloud, Colour, Scale, Scatter};
use std::fmt::Write;

/// How well one measure tells.
#[derive(Debug)]
struct Column {
    /// The measure, with its value for the corrected trajectory.
    measure: Measure,
    /// Its value by odometry.
    odometry: f64,
    /// The correlations with the yardsticks; positive where the measure finds the trajectory with less error better.
    correlations: [Correlation; 4],
    /// The correlations with the mean errors of translation and rotation, without jitter.
    without_jitter: [f64; 2],
    /// The part of the pairs of known order that it orders so.
    ordered: f64,
    /// The standard deviation, and the greatest difference to the corrected one, that moves of the whole make.
    moves: [f64; 2],
}

/// The rank correlations of one kind of error.
#[derive(Debug)]
struct OfKind {
    kind: Kind,
    /// The correlations of mean information with the mean errors of translation and rotation.
    correlations: [f64; 2],
    /// The parts of the pairs of known order that mean information orders so, and that the relations do: the mean errors of
    /// translation and rotation.
    ordered: [f64; 3],
}

/// All of it.
#[derive(Debug)]
pub(crate) struct Evidence {
    rows: Vec<Row>,
    differences: Vec<Difference>,
    relations: usize,
    columns: Vec<Column>,
    kinds: Vec<OfKind>,
    pairs: [Vec<Pairs>; 2],
    seen: Vec<Seen>,
}

/// The columns of mean information by a model at a resolution.
fn column_of(rows: &[Row], model: Model, resolution: f64) -> usize {
    let is = |measure: &Measure| {
        measure.name == MEAN_INFORMATION
            && measure.by == model.name()
            && measure.resolution == Some(resolution)
    };
    rows[0].measured.measures.iter().position(is).expect("it is measured")
}

impl Evidence {
    /// Ranks the trajectories, the first of which is the corrected one.
    pub(crate) fn new(rows: Vec<Row>, relations: usize) -> Result<Self, Failure> {
        let ranked: Vec<&Row> = rows.iter().filter(|row| row.is_ranked()).collect();
        let yardstick =
            |rows: &[&Row], k: usize| rows.iter().map(|row| row.errors.yardsticks()[k]).collect::<Vec<_>>();
        let losses = |rows: &[&Row], k: usize| rows.iter().map(|row| row.loss(k)).collect::<Vec<_>>();
        let calm: Vec<&Row> = ranked.iter().filter(|row| row.made.kind != Kind::Jitter).copied().collect();
        let columns = rows[0].measured.measures.iter().enumerate().map(|(k, measure)| {
            let own = losses(&ranked, k);
            let value = |row: &Row| row.measured.measures[k].value;
            let moved = rows.iter().filter(|row| row.made.kind == Kind::Moved).map(value);
            let odometry = rows.iter().find(|row| row.made.kind == Kind::Odometry).map_or(f64::NAN, value);
            Column {
                measure: measure.clone(),
                odometry,
                correlations: [0, 1, 2, 3].map(|y| Correlation::new(&own, &yardstick(&ranked, y))),
                without_jitter: [0, 1].map(|y| spearman(&losses(&calm, k), &yardstick(&calm, y))),
                ordered: ordered(&rows, &Kind::ERRORS, |row| row.loss(k)),
                moves: spread(measure.value, &moved.collect::<Vec<_>>()),
            }
        });
        let columns: Vec<_> = columns.collect();
        let middle = column_of(&rows, DEFAULT, MIDDLE);
        let kinds = Kind::ERRORS.map(|kind| {
            let is_own = |row: &&&Row| [kind, Kind::Corrected].contains(&row.made.kind);
            let own: Vec<&Row> = ranked.iter().filter(is_own).copied().collect();
            OfKind {
                kind,
                correlations: [0, 1].map(|y| spearman(&losses(&own, middle), &yardstick(&own, y))),
                ordered: [
                    ordered(&rows, &[kind], |row| row.loss(middle)),
                    ordered(&rows, &[kind], |row| row.errors.yardsticks()[0]),
                    ordered(&rows, &[kind], |row| row.errors.yardsticks()[1]),
                ],
            }
        });
        let pairs = pairs(&ranked)?;
        let seen = seen(&rows, columns[middle].moves[1])?;
        let differences = rows.iter().map(|row| to_corrected(&rows, row));
        let differences = differences.collect::<Result<Vec<_>, mean_information::Error>>()?;
        Ok(Self { differences, relations, columns, kinds: kinds.into(), pairs, seen, rows })
    }

    /// Returns the scatter plots: a file, its plots, what they show.
    pub(crate) fn scatters(&self) -> [(&'static str, Vec<Scatter>, &'static str); 2] {
        let of = |model: Model, yardstick: usize, title: &str| {
            let column = column_of(&self.rows, model, MIDDLE);
            let horizontal = ["mean error of translation, m", "mean error of rotation, rad"][yardstick];
            let point = |row: &Row| (row.errors.yardsticks()[yardstick], row.measured.measures[column].value);
            let cloud = |kind: Kind, colour, filled| Cloud {
                name: kind.name().to_owned(),
                colour,
                filled,
                points: self.rows.iter().filter(|row| row.made.kind == kind).map(point).collect(),
            };
            let colours = [Colour::Blue, Colour::Orange, Colour::Grey];
            let styles = [false, true].into_iter().flat_map(|filled| colours.map(|colour| (colour, filled)));
            let clouds: Vec<_> = Kind::ERRORS
                .into_iter()
                .zip(styles)
                .map(|(kind, (colour, filled))| cloud(kind, colour, filled))
                .collect();
            Scatter {
                title: title.to_owned(),
                horizontal: horizontal.to_owned(),
                scale: Scale::Logarithmic,
                vertical: "mean information, bits per cell".to_owned(),
                clouds,
            }
        };
        let steps = "Steps of 0.4 and 0.7, cells of 10 cm";
        let eq5 = "Eq. 5, 5 cm, cells of 10 cm";
        [
            (
                "evidence.svg",
                vec![of(DEFAULT, 0, steps), of(GAUSSIAN, 0, eq5)],
                "Mean information against the error of translation of each trajectory, by the stepped model and by Eq. 5",
            ),
            (
                "evidence-rotation.svg",
                vec![of(DEFAULT, 1, steps), of(GAUSSIAN, 1, eq5)],
                "Mean information against the error of rotation of each trajectory, by the stepped model and by Eq. 5",
            ),
        ]
    }

    /// Returns the table of the trajectories.
    fn trajectories(&self) -> String {
        let rows = table(
            ["kind", "size", "seed", "m", "rad", "bits", "standard error"],
            self.rows.iter().zip(&self.differences).map(|(row, difference)| {
                let [translation, rotation, ..] = row.errors.yardsticks();
                [
                    row.made.kind.name().to_owned(),
                    row.made.size.to_string(),
                    row.made.seed.to_string(),
                    format!("{translation:.4}"),
                    format!("{rotation:.4}"),
                    format!("{:.5}", difference.value()),
                    format!("{:.5}", difference.standard_error()),
                ]
            }),
        );
        format!(
            "\nTrajectories: mean errors; mean information at 10 cm less that of the corrected one\n{rows}"
        )
    }
}

/// The standard deviation of numbers, and the greatest of their distances from `value`.
fn spread(value: f64, numbers: &[f64]) -> [f64; 2] {
    let n = numbers.len() as f64;
    let mean = numbers.iter().sum::<f64>() / n;
    let squares = numbers.iter().map(|x| (x - mean) * (x - mean)).sum::<f64>();
    let greatest = numbers.iter().map(|x| (x - value).abs()).fold(0.0, f64::max);
    [mean_information::elementary::sqrt(squares / (n - 1.0)), greatest]
}

/// Writes a number to four digits after the point, a great one without any.
fn digits(x: f64) -> String {
    if x.abs() >= 100.0 { format!("{x:.0}") } else { format!("{x:.4}") }
}

fn centimetres(resolution: Option<f64>) -> String {
    resolution.map_or(String::new(), |side| format!("{:.0} cm", 100.0 * side))
}

fn size(size: Option<f64>) -> String {
    size.map_or("none".to_owned(), |size| size.to_string())
}

impl Report for Evidence {
    fn table(&self) -> String {
        let ranked = self.rows.iter().filter(|row| row.is_ranked()).count();
        let mut text =
            format!("{ranked} trajectories, {} relations\n\nSpearman's rank correlation\n", self.relations);
        let with_interval =
            |c: &Correlation| format!("{:.3} [{:.2}, {:.2}]", c.value, c.interval[0], c.interval[1]);
        text += &table(
            [
                "measure",
                "model",
                "cells",
                YARDSTICKS[0],
                YARDSTICKS[1],
                "squared",
                "squared rot.",
                "no jitter",
                "in order",
                "corrected",
                "odometry",
                "moved: sd",
                "most",
            ],
            self.columns.iter().map(|column| {
                let Column { measure, odometry, correlations, without_jitter, ordered, moves } = column;
                [
                    measure.name.to_owned(),
                    measure.by.clone(),
                    centimetres(measure.resolution),
                    with_interval(&correlations[0]),
                    with_interval(&correlations[1]),
                    format!("{:.3}", correlations[2].value),
                    format!("{:.3}", correlations[3].value),
                    without_jitter.map(|value| format!("{value:.3}")).join(", "),
                    format!("{ordered:.3}"),
                    digits(measure.value),
                    digits(*odometry),
                    digits(moves[0]),
                    digits(moves[1]),
                ]
            }),
        );
        text += "\nMean information by the default model, 10 cm: correlations within a kind; pairs of known order\n";
        text += &table(
            [
                "kind",
                "translation",
                "rotation",
                "in order",
                "by translation",
                "by rotation",
                "seen: 2 se",
                "moves",
                "relations",
            ],
            self.kinds.iter().zip(&self.seen).map(|(of, seen)| {
                [
                    of.kind.name().to_owned(),
                    format!("{:.3}", of.correlations[0]),
                    format!("{:.3}", of.correlations[1]),
                    format!("{:.3}", of.ordered[0]),
                    format!("{:.3}", of.ordered[1]),
                    format!("{:.3}", of.ordered[2]),
                    size(seen.standard_error),
                    size(seen.moves),
                    size(seen.relations),
                ]
            }),
        );
        for (pairs, unit) in self.pairs.iter().zip(["bits", "standard errors"]) {
            let _ = writeln!(
                text,
                "\nPairs by their difference in {unit}, 10 cm: part in the order of the relations"
            );
            text += &table(
                ["below", "pairs", "translation", "rotation"],
                pairs.iter().map(|pairs| {
                    let part = |right: usize| format!("{:.3}", right as f64 / pairs.count as f64);
                    [
                        pairs.below.to_string(),
                        pairs.count.to_string(),
                        part(pairs.as_translation),
                        part(pairs.as_rotation),
                    ]
                }),
            );
        }
        text + &self.trajectories()
    }

    fn rows(&self) -> Vec<Record> {
        let number = |x: f64| Value::Computed(Some(Number::Double(x)));
        let record = |(row, difference): (&Row, &Difference)| {
            let yardsticks = row.errors.yardsticks().map(|x| Some(Number::Double(x))).to_vec();
            let values = row.measured.measures.iter().map(|measure| Some(Number::Double(measure.value)));
            Record(vec![
                ("kind", Value::Text(row.made.kind.name().to_owned())),
                ("size", Value::Given(Some(row.made.size))),
                ("seed", Value::Count(row.made.seed)),
                ("errors", Value::Numbers(yardsticks)),
                ("measures", Value::Numbers(values.collect())),
                ("difference_bits", number(difference.value())),
                ("standard_error_bits", number(difference.standard_error())),
            ])
        };
        self.rows.iter().zip(&self.differences).map(record).collect()
    }

    fn json(&self) -> Value {
        let numbers =
            |numbers: &[f64]| Value::Numbers(numbers.iter().map(|&x| Some(Number::Double(x))).collect());
        let column = |column: &Column| {
            let values: Vec<f64> = column.correlations.iter().map(|c| c.value).collect();
            let intervals: Vec<f64> = column.correlations.iter().flat_map(|c| c.interval).collect();
            Record(vec![
                ("measure", Value::Text(column.measure.name.to_owned())),
                ("by", Value::Text(column.measure.by.clone())),
                ("resolution_m", Value::Given(column.measure.resolution)),
                ("spearman", numbers(&values)),
                ("intervals", numbers(&intervals)),
                ("spearman_without_jitter", numbers(&column.without_jitter)),
                ("ordered", numbers(&[column.ordered])),
                ("moves", numbers(&column.moves)),
            ])
        };
        Value::Record(Record(vec![
            ("errors", Value::Texts(YARDSTICKS.map(str::to_owned).to_vec())),
            ("relations", Value::Count(self.relations as u64)),
            ("measures", Value::Records(self.columns.iter().map(column).collect())),
            ("trajectories", Value::Records(self.rows())),
        ]))
    }
}
