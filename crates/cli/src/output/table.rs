//! Tables for people.

use comfy_table::{Cell, CellAlignment, ContentArrangement, LineStyle, Table, presets};
use mean_information_report::one_line;

/// Names are wrapped to this many characters, as far as they have folders to wrap after.
const NAME_WIDTH: usize = 20;

/// Returns a table of numbers: its columns are set right, but the first, which holds names. The same text in a terminal
/// and in a file: as wide as its contents, for a number broken in two is no number.
pub fn table<const N: usize>(header: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    aligned(header, rows, CellAlignment::Right)
}

/// Returns a table of texts, set left.
pub fn text_table<const N: usize>(header: [&str; N], rows: impl IntoIterator<Item = [String; N]>) -> String {
    aligned(header, rows, CellAlignment::Left)
}

/// The columns but the first as they are to be aligned.
fn aligned<const N: usize>(
    header: [&str; N],
    rows: impl IntoIterator<Item = [String; N]>,
    alignment: CellAlignment,
) -> String {
    let rows: Vec<_> = rows.into_iter().collect();
    // Lines between rows only where a row may have several lines itself.
    let tall = rows.iter().flatten().any(|text| text.contains('\n'));
    let style = presets::UTF8_HORIZONTAL_ONLY;
    let mut table = Table::new();
    table.load_style(if tall { style } else { style.row_separator(LineStyle::none()) });
    table.set_content_arrangement(ContentArrangement::Disabled);
    table.set_header(header.map(Cell::new));
    table.add_rows(rows);
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(alignment);
    }
    table.trim_fmt() + "\n"
}

/// Returns the name of a file without control characters, a long one in several lines, each of which ends with a folder.
pub fn wrapped(name: &str) -> String {
    let mut lines = String::new();
    let mut width = 0;
    for part in one_line(name).split_inclusive('/') {
        let more = part.chars().count();
        if width > 0 && width + more > NAME_WIDTH {
            lines.push('\n');
            width = 0;
        }
        lines.push_str(part);
        width += more;
    }
    lines
}

/// Folds a text into lines of about `width` characters.
pub fn folded(text: &str, width: usize) -> String {
    let mut lines = String::new();
    let mut length = 0;
    for word in text.split(' ') {
        if length > 0 && length + word.chars().count() >= width {
            lines.push('\n');
            length = 0;
        } else if length > 0 {
            lines.push(' ');
        }
        lines.push_str(word);
        length += word.chars().count() + 1;
    }
    lines
}

/// Appends to a table what is to be said of each map, each in a line.
pub fn with_notes<'a>(table: String, notes: impl IntoIterator<Item = (&'a str, &'a str)>) -> String {
    notes.into_iter().fold(table, |text, (map, note)| text + &one_line(&format!("{map}: {note}")) + "\n")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_are_wrapped_after_folders_only() {
        assert_eq!(wrapped("maps/room.yaml"), "maps/room.yaml");
        let long = "/srv/maps/2024-11-03/building_7/ground_floor/a_rather_long_name_of_a_map_in_a_file.yaml";
        let lines =
            "/srv/maps/\n2024-11-03/\nbuilding_7/\nground_floor/\na_rather_long_name_of_a_map_in_a_file.yaml";
        assert_eq!(wrapped(long), lines);
        assert_eq!(wrapped(""), "");
        assert_eq!(wrapped("a\nb\u{1b}[2J.yaml"), "a\\nb\\u{1b}[2J.yaml");
    }

    #[test]
    fn text_is_folded_between_words() {
        assert_eq!(folded("one two three four", 9), "one two\nthree\nfour");
        assert_eq!(folded("", 9), "");
        assert_eq!(folded("incomprehensibilities", 9), "incomprehensibilities");
    }
}
