//! Fig. 1: two scans of one place, alone, fused where they belong, and fused out of place.

use super::{Claim, Figure, Section};
use crate::failure::Failure;
use crate::plots::{MapPanel, panels};
use crate::simulation::{Random, Readings, Room, RoomName, Scanner, insert, trajectory};
use mean_information::build::{Pose, ScanMap};
use mean_information::cell::{Cell, information};
use mean_information::map::Grid;
use mean_information::map::encoding::LogOdds;
use mean_information::{Error, Tally};

const SIGMA: f64 = 0.05;
const RESOLUTION: f64 = 0.05;
/// How far the second scan is put out of place: metres along x and y, radians.
const MISPLACED: [f64; 3] = [0.25, -0.15, 0.1];
const ROOMS: u64 = 100;

/// Two scans and the maps of them.
struct Scans {
    places: [[f64; 2]; 2],
    alone: [Grid<LogOdds<f64>>; 2],
    aligned: Grid<LogOdds<f64>>,
    misaligned: Grid<LogOdds<f64>>,
}

impl Scans {
    /// Looks round at two poses of a room.
    fn of(room: &Room, poses: [Pose; 2], beams: u32, seed: u64) -> Result<Self, Error> {
        let scanner = Scanner { beams, maximum_range: 8.0, noise: SIGMA };
        let mut random = Random::new(seed);
        let first = scanner.look(room, &poses[0], &mut random)?;
        let second = scanner.look(room, &poses[1], &mut random)?;
        let [x, y] = poses[1].position();
        let misplaced = Pose::new(x + MISPLACED[0], y + MISPLACED[1], poses[1].theta() + MISPLACED[2])?;
        Ok(Self {
            places: poses.map(|pose| pose.position()),
            alone: [map(&[(&first, poses[0])])?, map(&[(&second, poses[1])])?],
            aligned: map(&[(&first, poses[0]), (&second, poses[1])])?,
            misaligned: map(&[(&first, poses[0]), (&second, misplaced)])?,
        })
    }

    /// Of the first scan, the second, both aligned, both misaligned.
    fn tallies(&self) -> [Tally<f64>; 4] {
        [&self.alone[0], &self.alone[1], &self.aligned, &self.misaligned].map(Grid::tally)
    }
}

fn map(scans: &[(&Readings, Pose)]) -> Result<Grid<LogOdds<f64>>, Error> {
    let mut map = ScanMap::new(RESOLUTION)?;
    for (readings, pose) in scans {
        insert(&mut map, &readings.at(*pose)?, SIGMA)?;
    }
    map.log_odds()
}

/// How often the three claims of Fig. 1 hold in random rooms, and the least and largest mean information met.
#[derive(Debug, Default, PartialEq)]
struct Counts {
    better_aligned: u64,
    worse_misaligned: u64,
    more_observed: u64,
    maps: u64,
    within: u64,
}

impl Counts {
    fn over(rooms: u64) -> Result<Self, Error> {
        let mut counts = Self::default();
        for seed in 0..rooms {
            let mut random = Random::new(seed);
            let room = Room::random(&mut random);
            let poses = trajectory::along(&room.route, 2)?;
            let scans = Scans::of(&room, [poses[0], poses[1]], 360, random.bits())?;
            let tallies = scans.tallies();
            let [first, second, aligned, misaligned] = tallies.each_ref().map(Tally::mean_information);
            counts.better_aligned += u64::from(aligned > first.max(second));
            counts.worse_misaligned += u64::from(misaligned < aligned);
            counts.more_observed += u64::from(tallies[3].observed() > tallies[2].observed());
            let all = [first, second, aligned, misaligned];
            counts.maps += all.len() as u64;
            counts.within += all.into_iter().filter(|x| (0.0..=1.0).contains(x)).count() as u64;
        }
        Ok(counts)
    }
}

pub(super) fn section() -> Result<Section, Failure> {
    let room = RoomName::Study.room();
    let poses = [Pose::new(2.4, 3.2, 0.4)?, Pose::new(3.6, 4.4, -0.2)?];
    let scans = Scans::of(&room, poses, 720, 1)?;
    Ok(Section { figures: vec![figure(&scans)?], claims: claims(&scans)? })
}

fn figure(scans: &Scans) -> Result<Figure, Failure> {
    let tallies = scans.tallies();
    let [alone_1, alone_2, aligned, misaligned] = tallies.each_ref().map(Tally::mean_information);

    let panel = |title, grid: &Grid<LogOdds<f64>>, tally: &Tally<f64>, places: &[[f64; 2]]| {
        let text = format!("{:.4} bits/cell, {} cells", tally.mean_information(), tally.observed());
        MapPanel::new(grid, title, text).map(|panel| panel.with_places(places.to_vec()))
    };
    let picture = panels(
        &[
            panel("(a) first scan", &scans.alone[0], &tallies[0], &scans.places[..1])?,
            panel("(b) second scan", &scans.alone[1], &tallies[1], &scans.places[1..])?,
            panel("(c) fused, aligned", &scans.aligned, &tallies[2], &scans.places)?,
            panel("(d) fused, misaligned", &scans.misaligned, &tallies[3], &scans.places)?,
        ],
        2,
    );
    Ok(Figure {
        file: "figure-1.svg",
        title: "Fig. 1: consistent and inconsistent scans",
        should: "Fused in the correct alignment, two scans have a higher mean information than either alone. Misaligned, \
                 they have more observed cells and a lower mean information.",
        shows: format!(
            "Alone {alone_1:.4} and {alone_2:.4}, aligned {aligned:.4}, misaligned {misaligned:.4} bits per cell: the second \
             scan is off by 29 cm and 6 degrees, and walls are drawn twice."
        ),
        svg: picture.document(&format!(
            "Four maps of the same room. First scan: {alone_1:.4} bits per cell. Second scan, from half a step aside: \
             {alone_2:.4}. Both aligned, with sharp walls: {aligned:.4}. Both misaligned, with double walls: {misaligned:.4}."
        )),
    })
}

fn claims(scans: &Scans) -> Result<Vec<Claim>, Failure> {
    let tallies = scans.tallies();
    let [alone_1, alone_2, aligned, misaligned] = tallies.each_ref().map(Tally::mean_information);
    let counts = Counts::over(ROOMS)?;
    let in_rooms = |count: u64| format!("in {count} of {ROOMS} random rooms");
    let padded = |tally: &Tally<f64>, unknown: u64| {
        let mut padded = tally.clone();
        padded.add_many(Cell::unknown(), unknown);
        padded
    };
    let wider = padded(&tallies[2], 100_000);
    Ok(vec![
        Claim::new(
            "Section I, Eq. 3",
            "A certainly occupied or free cell has 1 bit of information, an unobserved one none.",
            [0.0, 0.5, 1.0].map(information) == [1.0, 0.0, 1.0],
            "exactly 1, 0 and 1 bit at p = 0, 1/2 and 1".to_owned(),
        ),
        Claim::new(
            "Section I, 1 and Eq. 3",
            "Entropy depends on the limits of the map; information and mean information do not.",
            wider.entropy() == tallies[2].entropy() + 1e5
                && wider.information() == tallies[2].information()
                && wider.mean_information() == aligned,
            format!(
                "100000 unknown cells around (c): entropy {:.0} to {:.0} bits, the other two to the same bit",
                tallies[2].entropy(),
                wider.entropy()
            ),
        ),
        Claim::new(
            "Section I, Eq. 4",
            "The mean information lies between 0 and 1.",
            counts.within == counts.maps,
            format!("in {} of {} maps of random rooms", counts.within, counts.maps),
        ),
        Claim::new(
            "Section I, property 1",
            "A map of unobserved cells only has a null mean information.",
            padded(&Tally::new(), 1000).mean_information() == 0.0,
            "0 bits, by convention: 0/0".to_owned(),
        ),
        Claim::new(
            "Section I, Fig. 1 (c)",
            "Two scans fused with the correct alignment have a higher mean information than one alone.",
            aligned > alone_1.max(alone_2) && counts.better_aligned == ROOMS,
            format!(
                "{aligned:.4} over {alone_1:.4} and {alone_2:.4}; higher than both {}",
                in_rooms(counts.better_aligned)
            ),
        ),
        Claim::new(
            "Section I, Fig. 1 (d), property 3",
            "Misalignment lowers the mean information.",
            misaligned < aligned && counts.worse_misaligned == ROOMS,
            format!("{misaligned:.4} under {aligned:.4}; lower {}", in_rooms(counts.worse_misaligned)),
        ),
        Claim::new(
            "Section I, Fig. 1 (d)",
            "The misaligned map has more observed cells than the aligned one.",
            tallies[3].observed() > tallies[2].observed() && counts.more_observed == ROOMS,
            format!(
                "{} over {}; more {}",
                tallies[3].observed(),
                tallies[2].observed(),
                in_rooms(counts.more_observed)
            ),
        ),
    ])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn aligned_scans_inform_more_than_misaligned_ones() {
        let counts = Counts::over(3).unwrap();
        let all = Counts { better_aligned: 3, worse_misaligned: 3, more_observed: 3, maps: 12, within: 12 };
        assert_eq!(counts, all);
    }
}
