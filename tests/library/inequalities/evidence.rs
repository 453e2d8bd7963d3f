//! Scans that agree or contradict one another, and jumps and kinks that the ends of a panel hide.

use super::search::{between, choice, dyadic, inequalities, scaled};
use mean_information::cell::information_from_log_odds as information;
use mean_information::quadrature::adaptive::{GaussKronrod, Rule};
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information::sensor::SteppedSensor;

/// Log-odds whose sums are exact: multiples of `2^-20` up to 32 in magnitude.
fn log_odds(u: f64) -> f64 {
    64.0 * dyadic(u, 26) - 32.0
}

/// The agreement of three beams in one row of cells, each from a place and with a range of its own.
fn agreement(u: &[f64]) -> Option<f64> {
    let mut map = ScanMap::<f64>::new(0.25).unwrap().with_agreement().unwrap();
    for u in u.chunks(4) {
        let pose = Pose::new(between(u[0], -2.0, 2.0), 0.125, 0.0).unwrap();
        let beam = Beam { bearing: 0.0, range: Some(between(u[1], 0.3, 3.0)) };
        let (free, occupied) = (between(u[2], 0.05, 0.49), between(u[3], 0.51, 0.95));
        let scan = Scan::new(pose, 8.0, vec![beam]).unwrap();
        map.insert(&scan, |range| SteppedSensor::new(range, 0.3, free, occupied)).unwrap();
    }
    map.agreement()
}

/// The true error of one panel of a function with a jump or a kink anywhere, over the claimed error.
fn jump_or_kink(u: &[f64]) -> f64 {
    let rule = [Rule::K15, Rule::K21, Rule::K31, Rule::K41, Rule::K51, Rule::K61][choice(u[0], 6)];
    let (from, width, height) =
        (between(u[1], -3.0, 3.0), scaled(u[2], 0.01, 100.0), scaled(u[3], 1e-6, 1e6));
    let to = from + width;
    // Crowded towards both ends, where the gaps are.
    let share = if u[4] < 0.5 { 2.0 * u[4] } else { scaled(2.0 * u[4] - 1.0, 1e-9, 0.01) };
    let is_low = u[5] < 0.5;
    let place = if is_low { from + share * width } else { to - share * width };
    let settings = GaussKronrod::new().rule(rule).relative(0.5);
    let (found, beyond) = if u[6] < 0.5 {
        let step = |x: f64| if x < place { 1.0 } else { 1.0 + height };
        (settings.integrate(step, from, to), height * (to - place))
    } else {
        // Towards the end that is near: `|g_2 - g_1|` is largest there, the lemma's hypothesis.
        let (slope, sign) = (height / width, if is_low { -1.0 } else { 1.0 });
        let kink = |x: f64| 1.0 + slope * (sign * (x - place)).max(0.0);
        let length = if is_low { place - from } else { to - place };
        (settings.integrate(kink, from, to), 0.5 * slope * length * length)
    };
    let found = found.unwrap();
    let exact = (to - from) + beyond;
    // The integrand and the exact value are rounded a few times.
    let rounding = 8.0 * f64::EPSILON * (exact.abs() + (1.0 + height) * (from.abs() + to.abs()));
    (found.value - exact).abs() / (found.error + rounding)
}

inequalities! {
    evidence_grows: "evidence", "Theorem (evidence)", 2, 0.0, |u| {
        let [a, b] = [log_odds(u[0]).abs(), log_odds(u[1]).abs()];
        (a.max(b) > 0.0).then(|| information(-a.min(b)) / information(a.max(b)))
    };
    contradiction_lowers: "evidence", "Corollary (contradiction)", 3, 0.0, |u| {
        let readings = [log_odds(u[0]), log_odds(u[1]), log_odds(u[2])];
        let magnitude: f64 = readings.iter().map(|l| l.abs()).sum();
        (magnitude > 0.0).then(|| information(readings.iter().sum::<f64>()) / information(magnitude))
    };
    agreement_is_a_share: "evidence", "Theorem (agreement)", 12, 0.0, agreement;
    ends_hide_no_more: "quadrature", "Lemma (gap)", 7, 0.0, |u| Some(jump_or_kink(u));
}
