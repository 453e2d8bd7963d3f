//! Text within XML and HTML.

/// Escapes the characters of markup, for elements and attributes, and replaces what is no character of XML.
///
/// U+FFFE, U+FFFF and control characters other than tab and the ends of lines cannot stand in XML 1.0, not even as
/// references; each becomes U+FFFD.
pub(crate) fn escaped(text: &str) -> String {
    let mut xml = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => xml.push_str("&amp;"),
            '<' => xml.push_str("&lt;"),
            '>' => xml.push_str("&gt;"),
            '"' => xml.push_str("&quot;"),
            '\t' | '\n' | '\r' => xml.push(c),
            '\0'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => xml.push('\u{fffd}'),
            _ => xml.push(c),
        }
    }
    xml
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_was_escaped_is_read_again() {
        for (text, read) in [
            ("a < b & \"c\" > 'd'", "a < b & \"c\" > 'd'"),
            ("&amp;lt;", "&amp;lt;"),
            ("\u{1b}[31m\u{fffe}\u{ffff}\0", "\u{fffd}[31m\u{fffd}\u{fffd}\u{fffd}"),
        ] {
            let xml = format!("<a b=\"{0}\">{0}</a>", escaped(text));
            let document = roxmltree::Document::parse(&xml).unwrap();
            let root = document.root_element();
            assert_eq!((root.attribute("b"), root.text()), (Some(read), Some(read)));
        }
    }
}
