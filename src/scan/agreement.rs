//! How far scans agree: `A = Σ|Σ l| / ΣΣ|l|` over cells and their readings, and where they contradict one another.

use super::layer::Layer;
use super::scan_map::ScanMap;
use super::sums::Sums;
use crate::error::Error;
use crate::real::Real;
use crate::rounded::{NaturalNumber, round_log_odds, round_quotient};

impl<T: Real> ScanMap<T> {
    /// Returns the agreement of the scans, `A = Σ |Σ l| / Σ Σ |l|`: the outer sums are over the cells, the inner ones over
    /// the log-odds `l` of a cell's readings. It lies in `[0, 1]`, and is 1 if and only if no cell was told both free and
    /// occupied ([`evidence`](crate::book::evidence), Theorem (agreement)). `None` unless the map was made
    /// [with agreement](Self::with_agreement).
    ///
    /// The exact quotient of the sums of readings, which are integers, correctly rounded (proved). Each reading is within
    /// `2^-76` nats of its exact log-odds, which moves the quotient by at most `2^-75` over the mean magnitude of a reading in
    /// nats (proved). A float may be 1 where at most `2^-54` of the evidence contradicts the rest, `2^-25` in `f32`;
    /// [`contradictions`](Self::contradictions) shows that, too.
    ///
    /// Special case: 1 of no readings.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = |range| Scan::new(Pose::new(0.13, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.0, range: Some(range) }]);
    /// let model = |range| SteppedSensor::new(range, 0.25, 0.25, 0.75); // log-odds -ln 3 and ln 3
    /// let mut map = ScanMap::<f64>::new(0.25)?.with_agreement()?;
    /// map.insert(&scan(0.5)?, model)?; // two cells free, the third occupied
    /// assert_eq!(map.agreement(), Some(1.0));
    /// map.insert(&scan(1.0)?, model)?; // four free, the fifth occupied
    /// assert_eq!(map.agreement(), Some(0.75)); // 6 of 8 readings: those of the third cell cancel
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn agreement(&self) -> Option<T> {
        if !self.has_agreement() {
            return None;
        }
        // Below 2^127 each, of less than 2^64 cells: in 192 bits.
        let mut sums = [[0_u128; 2]; 2];
        for (sum, magnitude) in self.sums.iter().filter_map(Sums::pairs).flatten() {
            for ([low, high], more) in sums.iter_mut().zip([sum.unsigned_abs(), magnitude.unsigned_abs()]) {
                let carry;
                (*low, carry) = low.overflowing_add(more);
                *high += u128::from(carry);
            }
        }
        let [held, told] = sums.map(NaturalNumber::from);
        Some(if told.is_zero() { T::one() } else { round_quotient(&held, &told, 0) })
    }

    /// Returns where scans contradict one another: `Σ|l| - |Σ l|` of each cell in nats, which is 0 if and only if the cell was
    /// not told both free and occupied, and otherwise twice the lesser of what speaks for either. `None` unless the map was
    /// made [with agreement](Self::with_agreement).
    ///
    /// The exact difference of the sums of readings, rounded once (proved, [`evidence`](crate::book::evidence)); that of `n`
    /// readings is within `n 2^-75` nats of the exact one.
    ///
    /// # Errors
    /// [`Error::OutOfRange`] if the corner of the map is not finite.
    ///
    /// ```
    /// use mean_information::scan::{Beam, Pose, Scan, ScanMap};
    /// use mean_information::sensor::SteppedSensor;
    /// let scan = |range| Scan::new(Pose::new(0.13, 0.12, 0.0)?, 4.0, vec![Beam { bearing: 0.0, range: Some(range) }]);
    /// let model = |range| SteppedSensor::new(range, 0.25, 0.25, 0.75);
    /// let mut map = ScanMap::<f64>::new(0.25)?.with_agreement()?;
    /// map.insert(&scan(0.5)?, model)?;
    /// map.insert(&scan(1.0)?, model)?; // sees through the wall in the third cell
    /// let layer = map.contradictions()?.expect("with agreement");
    /// assert_eq!(layer.cells(), [0.0, 0.0, 2.1972245773362196, 0.0, 0.0, 0.0]); // 2 ln 3
    /// # Ok::<(), mean_information::Error>(())
    /// ```
    pub fn contradictions(&self) -> Result<Option<Layer<T>>, Error> {
        if !self.has_agreement() {
            return Ok(None);
        }
        let (size, geometry) = self.place()?;
        let pairs = self.sums.iter().filter_map(Sums::pairs).flatten();
        // A sum of magnitudes is no less than the magnitude of the sum: exactly, as integers.
        let cells = pairs.map(|(sum, magnitude)| round_log_odds(magnitude - sum.abs())).collect();
        Ok(Some(Layer::new(size, geometry, cells)))
    }
}
