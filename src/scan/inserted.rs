//! Which scans a map holds: their prints, to know a scan again that is to be removed, and the rectangles that they crossed, to
//! know that of the scans that stay.

use super::raster::Area;
use alloc::collections::BTreeMap;

/// The scans of a map: for each print the rectangle of its beams, and how often it was inserted.
///
/// Memory: some 60 bytes for each scan.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Inserted {
    scans: BTreeMap<Print, (Area, u64)>,
    count: u64,
}

impl Inserted {
    /// Counts the scans that were inserted and not removed.
    pub(super) fn count(&self) -> u64 {
        self.count
    }

    /// Tells whether a scan of this print was inserted and not removed.
    pub(super) fn holds(&self, print: Print) -> bool {
        self.scans.contains_key(&print)
    }

    /// Adds a scan.
    pub(super) fn add(&mut self, print: Print, area: Area) {
        self.scans.entry(print).or_insert((area, 0)).1 += 1;
        self.count += 1;
    }

    /// Takes out one scan of this print, which must be held.
    pub(super) fn remove(&mut self, print: Print) {
        if let Some((_, times)) = self.scans.get_mut(&print) {
            *times -= 1;
            self.count -= 1;
            if *times == 0 {
                self.scans.remove(&print);
            }
        }
    }

    /// Finds the rectangle that the scans would have crossed without one of this print; `seen` is that of them all.
    pub(super) fn area_without(&self, print: Print, seen: Area) -> Option<Area> {
        match self.scans.get(&print) {
            // A rectangle that meets no side of the whole one does not hold it open.
            Some(&(area, 1)) if !area.is_inside(seen) => {
                let others = self.scans.iter().filter(|&(&other, _)| other != print);
                others.map(|(_, &(area, _))| area).reduce(Area::union)
            }
            _ => Some(seen),
        }
    }
}

/// 64 bits that tell scans apart: of what a map takes from them, mixed. Two different scans share one with a probability of
/// a few times `2^-64`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Print(u64);

impl Print {
    /// Mixes words into a print, in their order.
    #[inline]
    pub(super) fn of(words: &[u64]) -> Self {
        // Both halves of a product have bits of all of the word. Folded they are no bijection: each step may join two prints, too.
        let mixed = words.iter().fold(0x9e37_79b9_7f4a_7c15_u64, |print, word| {
            let product = u128::from(print ^ word) * 0xff51_afd7_ed55_8ccd;
            product as u64 ^ (product >> 64) as u64
        });
        Self(mixed)
    }

    /// Joins prints whose order means nothing.
    pub(super) fn together(self, other: Self) -> Self {
        Self(self.0.wrapping_add(other.0))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use alloc::vec::Vec;
    use proptest::collection::vec;
    use proptest::prelude::*;

    /// Two corners of a scan's rectangle.
    type Corners = [[i64; 2]; 2];

    fn area([a, b]: Corners) -> Area {
        Area::of_cell(a).union(Area::of_cell(b))
    }

    proptest! {
        /// Against a list of the scans, of which some are equal.
        #[test]
        fn the_rectangle_is_that_of_the_scans_that_stay(
            scans in vec([[-9_i64..9, -9_i64..9], [-9_i64..9, -9_i64..9]], 1..12), order in vec(0_usize..99, 12),
        ) {
            // The first two are there twice.
            let twice = scans.iter().chain(scans.iter().take(2));
            let mut list: Vec<(Print, Corners)> =
                twice.map(|&corners| (Print::of(&corners.concat().iter().map(|&k| k as u64).collect::<Vec<_>>()), corners)).collect();
            let mut inserted = Inserted::default();
            for &(print, corners) in &list {
                inserted.add(print, area(corners));
            }
            let whole = |list: &[(Print, Corners)]| list.iter().map(|&(_, corners)| area(corners)).reduce(Area::union);
            for pick in order {
                let Some(seen) = whole(&list) else { break };
                let (print, _) = list.swap_remove(pick % list.len());
                prop_assert!(inserted.holds(print));
                prop_assert_eq!(inserted.area_without(print, seen), whole(&list));
                inserted.remove(print);
                prop_assert_eq!(inserted.count(), list.len() as u64);
                prop_assert_eq!(inserted.holds(print), list.iter().any(|scan| scan.0 == print));
            }
        }
    }

    #[test]
    fn prints_depend_on_each_word_and_its_place() {
        let prints = [&[2, 3][..], &[3, 2], &[2, 3, 0], &[2], &[]].map(Print::of);
        for (k, print) in prints.iter().enumerate() {
            assert!(prints[..k].iter().all(|other| other != print));
        }
        assert_eq!(prints[0].together(prints[1]), prints[1].together(prints[0]));
    }
}
