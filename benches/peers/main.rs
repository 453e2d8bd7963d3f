//! This crate and others at the same work, in one run: tables of times and their ratios.
//!
//! `cargo bench --bench peers`, or with `-- elementwise`, `-- limit` or `-- maps` one of the three. What is not installed is skipped with a
//! message. Every result is checked before it is printed; `benches/RESULTS.md` has runs.

#![allow(missing_docs)]

mod elementwise;
mod limit;
mod maps;
mod program;

fn main() {
    // Cargo adds `--bench`.
    let asked: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wanted = |name: &str| asked.is_empty() || asked.iter().any(|argument| argument == name);
    if wanted("elementwise") {
        elementwise::compare();
    }
    if wanted("limit") {
        limit::compare();
    }
    if wanted("maps") {
        maps::compare();
    }
}
