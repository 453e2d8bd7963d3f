//! Text of others in one line, for messages and tables.

/// Returns the text in one line, whatever a file is called or a message quotes: control characters are escaped.
pub fn one_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for c in text.chars() {
        if c.is_control() { line.extend(c.escape_default()) } else { line.push(c) }
    }
    line
}
