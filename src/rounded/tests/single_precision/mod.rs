//! Every `f32`: the library's result against an enclosure of the exact value that all rounds to one float.
//!
//! `cargo test` checks a slice; `proofs/exhaust.sh` runs the ignored tests, which leave no input out.

mod blocks;
mod enclosure;

use crate::Real;
use crate::cell::{
    Cell, entropy, entropy_from_log_odds, information, information_from_log_odds, occupancy_from_log_odds,
};
use crate::rounded::oracle::{self, Oracle};
use enclosure::Bounds;
use std::ops::AddAssign;
use std::sync::atomic::{AtomicU32, Ordering};

const ONE: u32 = 1.0_f32.to_bits();
const INFINITY: u32 = f32::INFINITY.to_bits();

/// What a check has seen.
#[derive(Default)]
struct Seen {
    results: u64,
    wrong: u64,
    /// Results that `f64` left undecided: the hardest to round. Printed, since they make good vectors.
    wide: u64,
}

impl AddAssign for Seen {
    fn add_assign(&mut self, other: Self) {
        self.results += other.results;
        self.wrong += other.wrong;
        self.wide += other.wide;
    }
}

impl Seen {
    /// Judges the `results` of the functions `names` at `x`.
    #[inline]
    fn judge<const N: usize>(
        &mut self,
        names: [&str; N],
        x: f32,
        results: [f32; N],
        enclosures: [Bounds; N],
        wider: impl Fn(&Oracle) -> [Oracle; N],
    ) {
        for k in 0..N {
            self.results += 1;
            let right = if let Some(nearest) = enclosures[k].nearest() {
                nearest.to_bits() == results[k].to_bits()
            } else {
                self.wide += 1;
                println!("near-tie {} {:#010x}", names[k], x.to_bits());
                is_nearest(results[k], &wider(&exact(x))[k])
            };
            if !right {
                self.wrong += 1;
                eprintln!("WRONG: {} at {x:e} ({:#010x}) gives {:e}", names[k], x.to_bits(), results[k]);
            }
        }
    }

    fn occupancy(&mut self, bits: u32) {
        let p = f32::from_bits(bits);
        let cell = Cell::from_occupancy(p).expect("an occupancy");
        let results = [cell.entropy(), cell.information()];
        let enclosures = enclosure::from_occupancy(p);
        self.judge(["entropy", "information"], p, results, enclosures, oracle::from_occupancy);
    }

    fn log_odds(&mut self, bits: u32) {
        let l = f32::from_bits(bits);
        let [cell, mirrored] = [l, -l].map(|l| Cell::from_log_odds(l).expect("log-odds"));
        let even = cell.entropy().to_bits() == mirrored.entropy().to_bits()
            && cell.information().to_bits() == mirrored.information().to_bits();
        assert!(even, "entropy and information are even in the log-odds, but not at {l:e}");
        let names = [
            "entropy_from_log_odds",
            "information_from_log_odds",
            "occupancy_from_log_odds",
            "occupancy_from_log_odds of minus",
        ];
        let results =
            [cell.entropy(), cell.information(), occupancy_from_log_odds(l), occupancy_from_log_odds(-l)];
        self.judge(names, l, results, enclosure::from_log_odds(l), oracle::from_log_odds);
    }
}

/// A non-negative float, exactly.
fn exact(x: f32) -> Oracle {
    let (m, e) = x.parts();
    Oracle::dyadic(m, e)
}

/// Whether `x` is the float nearest to every number of an enclosure.
fn is_nearest(x: f32, enclosure: &Oracle) -> bool {
    let [lo, hi] = enclosure.bounds();
    let twice_midpoint = |y: f32| exact(x).bounds()[0] + exact(y).bounds()[0];
    (x == 0.0 || twice_midpoint(x.next_down()) <= lo * 2) && hi * 2 <= twice_midpoint(x.next_up())
}

/// Checks all bit patterns up to `last`, on all processors.
fn exhaust(what: &str, last: u32, check: fn(&mut Seen, u32)) {
    const BLOCK: u32 = 1 << 20;
    let next = AtomicU32::new(0);
    let work = || {
        let mut seen = Seen::default();
        loop {
            let start = next.fetch_add(BLOCK, Ordering::Relaxed);
            if start > last {
                return seen;
            }
            (start..=last.min(start + (BLOCK - 1))).for_each(|bits| check(&mut seen, bits));
        }
    };
    let mut seen = Seen::default();
    std::thread::scope(|scope| {
        let threads = std::thread::available_parallelism().map_or(1, usize::from);
        let workers: Vec<_> = (0..threads).map(|_| scope.spawn(work)).collect();
        for worker in workers {
            seen += worker.join().expect("a worker that ends");
        }
    });
    let inputs = u64::from(last) + 1;
    let Seen { results, wrong, wide } = seen;
    println!("{what}: {inputs} inputs, {results} results, {wrong} wrong, {wide} decided by 600 bits");
    assert_eq!(wrong, 0);
}

#[test]
#[ignore = "a minute or more in release mode: proofs/exhaust.sh"]
fn every_occupancy() {
    exhaust("occupancies", ONE, Seen::occupancy);
}

/// In blocks of successive floats, the sums of which are compared exactly.
#[test]
#[ignore = "two minutes in release mode: proofs/exhaust.sh"]
fn every_occupancy_in_blocks() {
    const BLOCK: u32 = 256;
    exhaust("blocks of 256 occupancies", ONE / BLOCK, |seen, block| {
        let wrong = !blocks::agree(block * BLOCK..(block + 1) * BLOCK);
        seen.results += 2;
        seen.wrong += u64::from(wrong);
    });
}

/// Of `f64` not all, but 100 million at random: towards 0, towards 1 and towards 1/2, up to each of 20 powers of two.
#[test]
#[ignore = "half a minute in release mode: proofs/exhaust.sh"]
fn random_occupancies_in_blocks_of_double_precision() {
    exhaust("blocks of 256 random occupancies in f64", 400_000, |seen, block| {
        let mut state = (u64::from(block) + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
        let cells = std::iter::repeat_with(|| {
            state ^= state << 13;
            state ^= state >> 7;
            state ^= state << 17;
            let distance = f64::from_parts(state >> 11, -53 - (block % 20) as i32);
            match block / 20 % 3 {
                0 => distance,
                1 => 1.0 - distance,
                _ if state & 1 == 1 => 0.5 + distance / 2.0,
                _ => 0.5 - distance / 2.0,
            }
        });
        let wrong = !blocks::agree_on(&cells.take(256).collect::<Vec<f64>>());
        seen.results += 2;
        seen.wrong += u64::from(wrong);
    });
}

#[test]
#[ignore = "some minutes in release mode: proofs/exhaust.sh"]
fn every_log_odds() {
    exhaust("log-odds", INFINITY, Seen::log_odds);
}

/// Every `stride`-th float up to `last`, and all within 40 ulp of the edges.
fn slice(last: u32, stride: usize, edges: &[f32]) -> impl Iterator<Item = u32> {
    let near = edges.iter().flat_map(|x| x.to_bits().saturating_sub(40)..=x.to_bits().saturating_add(40));
    (7919..=last)
        .step_by(stride)
        .chain(near)
        .filter(move |&bits| bits <= last)
        .collect::<Vec<_>>()
        .into_iter()
}

#[test]
fn a_slice_of_the_occupancies() {
    let edges = [0.0, f32::MIN_POSITIVE, 0.00390625, 0.25, 0.46875, 0.5, 0.53125, 0.75, 0.99609375, 1.0];
    let mut seen = Seen::default();
    for bits in slice(ONE, 8209, &edges) {
        seen.occupancy(bits);
        let p = f32::from_bits(bits);
        let cell = Cell::from_occupancy(p).unwrap();
        assert_eq!((entropy(p), information(p)), (cell.entropy(), cell.information()));
    }
    assert!(seen.results > 250_000 && seen.wrong == 0);
}

#[test]
fn a_slice_in_blocks() {
    for phase in 0..4 {
        let first = 1 + phase * 1021;
        assert!(blocks::agree((first..=ONE).step_by(4099)), "the blocks of phase {phase}");
    }
}

#[test]
fn a_slice_of_the_log_odds() {
    let edges = [0.0, f32::MIN_POSITIVE, 0.125, 0.5, 5.545177, 103.972_08, 104.0, 128.0, 1024.0, f32::MAX];
    let mut seen = Seen::default();
    for bits in slice(INFINITY, 16411, &edges) {
        seen.log_odds(bits);
        let l = f32::from_bits(bits);
        let cell = Cell::from_log_odds(-l).unwrap();
        let functions = (entropy_from_log_odds(-l), information_from_log_odds(-l));
        assert_eq!(functions, (cell.entropy(), cell.information()));
    }
    assert!(seen.results > 500_000 && seen.wrong == 0);
}

/// The two oracles against each other, where `f64` decides: a mistake of the wide one would otherwise hide among few
/// inputs.
#[test]
fn the_oracles_agree() {
    let mut bits = 0x0123_4567;
    for _ in 0..200 {
        bits = (bits + 0x1357_9bdf) % ONE;
        let p = f32::from_bits(bits);
        // |l| from 2^-20 to 90.
        let l = f32::from_bits(0x3580_0000 + bits % 0x0d30_0000);
        for (interval, wide) in enclosure::from_occupancy(p).iter().zip(&oracle::from_occupancy(&exact(p))) {
            assert!(
                interval.nearest().is_none_or(|x| is_nearest(x, wide) && !is_nearest(x.next_up(), wide)),
                "{p:e}"
            );
        }
        for (interval, wide) in enclosure::from_log_odds(l).iter().zip(&oracle::from_log_odds(&exact(l))) {
            assert!(
                interval.nearest().is_none_or(|x| is_nearest(x, wide) && !is_nearest(x.next_up(), wide)),
                "{l:e}"
            );
        }
    }
}
