//! Pages in one file that needs no other, for screens of any width, light and dark.

use super::escaped;

const STYLE: &str = include_str!("page.css");

/// Returns a link to a chapter of the book, or to its contents, as docs.rs has it for this version.
pub(crate) fn book(chapter: &str, text: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let text = escaped(text);
    let chapter = if chapter.is_empty() { String::new() } else { format!("{chapter}/") };
    format!(
        "<a href=\"https://docs.rs/mean-information/{version}/mean_information/book/{chapter}index.html\">{text}</a>"
    )
}

/// The name of the page in the folder that a command writes.
pub(crate) const PAGE: &str = "index.html";

/// Returns the page of this title, a text, and this body, which is HTML.
pub(crate) fn page(title: &str, body: &str) -> String {
    let title = escaped(title);
    format!(
        r#"<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8"/>
<meta name="viewport" content="width=device-width, initial-scale=1"/>
<title>{title}</title>
<style>
{STYLE}</style>
</head>
<body>
<main>
<h1>{title}</h1>
{body}</main>
</body>
</html>
"#
    )
}
