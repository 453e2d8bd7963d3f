//! A node's place in a tree, and how many finest cells it stands for.

/// The depth of the finest cells: OctoMap numbers them with 16 bits along each axis.
pub const DEPTH: u32 = 16;

/// The place of a node below its parent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Octant {
    /// The number of steps from the root, 0 to [`DEPTH`].
    pub depth: u32,
    /// The number among the children of its parent, 0 to 7; 0 of the root.
    pub child: usize,
}

impl Octant {
    /// The root.
    pub(super) const ROOT: Self = Self { depth: 0, child: 0 };

    /// Returns the number of finest cells in the cube of the node, `8^(16 - depth)`: at most `2^48`, so that a tree never has
    /// more than a tally counts.
    ///
    /// ```
    /// use mean_information_files::octree::Octant;
    /// assert_eq!(Octant { depth: 14, child: 3 }.finest_cells(), 64);
    /// ```
    pub fn finest_cells(self) -> u64 {
        1 << (3 * DEPTH.saturating_sub(self.depth))
    }

    /// Returns a child; `None` below the finest cells.
    pub(super) fn child(self, child: usize) -> Option<Self> {
        (self.depth < DEPTH).then_some(Self { depth: self.depth + 1, child })
    }
}
