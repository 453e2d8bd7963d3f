//! Tallies as bytes (`docs/tally_format.md`): the golden ones, every flipped bit, and what no cells have.

use super::common::occupancy;
use mean_information::expected::Hypotheses;
use mean_information::map::{Geometry, Grid, encoding::Probability};
use mean_information::tally::{TALLY_BYTES, TallyFault, format_of_bytes};
use mean_information::{Error, Real, Tally, cell::Cell};
use proptest::collection::vec;
use proptest::prelude::*;

/// The bytes of cells at 1/4, 1/2 and 1, made by `fractions`, `struct` and `zlib` of Python from the decimals of H and I.
/// Zeros stand between the parts.
const GOLDEN_F64: [(usize, &[u8]); 7] = [
    (0, b"\x89MI\n\x01\x00\x40\x00"),
    (8, &[1]),
    (16, &[1]),
    (24, &[1]),
    (159, &[96, 124, 12, 82, 177, 191, 62, 7]),
    (303, &[152, 131, 243, 173, 78, 64, 193, 4]),
    (320, &[50, 224, 48, 97]),
];
const GOLDEN_F32: [(usize, &[u8]); 7] = [
    (0, b"\x89MI\n\x01\x00\x20\x00"),
    (8, &[1]),
    (16, &[1]),
    (24, &[1]),
    (163, &[176, 191, 62, 7]),
    (307, &[79, 64, 193, 4]),
    (320, &[118, 190, 132, 92]),
];

fn golden(parts: &[(usize, &[u8])]) -> [u8; TALLY_BYTES] {
    let mut bytes = [0; TALLY_BYTES];
    for &(start, part) in parts {
        bytes[start..start + part.len()].copy_from_slice(part);
    }
    bytes
}

/// The CRC-32 of the bytes before the last four, bit by bit.
fn seal(mut bytes: [u8; TALLY_BYTES]) -> [u8; TALLY_BYTES] {
    let (body, checksum) = bytes.split_last_chunk_mut().expect("longer than a checksum");
    let mut rest = u32::MAX;
    for k in 0..8 * body.len() {
        let bit = u32::from(body[k / 8] >> (k % 8)) & 1;
        rest = if (rest ^ bit) & 1 == 1 { rest >> 1 ^ 0xedb8_8320 } else { rest >> 1 };
    }
    *checksum = (!rest).to_le_bytes();
    bytes
}

fn refusal<T: Real>(bytes: &[u8]) -> String {
    Tally::<T>::from_bytes(bytes).expect_err("no tally").to_string()
}

fn fault<T: Real>(bytes: &[u8]) -> TallyFault {
    match Tally::<T>::from_bytes(bytes) {
        Err(Error::TallyBytes(fault)) => fault,
        other => panic!("{other:?}"),
    }
}

#[test]
fn the_bytes_are_the_golden_ones() {
    let cells = [0.25, 0.5, 1.0];
    let tally = Tally::from_occupancies(&cells);
    assert_eq!(tally.to_bytes(), golden(&GOLDEN_F64));
    assert_eq!(Tally::from_bytes(&golden(&GOLDEN_F64)), Ok(tally));
    let tally = Tally::from_occupancies(&cells.map(|p| p as f32));
    assert_eq!(tally.to_bytes(), golden(&GOLDEN_F32));
    assert_eq!(Tally::from_bytes(&golden(&GOLDEN_F32)), Ok(tally));
    assert_eq!(format_of_bytes(&golden(&GOLDEN_F64)), Ok("f64"));
    assert_eq!(format_of_bytes(&golden(&GOLDEN_F32)), Ok("f32"));
}

proptest! {
    #[test]
    fn a_tally_survives_as_bytes(cells in vec(occupancy(), 0..40), count in 0..1_u64 << 58) {
        let mut tally = Tally::from_occupancies(&cells);
        cells.iter().flat_map(|&p| Cell::from_occupancy(p)).for_each(|cell| tally.add_many(cell, count));
        prop_assert_eq!(Tally::from_bytes(&tally.to_bytes()), Ok(tally));
        let log_odds = cells.iter().flat_map(|&p| Cell::from_log_odds(p as f32 * 200.0 - 50.0));
        let mut tally: Tally<f32> = log_odds.collect();
        tally.merge(&cells.iter().flat_map(|&p| Cell::from_occupancy(p as f32)).collect());
        prop_assert_eq!(Tally::from_bytes(&tally.to_bytes()), Ok(tally));
    }

    /// No tally of other cells, and no panic; the seal is right, so that the sums and counts are looked at.
    #[test]
    fn other_bytes_are_refused_or_a_tally(at in 4..TALLY_BYTES - 4, with in any::<u8>()) {
        let mut bytes = golden(&GOLDEN_F64);
        bytes[at] = with;
        if let Ok(tally) = Tally::<f64>::from_bytes(&seal(bytes)) {
            prop_assert_eq!(tally.to_bytes(), seal(bytes));
            prop_assert_eq!(tally.cells(), 3);
        }
    }
}

/// Its sums are finer than floats, and still sums of the smallest numbers of the format.
#[test]
fn the_tally_of_an_expected_map_survives_too() {
    let geometry = Geometry::new(0.25, [0.0; 2]).unwrap();
    let map = |cells| Grid::<Probability<f32>>::new(3, 1, geometry, cells).unwrap();
    let maps = [map(vec![0.3, 1e-30, 0.500_000_06]), map(vec![0.4, 1e-40, 0.5])];
    let tally = Hypotheses::new(&maps, &[0.3, 0.1]).unwrap().expected_tally().unwrap();
    assert_eq!(Tally::from_bytes(&tally.to_bytes()), Ok(tally));
}

#[test]
fn every_flipped_bit_is_found() {
    for (good, single) in [(golden(&GOLDEN_F64), false), (golden(&GOLDEN_F32), true)] {
        for bit in 0..8 * TALLY_BYTES {
            let mut bytes = good;
            bytes[bit / 8] ^= 1 << (bit % 8);
            let found = if single { fault::<f32>(&bytes) } else { fault::<f64>(&bytes) };
            let is_it = match bit {
                0..32 => found == TallyFault::NoTally,
                33..48 => {
                    matches!(found, TallyFault::LaterVersion { version, .. } if version == 1 + (1 << (bit - 32)))
                }
                // The first of these makes version 0, which no release wrote.
                32 | 48.. => found == TallyFault::Damaged,
            };
            assert!(is_it, "bit {bit}: {found}");
        }
    }
}

#[test]
fn other_bytes_are_named() {
    let good = golden(&GOLDEN_F64);
    assert_eq!(refusal::<f64>(&[]), "number of bytes of a tally is 0, allowed is 324");
    assert_eq!(refusal::<f64>(&good[..323]), "number of bytes of a tally is 323, allowed is 324");
    assert!(matches!(fault::<f64>(&good[..5]), TallyFault::Length { given: 5, .. }));
    for other in [&b"doe a deer"[..], b"\x89PN", b"\x89PNG\r\n"] {
        assert_eq!(refusal::<f64>(other), "the bytes are those of something else than a tally");
    }
    let mut damaged = good;
    damaged[40] ^= 1;
    let text = "the bytes of the tally are damaged: their checksum is another";
    assert_eq!(refusal::<f64>(&damaged), text);
    // A later version may be of another length.
    let later = [&good[..4], &[2, 0], &good[6..100]].concat();
    let text = "version of the bytes of a tally is 2, allowed is 1: a later release wrote them";
    assert_eq!(refusal::<f64>(&later), text);
    assert_eq!(format_of_bytes(&later).unwrap_err().to_string(), text);
    assert_eq!(refusal::<f32>(&good), "bits of a float in the bytes of a tally is 64, allowed is 32");
    let mut half = good;
    half[6] = 16;
    let half = seal(half);
    assert_eq!(refusal::<f32>(&half), "bits of a float in the bytes of a tally is 16, allowed is 32");
    let text = "bits of a float in the bytes of a tally is 16, allowed is 32 or 64";
    assert_eq!(format_of_bytes(&half).unwrap_err().to_string(), text);
}

#[test]
fn sums_and_counts_that_no_cells_have_are_refused() {
    let with = |changes: &[(usize, &[u8])]| {
        let mut bytes = golden(&GOLDEN_F64);
        for &(start, part) in changes {
            bytes[start..start + part.len()].copy_from_slice(part);
        }
        refusal::<f64>(&seal(bytes))
    };
    let both = "entropy and information of the tally together";
    for (changes, words) in [
        (
            &[(16, &[0xff; 16][..])][..],
            "number of cells of the tally is 36893488147419103000, allowed is at most 2^64 - 1",
        ),
        (&[(16, &[0]), (24, &[0])], "information of the tally is 1.1887"),
        (&[(8, &[2])], "entropy of the tally is 1.811278124"),
        (&[(8, &[0]), (24, &[2])], ""),
        // One observed cell more, which would lower the mean.
        (&[(24, &[2])], both),
        (&[(24, &[0])], "information of the tally is 1.1887"),
        // A cell that is a bit of entropy too few.
        (&[(166, &[3])], "entropy"),
        (&[(310, &[6])], both),
        (&[(300, &[1])], ""),
    ] {
        if words.is_empty() {
            // The states of cells cannot be told from the sums, nor a change within the rounding.
            let mut bytes = golden(&GOLDEN_F64);
            for &(start, part) in changes {
                bytes[start..start + part.len()].copy_from_slice(part);
            }
            assert!(Tally::<f64>::from_bytes(&seal(bytes)).is_ok());
        } else {
            let refused = with(changes);
            assert!(refused.starts_with(words), "{refused}");
        }
    }
    // 2^-150 is no multiple of the smallest f32.
    let mut bytes = golden(&GOLDEN_F32);
    bytes[32 + 115] = 1 << 4;
    let words = refusal::<f32>(&seal(bytes));
    assert!(words.ends_with("allowed is a sum of numbers of the tally's format"), "{words}");
}
