//! How often each value occurs in an image: all that the measures of a map need, and no memory for its cells.

use super::doubts::Suspect;
use super::shading::{Place, Shading};
use crate::maps::Fault;
use crate::maps::image::{Image, Layout};
use std::io::{BufRead, Seek};
use std::ops::Range;

/// Pixels are counted in so many lanes in turn: equal neighbours would wait for each other.
const LANES: usize = 4;
/// Bytes that are compared at a time: maps are mostly long runs of one value.
const RUN: usize = 32;

/// How often each place of a [`Shading`]'s tables occurs, of opaque pixels and of others.
struct Counts([Vec<[u64; LANES]>; 2]);

impl Counts {
    fn extend<C: Copy>(&mut self, shading: &Shading<C>, layout: &Layout, pixels: &[u8]) {
        let Self([opaque, clear]) = self;
        if layout.pixel_bytes() == 1
            && let Ok(table) = <&mut [_; 256]>::try_from(opaque.as_mut_slice())
        {
            return extend_by(table, pixels);
        }
        let mut lane = 0;
        shading.places(layout, pixels, |place| {
            match place {
                Place::Opaque(index) => opaque[index][lane] += 1,
                Place::Clear(index) => clear[index][lane] += 1,
            }
            lane = (lane + 1) % LANES;
        });
    }

    /// How often something occurs, of what occurs.
    fn present(&self) -> impl Iterator<Item = (Place, u64)> {
        let Self([opaque, clear]) = self;
        let opaque = (0..).map(Place::Opaque).zip(opaque);
        let clear = (0..).map(Place::Clear).zip(clear);
        let all = opaque.chain(clear).map(|(place, lanes)| (place, lanes.iter().sum()));
        all.filter(|&(_, count)| count > 0)
    }
}

/// Pixels that are their own index.
fn extend_by(table: &mut [[u64; LANES]; 256], pixels: &[u8]) {
    let (runs, rest) = pixels.as_chunks::<RUN>();
    for run in runs {
        if *run == [run[0]; RUN] {
            table[usize::from(run[0])][0] += RUN as u64;
            continue;
        }
        for turn in run.as_chunks::<LANES>().0 {
            for (lane, &pixel) in turn.iter().enumerate() {
                table[usize::from(pixel)][lane] += 1;
            }
        }
    }
    for &pixel in rest {
        table[usize::from(pixel)][0] += 1;
    }
}

/// How often the cells of an image, and what is watched, occur. A cell may be listed more than once.
type Counted<C> = (Vec<(C, u64)>, Vec<(Suspect, u64)>);

/// Counts the cells of an image.
pub(super) fn count<C: Copy, R: BufRead + Seek>(
    image: Image<R>,
    shading: &Shading<C>,
) -> Result<Counted<C>, Fault> {
    let layout = image.layout();
    let mut counts = Counts(shading.lengths().map(|length| vec![[0; LANES]; length]));
    image.pixels(|pixels| {
        counts.extend(shading, &layout, pixels);
        Ok(())
    })?;
    let found: u64 = counts.present().map(|(_, count)| count).sum();
    layout.require(found)?;
    let cells = counts.present().map(|(place, count)| (shading.cell(place), count)).collect();
    let of_opaque = |sums: &Range<usize>| counts.0[0][sums.clone()].iter().flatten().sum();
    let suspects = shading.watched().iter().map(|(suspect, sums)| (*suspect, of_opaque(sums))).collect();
    Ok((cells, suspects))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn runs_and_what_is_between_them_are_counted() {
        let mut pixels = vec![7; 100];
        pixels.extend((0..=255).chain([205; 45]).chain(0..3));
        let mut table = [[0; LANES]; 256];
        extend_by(&mut table, &pixels);
        let mut expected = [0; 256];
        for &pixel in &pixels {
            expected[usize::from(pixel)] += 1;
        }
        assert_eq!(table.map(|lanes| lanes.iter().sum::<u64>()), expected);
    }
}
