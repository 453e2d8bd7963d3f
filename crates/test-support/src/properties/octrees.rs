//! Octrees: each is read or refused, and what is read is what was written.

use super::formats::kept;
use crate::formats::Seen;
use mean_information::Tally;
use mean_information::cell::Cell;
use mean_information_files::octree::{self, Leaf, Octant, OctreeVisitor};

/// More leaves are not expanded.
const MAX_EXPANDED: u64 = 1 << 10;

/// What is measured of a tree; a `.bt` file is thresholded.
#[derive(Debug, Default, PartialEq)]
struct Measured {
    tally: Tally<f64>,
    leaves: u64,
}

impl OctreeVisitor for Measured {
    fn leaf(&mut self, octant: Octant, leaf: Leaf) {
        let cell = match leaf {
            Leaf::LogOdds(l) => Cell::from_log_odds(f64::from(l)),
            Leaf::Free => Cell::from_occupancy(0.0),
            Leaf::Occupied => Cell::from_occupancy(1.0),
        };
        self.tally.add_many(cell.unwrap(), octant.finest_cells());
        self.leaves += 1;
    }
}

/// Reads a tree: its cells lie apart in the cube, what is written of it is read again, and expanded it measures the same.
pub fn octree(bytes: &[u8]) {
    let (mut measured, mut seen) = (Measured::default(), Seen::default());
    let Some(tree) = kept(octree::read(bytes, &mut measured)) else { return };
    assert_eq!(octree::read(bytes, &mut seen).unwrap(), tree);
    assert_eq!(tree.leaves, measured.leaves);
    assert!(measured.tally.cells() <= 1 << 48 && tree.resolution > 0.0);
    let Some(root) = seen.into_root() else { return assert_eq!(tree.nodes, 0) };
    assert_eq!(root.count(), tree.nodes);

    let again = if tree.binary { root.binary() } else { root.full(bytes.len() % 2 == 1) };
    let mut seen = Seen::default();
    octree::read(&again[..], &mut seen).unwrap();
    assert_eq!(seen.into_root().unwrap(), root);

    if tree.leaves <= MAX_EXPANDED {
        let expanded = root.expanded();
        let mut cells = Measured::default();
        octree::read(&(if tree.binary { expanded.binary() } else { expanded.full(false) })[..], &mut cells)
            .unwrap();
        assert_eq!(cells.tally, measured.tally);
    }
}
