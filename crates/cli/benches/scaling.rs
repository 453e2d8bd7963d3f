//! How the time of a map grows with its cells and falls with threads, and that of a beam with the beams of its scan, as plots.
//!
//! `cargo bench -p mean-information-cli --bench scaling` draws `benches/cells.svg`, `benches/threads.svg` and `benches/beams.svg` and
//! prints what they show; with `-- beams` or `-- maps` a part of it. Time against threads is that of the clock, so that needs a
//! quiet machine; the others are the processor's. Every result is checked.

#![allow(missing_docs)]

use mean_information::map::encoding::{Encoding, MrptLogOdds, Probability};
use mean_information::scan::{Beam, Pose, Scan, ScanMap};
use mean_information::sensor::{GaussianSensor, InverseSensorModel, SteppedSensor};
use mean_information::{Error, Tally};
use mean_information_cli::plots::{Chart, ChartPanel, Colour, Curve, Drawing, Marks, Picture, Scale, Shape};
use mean_information_test_support::timing;
use std::hint::black_box;
use std::num::NonZero;
use std::path::Path;
use std::thread;
use std::time::Instant;

/// The largest map has `10^DECADES` cells.
const DECADES: u32 = 8;
/// The memory of the map that threads share: it takes them some milliseconds, so that some run is not disturbed.
const SHARED_BYTES: usize = 8_000_000;
/// So many runs of it.
const RUNS: usize = 400;

/// The beams of all scans of a map together, as a power of two.
const BEAMS: u32 = 16;

/// Times against something.
struct Times {
    name: &'static str,
    colour: Colour,
    points: Vec<(f64, f64)>,
}

/// The numbers of a multiplicative generator, 53 bits each.
fn random() -> impl Iterator<Item = u64> {
    let mut state = 20261122_u64;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        state >> 11
    })
}

/// Both measurements of a map of random cells, all of them allowed.
fn measure<E: Encoding>(
    name: &'static str,
    colour: Colour,
    cell: impl Fn(u64) -> E::Stored,
) -> (Times, Times) {
    let cells: Vec<E::Stored> = random().map(cell).take(10_usize.pow(DECADES)).collect();
    let times = |points| Times { name, colour, points };
    let sizes = (3..DECADES).flat_map(|n| [1, 3].map(|m| m * 10_usize.pow(n))).chain([cells.len()]);
    let by_cells = sizes.map(|count| {
        let cells = &cells[..count];
        assert_eq!(E::information_sum(cells).mean(), E::tally(cells).mean_information());
        let seconds = timing::least_time(1.0, || E::information_sum(black_box(cells)).mean());
        (count as f64, seconds / count as f64 * 1e9)
    });
    let shared = &cells[..SHARED_BYTES / size_of::<E::Stored>()];
    let whole = E::tally(shared);
    let most = thread::available_parallelism().map_or(1, NonZero::get);
    let by_threads = (1..=most).map(|threads| {
        let run = |_| {
            let start = Instant::now();
            let tally = tally_of_parts::<E>(black_box(shared), threads);
            let seconds = start.elapsed().as_secs_f64();
            assert_eq!(tally, whole);
            seconds
        };
        let seconds = (0..RUNS).map(run).fold(f64::INFINITY, f64::min);
        (threads as f64, seconds / shared.len() as f64 * 1e9)
    });
    (times(by_cells.collect()), times(by_threads.collect()))
}

/// Each thread counts a part; the parts are merged.
fn tally_of_parts<E: Encoding>(cells: &[E::Stored], threads: usize) -> Tally<E::Float> {
    thread::scope(|scope| {
        let parts = cells.chunks(cells.len().div_ceil(threads));
        let running: Vec<_> = parts.map(|part| scope.spawn(|| E::tally(part))).collect();
        let mut all = Tally::new();
        for part in running {
            all.merge(&part.join().expect("a tally"));
        }
        all
    })
}

/// Scans of so many beams each, from places along a drive through a room of 8 m by 6 m.
fn scans(beams: u32) -> Vec<Scan<f64>> {
    let scan = |number: u32| {
        let part = f64::from(number) / f64::from((1 << BEAMS) / beams);
        let ([x, y], heading) = ([4.0 * part - 2.0, 1.5 * part - 1.0], 2.5 * part);
        let beam = |k: u32| {
            let bearing = std::f64::consts::TAU * f64::from(k) / f64::from(beams);
            let (sine, cosine) = libm::sincos(heading + bearing);
            let along = (4.0_f64.copysign(cosine) - x) / cosine;
            let across = (3.0_f64.copysign(sine) - y) / sine;
            Beam { bearing, range: Some(along.min(across)) }
        };
        Scan::new(Pose::new(x, y, heading)?, 12.0, (0..beams).map(beam).collect())
    };
    (0..(1 << BEAMS) / beams).map(|number| scan(number).expect("a scan of a room")).collect()
}

/// The map of scans, in cells of 5 cm.
fn map_of<'a, M: InverseSensorModel<Float = f64>>(
    scans: impl Iterator<Item = &'a Scan<f64>>,
    model: impl Fn(f64) -> Result<M, Error>,
) -> Result<ScanMap<f64>, Error> {
    let mut map = ScanMap::new(0.05)?;
    for scan in scans {
        map.insert(scan, &model)?;
    }
    Ok(map)
}

/// Microseconds a beam against the beams of a scan.
fn measure_beams<M: InverseSensorModel<Float = f64>>(
    name: &'static str,
    colour: Colour,
    model: impl Fn(f64) -> Result<M, Error>,
) -> Times {
    let points = (4..=BEAMS).map(|power| {
        let scans = scans(1 << power);
        let map = |scans: &[Scan<f64>]| map_of(scans.iter(), &model).expect("a map");
        // In whatever order.
        let backwards = map_of(scans.iter().rev(), &model).expect("a map");
        assert_eq!(map(&scans).tally(), backwards.tally());
        let seconds = timing::least_time(1.0, || map(black_box(&scans)));
        (f64::from(1 << power), seconds / f64::from(1 << BEAMS) * 1e6)
    });
    Times { name, colour, points: points.collect() }
}

fn panel(
    vertical: &'static str,
    scale: Scale,
    times: &[Times],
    of: impl Fn(&[(f64, f64)], f64) -> f64,
) -> ChartPanel {
    let curve = |times: &Times| Curve {
        name: times.name.to_owned(),
        colour: times.colour,
        marks: Marks::Each(Shape::Circle),
        points: times.points.iter().map(|&(x, y)| (x, of(&times.points, y))).collect(),
    };
    ChartPanel { vertical, scale, curves: times.iter().map(curve).collect(), marks: Vec::new() }
}

fn save(name: &str, drawing: &impl Drawing) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../benches").join(name);
    let picture = drawing.draw(Picture::Svg).expect("points");
    std::fs::write(&path, picture).expect("a folder to write to");
    println!("drawn: benches/{name}");
}

/// Prints the times of several curves at the same places.
fn print(what: &str, all: &[Times]) {
    println!("| {what} | {} |", all.iter().map(|times| times.name).collect::<Vec<_>>().join(" | "));
    println!("|{}", "---|".repeat(1 + all.len()));
    for (k, &(x, _)) in all[0].points.iter().enumerate() {
        let times: Vec<_> = all.iter().map(|times| format!("{:.3}", times.points[k].1)).collect();
        println!("| {x} | {} |", times.join(" | "));
    }
}

/// Maps against their cells and against threads.
fn maps() {
    let (cells, threads): (Vec<Times>, Vec<Times>) = [
        measure::<Probability<f64>>("probabilities in f64", Colour::Blue, |bits| {
            ((bits >> 1) as f64 + 0.5) / (1_u64 << 52) as f64
        }),
        measure::<Probability<f32>>("probabilities in f32", Colour::Orange, |bits| {
            ((bits >> 30) as f32 + 0.5) / (1_u32 << 23) as f32
        }),
        measure::<MrptLogOdds>("random bytes", Colour::Grey, |bits| (bits >> 45) as i8),
    ]
    .into_iter()
    .unzip();
    print("cells", &cells);
    print("threads", &threads);
    let time = |times: &[Times]| panel("time (ns / cell)", Scale::Logarithmic, times, |_, y| y);
    save(
        "cells.svg",
        &Chart {
            title: "Mean information on one thread".to_owned(),
            horizontal: "cells",
            scale: Scale::Logarithmic,
            panels: [time(&cells)],
        },
    );
    let speed_up = panel("one thread's time over it", Scale::Linear, &threads, |all, y| all[0].1 / y);
    save(
        "threads.svg",
        &Chart {
            title: "Tallies of 8 MB of cells".to_owned(),
            horizontal: "threads",
            scale: Scale::Logarithmic,
            panels: [time(&threads), speed_up],
        },
    );
}

/// Beams against the beams of a scan.
fn beams() {
    let all = [
        measure_beams("steps", Colour::Blue, |range| SteppedSensor::new(range, 0.05, 0.4, 0.7)),
        measure_beams("Eq. 5", Colour::Orange, |range| GaussianSensor::new(range, 0.05)),
    ];
    print("beams of a scan", &all);
    save(
        "beams.svg",
        &Chart {
            title: "Scans inserted into a map on one thread".to_owned(),
            horizontal: "beams of a scan",
            scale: Scale::Logarithmic,
            panels: [panel("time (µs / beam)", Scale::Logarithmic, &all, |_, y| y)],
        },
    );
}

fn main() {
    // Cargo adds `--bench`.
    let asked: Vec<String> = std::env::args().skip(1).filter(|argument| !argument.starts_with('-')).collect();
    let wanted = |name: &str| asked.is_empty() || asked.iter().any(|argument| argument == name);
    if wanted("maps") {
        maps();
    }
    if wanted("beams") {
        beams();
    }
}
