//! `meaninfo --version`: the version of the program, and what it has within.

use super::page;
use crate::check::{Vectors, Version};
use mean_information_report::protocol;
use std::sync::LazyLock;

/// Returns the lines that follow the name: the version, then one for each part.
pub(super) fn long() -> &'static str {
    static LONG: LazyLock<String> = LazyLock::new(made);
    &LONG
}

/// Makes these lines, for which all vectors are read.
fn made() -> String {
    // A test reads them all.
    let vectors = Vectors::built_in().unwrap_or_default();
    let tests: usize = vectors.iter().map(|of| of.tests.len()).sum();
    let page =
        if page::is_built_in() { "the page for browsers" } else { "no page for browsers (MEANINFO_PAGE)" };
    format!(
        "{}\n\
         features: several threads, .db3 bags by an SQLite of its own, {page}\n\
         vectors: v{}, {tests} tests of {} operations\n\
         port protocol: {}",
        env!("CARGO_PKG_VERSION"),
        Version::NUMBER,
        vectors.len(),
        protocol::VERSION
    )
}
