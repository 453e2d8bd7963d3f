//! The page: text, figures and table in one file that needs no other.

use super::{Claim, Figure, Paper, Theory, Verdict};
use crate::output::{self, book, escaped};

pub(super) fn page(paper: &Paper) -> String {
    let figures: String = paper.figures.iter().map(figure).collect();
    let claims: String = paper.claims.iter().map(claim).collect();
    let count = |verdict| paper.claims.iter().filter(|claim| claim.verdict == verdict).count();
    let [pass, corrected, fail] = [Verdict::Pass, Verdict::Corrected, Verdict::Fail].map(count);
    let body = format!(
        r##"<p>The figures and claims of J.-L. Blanco, <cite>Derivation of an Expression for the Mean Information Maximum Value</cite>
(technical report, University of Malaga), computed again by <code>meaninfo paper</code>. Maps are made of simulated scans;
white is free, black is occupied, blue-grey is unknown, and an orange dot is where the robot was. Every number on this page is
computed as the page is made, and is the same on every run and machine.</p>
<p>{} claims: {pass} hold as they stand, {corrected} are corrected, {fail} failed. <a href="#claims">The table</a> has them.
The derivations are in {}, and each statement of the report with its chapter, function and test in {}. These links lead to docs.rs, once version {version} is
published there; until then the same chapters are in <code>docs/</code> of the checkout, the last of them as <code>docs/paper.md</code>.</p>
<p>Made by mean-information {version}. To cite it: The mean-information developers,
<cite>mean-information: reference implementation of the mean information of occupancy maps, with verified numerics</cite>, version {version},
beside the report; <code>CITATION.cff</code> of the checkout has both.</p>
{figures}<section id="claims">
<h2>What can be checked</h2>
<table>
<caption>Pass: the claim holds as it stands. Corrected: it does not, and what holds instead was checked. That is of
three kinds: true within limits that the report does not state (alignment, finer cells, the closing of a loop), true of one of two
readings (the grids of the experiment), and compared in part only (other estimators). What was asked for, where that is more than the claim
itself, is said behind the measurement; these bounds are this project's, not the report's.</caption>
<thead><tr><th scope="col">In the report</th><th scope="col">Claim</th><th scope="col">Measured</th><th scope="col">Verdict</th></tr></thead>
<tbody>
{claims}</tbody>
</table>
</section>
"##,
        paper.claims.len(),
        book("", "the book"),
        book("paper", "the report, line by line"),
        version = env!("CARGO_PKG_VERSION"),
    );
    output::page("The mean information of occupancy maps, reproduced", &body)
}

fn figure(figure: &Figure) -> String {
    let Figure { file, title, should, shows, theory, picture } = figure;
    let picture = picture.element();
    let theory: String = theory.iter().map(formula).collect();
    let id = file.trim_end_matches(".svg");
    let [title, should, shows] = [title, should, shows.as_str()].map(escaped);
    format!(
        "<section id=\"{id}\">\n<h2>{title}</h2>\n<figure>\n{picture}<figcaption>\n<dl>\n<dt>What the report says it shows</dt>\n<dd>{should}</dd>\n<dt>What it shows here</dt>\n\
         <dd>{shows}</dd>\n</dl>\n</figcaption>\n</figure>\n{theory}</section>\n"
    )
}

fn formula(theory: &Theory) -> String {
    let Theory { words, formula, chapter: [chapter, name] } = theory;
    format!("<p>{} (chapter {}):</p>\n{formula}\n", escaped(words), book(chapter, name))
}

fn claim(claim: &Claim) -> String {
    let Claim { place, claim, measured, verdict } = claim;
    let [place, claim, measured] = [place, claim, measured.as_str()].map(escaped);
    let verdict = verdict.name();
    format!(
        "<tr><td>{place}</td><td>{claim}</td><td>{measured}</td><td class=\"{verdict}\">{verdict}</td></tr>\n"
    )
}
