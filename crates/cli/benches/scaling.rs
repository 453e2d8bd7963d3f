//! How the time of a map grows with its cells and falls with threads, as two plots.
//!
//! `cargo bench -p mean-information-cli --bench scaling` draws `benches/cells.svg` and `benches/threads.svg` and prints what they
//! show. Time against cells is the processor's, time against threads that of the clock, so that needs a quiet machine. Every
//! result is checked.

#![allow(missing_docs)]

use mean_information::Tally;
use mean_information::map::encoding::{Encoding, MrptLogOdds, Probability};
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

/// Nanoseconds per cell against something.
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

fn main() {
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
    for (what, all) in [("cells", &cells), ("threads", &threads)] {
        println!("| {what} | {} |", all.iter().map(|times| times.name).collect::<Vec<_>>().join(" | "));
        println!("|---|---|---|---|");
        for (k, &(x, _)) in all[0].points.iter().enumerate() {
            let times: Vec<_> = all.iter().map(|times| format!("{:.3}", times.points[k].1)).collect();
            println!("| {x:.0e} | {} |", times.join(" | "));
        }
    }
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
