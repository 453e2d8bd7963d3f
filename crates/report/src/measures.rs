//! What is measured of a map, and whether it means anything.

use crate::number::Number;
use crate::record::Value;
use mean_information::cell::Cell;
use mean_information::map::{Encoding, Grid};
use mean_information::{Real, Tally};
use mean_information_files::{Cells, CellsVisitor, Contents, Counted, Counts, Readable, Warning, with_grid};
use std::any::Any;

/// The measures of a grid: its size, the sums of Eqs. 2 to 4 of the paper, and the counts behind them.
#[derive(Clone, Debug, PartialEq)]
pub struct Measures {
    /// Columns.
    pub width: usize,
    /// Rows.
    pub height: usize,
    /// Eq. 4, in bits per observed cell; `None` if nothing is observed.
    pub mean_information: Option<Number>,
    /// Eq. 3, in bits.
    pub information: Number,
    /// Eq. 2, in bits, unknown cells at 1 bit each.
    pub entropy: Number,
    /// Cells with `p = 1/2`.
    pub unknown: u64,
    /// Observed cells with `p < 1/2`.
    pub free: u64,
    /// Observed cells with `p > 1/2`.
    pub occupied: u64,
    /// Why the mean information means nothing, if so.
    pub not_meaningful: Option<NotMeaningful>,
}

impl Measures {
    /// Measures a map in any encoding.
    pub fn of(cells: &Cells) -> Self {
        with_grid!(cells, grid => Self::of_grid(grid))
    }

    /// Measures a grid.
    pub fn of_grid<E: Encoding>(grid: &Grid<E>) -> Self {
        Self::of_tallied(grid, &grid.tally())
    }

    /// Takes the measures of a grid from its tally.
    pub fn of_tallied<E: Encoding>(grid: &Grid<E>, tally: &Tally<E::Float>) -> Self {
        let marked = || grid.cells().iter().any(|&stored| stored == E::unknown());
        Self::new([grid.width(), grid.height()], tally, marked)
    }

    /// Measures what was read of a map, whose other cells `sums` visited.
    pub fn of_contents(contents: &Contents, sums: &Sums) -> Self {
        match contents {
            Contents::Cells(cells) => Self::of(cells),
            Contents::Counted(Counted::Percent(counts)) => Self::of_counts(counts),
            Contents::Counted(Counted::Mrpt(counts)) => Self::of_counts(counts),
            Contents::Counted(Counted::Probability(counts)) => Self::of_counts(counts),
            Contents::Visited { width, height } => match &sums.tally {
                None => Self::new([*width, *height], &Tally::<f64>::new(), || false),
                Some(TallyOf::Single(tally)) => Self::new([*width, *height], tally, || sums.marked),
                Some(TallyOf::Double(tally)) => Self::new([*width, *height], tally, || sums.marked),
            },
        }
    }

    /// Takes note of what was noticed when the map was read: sums that were rounded mean nothing, nor do two greys.
    #[must_use]
    pub fn noticing(mut self, warnings: &[Warning]) -> Self {
        let noticed = warnings.iter().find_map(|warning| match warning {
            Warning::BesideUnknown { .. } => Some(NotMeaningful::BesideUnknown),
            Warning::TwoGreys { .. } => Some(NotMeaningful::TwoValued),
            _ => None,
        });
        self.not_meaningful = self.not_meaningful.or(noticed);
        self
    }

    /// Measures a map of which is known how often each value occurs.
    pub fn of_counts<E: Encoding>(counts: &Counts<E>) -> Self {
        let mut tally = Tally::new();
        for &(stored, count) in &counts.values {
            if let Some(cell) = E::cell(stored) {
                tally.add_many(cell, count);
            }
        }
        let marked = || counts.values.iter().any(|&(stored, _)| stored == E::unknown());
        Self::new([counts.width, counts.height], &tally, marked)
    }

    /// Takes the measures of a map of which only the sums are known, as an expected one or one of scans: a cell that is unknown
    /// there is not marked so by anyone, but no percentage either.
    pub fn of_tally<T: Real>(size: [usize; 2], tally: &Tally<T>) -> Self {
        Self::new(size, tally, || tally.unknown() > 0)
    }

    /// Takes the measures of an octree by the tally of its finest cells, which lie in no rectangle: its width and height are 0.
    pub(crate) fn of_octree(tally: &Tally<f64>, has_two_values: bool) -> Self {
        let measures = Self::new([0; 2], tally, || true);
        let two_valued = has_two_values.then_some(NotMeaningful::TwoValued);
        Self { not_meaningful: measures.not_meaningful.or(two_valued), ..measures }
    }

    /// Takes the measures of a tally; `marked` tells whether a cell is marked as unknown, not only as `p = 1/2`.
    fn new<T: Real>([width, height]: [usize; 2], tally: &Tally<T>, marked: impl FnOnce() -> bool) -> Self {
        let observed = tally.observed() > 0;
        Self {
            width,
            height,
            mean_information: observed.then(|| Number::new(tally.mean_information())),
            information: Number::new(tally.information()),
            entropy: Number::new(tally.entropy()),
            unknown: tally.unknown(),
            free: tally.free(),
            occupied: tally.occupied(),
            not_meaningful: NotMeaningful::of(tally, marked),
        }
    }

    /// Returns the mean information in words, with the reason if it means nothing.
    pub fn summary(&self) -> String {
        let number =
            self.mean_information.map_or("none".to_owned(), |x| format!("{x} bits per observed cell"));
        let reason = self.not_meaningful.map(|why| format!(" (not meaningful: {})", why.reason()));
        format!("mean information: {number}{}", reason.unwrap_or_default())
    }

    /// Returns the sentence that says why the mean information means nothing, if so.
    pub fn warning(&self) -> Option<String> {
        self.not_meaningful.map(|why| why.warning().to_owned())
    }

    /// Returns the number of cells with `p != 1/2`.
    pub fn observed(&self) -> u64 {
        self.free + self.occupied
    }

    /// Returns their area in square metres, if the side of a cell is known and the area is a number.
    pub fn observed_area(&self, resolution: Option<f64>) -> Option<f64> {
        resolution.map(|side| area(side, self.observed())).filter(|area| area.is_finite())
    }

    /// The head of a table's column of mean information.
    pub const MEAN_INFORMATION_HEAD: &str = "mean information\n(bits / cell)";

    /// Returns the entries of a record of the map, whose cells have the given side in metres.
    pub fn entries(&self, resolution: Option<f64>) -> [(&'static str, Value); 11] {
        [
            ("width", Value::Count(self.width as u64)),
            ("height", Value::Count(self.height as u64)),
            ("resolution_m", Value::Given(resolution)),
            ("mean_information", Value::Computed(self.mean_information)),
            ("information_bits", Value::Computed(Some(self.information))),
            ("entropy_bits", Value::Computed(Some(self.entropy))),
            ("observed", Value::Count(self.observed())),
            ("unknown", Value::Count(self.unknown)),
            ("free", Value::Count(self.free)),
            ("occupied", Value::Count(self.occupied)),
            ("observed_area_m2", Value::Computed(self.observed_area(resolution).map(Number::Double))),
        ]
    }
}

/// The sums over the cells of a map that are visited, some at a time, and not kept.
#[derive(Debug, Default)]
pub struct Sums {
    tally: Option<TallyOf>,
    /// True if a cell is marked as unknown.
    marked: bool,
}

/// A tally in either precision.
#[derive(Debug)]
enum TallyOf {
    Single(Tally<f32>),
    Double(Tally<f64>),
}

impl CellsVisitor for Sums {
    fn visit<E: Readable>(&mut self, cells: &[E::Stored]) {
        self.marked = self.marked || cells.contains(&E::unknown());
        let tally: Box<dyn Any> = Box::new(tally::<E>(cells));
        match tally.downcast::<Tally<f32>>() {
            Ok(tally) => match &mut self.tally {
                Some(TallyOf::Single(all)) => all.merge(&tally),
                _ => self.tally = Some(TallyOf::Single(*tally)),
            },
            Err(tally) => match (tally.downcast::<Tally<f64>>(), &mut self.tally) {
                (Ok(tally), Some(TallyOf::Double(all))) => all.merge(&tally),
                (Ok(tally), _) => self.tally = Some(TallyOf::Double(*tally)),
                // `Real` is sealed: there is no third precision.
                (Err(_), _) => {}
            },
        }
    }
}

/// Tallies cells; with the feature `rayon` by two threads, which changes no bit.
fn tally<E: Readable>(cells: &[E::Stored]) -> Tally<E::Float> {
    #[cfg(feature = "rayon")]
    if cells.len() >= 2 * PART {
        let (some, others) = cells.split_at(cells.len() / 2);
        let (mut all, others) = rayon::join(|| E::tally(some), || E::tally(others));
        all.merge(&others);
        return all;
    }
    E::tally(cells)
}

/// The least number of cells that a thread takes at once, some 50 µs of floats: below, it takes longer to wake one up.
#[cfg(feature = "rayon")]
const PART: usize = 1 << 14;

/// Why a mean information means nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NotMeaningful {
    /// Every observed cell has `p` 0 or 1.
    Thresholded,
    /// Every free cell has one value, and every occupied cell one, of an octree or of an image.
    TwoValued,
    /// There are no cells.
    NoCells,
    /// Every cell is unknown.
    NothingObserved,
    /// Every cell is unknown, and not because it is marked so: each holds 50 percent.
    AllFiftyPercent,
    /// Many cells are beside unknown by rounding only.
    BesideUnknown,
}

impl NotMeaningful {
    /// Tells why the mean information of a tally means nothing, if so.
    fn of<T: Real>(tally: &Tally<T>, marked: impl FnOnce() -> bool) -> Option<Self> {
        if tally.observed() > 0 {
            is_thresholded(tally).then_some(Self::Thresholded)
        } else if tally.cells() == 0 {
            Some(Self::NoCells)
        } else if marked() {
            Some(Self::NothingObserved)
        } else {
            Some(Self::AllFiftyPercent)
        }
    }

    /// Returns the reason in a few words, to stand beside the number.
    pub fn reason(self) -> &'static str {
        match self {
            Self::Thresholded => "thresholded",
            Self::TwoValued => "two values",
            Self::NoCells => "no cells",
            Self::NothingObserved => "nothing observed",
            Self::AllFiftyPercent => "all 50 percent",
            Self::BesideUnknown => "unknown cells rounded",
        }
    }

    /// Returns the reason in a sentence.
    pub fn warning(self) -> &'static str {
        match self {
            Self::Thresholded => {
                "thresholded: every observed cell has p = 0 or 1, so the mean information is 1 whatever the map shows"
            }
            Self::TwoValued => {
                "two-valued: every free cell has one value and every occupied cell one, so the mean information is of these \
                 two values and of how many cells have each, not of evidence"
            }
            Self::NoCells => "the map has no cells, so there is no mean information",
            Self::NothingObserved => {
                "nothing observed: every cell is unknown, so there is no mean information"
            }
            Self::BesideUnknown => {
                "many cells would be unknown but for rounding, so the mean information is too low: average with exact sums, \
                 or round the probabilities"
            }
            Self::AllFiftyPercent => {
                "every cell is exactly 50 percent, which means unknown: nothing is observed"
            }
        }
    }
}

/// Tells whether the cells' tally is that of cells with `p` 0, 1/2 and 1 only. Sums are exact, so no cell hides in rounding.
fn is_thresholded<T: Real>(tally: &Tally<T>) -> bool {
    let counts = [(T::zero(), tally.free()), (T::HALF, tally.unknown()), (T::one(), tally.occupied())];
    let mut certain = Tally::new();
    for (cell, count) in
        counts.into_iter().filter_map(|(p, count)| Some((Cell::from_occupancy(p).ok()?, count)))
    {
        certain.add_many(cell, count);
    }
    certain == *tally
}

/// Rounds the area of `count` squares once: `count side^2`, from the exact product.
fn area(side: f64, count: u64) -> f64 {
    let (significand, exponent) = side.parts();
    let square = u128::from(significand) * u128::from(significand);
    let [high, low] = [square >> 64, square & u128::from(u64::MAX)].map(|half| u128::from(count) * half);
    let (high, low) = (high + (low >> 64), low & u128::from(u64::MAX));
    // The first 128 bits of both, the last of them set if anything follows, which is how `as` rounds them right.
    let room = high.leading_zeros().min(64);
    let follows = (low << room) & u128::from(u64::MAX) != 0;
    let product = (high << room) | (low >> (64 - room)) | u128::from(follows);
    let scale = f64::from_parts(1, exponent);
    product as f64 * f64::from_parts(1, 64 - room as i32) * scale * scale
}

#[cfg(test)]
mod tests {
    use super::*;
    use mean_information::map::Geometry;
    use mean_information::map::encoding::{LogOdds, MrptLogOdds, Percent, Probability};

    fn grid<E: Encoding>(cells: &[E::Stored]) -> Grid<E> {
        Grid::new(cells.len(), 1, Geometry::new(0.2, [0.0; 2]).unwrap(), cells.to_vec()).unwrap()
    }

    fn why<E: Encoding>(cells: &[E::Stored]) -> Option<NotMeaningful> {
        Measures::of_grid(&grid::<E>(cells)).not_meaningful
    }

    #[test]
    fn an_area_is_the_exact_product_rounded_once() {
        assert_eq!(area(0.05, 21477), 53.6925); // of two roundings: 53.69250000000001
        assert_eq!([area(0.25, 0), area(1.5, 3), area(1e200, 1)], [0.0, 6.75, f64::INFINITY]);
        // (2^52 + 1)^2 (2^64 - 1) 2^-104: bits to both ends of the product.
        let side = 1.0_f64.next_up();
        let exact = num_bigint::BigUint::from((1_u64 << 52) + 1).pow(2) * u64::MAX;
        let above = exact >> (168 - 60); // of 169 bits, the first 61
        let nearest = u64::try_from(above).unwrap() as f64 * 16.0;
        assert_eq!(area(side, u64::MAX), nearest);
    }

    #[test]
    fn thresholded_in_every_encoding() {
        assert_eq!(why::<Probability<f64>>(&[0.0, 1.0, 0.5]), Some(NotMeaningful::Thresholded));
        assert_eq!(why::<Probability<f32>>(&[0.0, 1.0, f32::MIN_POSITIVE]), None);
        assert_eq!(why::<LogOdds<f64>>(&[f64::INFINITY, 0.0]), Some(NotMeaningful::Thresholded));
        // Its occupancy rounds to 1, but the cell is not certain.
        assert_eq!(why::<LogOdds<f64>>(&[f64::INFINITY, 60.0]), None);
        assert_eq!(why::<MrptLogOdds>(&[127, -127]), None);
    }

    #[test]
    fn unknown_in_every_encoding() {
        assert_eq!(why::<Probability<f64>>(&[0.5; 3]), Some(NotMeaningful::NothingObserved));
        assert_eq!(why::<LogOdds<f32>>(&[0.0, -0.0]), Some(NotMeaningful::NothingObserved));
        assert_eq!(why::<MrptLogOdds>(&[0; 3]), Some(NotMeaningful::NothingObserved));
        assert_eq!(why::<Percent>(&[50, 50]), Some(NotMeaningful::AllFiftyPercent));
        assert_eq!(why::<Percent>(&[50, -1]), Some(NotMeaningful::NothingObserved));
        assert_eq!(why::<Percent>(&[]), Some(NotMeaningful::NoCells));
        assert_eq!(why::<Percent>(&[50, 49]), None);
    }

    /// Some at a time, and so many that threads share them.
    #[test]
    fn cells_that_are_visited_are_measured_as_a_grid() {
        fn check<E: Readable>(cells: &[E::Stored]) {
            let mut sums = Sums::default();
            let (first, second) = cells.split_at(cells.len() / 3);
            sums.visit::<E>(first);
            sums.visit::<E>(second);
            let visited = Contents::Visited { width: cells.len(), height: 1 };
            assert_eq!(Measures::of_contents(&visited, &sums), Measures::of_grid(&grid::<E>(cells)));
        }
        let cells: Vec<f64> = (0..90_011).map(|k| f64::from(k * 7 % 90_012) / 90_011.0).collect();
        check::<Probability<f64>>(&cells);
        let singles: Vec<f32> = cells.iter().map(|&p| p as f32 - 0.5).collect();
        check::<LogOdds<f32>>(&singles);
    }

    #[test]
    fn a_map_in_single_precision_has_results_in_single_precision() {
        let measures = Measures::of(&Cells::Probability32(grid(&[0.125, 0.5, 0.75])));
        let entropy = |p: f64| -p * libm::log2(p) - (1.0 - p) * libm::log2(1.0 - p);
        let expected = f32::nearest((2.0 - entropy(0.125) - entropy(0.75)) / 2.0);
        assert_eq!(measures.mean_information, Some(Number::Single(expected)));
        assert_eq!((measures.unknown, measures.free, measures.occupied), (1, 1, 1));
    }
}
