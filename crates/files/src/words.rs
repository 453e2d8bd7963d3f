//! The first words of lines that a reader does not understand, counted.

use crate::text::shortened;
use crate::warning::Warning;

/// The most words that are kept.
const MAX_WORDS: usize = 8;

/// The first words, each with its number of lines, and the number of lines of other words.
#[derive(Clone, Debug, Default)]
pub(crate) struct Words {
    words: Vec<(String, u64)>,
    others: u64,
}

impl Words {
    /// Counts a line by its first word, or with the others once there are many words.
    pub(crate) fn add(&mut self, word: &[u8]) {
        let word = shortened(word);
        if let Some((_, lines)) = self.words.iter_mut().find(|(own, _)| *own == word) {
            *lines += 1;
        } else if self.words.len() < MAX_WORDS {
            self.words.push((word, 1));
        } else {
            self.others += 1;
        }
    }

    /// Returns the warning of them, if there is a line.
    pub(crate) fn warning(&self) -> Option<Warning> {
        let lines = self.others + self.words.iter().map(|(_, count)| count).sum::<u64>();
        (lines > 0).then(|| Warning::LinesNotUnderstood { lines, words: self.words.clone() })
    }
}
