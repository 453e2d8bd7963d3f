//! The rows of a comparison, one a trajectory, and their form as table, JSON and CSV.

use super::alike::Frame;
use super::common::{Candidate, Common};
use super::contradictions::Contradiction;
use super::labels::labels;
use super::measure::{BLOCKS, Measured};
use super::parting::Parting;
use super::row::{Row, Used};
use super::verdict::{Behind, verdict};
use super::warnings;
use crate::output::{Number, Record, Report, Value, short, table, with_notes, wrapped};
use mean_information::scan::Difference;
use mean_information_report::measures::Measures;
use mean_information_report::one_line;

/// What is said below the worst places of one trajectory.
const WORST: &str =
    "a trajectory that is right has its worst places, too: at doors, people, glass, and the edges of cells";

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
        let labels = labels(&candidates.iter().map(|of| of.name.clone()).collect::<Vec<_>>());
        let frame = |own: usize, other: usize| Frame::of(common, own, other, used.setup.resolution);
        let all = candidates.iter().zip(&common.without_pose).zip(measured).enumerate();
        let rows = all.map(|(index, ((candidate, &scans_without_pose), own))| {
            let mut row = Row {
                name: candidate.name.clone(),
                scans_without_pose,
                measures: Measures::of_tally(own.size, &own.tally),
                agreement: own.agreement,
                revisited: own.revisited(),
                parting: Parting::of(common, index, order[0], BLOCKS)
                    .filter(|_| frame(index, order[0]).is_none()),
                difference: if index == 0 { None } else { against(&measured[0], own) },
                contradictions: own.contradictions.clone(),
                warnings: candidate.warnings.clone(),
            };
            row.warnings.extend(warnings::of_row(&row, &measured[0]));
            row.warnings.extend(warnings::stretched(common, index));
            let same = (0..index).find(|&other| common.poses[other] == common.poses[index]);
            let alike = (0..index).find_map(|other| Some((other, frame(index, other)?)));
            row.warnings.extend(match (same, alike) {
                (Some(same), _) => Some(warnings::identical(&candidates[same].name)),
                (None, Some((other, frame))) => Some(warnings::alike(&labels[other], &frame)),
                (None, None) => None,
            });
            row
        });
        let rows: Vec<_> = rows.collect();
        let behind = |&index: &usize| {
            let difference = against(&measured[index], &measured[order[0]])?;
            Some(Behind { label: &labels[index], difference, frame: frame(index, order[0]) })
        };
        let verdict = match &*order {
            [best, others @ ..] => {
                let others: Option<Vec<_>> = others.iter().map(behind).collect();
                others.and_then(|others| verdict(&labels[*best], &others))
            }
            [] => None,
        };
        let mut used = used;
        used.warnings.extend(warnings::of_scans(&used, common, &labels));
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
        let [row] = &self.rows[..] else { return Vec::new() };
        let places: Vec<_> = row.contradictions.iter().map(Contradiction::in_words).collect();
        let own = (!places.is_empty()).then(|| WORST.to_owned());
        places.into_iter().chain(own).map(|words| (row.name.as_str(), words)).collect()
    }

    /// Says what the maps were made of, in words.
    pub fn made_of(&self) -> [String; 2] {
        let Used { scans, scans_used, beams, setup, laser, .. } = &self.used;
        let errors = match BLOCKS.min(*scans_used) {
            1 => "no standard errors, as there is one scan alone".to_owned(),
            parts => format!("standard errors by leaving out each of {parts} parts of the log"),
        };
        [
            format!("{scans_used} of {scans} scans with {beams} beams; {}", laser.in_words),
            format!(
                "cells of {} m; sensor {}; readings up to {} nats; {errors}",
                setup.resolution, setup.sensor, setup.reading_limit,
            ),
        ]
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
        ];
        entries.extend(used.setup.entries());
        entries.extend(used.laser.entries());
        entries.extend([resolution, width, height]);
        entries.extend(measures);
        let number = |of: fn(&Difference) -> f64| {
            Value::Computed(self.difference.as_ref().map(|difference| Number::Double(of(difference))))
        };
        entries.extend([
            ("revisited", Value::Count(self.revisited)),
            ("agreement", Value::Computed(Some(Number::Double(self.agreement)))),
            ("difference", number(Difference::value)),
            ("standard_error", number(Difference::standard_error)),
            ("partings", Value::Records(self.parting.as_ref().map(Parting::records).unwrap_or_default())),
            (
                "contradictions",
                Value::Records(self.contradictions.iter().map(Contradiction::record).collect()),
            ),
            ("meaningful", Value::Flag(self.measures.not_meaningful.is_none())),
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
