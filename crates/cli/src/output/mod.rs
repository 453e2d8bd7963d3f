//! What every command does with its result: a table, JSON or CSV; to standard output or to files.

mod files;
pub(crate) mod formulas;
mod page;
mod standard_output;
mod table;
mod writing;
mod xml;

pub use files::Files;
pub(crate) use mean_information_report::number::{decimal_exponent, short};
pub use mean_information_report::{Number, Record, Value, record};
pub(crate) use page::{PAGE, book, page};
pub use table::{folded, table, text_table, with_notes, wrapped};
pub use writing::{Writing, may_write, write_text};
pub(crate) use xml::escaped;

use clap::ValueEnum;

/// The form of a result.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A table for people.
    #[default]
    Table,
    /// JSON for programs: the keys of the contract, in its order.
    Json,
    /// CSV for spreadsheets: the columns are the keys of the JSON.
    Csv,
}

/// A result that can be written in every [`Format`].
pub trait Report {
    /// Returns the table for people; it ends with a newline.
    fn table(&self) -> String;

    /// Returns one record per row; all have the same keys.
    fn rows(&self) -> Vec<Record>;

    /// Returns the array of the rows, unless a command says otherwise.
    fn json(&self) -> Value {
        Value::Records(self.rows())
    }

    /// Returns the text in one of the formats.
    fn text(&self, format: Format) -> String {
        match format {
            Format::Table => self.table(),
            Format::Json => record::to_json(&self.json()),
            Format::Csv => record::to_csv(&self.rows()),
        }
    }
}
