//! The file of known failures, which cannot go stale: an entry whose test passes or is skipped is a failure itself. A
//! test that was not run after too much trouble has failed, whether it is in the file or not: nobody saw it fail.

use crate::failure::Failure;
use std::collections::BTreeSet;
use std::fs;
use std::path::Path;

/// The ids of tests that are known to fail.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct KnownFailures(BTreeSet<String>);

impl KnownFailures {
    /// Reads a file of ids, one a line; what follows a `#` is a comment.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn read(path: &Path) -> Result<Self, Failure> {
        let text =
            fs::read_to_string(path).map_err(|e| Failure::file(path, format!("cannot be read: {e}")))?;
        Ok(Self::parse(&text))
    }

    fn parse(text: &str) -> Self {
        // Some editors begin a file with a byte order mark.
        let text = text.trim_start_matches('\u{feff}');
        let ids = text.lines().map(|line| line.split('#').next().unwrap_or_default().trim());
        Self(ids.filter(|id| !id.is_empty()).map(str::to_owned).collect())
    }

    /// Returns whether this test is known to fail.
    pub(super) fn contains(&self, id: &str) -> bool {
        self.0.contains(id)
    }

    /// Returns all ids, sorted.
    pub(super) fn ids(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(String::as_str)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_and_comments() {
        let known = KnownFailures::parse("# all of these\n\n a/f64/0x1p-2  # slow\r\nb,c\na/f64/0x1p-2\n");
        assert_eq!(known.ids().collect::<Vec<_>>(), ["a/f64/0x1p-2", "b,c"]);
        assert_eq!(KnownFailures::parse("\u{feff}b,c\n").ids().collect::<Vec<_>>(), ["b,c"]);
    }
}
