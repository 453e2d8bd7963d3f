//! Copied into the library: which mutant runs, read once from the environment.
extern crate std;

use core::sync::atomic::{AtomicBool, AtomicU32, Ordering::Relaxed};
use std::{env, fs::OpenOptions, io::Write};

/// The mutant, 0 for none; or one of the two below.
static CHOSEN: AtomicU32 = AtomicU32::new(UNREAD);
const UNREAD: u32 = u32::MAX;
const RECORDING: u32 = u32::MAX - 1;

static REACHED: [AtomicBool; 1 << 14] = [const { AtomicBool::new(false) }; 1 << 14];

/// The mutant that runs, asked at `place`.
#[inline(always)]
pub(crate) fn at(place: u32) -> u32 {
    let chosen = CHOSEN.load(Relaxed);
    if chosen >= RECORDING { seldom(place) } else { chosen }
}

/// Reads the environment; under `MUTANT_REACHED=file`, writes each place once to that file.
#[cold]
#[inline(never)]
fn seldom(place: u32) -> u32 {
    if REACHED[place as usize].load(Relaxed) {
        return 0;
    }
    let Some(path) = env::var_os("MUTANT_REACHED") else {
        let chosen = env::var("MUTANT").map_or(0, |id| id.parse().expect("MUTANT is a number"));
        CHOSEN.store(chosen, Relaxed);
        return chosen;
    };
    CHOSEN.store(RECORDING, Relaxed);
    if !REACHED[place as usize].swap(true, Relaxed) {
        let mut file = OpenOptions::new().append(true).create(true).open(path).expect("MUTANT_REACHED opens");
        file.write_all(std::format!("{place}\n").as_bytes()).expect("MUTANT_REACHED is written");
    }
    0
}
