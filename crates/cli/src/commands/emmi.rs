//! `meaninfo emmi`: the mean information of the expected map of weighted maps.

use super::Status;
use super::filter::Filter;
use crate::failure::Failure;
use crate::metres::positive;
use crate::output::{Files, Number, Record, Report, Value, Writing, short, table, with_notes};
use crate::progress::Progress;
use clap::Args;
use mean_information::Real;
use mean_information::expected::{Hypotheses, weighted_mean};
use mean_information::map::Grid;
use mean_information_files::npy::MapsVisitor;
use mean_information_files::{
    ARRAY_NUMBERS, ArrayEncoding, MAX_CELLS, Options, Readable, file_of, read_particles, read_weights,
};
use mean_information_report::measures::Measures;
use std::path::{Path, PathBuf};

/// The arguments of `meaninfo emmi`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The particles' maps: an .npy array of three dimensions, particle, row and column.
    #[arg(long, value_name = "FILE.npy", required_unless_present = "log", requires = "weights")]
    particles: Option<PathBuf>,
    /// Their weights: an .npy list of floats or integers, not negative and not all 0; they need not add up to 1.
    #[arg(long, value_name = "FILE.npy", requires = "particles")]
    weights: Option<PathBuf>,
    #[arg(long, value_enum, requires = "particles", help = format!("What the numbers of the maps are; {ARRAY_NUMBERS}"))]
    encoding: Option<ArrayEncoding>,
    /// The number of maps of floats that means unknown, or nan.
    #[arg(long, value_name = "NUMBER|nan", requires = "particles")]
    unknown: Option<f64>,
    /// The side of a cell in metres; of a --filter's maps 0.05 if absent.
    #[arg(long, value_name = "METRES", value_parser = positive::<f64>)]
    resolution: Option<f64>,
    /// Refuse particles of more cells together than this before memory is taken for them, 268435456 if absent; of a --filter,
    /// maps of more cells than this, 67108864 if absent: two poses some hundred metres apart make a large one of any log.
    #[arg(long, value_name = "N")]
    max_cells: Option<u64>,
    #[command(flatten)]
    filter: Filter,
    #[command(flatten)]
    writing: Writing,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        match (&self.filter.log, &self.particles, &self.weights) {
            // The parser does not ask for what an argument needs where that is excluded.
            (Some(_), ..) if self.encoding.is_some() || self.unknown.is_some() => {
                let words = "--encoding and --unknown need --particles: the maps of --filter are made here";
                Err(Failure::Usage(words.to_owned()))
            }
            (Some(log), ..) => self.filter.run(log, self.resolution, self.max_cells, &self.writing),
            (None, Some(particles), Some(weights)) => {
                self.filter.refuse()?;
                self.run_once(particles, weights)
            }
            // The parser asks for them.
            _ => Err(Failure::Usage("give --particles and --weights, or --filter".to_owned())),
        }
    }

    /// Measures the expected map of maps as they are stored.
    fn run_once(&self, particles: &Path, weights_file: &Path) -> Result<Status, Failure> {
        let mut files = Files::new();
        files.read([particles, weights_file].map(|path| file_of(path).to_owned()));
        self.writing.check(&files, [])?;
        let max_cells = self.max_cells.unwrap_or(MAX_CELLS);
        let options = Options {
            encoding: self.encoding,
            unknown: self.unknown,
            resolution: self.resolution,
            max_cells: Some(max_cells),
            ..Options::default()
        };
        let weights = read_weights(weights_file, &options)?;
        let expected = read_particles(particles, &options, Expecting { weights: &weights, max_cells })?;
        let expected = expected.map_err(|error| refused(error, particles, weights_file))?;
        let name = particles.display().to_string();
        let report = Emmi { name, weights, resolution: self.resolution, expected };
        self.writing.write(&report, files)?;
        Ok(Status::Done)
    }
}

/// Creates the failure of weights that do not go with the particles, or are none.
fn refused(error: mean_information::Error, particles: &Path, weights: &Path) -> Failure {
    use mean_information::Error as Refused;
    let help = match error {
        Refused::WeightCount { given, items, .. } => {
            let particles = particles.display();
            let message = format!(
                "has {given} weights, but {particles} has {items} particles; allowed is one for each"
            );
            return Failure::file(weights, message);
        }
        Refused::Item { value, .. } if value < 0.0 => {
            "; if they are logarithms, np.exp(w - w.max()) makes weights of them"
        }
        Refused::Item { value, .. } if value.is_nan() => "; np.nan_to_num(w) makes 0 of NaN",
        _ => "",
    };
    let words = mean_information_files::Error::from(error);
    Failure::file(weights, format!("{}{help}", words.message()))
}

/// The measures of the expected map and of the particles.
struct Expected {
    /// The measures of the expected map.
    measures: Measures,
    /// The mean of the particles; `None` if nothing is observed in any of a weight above 0.
    mean_of_particles: Option<Number>,
    /// The number of other particles of weight above 0 in which nothing is observed.
    unobserved: usize,
    particles: Vec<Measures>,
}

/// Takes the expected map of particles with these weights.
struct Expecting<'a> {
    weights: &'a [f64],
    max_cells: u64,
}

impl MapsVisitor for Expecting<'_> {
    type Output = Result<Expected, mean_information::Error>;

    fn visit<E: Readable>(self, maps: Vec<Grid<E>>) -> Self::Output {
        let hypotheses = Hypotheses::new(&maps, self.weights)?.with_max_cells(self.max_cells);
        let progress = Progress::new(maps.len() + 1);
        progress.begin("expected map");
        // The particles of a file are all of one size.
        let size = maps.first().map_or([0; 2], |map| [map.width(), map.height()]);
        let measures = Measures::of_tally(size, &hypotheses.expected_tally()?);
        progress.done();
        let mut particles = Vec::with_capacity(maps.len());
        for (index, map) in maps.iter().enumerate() {
            progress.begin(&format!("particle {index}"));
            particles.push(Measures::of_grid(map));
            progress.done();
        }
        // Where others have some, a map in which nothing is observed has mean information 0. The numbers are of the maps'
        // own precision.
        let own = |m: &Measures| E::Float::nearest(m.mean_information.map_or(0.0, Number::widen));
        let values: Vec<E::Float> = particles.iter().map(own).collect();
        let mean = Number::new(weighted_mean(self.weights, &values)?);
        let counted = || particles.iter().zip(self.weights).filter(|&(_, &weight)| weight > 0.0);
        let unobserved = counted().filter(|(m, _)| m.mean_information.is_none()).count();
        let mean_of_particles = (unobserved < counted().count()).then_some(mean);
        Ok(Expected { measures, mean_of_particles, unobserved, particles })
    }
}

/// The result.
struct Emmi {
    name: String,
    weights: Vec<f64>,
    resolution: Option<f64>,
    expected: Expected,
}

impl Emmi {
    fn warnings(&self) -> Vec<String> {
        let Expected { measures, mean_of_particles, unobserved, .. } = &self.expected;
        let why = measures.warning();
        let zeros = (*unobserved > 0 && mean_of_particles.is_some()).then(|| {
            let particles = if *unobserved == 1 { "particle" } else { "particles" };
            format!("{unobserved} {particles} with nothing observed, 0 in the mean of particles")
        });
        why.into_iter().chain(zeros).collect()
    }

    fn observed_area(&self) -> Option<f64> {
        self.expected.measures.observed_area(self.resolution)
    }

    fn record(&self) -> Record {
        let Expected { measures, mean_of_particles, particles, .. } = &self.expected;
        Record(vec![
            ("emmi", Value::Computed(measures.mean_information)),
            ("observed", Value::Count(measures.observed())),
            ("information_bits", Value::Computed(Some(measures.information))),
            ("entropy_bits", Value::Computed(Some(measures.entropy))),
            ("mean_of_particles", Value::Computed(*mean_of_particles)),
            ("particles", Value::Numbers(particles.iter().map(|m| m.mean_information).collect())),
            ("observed_area_m2", Value::Computed(self.observed_area().map(Number::Double))),
            ("meaningful", Value::Flag(measures.not_meaningful.is_none())),
            ("warnings", Value::Texts(self.warnings())),
        ])
    }
}

impl Report for Emmi {
    fn table(&self) -> String {
        let header = [
            "map",
            "weight",
            "mean information\n(bits / cell)",
            "information\n(bits)",
            "entropy\n(bits)",
            "observed",
        ];
        let number = |x: Option<Number>| x.map_or("none".to_owned(), |x| x.to_string());
        let row = |name: String, weight: String, m: &Measures| {
            let [information, entropy] = [m.information, m.entropy].map(|x| format!("{:.3}", x.widen()));
            [name, weight, number(m.mean_information), information, entropy, m.observed().to_string()]
        };
        let area = self.observed_area().map(|area| format!("\n{} m²", short(area)));
        let mut expected = row("expected map".to_owned(), String::new(), &self.expected.measures);
        let why = self.expected.measures.not_meaningful;
        expected[2] += &why.map(|why| format!("\nnot meaningful:\n{}", why.reason())).unwrap_or_default();
        expected[5] += &area.unwrap_or_default();
        let mean = [
            "mean of particles".to_owned(),
            String::new(),
            number(self.expected.mean_of_particles),
            String::new(),
            String::new(),
            String::new(),
        ];
        let particles = self.expected.particles.iter().zip(&self.weights).enumerate();
        let particles =
            particles.map(|(index, (m, &weight))| row(format!("particle {index}"), short(weight), m));
        let warnings = self.warnings();
        let notes = warnings.iter().map(|note| (&*self.name, &**note));
        with_notes(table(header, [expected, mean].into_iter().chain(particles)), notes)
    }

    fn rows(&self) -> Vec<Record> {
        vec![self.record()]
    }

    fn json(&self) -> Value {
        Value::Record(self.record())
    }
}
