//! `meaninfo limit`: what the mean information of one scan of a circular room tends to as cells shrink.

use super::Status;
use crate::failure::Failure;
use crate::limits::{CONVERGED, Computed};
use crate::metres::positive;
use crate::output::{Files, Number, Record, Report, Value, Writing, table};
use clap::{Args, ValueEnum};
use mean_information::limit::{self, RadialModel, RepeatedScans};
use mean_information::quadrature::adaptive::GaussKronrod;
use mean_information::quadrature::rigorous::Rigorous;
use mean_information::sensor::GaussianSensor;
use mean_information::{Error, Real};
use std::num::NonZeroU32;
use std::str::FromStr;

/// The arguments of `meaninfo limit`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The range that the sensor reads, in metres.
    #[arg(long, value_name = "Z")]
    range: String,
    /// The standard deviation of the sensor, in metres.
    #[arg(long, value_name = "S")]
    sigma: String,
    /// The kind of grids that the limit belongs to.
    #[arg(long, value_enum, default_value_t)]
    weight: Weight,
    /// The way it is computed.
    #[arg(long, value_enum, default_value_t)]
    method: Method,
    /// The type of floats it is computed in; range and sigma are rounded to it.
    #[arg(long, value_enum, default_value_t)]
    float: Float,
    /// The number of consistent scans that are fused; more than one needs the method adaptive or rigorous.
    #[arg(long, value_name = "N", default_value = "1")]
    scans: NonZeroU32,
    /// The wanted error relative to the deficit, 1 less the limit, for the methods adaptive and rigorous.
    #[arg(long, value_name = "T")]
    tolerance: Option<String>,
    /// About how often these methods may evaluate the integrand, 100000 times if absent; rigorous: along each piece of the beam.
    #[arg(long, value_name = "N")]
    evaluations: Option<u64>,
    #[command(flatten)]
    writing: Writing,
}

/// The kind of grids that the limit belongs to.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Weight {
    /// Polar maps, cells of equal width and angle: the report's Eq. 7.
    #[default]
    Radial,
    /// Cartesian grids, cells of equal area.
    Area,
}

/// The way a limit is computed.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Method {
    /// From certified polynomials, with a proved error.
    #[default]
    ClosedForm,
    /// By Gauss-Kronrod quadrature, with an estimated error.
    Adaptive,
    /// By interval arithmetic: an enclosure.
    Rigorous,
}

/// A format of floats.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, ValueEnum)]
enum Float {
    F32,
    #[default]
    F64,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let files = Files::new();
        self.writing.check(&files, [])?;
        let limit = match self.float {
            Float::F32 => self.limit::<f32>(),
            Float::F64 => self.limit::<f64>(),
        }?;
        self.writing.write(&limit, files)?;
        Ok(if limit.status == CONVERGED { Status::Done } else { Status::CheckFailed })
    }

    fn limit<T: Real + FromStr>(&self) -> Result<Limit, Failure> {
        // In clap's words, as where it parses: here the format is chosen by another option.
        let given = |option: &str, text: &str| {
            let refused = |what| Failure::Usage(format!("invalid value '{text}' for '--{option}': {what}"));
            positive::<T>(text).map_err(refused)
        };
        let refused = |error: Error| Failure::Usage(error.to_string());
        let (range, sigma) = (given("range <Z>", &self.range)?, given("sigma <S>", &self.sigma)?);
        let tolerance = self.tolerance.as_ref().map(|text| given("tolerance <T>", text)).transpose()?;
        let sensor = GaussianSensor::new(range, sigma).map_err(refused)?;
        let result = match self.method {
            Method::ClosedForm => {
                self.check_for_closed_form()?;
                Computed::closed_form(limit::closed_form(&sensor, self.weight.into()))
            }
            _ if self.scans == NonZeroU32::MIN => self.integral(&sensor, tolerance).map_err(refused)?,
            _ => {
                let scans = RepeatedScans::new(sensor, self.scans.get()).map_err(refused)?;
                self.integral(&scans, tolerance).map_err(refused)?
            }
        };
        Ok(Limit {
            range: Number::new(range),
            sigma: Number::new(sigma),
            weight: self.weight,
            method: self.method,
            format: T::FORMAT,
            scans: self.scans.get(),
            value: Number::new(result.value),
            ends: [result.lower, result.upper].map(Number::new),
            status: result.status,
            evaluations: result.evaluations,
        })
    }

    /// Refuses what only integrals know.
    fn check_for_closed_form(&self) -> Result<(), Failure> {
        let refused = if self.scans != NonZeroU32::MIN {
            "--scans: there is no closed form for several scans; add --method adaptive or rigorous"
        } else if self.tolerance.is_some() {
            "--tolerance: the closed form has an error of its own"
        } else if self.evaluations.is_some() {
            "--evaluations: the closed form evaluates no integrand"
        } else {
            return Ok(());
        };
        Err(Failure::Usage(refused.to_owned()))
    }

    fn integral<M: RadialModel>(
        &self,
        model: &M,
        tolerance: Option<M::Float>,
    ) -> Result<Computed<M::Float>, Error> {
        let weight = self.weight.into();
        let evaluations = self.evaluations.unwrap_or(100_000);
        if self.method == Method::Rigorous {
            let rules = Rigorous::new().limit(evaluations);
            let rules = tolerance.map_or(rules, |relative| rules.relative(relative));
            return limit::rigorous(model, weight, &rules).map(Computed::from);
        }
        let rules = GaussKronrod::new().limit(evaluations);
        let rules = tolerance.map_or(rules, |relative| rules.relative(relative));
        limit::adaptive(model, weight, &rules).map(Computed::from)
    }
}

impl From<Weight> for limit::Weight {
    fn from(weight: Weight) -> Self {
        match weight {
            Weight::Radial => Self::Radial,
            Weight::Area => Self::Area,
        }
    }
}

/// A limit, and all that it belongs to.
struct Limit {
    range: Number,
    sigma: Number,
    weight: Weight,
    method: Method,
    format: &'static str,
    scans: u32,
    value: Number,
    ends: [Number; 2],
    status: &'static str,
    evaluations: u64,
}

impl Limit {
    fn weight(&self) -> &'static str {
        match self.weight {
            Weight::Radial => "radial",
            Weight::Area => "area",
        }
    }

    fn method(&self) -> &'static str {
        match self.method {
            Method::ClosedForm => "closed-form",
            Method::Adaptive => "adaptive",
            Method::Rigorous => "rigorous",
        }
    }

    /// Returns whether the true value is proved, or only estimated, to lie between the ends.
    fn kind(&self) -> &'static str {
        if self.method == Method::Adaptive { "estimated" } else { "rigorous" }
    }
}

impl Report for Limit {
    fn table(&self) -> String {
        let rows = [
            ["limit of the mean information (bits / cell)".to_owned(), self.value.to_string()],
            [format!("lower end ({})", self.kind()), self.ends[0].to_string()],
            [format!("upper end ({})", self.kind()), self.ends[1].to_string()],
            [
                "cells".to_owned(),
                match self.weight {
                    Weight::Radial => "polar (weight radial)".to_owned(),
                    Weight::Area => "of equal area, Cartesian (weight area)".to_owned(),
                },
            ],
            ["method".to_owned(), format!("{} in {}: {}", self.method(), self.format, self.status)],
            ["evaluations".to_owned(), self.evaluations.to_string()],
        ];
        let title = match self.scans {
            1 => format!("range {} m, sigma {} m", self.range, self.sigma),
            n => format!("range {} m, sigma {} m, {n} scans", self.range, self.sigma),
        };
        table([&*title, ""], rows)
    }

    fn rows(&self) -> Vec<Record> {
        let given = |number: Number| Value::Given(Some(number.widen()));
        let computed = |number| Value::Computed(Some(number));
        vec![Record(vec![
            ("range_m", given(self.range)),
            ("sigma_m", given(self.sigma)),
            ("weight", Value::Text(self.weight().to_owned())),
            ("method", Value::Text(self.method().to_owned())),
            ("float", Value::Text(self.format.to_owned())),
            ("scans", Value::Count(self.scans.into())),
            ("value", computed(self.value)),
            ("lower", computed(self.ends[0])),
            ("upper", computed(self.ends[1])),
            ("kind", Value::Text(self.kind().to_owned())),
            ("status", Value::Text(self.status.to_owned())),
            ("evaluations", Value::Count(self.evaluations)),
        ])]
    }

    /// Returns one object.
    fn json(&self) -> Value {
        self.rows().pop().map_or(Value::Texts(Vec::new()), Value::Record)
    }
}
