//! Reference implementation of the **mean information** of occupancy maps.
//!
//! The mean information (Blanco, *Derivation of an Expression for the Mean Information Maximum Value*, University of Malaga)
//! says how certain and consistent an occupancy map is. Per cell, `I = 1 - H` with the Bernoulli entropy `H` in bits; the
//! mean information is the sum of `I` over the number of observed cells, those with `p != 1/2`. It needs no ground truth, lies
//! in `[0, 1]`, and unlike the entropy it does not depend on the size of the map, and little on its resolution while cells are
//! small compared with the sensor's noise.
//!
//! ```
//! use mean_information::map::{Geometry, Grid, encoding::Probability};
//!
//! // Four rows: a wall (0.9) behind free space (0.1), and two unknown cells (0.5).
//! let geometry = Geometry::new(0.05, [0.0, 0.0])?;
//! let map = Grid::<Probability<f64>>::new(
//!     3,
//!     4,
//!     geometry,
//!     vec![0.1, 0.1, 0.9, 0.1, 0.1, 0.9, 0.1, 0.2, 0.5, 0.1, 0.7, 0.5],
//! )?;
//! let tally = map.tally();
//! assert_eq!(tally.observed(), 10);
//! assert_eq!(tally.information(), 4.644816257167696); // bits
//! assert_eq!(tally.mean_information(), 0.46448162571676954); // bits per observed cell
//! # Ok::<(), mean_information::Error>(())
//! ```
//!
//! The eight cells at 0.1 or 0.9 have 0.531 bits each, that at 0.2 has 0.278, that at 0.7 has 0.119; the two at 1/2 have none
//! and do not count.
//!
//! # Where to begin
//! In a checkout of the repository, `cargo install --locked --path crates/cli` brings the command `meaninfo`, and
//! `pip install ./bindings/python` the Python package.
//!
//! | you | run | it prints | in Rust |
//! |---|---|---|---|
//! | have a map | `meaninfo map maps/room.yaml` | `0.9574864350044338`, and what it is made of | [`map::Grid`] for what mapping programs store, [`Tally::from_occupancies`] for any list of occupancies, [`map::Histogram`] for bytes as they are read |
//! | have scans and trajectories | `meaninfo trajectory maps/room.log maps/room.true.tum maps/room.odometry.tum` | `room.true.tum makes the most consistent map: 0.0265 bits per cell above room.odometry.tum, 3.7 standard errors` | [`scan::ScanMap`] at each trajectory's poses, [`scan::Difference`] between the maps; [`book::evidence`] |
//! | use Python | `python bindings/python/examples/measure_map.py maps/room.yaml` | `mean information  0.9575 bits per observed cell` | the package calls this crate |
//! | write a port | `meaninfo check -- python3 ports/python/port.py` | `17376 passed, 0 failed, 0 skipped` | [`operations`]; [`book::porting`] |
//! | read the report | `meaninfo paper --out report` | its 21 claims with what was measured, and a page | [`book`]; [`book::paper`] for where each of its lines is |
//!
//! Besides:
//! * **You have a particle filter**: [`expected::Hypotheses`], whose expected map's mean information is the EMMI; over a run,
//!   [`scan::ParticleMaps`].
//! * **You have a sensor model**: [`sensor::InverseSensorModel`] for grids, [`limit::RadialModel`] for their limit.
//! * **You doubt it**: [`book::guarantees`].
//!
//! The repository has three programs to begin with, in `examples/`: `measure`, `watch_emmi` and `own_sensor`.
//!
//! # What is where
//! The rows follow the report; those of [`architecture`](book::architecture) follow the dependencies.
//!
//! | module | holds | equations |
//! |---|---|---|
//! | [`elementary`] | exponential, logarithm and square root, correctly rounded | |
//! | [`cell`] | entropy and information of one cell, correctly rounded | 1, 3 |
//! | [`elementwise`] | the same from a slice into a slice | 1, 3 |
//! | [`tally`] | the exact, mergeable sums over a map | 2, 4 |
//! | [`map`] | grids, cell encodings, pooling | |
//! | [`sensor`] | inverse sensor models: the occupancy that a range reading gives to a point | 5 |
//! | [`room`] | maps of a circular room, polar and Cartesian | 4, 5 |
//! | [`scan`] | maps from range scans | |
//! | [`fusion`] | observations of one cell, fused | |
//! | [`expected`] | the expected map of a filter's particles | |
//! | [`limit`] | the limit of the mean information of one scan as cells shrink | 6, 7 |
//! | [`estimate`] | results with an estimated error, and results with a proved enclosure | |
//! | [`scalar`] | the numbers of integrands: floats, intervals, rectangles | |
//! | [`interval`] | intervals that contain the exact result of every operation | |
//! | [`quadrature`] | integrals of functions of one variable, with the error estimated or proved | |
//! | [`real`] | the two formats of floats | |
//! | [`operations`] | the operations that a port of this measure implements, by name | |
//! | [`book`] | the derivation, chapter by chapter, with every claim executed | |
//!
//! # What it promises
//! * Entropy and information of a cell, and its occupancy by Eq. 5, are **correctly rounded**, in `f32` and `f64`, for every input.
//! * Sums over cells are **exact** until they are read, then rounded once: no order, split or thread count changes a bit.
//! * The same bits on every platform: integer arithmetic, and where floats are used the four operations of IEEE 754; no
//!   elementary function of the standard library is called.
//! * Unknown is exact: `p = 1/2`, and nothing here turns an unknown cell into an observed one.
//! * The limits of Eq. 7 are within **0.501 ulp** of exact; enclosures contain the exact value, always.
//! * No panic on input, except where an item says so under *Panics*. Functions of floats return NaN outside their domain. What is
//!   created from arguments is refused by an [`Error`] that names the argument, its value and the allowed range. Sums made of a
//!   slice of floats at once ([`Tally::from_occupancies`] and its like) refuse nothing: they leave out the values that are no
//!   cells, and their `cells` is then below the length of the slice. [`map::Grid::new`] refuses the first of these by its place.
//!
//! # What it does not do
//! It reads no files, which `mean-information-files` does, and draws no pictures, which the command `meaninfo` (package
//! `mean-information-cli`) does. It makes no maps for robots: rooms, scans at known poses and expected maps are there to show
//! and to test the measure. It does not compare with ground truth: a map that is certain and wrong has a high mean information.
//!
//! # Features
//! * `std` (default): maps of occupancies or log-odds in floats are measured by the vector unit of the processor it runs on, to the same
//!   bits, many times as fast (`benches/RESULTS.md`). Without it the crate is `no_std` + `alloc`.
//! * `rayon`: maps, rooms, scans' maps and expected maps are measured by several threads, to the same bits
//!   (`Grid::par_tally` and others).
//! * `vectors`: arguments with their exact results for every operation, as text, to check an implementation against.
//! * `approx`: maps, tallies and estimates can be compared within a bound, by the traits of the crate `approx`:
//!   `assert_ulps_eq!(ours, theirs, max_ulps = 1)`.
//! * `serde`: tallies and histograms can be written and read, so that parts of a map measured on several machines merge to
//!   the same bits.
//!
//! The dependencies are `num-traits`, for the vocabulary of generic float code, and with `std` `multiversion`, a macro that
//! compiles a function for several vector units.
// Unit tests have the standard library in any case.
#![cfg_attr(not(any(test, feature = "std")), no_std)]
// docs.rs says of each item which feature it takes.
#![cfg_attr(docsrs, feature(doc_cfg))]

extern crate alloc;
#[cfg(any(test, feature = "std"))]
extern crate std;

#[cfg(feature = "approx")]
mod approx;
pub mod book;
pub mod cell;
pub mod elementary;
pub mod elementwise;
mod error;
pub mod estimate;
pub mod expected;
pub mod fusion;
pub mod interval;
pub mod limit;
pub mod map;
pub mod operations;
pub mod quadrature;
pub mod real;
pub mod room;
mod rounded;
pub mod scalar;
pub mod scan;
pub mod sensor;
pub mod tally;

#[cfg(feature = "vectors")]
pub mod vectors;

pub use error::Error;
pub use real::Real;
pub use tally::{ExactSum, InformationSum, Tally};

/// The README, whose examples are tests.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
pub struct Readme;
