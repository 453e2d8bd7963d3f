//! The cells that a segment crosses, one by one: the grid traversal of Amanatides and Woo (1987), decided in integers. What tests
//! compare with.

use super::lattice::{FRACTION, Point, cell_of};

/// The cells from the one that holds `from` to the one that holds `to`, in the order in which the segment meets them.
///
/// A cell is half-open: it holds its lower and left edges. The segment passes from cell to cell where it crosses a
/// line of the grid; where it crosses two at once, through a corner, it goes on in the cell diagonally opposite, and
/// the two beside it are not met. So the cells are those whose interior the segment meets, those along whose lower or
/// left edge it runs, and those that hold its ends.
///
/// No rounding: where the segment crosses the next line of its longer axis, it has come `next / long` units beyond the last line of
/// the other that it crossed, in integers of at most `2^91`; if that is more than a cell, it crosses the other one before.
#[derive(Clone, Debug)]
pub(super) struct Traversal {
    cell: [i64; 2],
    forward: [bool; 2],
    is_steep: bool,
    /// The number of lines of the grid yet to be crossed, per axis.
    left: [u64; 2],
    /// How far from a line of the other axis it is where it crosses the next line of the longer one, how much further at each line
    /// after that, and how far from line to line: in units of `2^-28` of a cell over the longer side.
    next: u128,
    step: u128,
    side: u128,
    done: bool,
}

impl Traversal {
    /// Begins in the cell that holds `from`.
    pub(super) fn new(from: Point, to: Point) -> Self {
        let (cell, last) = (cell_of(from), cell_of(to));
        let forward = [to[0] >= from[0], to[1] >= from[1]];
        let line = |k: usize| ((cell[k] + i64::from(forward[k])) << FRACTION).abs_diff(from[k]);
        let sides = [to[0].abs_diff(from[0]), to[1].abs_diff(from[1])].map(u128::from);
        let is_steep = sides[0] < sides[1];
        let (long, wide) = if is_steep { (1, 0) } else { (0, 1) };
        let side = sides[long] << FRACTION;
        Self {
            cell,
            forward,
            is_steep,
            left: [cell[0].abs_diff(last[0]), cell[1].abs_diff(last[1])],
            // From the line behind, if there were one.
            next: side - u128::from(line(wide)) * sides[long] + u128::from(line(long)) * sides[wide],
            step: sides[wide] << FRACTION,
            side,
            done: false,
        }
    }

    /// Crosses the next line of an axis.
    fn cross(&mut self, axis: usize) {
        self.cell[axis] += if self.forward[axis] { 1 } else { -1 };
        self.left[axis] -= 1;
    }
}

impl Iterator for Traversal {
    type Item = [i64; 2];

    fn next(&mut self) -> Option<[i64; 2]> {
        if self.done {
            return None;
        }
        let cell = self.cell;
        let long = usize::from(self.is_steep);
        match self.left {
            [0, 0] => self.done = true,
            [_, 0] => self.cross(0),
            [0, _] => self.cross(1),
            // Both, through a corner.
            _ if self.next == self.side => {
                self.cross(0);
                self.cross(1);
                self.next = self.step;
            }
            _ if self.next > self.side => {
                self.cross(1 - long);
                self.next -= self.side;
            }
            _ => {
                self.cross(long);
                self.next += self.step;
            }
        }
        Some(cell)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;
    use std::collections::BTreeSet;

    const CELL: i64 = 1 << FRACTION;

    /// Whether the segment meets the interior of the cell, by clipping it to the open square: fractions `n / d` with
    /// `d > 0`, compared by cross products.
    fn meets_interior(from: Point, to: Point, cell: [i64; 2]) -> bool {
        let (mut low, mut high) = ((0_i128, 1_i128), (1_i128, 1_i128));
        // Closed at the ends of the segment, open at the sides of the square.
        let (mut low_open, mut high_open) = (false, false);
        for k in [0, 1] {
            let (a, d) = (i128::from(from[k]), i128::from(to[k]) - i128::from(from[k]));
            let (near, far) = (i128::from(cell[k]) << FRACTION, i128::from(cell[k] + 1) << FRACTION);
            if d == 0 {
                if a <= near || a >= far {
                    return false;
                }
                continue;
            }
            let (enter, leave) = if d > 0 { (near - a, far - a) } else { (a - far, a - near) };
            let d = d.abs();
            if enter * low.1 >= low.0 * d {
                (low, low_open) = ((enter, d), true);
            }
            if leave * high.1 <= high.0 * d {
                (high, high_open) = ((leave, d), true);
            }
        }
        let (a, b) = (low.0 * high.1, high.0 * low.1);
        if low_open || high_open { a < b } else { a <= b }
    }

    /// The rule of [`Traversal`], cell by cell.
    fn expected(from: Point, to: Point) -> BTreeSet<[i64; 2]> {
        let (a, b) = (cell_of(from), cell_of(to));
        let range = |k: usize| a[k].min(b[k])..=a[k].max(b[k]);
        let held = |cell: [i64; 2]| {
            // Along the lower or the left edge.
            let runs_along = |k: usize| from[k] == to[k] && from[k] == cell[k] << FRACTION;
            cell == a || cell == b || meets_interior(from, to, cell) || runs_along(0) || runs_along(1)
        };
        range(0).flat_map(|x| range(1).map(move |y| [x, y])).filter(|&cell| held(cell)).collect()
    }

    fn check(from: Point, to: Point) -> Result<(), TestCaseError> {
        let cells: Vec<_> = Traversal::new(from, to).collect();
        prop_assert_eq!((cells[0], cells[cells.len() - 1]), (cell_of(from), cell_of(to)));
        for pair in cells.windows(2) {
            let steps = [0, 1].map(|k| pair[0][k].abs_diff(pair[1][k]));
            prop_assert!(steps.iter().all(|&step| step <= 1) && steps != [0, 0], "{:?}", pair);
        }
        let set: BTreeSet<_> = cells.iter().copied().collect();
        prop_assert_eq!(set.len(), cells.len(), "a cell twice");
        prop_assert_eq!(set, expected(from, to), "{:?} {:?}", from, to);
        Ok(())
    }

    /// Places of which many lie on lines and corners.
    fn place() -> impl Strategy<Value = i64> {
        prop_oneof![
            -9 * CELL..9 * CELL,
            (-9_i64..9).prop_map(|k| k * CELL),
            (-18_i64..18).prop_map(|k| k * CELL / 2),
            (-9_i64..9, -2_i64..3).prop_map(|(k, more)| k * CELL + more),
        ]
    }

    /// Places on no line, of which many lie on the diagonals of cells.
    fn inside() -> impl Strategy<Value = i64> {
        (-9_i64..9, prop_oneof![1..CELL, Just(CELL / 2), Just(CELL / 4)])
            .prop_map(|(k, part)| k * CELL + part)
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(3000))]

        #[test]
        fn the_cells_are_those_the_segment_crosses(from in [place(), place()], to in [place(), place()]) {
            check(from, to)?;
        }

        /// Where rounding would decide wrongly: far out, nearly through corners.
        #[test]
        fn far_out_and_next_to_corners(
            x in -1_i64 << 31..1 << 31, y in -1_i64 << 31..1 << 31, columns in -40_i64..40, rows in -40_i64..40, more in [-2_i64..3, -2_i64..3],
        ) {
            let from = [x * CELL, y * CELL];
            check(from, [from[0] + columns * CELL + more[0], from[1] + rows * CELL + more[1]])?;
        }

        /// Turned by half a turn about a corner of the grid, with nothing on a line, the same cells turned.
        #[test]
        fn backwards_the_same_cells(from in [inside(), inside()], to in [inside(), inside()]) {
            let there: Vec<_> = Traversal::new(from, to).collect();
            let mut back: Vec<_> = Traversal::new(to, from).collect();
            back.reverse();
            prop_assert_eq!(&there, &back);
            let turned: Vec<_> = Traversal::new(from.map(|x| -x), to.map(|x| -x)).map(|cell| cell.map(|k| -1 - k)).collect();
            prop_assert_eq!(there, turned);
        }
    }

    #[test]
    fn through_a_corner_to_the_cell_opposite() {
        let cells = |from: Point, to: Point| Traversal::new(from, to).collect::<Vec<_>>();
        let (half, one) = (CELL / 2, CELL);
        assert_eq!(cells([half, half], [one + half, one + half]), [[0, 0], [1, 1]]);
        assert_eq!(cells([half, one + half], [one + half, half]), [[0, 1], [1, 0]]);
        assert_eq!(cells([half, half], [one + half, one + half - 1]), [[0, 0], [1, 0], [1, 1]]);
        // Along a line, in the cells above it; from a line downwards, through the cell that holds its start.
        assert_eq!(cells([half, one], [2 * one, one]), [[0, 1], [1, 1], [2, 1]]);
        assert_eq!(cells([half, one], [half, half]), [[0, 1], [0, 0]]);
        assert_eq!(cells([half, half], [half, half]), [[0, 0]]);
    }
}
