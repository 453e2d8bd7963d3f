//! The page of a comparison: the answer, the table, the curves, the maps, and what the numbers mean.

use super::pictures::Pictures;
use super::row::Row;
use crate::failure::Failure;
use crate::output::{self, book, escaped, formulas, short};
use crate::plots::{Sheet, panels};
use mean_information_report::one_line;

const MEANING: &str = include_str!("meaning.html");

impl Pictures<'_> {
    /// Returns the page, one file that needs no other.
    ///
    /// # Errors
    /// None is known.
    pub fn page(&self) -> Result<String, Failure> {
        let comparison = self.comparison;
        let used = &comparison.used;
        let text = |text: &str| escaped(&one_line(text));
        let line = |line: &String| format!("{}.<br/>\n", capital(&text(line)));
        let note = |(name, note): (&str, &str)| {
            format!("<li><strong>{}</strong>: {}.</li>\n", text(name), text(note))
        };
        let parting = |(name, parting): (&str, String)| {
            format!("<p><strong>{}</strong> {}.</p>\n", text(name), text(&parting))
        };
        let answer = |answer: &String| format!("<p class=\"answer\">{}.</p>\n", text(answer));
        let log = text(&used.log);
        let made_of: String = comparison.made_of().iter().map(line).collect();
        let notes: String = comparison.notes().map(note).collect();
        let notes = if notes.is_empty() { notes } else { format!("<ul class=\"notes\">\n{notes}</ul>\n") };
        let partings: String = comparison.partings().into_iter().map(parting).collect();
        let contradictions: String = comparison.contradictions().into_iter().map(parting).collect();
        let answer: String = comparison.verdict.iter().map(answer).collect();
        let heads: String = Row::HEADS.iter().enumerate().map(|(k, head)| th(k, head)).collect();
        let rows: String = comparison.rows.iter().map(|row| tr(&row.cells(used))).collect();
        let curves = Sheet::new(vec![vec![self.series_svg()?]], self.described());
        let (maps, top) = self.panels()?;
        let maps =
            Sheet::new(panels(&maps, 2), "Each trajectory's map beside its contradictions.".to_owned());
        let Words { title, subject, look } = Words::of(comparison.rows.len());
        let (curves, maps, top) = (curves.element(), maps.element(), short(top));
        let meaning = MEANING
            .replace("{mean information}", formulas::MEAN_INFORMATION)
            .replace("{agreement}", formulas::AGREEMENT)
            .replace("{chapter}", &book("evidence", "Evidence"));
        let body = format!(
            r#"{answer}<p>{subject} of the scans of <code>{log}</code>, without ground truth:
where a trajectory is wrong, scans contradict one another.</p>
<section id="rows">
<h2>The maps in numbers</h2>
<table>
<caption>{made_of}</caption>
<thead><tr>{heads}</tr></thead>
<tbody>
{rows}</tbody>
</table>
{notes}</section>
<section id="series">
<h2>When</h2>
<figure>
{curves}<figcaption>The mean information of the map as it is made, scan by scan. It rises where places are seen again and
agree, and falls where new ground is seen once, or where a trajectory went wrong{look}.</figcaption>
</figure>
{partings}</section>
<section id="maps">
<h2>Where</h2>
<figure>
{maps}<figcaption>First the map: white is free, black is occupied, blue-grey is unknown. Beside or below it the evidence that cancels,
from <span class="ramp conflicts"></span> little to {top} nats per cell and more, with the path of the laser, from dark blue at its first pose,
which has a dot, to light blue at its last; the other dots have the seconds since the first scan.
Contradictions show that a trajectory is wrong, and along which walls, not at which pose: a wall that is seen twice was seen
from two poses. Doors and people contradict under any.</figcaption>
</figure>
{contradictions}</section>
{meaning}"#
        );
        Ok(output::page(title, &body))
    }

    /// Describes the curves to those who do not see them.
    fn described(&self) -> String {
        let ends = self.comparison.labels.iter().zip(self.measured).map(|(label, measured)| {
            format!("{} ends at {:.4}", one_line(label), measured.tally.mean_information())
        });
        format!("Mean information against time: {}.", ends.collect::<Vec<_>>().join(", "))
    }
}

/// The words of a page that depend on whether there are trajectories to compare.
struct Words {
    title: &'static str,
    subject: &'static str,
    look: &'static str,
}

impl Words {
    /// Returns the words of a page of so many trajectories.
    fn of(trajectories: usize) -> Self {
        if trajectories == 1 {
            return Self {
                title: "Where do the scans contradict one another?",
                subject: "A trajectory seen by the map that it makes",
                look: "",
            };
        }
        Self {
            title: "Which trajectory is right?",
            subject: "Trajectories compared by the maps that they make",
            look: ": look where a curve leaves the first",
        }
    }
}

fn class(column: usize) -> &'static str {
    if column == 0 { "" } else { " class=\"number\"" }
}

fn th(column: usize, head: &str) -> String {
    format!("<th scope=\"col\"{}>{}</th>", class(column), escaped(&head.replace('\n', " ")))
}

/// Begins a sentence.
fn capital(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map_or(String::new(), |first| first.to_uppercase().chain(letters).collect())
}

/// Returns a row; on a narrow screen each cell has its head before it.
fn tr(cells: &[String; 7]) -> String {
    let cell = |(column, text): (usize, &String)| {
        if column == 0 {
            return format!("<td>{}</td>", breakable(&escaped(&text.replace('\n', ""))));
        }
        // Lines break between numbers, not within them.
        let text = escaped(&text.replace(' ', "\u{a0}").replace('\n', ", "));
        let head = escaped(&Row::HEADS[column].replace('\n', " "));
        format!("<td data-label=\"{head}\"{}>{text}</td>", class(column))
    };
    format!("<tr>{}</tr>\n", cells.iter().enumerate().map(cell).collect::<String>())
}

/// Lets the name of a file break after its marks, before it breaks anywhere.
fn breakable(name: &str) -> String {
    let mark = |letter| if ['/', '.', '_', '-'].contains(&letter) { "<wbr/>" } else { "" };
    name.chars().flat_map(|letter| [letter.to_string(), mark(letter).to_owned()]).collect()
}
