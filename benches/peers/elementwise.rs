//! Functions of many cells, from a slice into a slice, in the cache. C and Python read the same arguments from a file.

use crate::maps::{FLAGS, compiled, random, rows_of};
use crate::program::{Timed, beside, python};
use mean_information::{Real, elementwise};
use mean_information_test_support::timing::least_time;
use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The number of arguments, also that of the peers' sources.
const CELLS: usize = 1 << 16;
/// All is measured so many times in turn, and the least counts.
const ROUNDS: usize = 5;

/// A function with its name.
type Function<T> = (&'static str, fn(&[T], &mut [T]));

fn functions<T: Real>() -> [Function<T>; 3] {
    [
        ("entropy", elementwise::entropy),
        ("information_from_log_odds", elementwise::information_from_log_odds),
        ("occupancy_from_log_odds", elementwise::occupancy_from_log_odds),
    ]
}

fn mean<T: Real>(results: &[T]) -> f64 {
    results.iter().map(|&x| x.widen()).sum::<f64>() / CELLS as f64
}

/// Ours and the others once, each mean within the tolerance of ours.
fn measure<T: Real>(
    function: Function<T>,
    programs: &[(String, PathBuf)],
    file: &Path,
    cells: &[T],
) -> Vec<Timed<f64>> {
    let (name, call) = function;
    let results = std::cell::RefCell::new(vec![T::zero(); CELLS]);
    let seconds = least_time(0.2, || call(black_box(cells), black_box(results.borrow_mut().as_mut_slice())));
    let mut rows = vec![Timed { method: "ours".to_owned(), seconds, result: mean(&results.borrow()) }];
    for (flags, program) in programs {
        let named = |row: Timed<f64>| Timed { method: format!("C, {flags}"), ..row };
        rows.extend(rows_of(Command::new(program).args([T::FORMAT, name]).arg(file)).map(named));
    }
    rows.extend(rows_of(python("elementwise.py").args([T::FORMAT, name]).arg(file)));
    for row in &rows {
        // No peer cares for cells next to 0, 1/2 and 1.
        let tolerance = 4096.0 * T::epsilon().widen();
        assert!((row.result - rows[0].result).abs() <= tolerance, "{name}, {}: {}", row.method, row.result);
    }
    rows
}

fn compare_format<T: Real>(programs: &[(String, PathBuf)], folder: &Path, bytes: fn(&T) -> Vec<u8>) {
    for function in functions::<T>() {
        let uniform = random().take(CELLS).map(|bits| ((bits >> 30) as f64 + 0.5) / (1_u64 << 23) as f64);
        let scaled = uniform.map(|p| if function.0 == "entropy" { p } else { 20.0 * p - 10.0 });
        let cells: Vec<T> = scaled.map(T::nearest).collect();
        let file = folder.join(function.0);
        fs::write(&file, cells.iter().flat_map(bytes).collect::<Vec<u8>>()).expect("a folder to write to");
        let mut rows = measure(function, programs, &file, &cells);
        for _ in 1..ROUNDS {
            for (row, again) in rows.iter_mut().zip(measure(function, programs, &file, &cells)) {
                row.seconds = row.seconds.min(again.seconds);
            }
        }
        for Timed { method, seconds, .. } in &rows {
            let (nanoseconds, ratio) = (seconds / CELLS as f64 * 1e9, seconds / rows[0].seconds);
            println!("| {} | {} | {method} | {nanoseconds:.2} | {ratio:.2} |", function.0, T::FORMAT);
        }
    }
}

pub(crate) fn compare() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers-elementwise");
    fs::create_dir_all(&folder).expect("a folder to write to");
    let programs: Vec<_> = FLAGS
        .into_iter()
        .filter_map(|flags| {
            let program = folder.join(flags.concat());
            let mut compiler = Command::new("cc");
            compiler.args(flags).arg(beside("elementwise.c")).arg("-o").arg(&program).arg("-lm");
            if flags.contains(&"-Ofast") {
                compiler.arg("-lmvec");
            }
            Some((flags.join(" "), compiled(&mut compiler, program)?))
        })
        .collect();
    println!("| function | format | method | ns per cell | by ours |");
    println!("|---|---|---|---|---|");
    compare_format::<f64>(&programs, &folder, |x| x.to_ne_bytes().to_vec());
    compare_format::<f32>(&programs, &folder, |x| x.to_ne_bytes().to_vec());
    fs::remove_dir_all(&folder).expect("the folder");
}
