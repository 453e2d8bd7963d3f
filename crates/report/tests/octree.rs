//! Octrees measured at each depth.

use mean_information::cell::information;
use mean_information::map::Encoding;
use mean_information::map::encoding::LogOdds;
use mean_information_files::Memory;
use mean_information_report::clamp::Clamp;
use mean_information_report::measures::Measures;
use mean_information_report::octree::MeasuredDepths;
use mean_information_test_support::formats::Node;
use proptest::prelude::*;
use std::path::Path;

/// The measures of a tree of these bytes, from depth 0 to 16.
fn depths(bytes: Vec<u8>) -> Vec<Measures> {
    let mut files = Memory::new();
    files.add("map.ot", bytes);
    let mut depths = MeasuredDepths::read(&files, Path::new("map.ot"), Clamp::default()).unwrap().measures;
    depths.reverse();
    depths
}

fn bits(measures: &Measures) -> f64 {
    measures.information.widen()
}

#[test]
fn a_cell_is_the_mean_of_its_finest_cells() {
    // Two leaves of three children at depth 16: log-odds -ln 3 and ln 7 are 1/4 and 7/8.
    let quarter = -1.098_612_3_f32;
    let node = Node::Inner(vec![(0, Node::Leaf(quarter)), (3, Node::Leaf(quarter)), (6, Node::Leaf(2.0))]);
    let depths = depths(node.lowered(15).full(false));
    let p = |l: f32| LogOdds::<f64>::occupancy(f64::from(l)).unwrap();
    let mean = (2.0 * p(quarter) + p(2.0) + 5.0 * 0.5) / 8.0;
    assert!((bits(&depths[15]) - information(mean)).abs() < 1e-15);
    assert_eq!((depths[16].observed(), depths[15].observed(), depths[0].observed()), (3, 1, 1));
    let of_next = information(0.5 + (mean - 0.5) / 8.0);
    assert!((bits(&depths[14]) - of_next).abs() < 1e-15);
}

proptest! {
    /// Pruned is expanded, bit for bit, at every depth; and averaging only loses information (Jensen).
    #[test]
    fn pruned_is_expanded_at_every_depth(
        leaves in prop::collection::btree_map(0_usize..8, -3_f32..3.0, 1..8), lowered in 0_u32..14,
    ) {
        let below = Node::Inner(leaves.iter().map(|(&child, &l)| (child, Node::Leaf(l))).collect());
        let tree = Node::Inner(vec![(1, Node::Leaf(-0.4)), (4, below)]).lowered(lowered);
        let of = |bytes| {
            let said = |m: &Measures| (bits(m).to_bits(), m.entropy.widen().to_bits(), m.unknown, m.free, m.occupied);
            depths(bytes).iter().map(said).collect::<Vec<_>>()
        };
        let pruned = of(tree.full(false));
        prop_assert_eq!(&of(tree.expanded().full(true)), &pruned);
        prop_assert_eq!(&of(tree.expanded().expanded().full(false)), &pruned);
        for pair in depths(tree.full(false)).windows(2) {
            prop_assert!(8.0 * bits(&pair[0]) <= bits(&pair[1]) * (1.0 + 1e-12));
        }
    }
}
