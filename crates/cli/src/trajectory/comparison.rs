//! The rows of a comparison, one a trajectory, and their form as table, JSON and CSV.

use super::common::{Candidate, Common};
use super::contradictions::Contradiction;
use super::labels::labels;
use super::measure::{BLOCKS, Measured};
use super::parting::Parting;
use super::row::{Row, Used};
use super::warnings;
use crate::output::{Number, Record, Report, Value, short, table, with_notes, wrapped};
use mean_information::scan::Difference;
use mean_information_report::measures::Measures;
use mean_information_report::one_line;

/// The quantile of Student's distribution with 19 degrees of freedom, one less than blocks: 95 % lie within it on both sides.
const CLEAR: f64 = 2.093;

/// Trajectories compared on the same scans.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The scans that the rows were measured of, and how.
    pub used: Used,
    /// The rows, in the order in which the trajectories were given.
    pub rows: Vec<Row>,
    /// The short name of the row with the most mean information.
    pub best: Option<String>,
    /// The answer in a sentence, of two rows or more.
    pub verdict: Option<String>,
    /// Short names of the rows.
    pub labels: Vec<String>,
}

impl Comparison {
    /// Creates a comparison from what was measured of each candidate.
    pub fn new(used: Used, candidates: &[Candidate], common: &Common<'_>, measured: &[Measured]) -> Self {
        let against = |one: &Measured, other: &Measured| {
            let without: Vec<_> =
                one.without.iter().zip(&other.without).map(|(a, b)| [a.clone(), b.clone()]).collect();
            Difference::by_jackknife([&one.tally, &other.tally], &without).ok()
        };
        // From the most information to the least; of equal ones the first first.
        let mut order: Vec<_> = (0..measured.len()).collect();
        order.sort_by(|&a, &b| {
            let [a, b] = [a, b].map(|k| measured[k].tally.mean_information());
            b.total_cmp(&a)
        });
        let all = candidates.iter().zip(&common.without_pose).zip(measured).enumerate();
        let rows = all.map(|(index, ((candidate, &scans_without_pose), own))| {
            let mut row = Row {
                name: candidate.name.clone(),
                scans_without_pose,
                measures: Measures::of_tally(own.size, &own.tally),
                agreement: own.agreement,
                revisited: own.revisited(),
                parting: Parting::of(common, index, order[0], BLOCKS).filter(|_| index != order[0]),
                difference: if index == 0 { None } else { against(&measured[0], own) },
                contradictions: own.contradictions.clone(),
                warnings: candidate.warnings.clone(),
            };
            row.warnings.extend(warnings::of_row(&row, &measured[0]));
            let same = common.poses[..index].iter().position(|poses| *poses == common.poses[index]);
            row.warnings.extend(same.map(|same| warnings::identical(&candidates[same].name)));
            row
        });
        let rows: Vec<_> = rows.collect();
        let mut used = used;
        used.warnings.extend(warnings::of_scans(&used, common.silent));
        let labels = labels(&candidates.iter().map(|of| of.name.clone()).collect::<Vec<_>>());
        let verdict = match *order {
            [best, next, ..] => against(&measured[next], &measured[best])
                .map(|difference| verdict([&labels[best], &labels[next]], &difference)),
            _ => None,
        };
        let best = order.first().map(|&best| labels[best].clone());
        Self { used, rows, best, verdict, labels }
    }

    /// Returns what is to be said of the log and of the rows, each with the name of what it is about.
    pub(super) fn notes(&self) -> impl Iterator<Item = (&str, &str)> {
        let of_log = self.used.warnings.iter().map(|note| (self.used.log.as_str(), note.as_str()));
        let of_rows = self
            .rows
            .iter()
            .flat_map(|row| row.warnings.iter().map(|note| (row.name.as_str(), note.as_str())));
        of_log.chain(of_rows)
    }

    /// Says where each trajectory but the best parts from that one, with its name.
    pub(super) fn partings(&self) -> Vec<(&str, String)> {
        let Some(best) = &self.best else { return Vec::new() };
        let parting = |row: &'_ Row| row.parting.as_ref().map(|parting| parting.in_words(best));
        self.rows.iter().filter_map(|row| Some((row.name.as_str(), parting(row)?))).collect()
    }

    /// Says where the scans of a trajectory contradict one another most, with its name, if it is the only one: else the others
    /// show where.
    pub(super) fn contradictions(&self) -> Vec<(&str, String)> {
        let alone = match &self.rows[..] {
            [row] => &row.contradictions[..],
            _ => &[],
        };
        alone.iter().map(|place| (self.rows[0].name.as_str(), place.in_words())).collect()
    }

    /// Says what the maps were made of, in words.
    pub fn made_of(&self) -> [String; 2] {
        let Used { scans, scans_used, beams, setup, mount, .. } = &self.used;
        [
            format!("{scans_used} of {scans} scans with {beams} beams; {mount}"),
            format!(
                "cells of {} m; sensor {}; readings up to {} nats; standard errors by leaving out each of {} parts of the log",
                setup.resolution,
                setup.sensor,
                setup.reading_limit,
                BLOCKS.min(*scans_used)
            ),
        ]
    }
}

/// Tells whether the second map is better by more than chance explains: 97.5 % of the differences that chance makes are below.
fn is_clear(difference: &Difference) -> bool {
    difference.blocks() == BLOCKS && difference.value() > CLEAR * difference.standard_error()
}

/// Tells which of the two best is better.
fn verdict([best, next]: [&str; 2], difference: &Difference) -> String {
    let (value, error) = (difference.value(), difference.standard_error());
    let times = if error > 0.0 { format!(", {:.1} standard errors", value / error) } else { String::new() };
    if is_clear(difference) {
        format!("{best} makes the most consistent map: {value:.4} bits per cell above {next}{times}")
    } else {
        let ahead =
            format!(": {best} is ahead by {value:.4} bits per cell{times}, where {CLEAR:.1} would tell");
        let ahead = if value > 0.0 { ahead } else { String::new() };
        format!("{best} and {next} are not told apart by these scans{ahead}")
    }
}

impl Row {
    fn record(&self, used: &Used, verdict: Option<&str>) -> Record {
        let [width, height, resolution, measures @ ..] = self.measures.entries(Some(used.setup.resolution));
        let mut entries = vec![
            ("poses", Value::Text(self.name.clone())),
            ("scans", Value::Count(used.scans as u64)),
            ("scans_used", Value::Count(used.scans_used as u64)),
            ("scans_without_pose", Value::Count(self.scans_without_pose as u64)),
            ("beams", Value::Count(used.beams)),
            ("sensor", Value::Text(used.setup.sensor.to_string())),
            resolution,
            width,
            height,
        ];
        entries.extend(measures);
        let number = |of: fn(&Difference) -> f64| {
            Value::Computed(self.difference.as_ref().map(|difference| Number::Double(of(difference))))
        };
        entries.extend([
            ("revisited", Value::Count(self.revisited)),
            ("agreement", Value::Computed(Some(Number::Double(self.agreement)))),
            ("difference", number(Difference::value)),
            ("standard_error", number(Difference::standard_error)),
            ("partings", Value::Records(self.parting.iter().map(Parting::record).collect())),
            (
                "contradictions",
                Value::Records(self.contradictions.iter().map(Contradiction::record).collect()),
            ),
            ("verdict", verdict.map_or(Value::Given(None), |verdict| Value::Text(verdict.to_owned()))),
            ("warnings", Value::Texts(used.warnings.iter().chain(&self.warnings).cloned().collect())),
        ]);
        Record(entries)
    }

    /// Returns the cells of a table: digits below the standard error mean nothing.
    pub fn cells(&self, used: &Used) -> [String; 7] {
        let m = &self.measures;
        let difference = self.difference.as_ref().map_or(String::new(), |difference| {
            format!("{:+.4} ± {:.4}", difference.value(), difference.standard_error())
        });
        let area = m
            .observed_area(Some(used.setup.resolution))
            .map_or(String::new(), |area| format!("\n{} m²", short(area)));
        [
            wrapped(&self.name),
            m.mean_information.map_or("none".to_owned(), |x| format!("{:.4}", x.widen())),
            difference,
            format!("{:.4}", self.agreement),
            format!("{:.0}", m.entropy.widen()),
            format!("{}{area}", m.observed()),
            self.revisited.to_string(),
        ]
    }

    /// The heads of the columns.
    pub const HEADS: [&str; 7] = [
        "trajectory",
        Measures::MEAN_INFORMATION_HEAD,
        "difference\n± standard error",
        "agreement",
        "entropy\n(bits)",
        "observed",
        "revisited",
    ];
}

impl Report for Comparison {
    fn table(&self) -> String {
        let made_of = self.made_of();
        let made_of = made_of.iter().map(|note| (self.used.log.as_str(), note.as_str()));
        let mut places = self.partings();
        places.extend(self.contradictions());
        let places = places.iter().map(|(name, place)| (*name, place.as_str()));
        let text = table(Row::HEADS, self.rows.iter().map(|row| row.cells(&self.used)));
        let text = with_notes(text, made_of.chain(self.notes()).chain(places));
        self.verdict.iter().fold(text, |text, verdict| text + &one_line(verdict) + "\n")
    }

    fn rows(&self) -> Vec<Record> {
        self.rows.iter().map(|row| row.record(&self.used, self.verdict.as_deref())).collect()
    }
}
