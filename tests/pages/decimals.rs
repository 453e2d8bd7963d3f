//! Decimals longer than a float, which no comparison of floats can see to their end, are those of `proofs/decimals.txt`.

use crate::{ROOT, read};
use std::fs;
use std::path::Path;

/// Significant digits up to which a decimal is one of floats.
const OF_FLOATS: usize = 17;
/// Measured on maps that are not kept: `docs/expected.md`.
const MEASURED: [&str; 1] = ["0.39551775772098043918"];

/// The decimals of a page with more digits than floats have, without underscores.
fn long_decimals(page: &str) -> Vec<String> {
    let pieces = page.split(|c: char| !(c.is_ascii_digit() || c == '.' || c == '_'));
    let decimals = pieces.map(|piece| piece.trim_matches(['.', '_']).replace('_', ""));
    let is_long = |decimal: &String| {
        // A fraction of nothing but zeros is an integer's, which is exact.
        let fraction = decimal.split_once('.').is_some_and(|(_, fraction)| fraction.contains(|c| c != '0'));
        fraction
            && decimal.matches('.').count() == 1
            && decimal.replace('.', "").trim_start_matches('0').len() > OF_FLOATS
    };
    decimals.filter(is_long).collect()
}

/// Whether a decimal is the constant, cut or rounded.
fn is_of(decimal: &str, constant: &str) -> bool {
    let [(whole, printed), (of_constant, exact)] =
        [decimal, constant].map(|text| text.split_once('.').unwrap());
    if whole != of_constant || printed.len() >= exact.len() {
        return false;
    }
    let (cut, rest) = exact.split_at(printed.len());
    let [printed, cut] =
        [printed, cut].map(|digits| digits.parse::<u128>().expect("a decimal of up to 38 digits"));
    printed == cut || printed == cut + 1 && rest.as_bytes()[0] >= b'5'
}

#[test]
fn long_decimals_are_those_of_the_proofs() {
    let file = read("proofs/decimals.txt");
    let constants: Vec<&str> =
        file.lines().filter_map(|line| line.rsplit_once(" = ")).map(|(_, value)| value).collect();
    let chapters = fs::read_dir(Path::new(ROOT).join("docs")).unwrap().map(|entry| entry.unwrap().path());
    let pages = chapters.filter(|path| path.extension().is_some_and(|extension| extension == "md"));
    let (mut count, mut unknown, mut used) = (0, Vec::new(), vec![false; constants.len()]);
    for page in pages.chain([Path::new(ROOT).join("README.md")]) {
        for decimal in long_decimals(&read(&page)) {
            count += 1;
            let found: Vec<usize> = (0..constants.len()).filter(|&k| is_of(&decimal, constants[k])).collect();
            for &k in &found {
                used[k] = true;
            }
            if found.is_empty() && !MEASURED.contains(&&*decimal) {
                unknown.push(format!("{}: {decimal}", page.display()));
            }
        }
    }
    println!("{count} decimals");
    assert!(
        count > 80 && unknown.is_empty(),
        "{count} decimals; not in proofs/decimals.txt:\n{}",
        unknown.join("\n")
    );
    let unused: Vec<_> =
        constants.iter().zip(used).filter(|(_, used)| !used).map(|(value, _)| value).collect();
    assert!(unused.is_empty(), "on no page: {unused:?}");
}

#[test]
fn a_wrong_digit_is_seen() {
    let constant = "1.67862484715325313261659211782935016419194171";
    for right in ["1.678624847153253132", "1.678624847153253133", "1.6786248471532531326"] {
        assert!(is_of(right, constant), "{right}");
    }
    // What the chapter on integration had.
    assert!(!is_of("1.678624847153253122", constant) && !is_of("1.678624847153253131", constant));
    assert_eq!(long_decimals("x = -0.676_043_132_003_130_446_64;"), ["0.67604313200313044664"]);
}
