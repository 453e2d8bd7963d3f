//! Tables for people.

use comfy_table::{Cell, CellAlignment, ContentArrangement, LineStyle, Table, presets};

/// The widest table, in characters; wider contents are wrapped.
const WIDTH: u16 = 120;

/// A table with its columns set right, but the first, which holds names. The same text in a terminal and in a file.
pub fn table<const N: usize>(header: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    let rows: Vec<_> = rows.into_iter().collect();
    // Lines between rows only where a row may have several lines itself.
    let tall = rows.iter().flatten().any(|text| text.contains('\n'));
    let style = presets::UTF8_HORIZONTAL_ONLY;
    let mut table = Table::new();
    table.load_style(if tall { style } else { style.row_separator(LineStyle::none()) });
    table.set_content_arrangement(ContentArrangement::Dynamic).set_width(WIDTH);
    table.set_header(header.map(Cell::new));
    table.add_rows(rows);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table.trim_fmt() + "\n"
}

/// The table with what is to be said of each map below it.
pub fn with_notes<'a>(table: String, notes: impl IntoIterator<Item = (&'a str, &'a str)>) -> String {
    notes.into_iter().fold(table, |text, (map, note)| text + map + ": " + note + "\n")
}
