//! Trajectories that are made worse on purpose, in six ways.

use crate::plane::{Place, compose, relative};
use mean_information::Error;
use mean_information_cli::simulation::Random;
use std::f64::consts::PI;

/// The way in which a trajectory was made worse.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    /// Nothing: the corrected poses of the log.
    Corrected,
    /// Everything: the poses of the odometry.
    Odometry,
    /// From scan to scan an error is added up, another one each time.
    Drift,
    /// Five errors at once are added up, each before some scan.
    Jumps,
    /// Each pose has an error of its own, which the next does not have.
    Jitter,
    /// From scan to scan the same error is added up.
    Bias,
    /// Ways and turns from scan to scan are too long, or too short, in the same ratio.
    Scale,
    /// Ways and turns from scan to scan are weighted means with those of the odometry, by ten weights one after another.
    Blend,
    /// The corrected poses, moved and turned as a whole: no error at all.
    Moved,
}

impl Kind {
    /// The ways that make errors, in the order of the tables.
    pub(crate) const ERRORS: [Self; 6] =
        [Self::Drift, Self::Jumps, Self::Jitter, Self::Bias, Self::Scale, Self::Blend];

    /// Returns the name.
    pub(crate) fn name(self) -> &'static str {
        match self {
            Self::Corrected => "corrected",
            Self::Odometry => "odometry",
            Self::Drift => "drift",
            Self::Jumps => "jumps",
            Self::Jitter => "jitter",
            Self::Bias => "bias",
            Self::Scale => "scale",
            Self::Blend => "blend",
            Self::Moved => "moved",
        }
    }

    /// Returns the sizes of the error: metres along x and y, of which [`Self::turn_of`] has the radians; ratios; weights.
    pub(crate) fn sizes(self) -> &'static [f64] {
        match self {
            Self::Corrected | Self::Odometry | Self::Moved => &[0.0],
            Self::Drift => &[0.0005, 0.001, 0.002, 0.004, 0.008, 0.016],
            Self::Jumps | Self::Blend => &[0.02, 0.05, 0.1, 0.2, 0.5, 1.0],
            Self::Jitter => &[0.005, 0.01, 0.02, 0.05, 0.1, 0.2],
            Self::Bias => &[0.0001, 0.0002, 0.0005, 0.001, 0.002, 0.004],
            Self::Scale => &[0.002, 0.005, 0.01, 0.02, 0.05, 0.1],
        }
    }

    /// Returns the radians of an error for its metres.
    fn turn_of(self) -> f64 {
        match self {
            Self::Jumps | Self::Jitter => 0.5,
            _ => 1.0,
        }
    }

    /// Returns the number of trajectories of each size, each with random numbers of its own.
    pub(crate) fn seeds(self) -> u64 {
        match self {
            Self::Corrected | Self::Odometry => 1,
            Self::Moved => 6,
            _ => 3,
        }
    }
}

/// A trajectory with what it was made by.
#[derive(Clone, Debug)]
pub(crate) struct Perturbed {
    pub(crate) kind: Kind,
    pub(crate) size: f64,
    pub(crate) seed: u64,
    pub(crate) places: Vec<Place>,
}

/// Makes all trajectories from the corrected one and the odometry: the corrected one first.
pub(crate) fn all(corrected: &[Place], odometry: &[Place]) -> Result<Vec<Perturbed>, Error> {
    let mut made = Vec::new();
    for kind in [&[Kind::Corrected, Kind::Odometry, Kind::Moved][..], &Kind::ERRORS].concat() {
        for &size in kind.sizes() {
            for seed in 0..kind.seeds() {
                let places = perturbed(kind, size, seed, corrected, odometry)?;
                made.push(Perturbed { kind, size, seed, places });
            }
        }
    }
    Ok(made)
}

/// Makes one trajectory. Equal seeds of one kind have the same random numbers for every size.
fn perturbed(
    kind: Kind,
    size: f64,
    seed: u64,
    corrected: &[Place],
    odometry: &[Place],
) -> Result<Vec<Place>, Error> {
    let mut random = Random::new(1000 * (kind as u64) + seed);
    let sizes = [size, size, size * kind.turn_of()];
    let error = |random: &mut Random| sizes.map(|part| part * random.normal());
    let count = corrected.len();
    match kind {
        Kind::Corrected => Ok(corrected.to_vec()),
        Kind::Odometry => Ok(odometry.to_vec()),
        Kind::Jitter => corrected.iter().map(|&place| compose(place, error(&mut random))).collect(),
        Kind::Drift => along(corrected, |_, step| compose(step, error(&mut random))),
        Kind::Bias => {
            let same = error(&mut random);
            along(corrected, |_, step| compose(step, same))
        }
        Kind::Scale => {
            let [way, _, turn] = error(&mut random);
            along(corrected, |_, step| {
                Ok([step[0] * (1.0 + way), step[1] * (1.0 + way), step[2] * (1.0 + turn)])
            })
        }
        Kind::Jumps => {
            let jumps: Vec<_> =
                (0..5).map(|_| (random.between(1.0, count as f64) as usize, random.fork())).collect();
            along(corrected, |k, mut step| {
                for (_, random) in jumps.iter().filter(|(at, _)| *at == k) {
                    step = compose(step, error(&mut random.clone()))?;
                }
                Ok(step)
            })
        }
        Kind::Blend => {
            let weights: Vec<f64> = (0..10).map(|_| (size * random.between(0.0, 2.0)).min(1.0)).collect();
            along(corrected, |k, step| {
                let other = relative(odometry[k - 1], odometry[k])?;
                let weight = weights[k * weights.len() / count];
                Ok([0, 1, 2].map(|part| (1.0 - weight) * step[part] + weight * other[part]))
            })
        }
        Kind::Moved => {
            let mut far = || random.between(-10.0, 10.0);
            let whole = [far(), far(), far() * PI / 10.0];
            corrected.iter().map(|&place| compose(whole, place)).collect()
        }
    }
}

/// Makes a trajectory again from its first pose and its steps, each of which `changed` gets with the number of the pose that it
/// leads to.
fn along(
    trajectory: &[Place],
    mut changed: impl FnMut(usize, Place) -> Result<Place, Error>,
) -> Result<Vec<Place>, Error> {
    let mut places = vec![trajectory[0]];
    for (k, pair) in trajectory.windows(2).enumerate() {
        let step = changed(k + 1, relative(pair[0], pair[1])?)?;
        places.push(compose(places[k], step)?);
    }
    Ok(places)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn round() -> Vec<Place> {
        let mut places = vec![[0.25, -3.0, 0.5]];
        for k in 0..60 {
            places.push(compose(places[k], [0.3, 0.01, 0.1]).unwrap());
        }
        places
    }

    fn distance(one: &[Place], other: &[Place]) -> f64 {
        one.iter().zip(other).map(|(a, b)| libm::hypot(a[0] - b[0], a[1] - b[1])).sum()
    }

    /// No error leaves the trajectory, up to rounding; a greater one is further away; all have as many poses.
    #[test]
    fn errors_grow_from_none() {
        let odometry: Vec<_> = round().iter().map(|&[x, y, theta]| [1.1 * x, y, theta]).collect();
        for kind in Kind::ERRORS {
            let of = |size| perturbed(kind, size, 2, &round(), &odometry).unwrap();
            assert!(distance(&round(), &of(0.0)) < 1e-10, "{kind:?}");
            let distances: Vec<_> = kind.sizes().iter().map(|&size| distance(&round(), &of(size))).collect();
            assert!(distances.is_sorted() && distances[0] > 0.0, "{kind:?} {distances:?}");
        }
        let all = all(&round(), &odometry).unwrap();
        assert_eq!(all.len(), 2 + 6 + 6 * 6 * 3);
        assert!(all.iter().all(|made| made.places.len() == 61));
    }

    /// A move of the whole keeps the ways between poses.
    #[test]
    fn a_move_is_no_error() {
        let moved = perturbed(Kind::Moved, 0.0, 3, &round(), &round()).unwrap();
        assert!(distance(&moved, &round()) > 1.0);
        let ways = [&moved, &round()].map(|places| relative(places[3], places[50]).unwrap());
        assert!(ways[0].iter().zip(ways[1]).all(|(a, b)| (a - b).abs() < 1e-12), "{ways:?}");
    }
}
