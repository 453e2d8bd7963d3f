//! The marks on curves, by which they are told apart without colours.

/// The marks on the points of a curve.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Marks {
    /// None.
    None,
    /// A shape on each point; a circle is a dot.
    Each(Shape),
    /// A dot on each point, and no line.
    Alone,
    /// A shape on a few points.
    Spaced(Shape),
}

/// The shape of a mark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// The first.
    Circle,
    /// The second.
    Square,
    /// The third.
    Triangle,
    /// The fourth.
    Diamond,
    /// The fifth.
    Cross,
}

/// The outlines, in pixels from the middle.
const CIRCLE: [(i32, i32); 12] = [
    (6, 0),
    (5, 3),
    (3, 5),
    (0, 6),
    (-3, 5),
    (-5, 3),
    (-6, 0),
    (-5, -3),
    (-3, -5),
    (0, -6),
    (3, -5),
    (5, -3),
];
const SQUARE: [(i32, i32); 4] = [(-5, -5), (5, -5), (5, 5), (-5, 5)];
const TRIANGLE: [(i32, i32); 3] = [(0, -7), (7, 5), (-7, 5)];
const DIAMOND: [(i32, i32); 4] = [(0, -7), (7, 0), (0, 7), (-7, 0)];
const CROSS: [(i32, i32); 12] = [
    (-6, -4),
    (-4, -6),
    (0, -2),
    (4, -6),
    (6, -4),
    (2, 0),
    (6, 4),
    (4, 6),
    (0, 2),
    (-4, 6),
    (-6, 4),
    (-2, 0),
];

impl Shape {
    /// All shapes.
    pub const ALL: [Self; 5] = [Self::Circle, Self::Square, Self::Triangle, Self::Diamond, Self::Cross];

    /// The number of marks on a curve.
    const MARKS: usize = 8;

    fn outline(self) -> &'static [(i32, i32)] {
        match self {
            Self::Circle => &CIRCLE,
            Self::Square => &SQUARE,
            Self::Triangle => &TRIANGLE,
            Self::Diamond => &DIAMOND,
            Self::Cross => &CROSS,
        }
    }

    /// Returns the points of a curve that have a mark: each shape others, so that equal curves show both.
    pub(super) fn spaced(self, points: &[(f64, f64)]) -> impl Iterator<Item = (f64, f64)> {
        let step = points.len() as f64 / Self::MARKS as f64;
        let first = (self as usize + 1) as f64 / (Self::ALL.len() + 1) as f64;
        (0..Self::MARKS).filter_map(move |k| points.get((step * (k as f64 + first)) as usize).copied())
    }
}

impl Marks {
    /// Tells whether each point has a dot.
    pub(super) fn is_dotted(self) -> bool {
        matches!(self, Self::Each(Shape::Circle) | Self::Alone)
    }

    /// Returns the outline of a shape about a point; empty of no shape and of a dot.
    pub(super) fn outline(self, (x, y): (i32, i32)) -> Vec<(i32, i32)> {
        match self {
            _ if self.is_dotted() => Vec::new(),
            Self::Spaced(shape) | Self::Each(shape) => {
                shape.outline().iter().map(|(dx, dy)| (x + dx, y + dy)).collect()
            }
            Self::None | Self::Alone => Vec::new(),
        }
    }
}
