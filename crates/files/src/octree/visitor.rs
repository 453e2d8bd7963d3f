//! Who visits the nodes of a tree, and what is in a leaf.

use super::octant::Octant;

/// The contents of a leaf.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Leaf {
    /// Log-odds in nats, not NaN: of a `.ot` file.
    LogOdds(f32),
    /// Free, which a `.bt` file does not say how surely.
    Free,
    /// Occupied, which a `.bt` file does not say how surely.
    Occupied,
}

/// A visitor of the nodes of a tree, in the order of the file: depth first, children in the order of their numbers.
pub trait OctreeVisitor {
    /// Visits a leaf.
    fn leaf(&mut self, octant: Octant, leaf: Leaf);

    /// Leaves an inner node, of whose children all that there are were visited.
    fn inner(&mut self, octant: Octant) {
        let _ = octant;
    }
}
