//! The rows of a filter's log as table, JSON and CSV.

use super::steps::Row;
use crate::output::{Number, Record, Report, Value, table, with_notes};
use crate::trajectory::{Laser, Setup};
use mean_information_report::measures::Measures;

/// The log that rows were made of, and how.
#[derive(Clone, Debug)]
pub struct Made {
    /// The name of the log.
    pub log: String,
    /// The number of its steps.
    pub steps: usize,
    /// The number of its resamplings.
    pub resamplings: usize,
    /// The number of its particles.
    pub particles: usize,
    /// The gain of its weights.
    pub gain: f64,
    /// The setup of the maps.
    pub setup: Setup,
    /// The laser.
    pub laser: Laser,
    /// The warnings of the log.
    pub warnings: Vec<String>,
}

/// The rows, and what they were made of.
#[derive(Clone, Debug)]
pub struct FilterReport {
    /// The log that they were made of, and how.
    pub made: Made,
    /// The rows, in the order of the log: one or more.
    pub rows: Vec<Row>,
}

impl Made {
    /// Says what the rows were made of, in words.
    pub fn in_words(&self) -> [String; 2] {
        let Self { steps, resamplings, particles, gain, setup, laser, .. } = self;
        [
            format!(
                "{steps} scans, {particles} particles, {resamplings} resamplings; weights by a gain of {gain}; {}",
                laser.in_words
            ),
            format!(
                "cells of {} m; sensor {}; readings up to {} nats",
                setup.resolution, setup.sensor, setup.reading_limit
            ),
        ]
    }
}

impl FilterReport {
    /// Returns the record of a row; what was noticed of the log stands in its first.
    fn record(&self, index: usize, row: &Row) -> Record {
        let Row { step, time, effective, left, expected, mean_of_particles } = row;
        let setup = &self.made.setup;
        let of_row = expected.warning();
        let of_log = if index == 0 { &*self.made.warnings } else { &[] };
        let mut entries = vec![
            ("step", Value::Count(*step as u64)),
            ("time_s", Value::Given(Some(*time))),
            ("effective_particles", Value::Computed(Some(Number::Double(*effective)))),
            ("resampled", Value::Flag(left.is_some())),
            ("particles_left", left.map_or(Value::Given(None), |left| Value::Count(left as u64))),
            ("emmi", Value::Computed(expected.mean_information)),
            ("observed", Value::Count(expected.observed())),
            ("information_bits", Value::Computed(Some(expected.information))),
            ("entropy_bits", Value::Computed(Some(expected.entropy))),
            ("mean_of_particles", Value::Computed(*mean_of_particles)),
            ("particles", Value::Count(self.made.particles as u64)),
            ("resolution_m", Value::Given(Some(setup.resolution))),
        ];
        entries.extend(setup.entries());
        entries.extend(self.made.laser.entries());
        entries.extend([
            ("mount", Value::Text(self.made.laser.in_words.clone())),
            ("gain", Value::Given(Some(self.made.gain))),
            ("meaningful", Value::Flag(expected.not_meaningful.is_none())),
            ("warnings", Value::Texts(of_log.iter().cloned().chain(of_row).collect())),
        ]);
        Record(entries)
    }
}

impl Report for FilterReport {
    fn table(&self) -> String {
        let head = [
            "step",
            "after\n(s)",
            "effective\nparticles",
            "resampled:\nleft",
            "EMMI\n(bits / cell)",
            "mean of particles\n(bits / cell)",
            "observed",
            "entropy\n(bits)",
        ];
        let first = self.rows.first().map_or(0.0, |row| row.time);
        let digits = |x: Option<Number>| x.map_or("none".to_owned(), |x| format!("{:.4}", x.widen()));
        let cells = |row: &Row| {
            let Measures { mean_information, entropy, .. } = row.expected;
            [
                row.step.to_string(),
                format!("{:.1}", row.time - first),
                format!("{:.2}", row.effective),
                row.left.map_or(String::new(), |left| left.to_string()),
                digits(mean_information),
                digits(row.mean_of_particles),
                row.expected.observed().to_string(),
                format!("{:.0}", entropy.widen()),
            ]
        };
        let words = self.made.in_words();
        let notes = words.iter().chain(&self.made.warnings).map(|note| (&*self.made.log, &**note));
        with_notes(table(head, self.rows.iter().map(cells)), notes)
    }

    fn rows(&self) -> Vec<Record> {
        self.rows.iter().enumerate().map(|(index, row)| self.record(index, row)).collect()
    }
}
