//! Octrees written here: both kinds of files, both kinds of trees, and the ways to break one.

use mean_information::cell::{Cell, information_from_log_odds};
use mean_information::{Tally, cell};
use mean_information_files::octree::{self, Leaf, Octant, OctreeVisitor};
use mean_information_files::{Error, ErrorKind, Options, Place, Warning, read_map, read_octree};
use mean_information_test_support::formats::{Folder, Node, Seen, shared_data as data};
use proptest::prelude::*;

fn root(bytes: &[u8]) -> Result<Node, Error> {
    let mut seen = Seen::default();
    octree::read(bytes, &mut seen).map(|_| seen.into_root().unwrap())
}

/// The tally of the finest cells, and the information of the leaves counted once; free and occupied are those of OctoMap's
/// clamping.
#[derive(Default)]
struct Measured {
    tally: Tally<f64>,
    of_leaves: f64,
}

impl OctreeVisitor for Measured {
    fn leaf(&mut self, octant: Octant, leaf: Leaf) {
        let cell = match leaf {
            Leaf::LogOdds(l) => Cell::from_log_odds(f64::from(l)),
            Leaf::Free => Cell::from_occupancy(0.1192),
            Leaf::Occupied => Cell::from_occupancy(0.971),
        }
        .unwrap();
        self.tally.add_many(cell, octant.finest_cells());
        self.of_leaves += cell.information();
    }
}

#[test]
fn what_is_written_is_read() {
    let small = Node::small();
    assert_eq!(root(&small.full(false)).unwrap(), small);
    assert_eq!(root(&small.full(true)).unwrap(), small);
    let Node::Inner(two) = root(&small.binary()).unwrap() else { panic!() };
    assert_eq!(two[0], (2, Node::Leaf(-1.0)));
    let Node::Inner(three) = &two[1].1 else { panic!() };
    assert_eq!((&three[0], &three[2]), (&(1, Node::Leaf(1.0)), &(7, Node::Leaf(-1.0))));

    let folder = Folder::new();
    let path = folder.write("tree.ot", small.full(true));
    let tree = read_octree(&path, &mut Seen::default()).unwrap();
    assert_eq!((tree.resolution, tree.nodes, tree.leaves, tree.binary), (0.05, 8, 5, false));
    assert_eq!((tree.files, tree.warnings), (vec![path], vec![]));
}

/// `.bt` files from before there were heads of text, and the first id of a head.
#[test]
fn old_heads_are_read() {
    let small = Node::small();
    let bytes = small.binary();
    let after = |bytes: &[u8]| bytes.windows(5).position(|five| five == b"data\n").unwrap() + 5;
    let nodes = &bytes[after(&bytes)..];
    let old = |kind: u32, side: f64, count: u32| {
        [&kind.to_le_bytes()[..], &side.to_le_bytes(), &count.to_le_bytes(), nodes].concat()
    };
    let tree = octree::read(&bytes[..], &mut Seen::default()).unwrap();
    let count = u32::try_from(tree.nodes).unwrap();
    assert_eq!(octree::read(&old(3, 0.05, count)[..], &mut Seen::default()).unwrap(), tree);
    assert_eq!(root(&old(3, 0.05, count)).unwrap(), root(&bytes).unwrap());
    let full = small.full(false);
    let text = String::from_utf8_lossy(&full[..after(&full)]).replace("id OcTree", "id 1");
    assert_eq!(root(&[text.as_bytes(), &full[after(&full)..]].concat()).unwrap(), small);
    for (bytes, kind, byte, words) in [
        (old(3, 0.05, count)[..15].to_vec(), ErrorKind::CutShort, 0, "ends within its head of 16 bytes"),
        (old(259, 0.05, count), ErrorKind::Format, 0, "is no octree of OctoMap"),
        (old(3, -0.05, count), ErrorKind::OutOfRange, 4, "resolution is -0.05"),
        (old(3, 0.05, count + 1), ErrorKind::Format, 16 + nodes.len() as u64, "that its head says"),
    ] {
        let refused = root(&bytes).unwrap_err();
        assert!(refused.to_string().contains(words), "{refused}: {words}");
        assert_eq!((refused.kind(), refused.place()), (kind, Some(&Place::Byte(byte))), "{refused}");
    }
}

#[test]
fn a_leaf_counts_for_its_finest_cells() {
    let mut measured = Measured::default();
    octree::read(&Node::small().lowered(13).full(false)[..], &mut measured).unwrap();
    // Leaves at depths 14, 15 and 16.
    let counts = [(-0.4_f32, 64), (0.85, 8), (-0.4, 1), (2.25, 1), (-1.5, 8)];
    let sum: f64 = counts.iter().map(|&(l, n)| f64::from(n) * information_from_log_odds(f64::from(l))).sum();
    assert!((measured.tally.information() - sum).abs() < 1e-12);
    let tally = &measured.tally;
    assert_eq!((tally.free(), tally.occupied(), tally.unknown()), (73, 9, 0));
}

#[test]
fn a_tree_without_nodes_and_a_root_that_is_a_leaf() {
    let empty = b"# Octomap OcTree file\nid OcTree\nsize 0\nres 0.1\ndata\n";
    let tree = octree::read(&empty[..], &mut Seen::default()).unwrap();
    assert_eq!((tree.nodes, tree.leaves), (0, 0));
    let mut measured = Measured::default();
    octree::read(&Node::Leaf(-0.4).full(false)[..], &mut measured).unwrap();
    assert_eq!(measured.tally.free(), 1 << 48);
}

#[test]
fn log_odds_0_are_said() {
    let tree = octree::read(
        &Node::Inner(vec![(0, Node::Leaf(0.0)), (4, Node::Leaf(-0.0)), (5, Node::Leaf(2.0))])
            .lowered(14)
            .full(false)[..],
        &mut Seen::default(),
    )
    .unwrap();
    assert_eq!(tree.warnings, [Warning::LeavesOfLogOdds0 { leaves: 2, cells: 16 }]);
    let words = "2 leaves have log-odds 0, which is unknown: 16 cells of the finest";
    assert_eq!(tree.warnings[0].to_string(), words);
}

#[test]
fn what_is_no_octree_is_refused_with_its_place() {
    use ErrorKind::{CutShort, Format, OutOfRange, Unsupported};
    let small = Node::small();
    let (full, binary) = (small.full(false), small.binary());
    let data = full.len() - 8 * 5; // the first node
    let head = |from: &str, to: &str| {
        let text = String::from_utf8_lossy(&full[..data]).replace(from, to);
        [text.as_bytes(), &full[data..]].concat()
    };
    let with = |at: usize, bytes: &[u8]| {
        let mut all = full.clone();
        all[at..at + bytes.len()].copy_from_slice(bytes);
        all
    };
    let place = |byte: usize| Some(Place::Byte(byte as u64));
    let cases: Vec<(Vec<u8>, ErrorKind, Option<Place>, &str)> = vec![
        (Vec::new(), CutShort, None, "the file is empty"),
        (b"OcTree\n".to_vec(), Format, Some(Place::Line(1)), "is no octree of OctoMap by its first line"),
        (head("id OcTree", "id OcTreeStamped"), Unsupported, Some(Place::Line(4)), "tree `OcTreeStamped`"),
        (head("id OcTree\n", ""), Format, Some(Place::Key("id")), "the head lacks id"),
        (head("res 0.05\n", ""), Format, Some(Place::Key("res")), "the head lacks res"),
        (head("size 8\n", ""), Format, Some(Place::Key("size")), "the head lacks size"),
        (head("size 8", "size -8"), Format, Some(Place::Line(5)), "size in line 5 is `-8`"),
        (head("res 0.05", "res 0"), OutOfRange, Some(Place::Line(6)), "res in line 6 is 0"),
        (head("res 0.05", "res nan"), OutOfRange, Some(Place::Line(6)), "res in line 6 is NaN"),
        (head("res 0.05", "res 1e99"), OutOfRange, Some(Place::Line(6)), "res in line 6 is 1"),
        (head("res 0.05", "res 1e-104"), OutOfRange, Some(Place::Line(6)), "res in line 6 is 0.0"),
        (full[..data - 2].to_vec(), CutShort, place(data - 2), "before the line `data`"),
        (head("size 8", "size 7"), Format, place(data + 35), "has more nodes than the 7 that its head says"),
        (head("size 8", "size 9"), Format, place(full.len()), "has 8 nodes, not the 9 that its head says"),
        (head("size 8", "size 0"), Format, place(data), "goes on after its last node"),
        (
            full[..full.len() - 3].to_vec(),
            CutShort,
            place(full.len() - 5),
            "cut short, in node 8 of 8, at byte",
        ),
        ([&full[..], b"\n"].concat(), Format, place(full.len()), "goes on after its last node"),
        (with(data, &f32::NAN.to_le_bytes()), OutOfRange, place(data), "log-odds of the node at byte"),
        (with(data + 9, &[1]), Format, place(full.len()), "more nodes than the 8"), // the first leaf promises a child
        (binary[..binary.len() - 1].to_vec(), CutShort, place(binary.len() - 2), "cut short, in node"),
        (Node::Leaf(0.5).binary(), CutShort, None, "cut short, in node 1 of 1"),
        ([Node::Leaf(0.5).binary(), vec![0; 2]].concat(), Format, None, "has no child"),
        (Node::small().lowered(14).full(false), Format, None, "at depth 16, promises children"),
        (Node::small().lowered(14).binary(), Format, None, "at depth 16, promises children"),
    ];
    for (bytes, kind, place, words) in cases {
        let refused = root(&bytes).unwrap_err();
        assert!(refused.to_string().contains(words), "{refused}: {words}");
        assert_eq!(refused.kind(), kind, "{refused}");
        if place.is_some() {
            assert_eq!(refused.place(), place.as_ref(), "{refused}");
        }
    }
}

#[test]
fn an_octree_is_no_grid() {
    let folder = Folder::new();
    let refused = read_map(&folder.write("a.bt", Node::small().binary()), &Options::default()).unwrap_err();
    assert_eq!(refused.kind(), ErrorKind::Unsupported);
    assert!(refused.to_string().ends_with("a.bt: is an octree, which has no grid of cells"), "{refused}");
}

/// A tree of at most `levels` levels below its root, with log-odds from few values, so that siblings are often equal.
fn trees(levels: u32) -> impl Strategy<Value = Node> {
    let leaf = prop::sample::select(vec![-2.0_f32, -0.4, 0.85, 0.0, 3.5, -0.4]).prop_map(Node::Leaf);
    leaf.prop_recursive(levels, 64, 8, |below| {
        prop::collection::btree_map(0_usize..8, below, 1..=8)
            .prop_map(|children| Node::Inner(children.into_iter().collect()))
    })
}

proptest! {
    /// Theorem (pruned trees) of docs/octrees.md.
    #[test]
    fn pruned_is_expanded_bit_for_bit(tree in trees(4), lowered in 0_u32..12, times in 1_u32..3) {
        let tree = tree.lowered(lowered);
        let expanded = (0..times).fold(tree.clone(), |tree, _| tree.expanded());
        let measured = [&tree, &expanded].map(|tree| {
            let mut measured = Measured::default();
            octree::read(&tree.full(false)[..], &mut measured).unwrap();
            measured.tally
        });
        prop_assert_eq!(&measured[0], &measured[1]);
        prop_assert_eq!(root(&expanded.full(true)).unwrap(), expanded);
    }
}

/// What clamping leaves: docs/octrees.md.
#[test]
fn clamped_cells_hold_less_than_a_bit() {
    assert_eq!(format!("{:.4} {:.4}", cell::information(0.1192), cell::information(0.971)), "0.4729 0.8106");
}

#[test]
fn octomap_s_own_trees_give_their_figures() {
    let Some(data) = data() else { return println!("skipped: no shared data") };
    let folder = data.join("octomap");
    if !folder.exists() {
        return println!("skipped: no octrees in the shared data");
    }
    for (name, leaves, cells, per_leaf, per_cell) in [
        ("geb079.bt", 428_144, 1_136_432, ".586312", ".528118"),
        ("spherical_scan.ot", 4926, 18_478, ".056734", ".036430"),
    ] {
        let mut measured = Measured::default();
        let tree = read_octree(&folder.join(name), &mut measured).unwrap();
        assert_eq!((tree.leaves, measured.tally.observed()), (leaves, cells), "{name}");
        let figures = [measured.of_leaves / leaves as f64, measured.tally.mean_information()];
        assert_eq!(figures.map(|x| format!("{x:.6}")[1..].to_owned()), [per_leaf, per_cell], "{name}");
    }
}
