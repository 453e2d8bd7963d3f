//! The path of a sensor over a map: its colour runs with the time, and some of its dots have theirs beside them.

use super::scale::ticks;

/// The most dots with a time, beside that of the first pose.
const DOTS: usize = 6;
/// The pieces of one colour each.
const PIECES: usize = 24;
/// The colours of the first pose and of the last: blues that are seen on white, on the blue-grey of what is unknown and among the
/// reds of contradictions.
const ENDS: [[u8; 3]; 2] = [[10, 20, 110], [0, 150, 235]];

/// The positions of a sensor, in metres, with their times, in seconds after the first, in their order.
#[derive(Clone, Debug, Default)]
pub struct TimedPath(Vec<(f64, [f64; 2])>);

impl TimedPath {
    /// Creates a path of positions (metres) by their times (seconds after the first), which ascend.
    pub fn new(positions: Vec<(f64, [f64; 2])>) -> Self {
        Self(positions)
    }

    /// Returns the first position.
    pub(super) fn first(&self) -> Option<[f64; 2]> {
        self.0.first().map(|&(_, position)| position)
    }

    /// Returns the path in pieces that join, each with its colour: as many scans in each, or nearly.
    pub(super) fn pieces(&self) -> impl Iterator<Item = ([u8; 3], Vec<[f64; 2]>)> {
        let legs = self.0.len().saturating_sub(1);
        let pieces = PIECES.min(legs);
        let start = move |piece: usize| legs * piece / pieces.max(1);
        (0..pieces).map(move |piece| {
            let part = piece as f64 / (pieces - 1).max(1) as f64;
            let positions = &self.0[start(piece)..=start(piece + 1)];
            (colour(part), positions.iter().map(|&(_, position)| position).collect())
        })
    }

    /// Returns some positions at round times, with these in words: the first pose at or after each.
    pub(super) fn dots(&self) -> Vec<([f64; 2], String)> {
        let last = self.0.last().map_or(0.0, |&(time, _)| time);
        if !(last > 0.0 && last.is_finite()) {
            return Vec::new();
        }
        let round = ticks(0.0, last, DOTS).into_iter().filter(|&(time, _)| time > 0.0);
        let at = |(round, text): (f64, String)| {
            let &(_, position) = self.0.iter().find(|&&(time, _)| time >= round)?;
            Some((position, format!("{text} s")))
        };
        round.filter_map(at).collect()
    }
}

/// Returns the colour of a part of the way, 0 at the first pose and 1 at the last.
pub(super) fn colour(part: f64) -> [u8; 3] {
    let between =
        |(from, to): (u8, u8)| (f64::from(from) + part * (f64::from(to) - f64::from(from))).round() as u8;
    let [first, last] = ENDS;
    [0, 1, 2].map(|k: usize| between((first[k], last[k])))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_join_and_their_colours_run_from_end_to_end() {
        for legs in [1_usize, 5, 24, 100] {
            let path = TimedPath::new((0..=legs).map(|k| (k as f64, [k as f64, 0.0])).collect());
            let pieces: Vec<_> = path.pieces().collect();
            assert_eq!(pieces.len(), legs.min(PIECES));
            assert_eq!(pieces[0].0, ENDS[0]);
            assert!(legs == 1 || pieces.last().unwrap().0 == ENDS[1]);
            assert!(pieces.windows(2).all(|pair| pair[0].1.last() == pair[1].1.first()));
            assert_eq!(pieces.iter().map(|(_, positions)| positions.len() - 1).sum::<usize>(), legs);
        }
        assert_eq!(TimedPath::new(vec![(0.0, [1.0, 2.0])]).pieces().count(), 0);
        assert_eq!(TimedPath::default().first(), None);
    }

    #[test]
    fn dots_lie_where_the_sensor_was_at_round_times() {
        // A scan every 3 s.
        let path = TimedPath::new((0..=100).map(|k| (f64::from(3 * k), [f64::from(k), 1.0])).collect());
        let dots = path.dots();
        let texts: Vec<_> = dots.iter().map(|(_, text)| text.as_str()).collect();
        assert_eq!(texts, ["50 s", "100 s", "150 s", "200 s", "250 s", "300 s"]);
        assert_eq!((dots[0].0, dots[5].0), ([17.0, 1.0], [100.0, 1.0])); // at 51 s, at 300 s
        assert!(TimedPath::new(vec![(0.0, [0.0; 2]), (0.0, [1.0; 2])]).dots().is_empty());
    }
}
