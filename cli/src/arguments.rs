//! The arguments of `meaninfo`, and those that several commands share.

use crate::commands::Command;
use crate::failure::Failure;
use crate::maps::{self, ArrayEncoding, Map, Mode, Semantics};
use crate::output::Format;
use clap::{Args, Parser};
use std::path::{Path, PathBuf};

/// The mean information of occupancy maps (Blanco's measure): how certain a map is of the cells it has observed, in
/// bits per observed cell, from 0 to 1.
#[derive(Debug, Parser)]
#[command(name = "meaninfo", version, arg_required_else_help = false)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// How to read map files.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Reading")]
pub struct Reading {
    /// Whose rules turn the grey levels of a ROS map into percentages.
    #[arg(long, value_enum, default_value_t)]
    semantics: Semantics,
    /// How the grey levels of a ROS map are meant; the file's own mode if absent.
    #[arg(long, value_enum)]
    mode: Option<Mode>,
    /// With --mode probability, the grey level (of the image's own depth) that means unknown.
    #[arg(long, value_name = "GREY")]
    unknown: Option<u16>,
    /// What the numbers of an .npy array are; if absent, floats are probabilities and int8 are percentages.
    #[arg(long, value_enum)]
    encoding: Option<ArrayEncoding>,
    /// The side of a cell of an .npy array in metres.
    #[arg(long, value_name = "METRES", value_parser = positive)]
    resolution: Option<f64>,
    /// Refuse a map of more cells than this before memory is taken for it (2^30 unless given).
    #[arg(long, value_name = "N", default_value_t = maps::MAX_CELLS)]
    max_cells: u64,
}

impl Reading {
    /// Reads the map at `path`.
    ///
    /// # Errors
    /// A grey level for unknown outside probability mode, or what [`maps::read`] refuses.
    pub fn read(&self, path: &Path) -> Result<Map, Failure> {
        if self.unknown.is_some() && self.mode != Some(Mode::Probability) {
            return Err(Failure::Usage("--unknown needs --mode probability".to_owned()));
        }
        let options = maps::Options {
            semantics: self.semantics,
            mode: self.mode,
            unknown: self.unknown,
            encoding: self.encoding,
            resolution: self.resolution,
            max_cells: self.max_cells,
        };
        Ok(maps::read(path, &options)?)
    }
}

/// Where the result goes, and in what form.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "Output")]
pub struct Writing {
    /// A table to read, or JSON or CSV, where each result also stands as an exact hexadecimal float.
    #[arg(long, value_enum, default_value_t)]
    pub format: Format,
    /// Write the result to this file instead of standard output.
    #[arg(long, value_name = "FILE")]
    pub output: Option<PathBuf>,
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse() {
        Ok(x) if x > 0.0 && x < f64::INFINITY => Ok(x),
        _ => Err("allowed is a positive, finite number of metres".to_owned()),
    }
}
