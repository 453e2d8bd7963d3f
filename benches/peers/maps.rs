//! The mean information of large maps. C, C++ and Python read the same cells from a file.

use crate::program::{Timed, beside, output_of, python};
use mean_information::map::encoding::{Encoding, MrptLogOdds, Probability};
use mean_information_test_support::timing::least_time;
use std::fs;
use std::hint::black_box;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A side of the maps, also that of the peers' sources.
const SIDE: usize = 4000;
const CELLS: usize = SIDE * SIDE;

/// All is measured so many times in turn, and the least counts: what else runs, runs beside all.
const ROUNDS: usize = 3;

/// The flags of C. The vector logarithms of the C library come with the last ones; `_ZGV` begins their names.
pub(crate) const FLAGS: [&[&str]; 3] =
    [&["-O3"], &["-O3", "-march=native"], &["-Ofast", "-march=native", WIDE]];
/// GCC alone prefers vectors half as wide as the processor has.
const WIDE: &str = if cfg!(target_arch = "x86_64") { "-mprefer-vector-width=512" } else { "-O3" };

/// What a method says of a map.
type Row = Timed<f64>;

type Call<'a> = Box<dyn Fn() -> f64 + 'a>;

/// A map, and what is known of it.
struct Map<'a> {
    name: &'static str,
    /// For the peers: how a cell is stored, and the file.
    stored: &'static str,
    file: PathBuf,
    /// Ours: the name of a method, and the method.
    ours: [(&'static str, Call<'a>); 2],
    mean_information: f64,
    /// How far from it a peer may be: sums of [`SIDE`] terms in the precision of a cell, in any order, then [`SIDE`] of them.
    tolerance: f64,
    /// The sum of its bytes, and what MRPT makes of it.
    bytes: Option<[f64; 2]>,
}

impl<'a> Map<'a> {
    fn new<E: Encoding<Float: Into<f64>>>(
        name: &'static str,
        stored: &'static str,
        cells: &'a [E::Stored],
        tolerance: f64,
        folder: &Path,
        write: impl Fn(&E::Stored) -> Vec<u8>,
    ) -> Self {
        let file = folder.join(name.replace(' ', "-"));
        fs::write(&file, cells.iter().flat_map(write).collect::<Vec<u8>>()).expect("a folder to write to");
        let mean_information = E::information_sum(cells).mean().into();
        let tally = || E::tally(black_box(cells)).mean_information().into();
        let mean = || E::information_sum(black_box(cells)).mean().into();
        assert_eq!(mean_information, tally());
        let ours: [(_, Call); 2] =
            [("ours, information only", Box::new(mean)), ("ours, tally", Box::new(tally))];
        Self { name, stored, file, ours, mean_information, tolerance, bytes: None }
    }

    fn of_bytes(name: &'static str, cells: &'a [i8], folder: &Path) -> Self {
        let sum: u64 = cells.iter().map(|&cell| u64::from(cell as u8)).sum();
        let map = Self::new::<MrptLogOdds>(name, "i8", cells, 1e-12, folder, |cell| vec![*cell as u8]);
        Self { bytes: Some([sum as f64, by_mrpt(cells)]), ..map }
    }

    /// All methods once, each checked.
    fn measure(&self, programs: &Programs) -> Vec<Row> {
        let time = |(method, call): &(&str, Call)| Row {
            method: (*method).to_owned(),
            seconds: least_time(1.0, call),
            result: call(),
        };
        let mut rows: Vec<Row> = self.ours.iter().map(time).collect();
        for (flags, program) in &programs.c {
            rows.extend(
                rows_of(Command::new(program).arg(self.stored).arg(&self.file))
                    .map(|row| Row { method: format!("C, {}, {flags}", row.method), ..row }),
            );
        }
        rows.extend(rows_of(python("maps.py").arg(self.stored).arg(&self.file)));
        if let Some(program) = programs.mrpt.as_ref().filter(|_| self.bytes.is_some()) {
            rows.extend(rows_of(Command::new(program).arg(&self.file)));
        }
        for Row { method, result, .. } in &rows {
            let (expected, tolerance) = match self.bytes {
                Some([sum, _]) if method.contains("byte sum") => (sum, 0.0),
                // Its table is of single precision.
                Some([_, mrpt]) if method.contains("MRPT") => (mrpt, 1e-6),
                _ if method.contains("ours") => (self.mean_information, 0.0),
                _ => (self.mean_information, self.tolerance),
            };
            assert!(
                (result - expected).abs() <= tolerance,
                "{}, {method}: {result} for {expected}",
                self.name
            );
        }
        rows
    }
}

/// From the lines that a peer prints.
pub(crate) fn rows_of(command: &mut Command) -> impl Iterator<Item = Row> {
    let row = |line: &str| {
        let mut fields = line.split('\t');
        let method = fields.next()?.to_owned();
        let mut number = || fields.next()?.parse().ok();
        Some(Row { method, seconds: number()?, result: number()? })
    };
    output_of(command).lines().filter_map(row).collect::<Vec<_>>().into_iter()
}

/// What MRPT 2.5 takes for the mean information: unknown cells, and those next to them on one side, count as observed with 1
/// bit, and those on the other side as unknown.
fn by_mrpt(cells: &[i8]) -> f64 {
    let others: Vec<i8> = cells.iter().copied().filter(|cell| !(-1..=1).contains(cell)).collect();
    let tally = MrptLogOdds::tally(&others);
    let certain = cells.iter().filter(|&&cell| cell == 0 || cell == -1).count() as f64;
    (tally.information() + certain) / (tally.observed() as f64 + certain)
}

/// The peers that are compiled.
struct Programs {
    /// With their flags.
    c: Vec<(String, PathBuf)>,
    mrpt: Option<PathBuf>,
}

impl Programs {
    fn compile(folder: &Path) -> Self {
        let c = FLAGS.into_iter().filter_map(|flags| {
            let program = folder.join(flags.concat());
            let mut compiler = Command::new("cc");
            compiler.args(flags).arg(beside("maps.c")).arg("-o").arg(&program).arg("-lm");
            if flags.contains(&"-Ofast") {
                compiler.arg("-lmvec");
            }
            let program = compiled(&mut compiler, program)?;
            let code = fs::read(&program).expect("the program");
            let vectors = code.windows(4).any(|name| name == b"_ZGV");
            assert_eq!(vectors, flags.contains(&"-Ofast"), "calls of vector logarithms with {flags:?}");
            Some((flags.join(" "), program))
        });
        Self { c: c.collect(), mrpt: Self::mrpt(folder) }
    }

    /// Against MRPT as Debian installs it.
    fn mrpt(folder: &Path) -> Option<PathBuf> {
        let program = folder.join("mrpt");
        let Ok(modules) = fs::read_dir("/usr/include/mrpt") else {
            eprintln!("skipped: no /usr/include/mrpt; Debian's package is libmrpt-maps-dev");
            return None;
        };
        let mut compiler = Command::new("c++");
        compiler.args(["-std=c++17", "-O3"]);
        let includes =
            modules.flatten().map(|module| module.path().join("include")).filter(|path| path.is_dir());
        for include in includes.chain([PathBuf::from("/usr/include/eigen3")]) {
            compiler.arg("-isystem").arg(include);
        }
        compiler.arg(beside("mrpt.cpp")).arg("-o").arg(&program);
        compiled(compiler.args(["-lmrpt-maps", "-lmrpt-obs", "-lmrpt-system"]), program)
    }
}

pub(crate) fn compiled(compiler: &mut Command, program: PathBuf) -> Option<PathBuf> {
    let _ = fs::remove_file(&program);
    output_of(compiler);
    program.exists().then_some(program)
}

/// A multiplicative generator's upper bits.
pub(crate) fn random() -> impl Iterator<Item = u64> {
    let mut state = 20261122_u64;
    std::iter::repeat_with(move || {
        state = state.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        state >> 11
    })
}

/// Free, occupied and unknown in runs of 1 to 200.
fn runs() -> Vec<i8> {
    let run =
        |bits: u64| std::iter::repeat_n([100, -100, 0][(bits >> 32) as usize % 3], bits as usize % 200 + 1);
    random().flat_map(run).take(CELLS).collect()
}

pub(crate) fn compare() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("peers");
    fs::create_dir_all(&folder).expect("a folder to write to");
    // Exact in their precision, so never 0, 1/2 or 1.
    let double: Vec<f64> =
        random().take(CELLS).map(|bits| ((bits >> 1) as f64 + 0.5) / (1_u64 << 52) as f64).collect();
    let single: Vec<f32> =
        random().take(CELLS).map(|bits| ((bits >> 30) as f32 + 0.5) / (1_u32 << 23) as f32).collect();
    let random_bytes: Vec<i8> = random().take(CELLS).map(|bits| (bits >> 45) as i8).collect();
    let few_bytes = runs();
    let bytes = |x: &f64| x.to_ne_bytes().to_vec();
    let maps = [
        Map::new::<Probability<f64>>("f64", "f64", &double, 1e-12, &folder, bytes),
        Map::new::<Probability<f32>>("f32", "f32", &single, 3e-4, &folder, |x| x.to_ne_bytes().to_vec()),
        Map::of_bytes("random bytes", &random_bytes, &folder),
        Map::of_bytes("three values in runs", &few_bytes, &folder),
    ];
    let programs = Programs::compile(&folder);
    let mut tables: Vec<Vec<Row>> = maps.iter().map(|map| map.measure(&programs)).collect();
    for _ in 1..ROUNDS {
        for (map, rows) in maps.iter().zip(&mut tables) {
            for (row, again) in rows.iter_mut().zip(map.measure(&programs)) {
                assert_eq!(row.method, again.method);
                row.seconds = row.seconds.min(again.seconds);
            }
        }
    }
    print(&maps, &tables);
    fs::remove_dir_all(&folder).expect("the folder");
}

fn print(maps: &[Map], tables: &[Vec<Row>]) {
    let plain = |row: &&Row| row.method == "C, byte sum, -O3";
    let unit = tables[2].iter().find(plain).map_or(f64::NAN, |row| row.seconds);
    println!("| map | method | ns per cell | by ours | by a byte sum | off by |");
    println!("|---|---|---|---|---|---|");
    for (map, rows) in maps.iter().zip(tables) {
        for Row { method, seconds, result } in rows {
            let error = (result - map.mean_information).abs();
            let error = if method.contains("byte sum") { "-".to_owned() } else { format!("{error:.0e}") };
            println!(
                "| {} | {method} | {:.3} | {:.2} | {:.2} | {error} |",
                map.name,
                seconds / CELLS as f64 * 1e9,
                seconds / rows[0].seconds,
                seconds / unit,
            );
        }
    }
}
