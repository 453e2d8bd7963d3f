//! The table of guarantees: `docs/guarantees.md` says the same, and what it cites is there.

use mean_information::interval::Interval;
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::room::{CartesianRoom, PolarRoom};
use mean_information::scalar::Scalar;
use mean_information::sensor::{GaussianSensor, InverseSensorModel};
use mean_information::{
    ExactSum, InformationSum, Tally, cell, elementary, elementwise, expected, fusion, limit, map, scan,
};
use std::path::Path;

type Particles<'a> = expected::Hypotheses<'a, map::encoding::LogOdds<f64>>;

/// How a bound is known.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Known {
    Proved,
}

/// What a function promises.
pub(crate) struct Guarantee {
    pub(crate) function: &'static str,
    pub(crate) ulps: f64,
    pub(crate) known: Known,
}

/// The item, so that a renamed or removed function does not compile, and its row.
macro_rules! guarantees {
    ($($item:expr => $function:literal, $ulps:literal, $known:ident;)*) => {{
        $(let _ = $item;)*
        vec![$(Guarantee { function: $function, ulps: $ulps, known: Known::$known }),*]
    }};
}

/// Every function with a bound on its error.
pub(crate) fn guarantees() -> Vec<Guarantee> {
    guarantees! {
        elementary::exp::<f64> => "elementary::exp", 0.5, Proved;
        elementary::ln::<f64> => "elementary::ln", 0.5, Proved;
        elementary::sqrt::<f64> => "elementary::sqrt", 0.5, Proved;
        <f64 as Scalar>::exp_m1 => "Scalar::exp_m1", 2.0, Proved;
        <f64 as Scalar>::x_ln_x => "Scalar::x_ln_x", 1.5, Proved;
        cell::entropy::<f64> => "cell::entropy", 0.5, Proved;
        cell::information::<f64> => "cell::information", 0.5, Proved;
        cell::entropy_from_log_odds::<f64> => "cell::entropy_from_log_odds", 0.5, Proved;
        <f64 as Scalar>::entropy_from_log_occupancy => "Scalar::entropy_from_log_occupancy", 2.0, Proved;
        cell::information_from_log_odds::<f64> => "cell::information_from_log_odds", 0.5, Proved;
        cell::occupancy_from_log_odds::<f64> => "cell::occupancy_from_log_odds", 0.5, Proved;
        cell::log_odds_from_occupancy::<f64> => "cell::log_odds_from_occupancy", 0.5, Proved;
        elementwise::entropy::<f64> => "elementwise::entropy", 0.5, Proved;
        elementwise::information::<f64> => "elementwise::information", 0.5, Proved;
        elementwise::entropy_from_log_odds::<f64> => "elementwise::entropy_from_log_odds", 0.5, Proved;
        elementwise::information_from_log_odds::<f64> => "elementwise::information_from_log_odds", 0.5, Proved;
        elementwise::occupancy_from_log_odds::<f64> => "elementwise::occupancy_from_log_odds", 0.5, Proved;
        elementwise::log_odds_from_occupancy::<f64> => "elementwise::log_odds_from_occupancy", 0.5, Proved;
        ExactSum::value::<f64> => "ExactSum::value", 0.5, Proved;
        ExactSum::mean::<f64> => "ExactSum::mean", 0.5, Proved;
        Tally::<f64>::entropy => "Tally::entropy", 1.5, Proved;
        Tally::<f64>::information => "Tally::information", 1.5, Proved;
        Tally::<f64>::mean_information => "Tally::mean_information", 1.5, Proved;
        InformationSum::<f64>::total => "InformationSum::total", 1.5, Proved;
        InformationSum::<f64>::mean => "InformationSum::mean", 1.5, Proved;
        map::Grid::<map::encoding::Percent>::mean_information => "Grid::mean_information", 1.5, Proved;
        map::PolarMap::<map::encoding::Percent>::mean_information => "PolarMap::mean_information", 1.5, Proved;
        map::Grid::<map::encoding::Percent>::pooled => "Grid::pooled", 0.5, Proved;
        GaussianSensor::<f64>::occupancy => "GaussianSensor::occupancy", 0.5, Proved;
        GaussianSensor::<f64>::reach => "GaussianSensor::reach", 2.0, Proved;
        fusion::fuse::<f64> => "fusion::fuse", 0.5, Proved;
        expected::weighted_mean::<f64> => "expected::weighted_mean", 0.5, Proved;
        expected::ExpectedMap::<f64>::grid => "ExpectedMap::grid", 0.5, Proved;
        Particles::mean_of_mean_information => "Hypotheses::mean_of_mean_information", 0.5, Proved;
        Particles::log_linear_pool => "Hypotheses::log_linear_pool", 0.5, Proved;
        scan::ScanMap::<f64>::probabilities => "ScanMap::probabilities", 0.501, Proved;
        scan::ScanMap::<f64>::agreement => "ScanMap::agreement", 0.5, Proved;
        limit::rigorous::<GaussianSensor<f64>> => "limit::rigorous", 0.0, Proved;
        limit::closed_form::<f64> => "limit::closed_form", 0.501, Proved;
        PolarRoom::<GaussianSensor<f64>>::distance => "PolarRoom::distance", 0.5, Proved;
        CartesianRoom::<GaussianSensor<f64>>::distance => "CartesianRoom::distance", 0.5, Proved;
        Interval::<f64>::new => "Interval", 2.0, Proved;
        Rigorous::<f64>::default => "Rigorous::integrate", 0.0, Proved;
    }
}

#[test]
fn the_page_says_what_the_table_says() {
    let rows = rows("<!-- table -->", "<!-- end -->");
    let guarantees = guarantees();
    assert_eq!(rows.len(), guarantees.len());
    for (row, guarantee) in rows.iter().zip(&guarantees) {
        assert_eq!(row[0], format!("`{}`", guarantee.function));
        assert_eq!(row[1], "f32, f64");
        assert_eq!(row[2], format!("{} ulp", guarantee.ulps));
        assert_eq!(row[3], format!("{:?}", guarantee.known).to_lowercase());
        assert_cited_files_exist(row);
    }
}

/// Their claims are tested in `adaptive.rs`, without any allowance.
#[test]
fn the_page_lists_the_estimates() {
    let rows = rows("<!-- estimates -->", "<!-- end of estimates -->");
    let functions = ["`GaussKronrod::integrate`", "`GaussKronrod::integrate_between`", "`limit::adaptive`"];
    assert_eq!(rows.iter().map(|row| row[0]).collect::<Vec<_>>(), functions);
    for row in &rows {
        assert_eq!(row[2..4], ["the claimed error", "measured"]);
        assert_cited_files_exist(row);
    }
}

/// The cells of a table of the page.
fn rows(begin: &str, end: &str) -> Vec<Vec<&'static str>> {
    let page = include_str!("../../docs/guarantees.md");
    let (_, table) = page.split_once(begin).expect("the page marks its table");
    let (table, _) = table.split_once(end).expect("the page marks the end of its table");
    table
        .lines()
        .filter(|line| line.starts_with("| `"))
        .map(|line| line.trim_matches('|').split('|').map(str::trim).collect())
        .collect()
}

fn assert_cited_files_exist(row: &[&str]) {
    for cited in row[4].split('`').skip(1).step_by(2) {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(cited);
        assert!(path.exists(), "{} cites {cited}", row[0]);
    }
}
