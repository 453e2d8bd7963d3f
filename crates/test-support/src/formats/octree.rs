//! OctoMap's octrees put together node by node, so that any part can be wrong.

use mean_information_files::octree::{DEPTH, Leaf, Octant, OctreeVisitor};

/// A node of a tree.
#[derive(Clone, Debug, PartialEq)]
pub enum Node {
    /// A leaf and its log-odds.
    Leaf(f32),
    /// An inner node: its children by their numbers, ascending.
    Inner(Vec<(usize, Self)>),
}

impl Node {
    /// Creates a tree whose leaves lie at depths 1, 2 and 3.
    pub fn small() -> Self {
        let fine = Self::Inner(vec![(0, Self::Leaf(-0.4)), (5, Self::Leaf(2.25))]);
        let middle = Self::Inner(vec![(1, Self::Leaf(0.85)), (3, fine), (7, Self::Leaf(-1.5))]);
        Self::Inner(vec![(2, Self::Leaf(-0.4)), (6, middle)])
    }

    /// Returns a tree of this one at `depth` below a root, always in child 7.
    #[must_use]
    pub fn lowered(self, depth: u32) -> Self {
        (0..depth).fold(self, |node, _| Self::Inner(vec![(7, node)]))
    }

    /// Counts nodes.
    pub fn count(&self) -> u64 {
        match self {
            Self::Leaf(_) => 1,
            Self::Inner(children) => 1 + children.iter().map(|(_, node)| node.count()).sum::<u64>(),
        }
    }

    /// Returns the tree with each leaf above the finest cells parted into eight, which hold what it held.
    #[must_use]
    pub fn expanded(&self) -> Self {
        self.expanded_below(0)
    }

    fn expanded_below(&self, depth: u32) -> Self {
        match self {
            Self::Leaf(log_odds) if depth < DEPTH => {
                Self::Inner((0..8).map(|child| (child, Self::Leaf(*log_odds))).collect())
            }
            Self::Leaf(log_odds) => Self::Leaf(*log_odds),
            Self::Inner(children) => {
                let below = |(child, node): &(usize, Self)| (*child, node.expanded_below(depth + 1));
                Self::Inner(children.iter().map(below).collect())
            }
        }
    }

    /// Returns the bytes of a `.ot` file of finest cells of 0.05 m.
    pub fn full(&self, coloured: bool) -> Vec<u8> {
        let id = if coloured { "ColorOcTree" } else { "OcTree" };
        let mut bytes = head("# Octomap OcTree file", id, self.count());
        self.write_full(coloured, &mut bytes);
        bytes
    }

    fn write_full(&self, coloured: bool, bytes: &mut Vec<u8>) {
        let (log_odds, children) = match self {
            Self::Leaf(log_odds) => (*log_odds, &[][..]),
            Self::Inner(children) => (7.5, &**children),
        };
        bytes.extend(log_odds.to_le_bytes());
        if coloured {
            bytes.extend([200, 100, 50]);
        }
        bytes.push(children.iter().map(|(child, _)| 1 << child).sum());
        for (_, node) in children {
            node.write_full(coloured, bytes);
        }
    }

    /// Returns the bytes of a `.bt` file of finest cells of 0.05 m: leaves above log-odds 0 are occupied. The root must be no
    /// leaf.
    pub fn binary(&self) -> Vec<u8> {
        let mut bytes = head("# Octomap OcTree binary file", "OcTree", self.count());
        self.write_binary(&mut bytes);
        bytes
    }

    fn write_binary(&self, bytes: &mut Vec<u8>) {
        let Self::Inner(children) = self else { return };
        let of = |node: &Self| match node {
            Self::Leaf(log_odds) => 1 + u16::from(*log_odds > 0.0),
            Self::Inner(_) => 3,
        };
        let pairs: u16 = children.iter().map(|(child, node)| of(node) << (2 * child)).sum();
        bytes.extend(pairs.to_le_bytes());
        for (_, node) in children {
            node.write_binary(bytes);
        }
    }
}

/// The head of a file.
fn head(first: &str, id: &str, nodes: u64) -> Vec<u8> {
    format!("{first}\n# a comment\n#\nid {id}\nsize {nodes}\nres 0.05\ndata\n").into_bytes()
}

/// A tree as its visitor saw it; a free leaf of a `.bt` file is -1, an occupied one 1.
#[derive(Clone, Debug, Default)]
pub struct Seen(Vec<(Octant, Node)>);

impl Seen {
    /// Returns the root; `None` of a tree without nodes.
    pub fn into_root(mut self) -> Option<Node> {
        self.0.pop().map(|(_, node)| node)
    }
}

impl OctreeVisitor for Seen {
    fn leaf(&mut self, octant: Octant, leaf: Leaf) {
        let log_odds = match leaf {
            Leaf::LogOdds(log_odds) => log_odds,
            Leaf::Free => -1.0,
            Leaf::Occupied => 1.0,
        };
        self.0.push((octant, Node::Leaf(log_odds)));
    }

    fn inner(&mut self, octant: Octant) {
        let first = self.0.iter().rposition(|(child, _)| child.depth != octant.depth + 1);
        let children = self.0.split_off(first.map_or(0, |before| before + 1));
        let children = children.into_iter().map(|(octant, node)| (octant.child, node)).collect();
        self.0.push((octant, Node::Inner(children)));
    }
}
