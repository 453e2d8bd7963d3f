//! The battery: 341 integrals with their values to 32 digits: 247 of the public test families (`generate.py`), and 94
//! that users reported as wrong, with their kin (`reported.py`).

use mean_information::cell::{entropy, information};
use mean_information::sensor::{GaussianSensor, InverseSensorModel};
use mean_information::{Real, elementary};
use num_traits::Float;

/// One integral of the battery.
#[derive(Clone, Debug)]
pub struct Case {
    /// The family of test integrals.
    pub family: &'static str,
    parameters: Vec<f64>,
    /// The ends, and between them the points where the definition of the family changes or peaks.
    pub points: Vec<f64>,
    /// The value, as the sum of two floats.
    value: [f64; 2],
}

/// Reads every case.
///
/// # Panics
/// If `cases.txt` is damaged.
#[must_use]
pub fn cases() -> Vec<Case> {
    let number = |text: &str| text.parse::<f64>().expect("a number");
    let list =
        |text: &'static str| text.split(',').filter(|text| *text != "-").map(number).collect::<Vec<_>>();
    [include_str!("cases.txt"), include_str!("reported.txt")]
        .into_iter()
        .flat_map(str::lines)
        .map(|line| {
            let fields: Vec<&'static str> = line.split(' ').collect();
            let [family, parameters, ends, breaks, high, low] = fields[..] else {
                panic!("six fields, not {line}");
            };
            let mut points = [list(ends), list(breaks)].concat();
            points.sort_by(f64::total_cmp);
            Case { family, parameters: list(parameters), points, value: [number(high), number(low)] }
        })
        .collect()
}

impl Case {
    /// Returns `|value - truth|`, to 16 digits.
    pub fn error(&self, value: f64) -> f64 {
        (value - self.value[0] - self.value[1]).abs()
    }

    /// Returns the parameters of the family.
    pub fn parameters(&self) -> &[f64] {
        &self.parameters
    }

    /// Returns the true value, rounded.
    #[must_use]
    pub fn value(&self) -> f64 {
        self.value[0]
    }

    /// Returns the integrand, written as a user would in floats of one format.
    ///
    /// The functions of the standard library that it uses are within an ulp or two.
    ///
    /// # Panics
    /// If `cases.txt` names a family that has no integrand here.
    #[must_use]
    pub fn integrand<T: Real + Float>(&self) -> Box<dyn Fn(T) -> T> {
        let c: Vec<T> = self.parameters.iter().map(|&x| T::nearest(x)).collect();
        let (zero, one, two) =
            (<T as num_traits::Zero>::zero(), <T as num_traits::One>::one(), T::nearest(2.0));
        match self.family {
            "quadpack-1" => Box::new(move |x| -Float::powf(x, c[0]) * Float::ln(x)),
            "quadpack-2" | "lyness-peak" => Box::new(move |x| c[0] / (square(x - c[1]) + square(c[0]))),
            "quadpack-3" => Box::new(move |x| Float::cos(c[0] * Float::sin(x))),
            "quadpack-4" | "quadpack-5" | "lyness-power" => {
                Box::new(move |x| Float::powf(Float::abs(x - c[1]), c[0]))
            }
            "quadpack-6" => Box::new(move |y| one / (Float::sqrt(y * (two - y)) * (y + c[0]))),
            "lyness-step" => Box::new(move |x| if x < c[1] { zero } else { Float::exp(c[0] * x) }),
            "lyness-cusp" => Box::new(move |x| Float::exp(-c[0] * Float::abs(x - c[1]))),
            "lyness-four-peaks" => Box::new(move |x| {
                c[1..].iter().fold(zero, |sum, &at| sum + c[0] / (square(x - at) + square(c[0])))
            }),
            "lyness-oscillation" => {
                Box::new(move |x| two * c[0] * (x - c[1]) * Float::cos(c[0] * square(x - c[1])))
            }
            "genz-oscillatory" => Box::new(move |x| Float::cos(c[1] + c[0] * x)),
            "genz-product-peak" => Box::new(move |x| one / (one / square(c[0]) + square(x - c[1]))),
            "genz-corner-peak" => Box::new(move |x| one / square(one + c[0] * x)),
            "genz-gaussian" => Box::new(move |x| Float::exp(-square(c[0] * (x - c[1])))),
            "genz-continuous" => Box::new(move |x| Float::exp(-c[0] * Float::abs(x - c[1]))),
            "genz-discontinuous" => Box::new(move |x| if x > c[1] { zero } else { Float::exp(c[0] * x) }),
            "gaussian-on-slope" => {
                let quarter = T::HALF * T::HALF;
                Box::new(move |x| Float::exp(-square((x - c[1]) / c[0])) + quarter * x)
            }
            "runge-scaled" => Box::new(move |x| one / (one + square(x / c[0]))),
            "gaussian" => Box::new(move |x| c[2] * Float::exp(-T::HALF * square((x - c[1]) / c[0]))),
            "peak-laplace" => Box::new(move |x| c[2] * Float::exp(-Float::abs(x - c[1]) / c[0])),
            "peak-lognormal" => {
                Box::new(move |x| c[2] * Float::exp(-T::HALF * square(Float::ln(x / c[1]) / c[0])))
            }
            "cosine-squared" => Box::new(move |x| square(Float::cos(c[0] * x))),
            "cubic" => Box::new(move |x| ((c[0] * x + c[1]) * x + c[2]) * x + c[3]),
            "kink" => Box::new(move |x| Float::exp(Float::abs(x - c[0]))),
            "jump" => Box::new(move |x| if x < c[0] { c[1] } else { c[2] }),
            "exponential-jump" => Box::new(move |x| Float::exp(if x < c[0] { x } else { c[1] * x })),
            "bump-jump" => Box::new(move |w| {
                Float::exp(-one / (one - if Float::abs(w) < c[0] { square(w) } else { zero }))
            }),
            "ramp" => Box::new(move |x| Float::min(x, c[0])),
            "cut-root" => Box::new(move |x| if x < c[0] { x / Float::sqrt(c[0] - x + c[1]) } else { zero }),
            "identity" => Box::new(|x| x),
            "end-power" => Box::new(move |x| Float::powf(x - c[1], c[0])),
            "gsl-11" => Box::new(move |x| Float::powf(-Float::ln(x), c[0] - one)),
            "gsl-454" => Box::new(move |x| {
                let square = square(x);
                square * x * Float::ln(Float::abs((square - one) * (square - two)))
            }),
            "boost-logarithms" => Box::new(move |x| Float::ln(x) * Float::ln_1p(-x)),
            "occupied" => Box::new(move |x| Float::exp(-T::HALF * x * x) / (one + Float::exp(x - c[0]))),
            "room-t" => Box::new(|t| entropy(elementary::exp(-T::HALF * t * t))),
            "room-rho" => {
                let sensor = GaussianSensor::new(c[0], c[1]).expect("a sensor");
                Box::new(move |rho| information(sensor.occupancy(rho)))
            }
            other => panic!("no family {other}"),
        }
    }
}

fn square<T: Float>(x: T) -> T {
    x * x
}
