//! How often each value occurs in an image: all that the measures of a map need, and no memory for its cells.

use super::doubts::Suspect;
use super::shading::{Place, Shading};
use crate::maps::Fault;
use crate::maps::image::{Image, Layout};
use mean_information::map::Histogram;
use std::io::{BufRead, Seek};
use std::ops::Range;

/// Pixels are counted in so many lanes in turn: equal neighbours would wait for each other.
const LANES: usize = 4;

/// How often each place of a [`Shading`]'s tables occurs.
enum Counts {
    /// Pixels that are bytes, and their own index.
    Bytes(Box<Histogram>),
    /// Opaque pixels, and others.
    Places([Vec<[u64; LANES]>; 2]),
}

impl Counts {
    fn new<C: Copy>(shading: &Shading<C>, layout: &Layout) -> Self {
        let lengths = shading.lengths();
        if layout.pixel_bytes() == 1 && lengths[0] == 256 {
            Self::Bytes(Box::default())
        } else {
            Self::Places(lengths.map(|length| vec![[0; LANES]; length]))
        }
    }

    fn extend<C: Copy>(&mut self, shading: &Shading<C>, layout: &Layout, pixels: &[u8]) {
        match self {
            Self::Bytes(histogram) => histogram.add_cells(pixels),
            Self::Places([opaque, clear]) => {
                let mut lane = 0;
                shading.places(layout, pixels, |place| {
                    match place {
                        Place::Opaque(index) => opaque[index][lane] += 1,
                        Place::Clear(index) => clear[index][lane] += 1,
                    }
                    lane = (lane + 1) % LANES;
                });
            }
        }
    }

    /// Of opaque pixels, and of others.
    fn totals(self) -> [Vec<u64>; 2] {
        match self {
            Self::Bytes(histogram) => [histogram.counts().to_vec(), Vec::new()],
            Self::Places(tables) => {
                tables.map(|table| table.iter().map(|lanes| lanes.iter().sum()).collect())
            }
        }
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
    let mut counts = Counts::new(shading, &layout);
    image.pixels(|pixels| {
        counts.extend(shading, &layout, pixels);
        Ok(())
    })?;
    let [opaque, clear] = counts.totals();
    let found = opaque.iter().chain(&clear).sum();
    layout.require(found)?;
    let all = (0..).map(Place::Opaque).zip(&opaque).chain((0..).map(Place::Clear).zip(&clear));
    let present = all.filter(|&(_, &count)| count > 0);
    let cells = present.map(|(place, &count)| (shading.cell(place), count)).collect();
    let of = |(suspect, sums): &(Suspect, Range<usize>)| (*suspect, opaque[sums.clone()].iter().sum());
    Ok((cells, shading.watched().iter().map(of).collect()))
}
