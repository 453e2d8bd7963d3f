//! The table of a sweep.

use crate::output::{Number, Record, Report, Value, table, with_notes};
use mean_information_report::sweep::Sweep;

impl Report for Sweep {
    fn table(&self) -> String {
        let header = [
            "cells\naveraged",
            "cell size\n(m)",
            "cells",
            "observed",
            "mean information\n(bits / cell)",
            "information\n(bits)",
            "entropy\n(bits)",
        ];
        let rows = self.steps.iter().map(|step| {
            let m = &step.measures;
            [
                self.depth(step)
                    .map_or_else(|| format!("{0} × {0}", step.k), |depth| format!("depth {depth}")),
                self.cell_size(step).map_or("unknown".to_owned(), |side| Number::given(side).to_string()),
                if self.has_depths {
                    (m.observed() + m.unknown).to_string()
                } else {
                    format!("{} × {}", m.width, m.height)
                },
                m.observed().to_string(),
                m.mean_information.map_or("none".to_owned(), |x| x.to_string()),
                format!("{:.3}", m.information.widen()),
                format!("{:.3}", m.entropy.widen()),
            ]
        });
        let notes = self.warnings.iter().map(|note| (&*self.name, &**note));
        with_notes(table(header, rows), notes)
    }

    fn rows(&self) -> Vec<Record> {
        self.rows()
    }

    fn json(&self) -> Value {
        self.json()
    }
}
