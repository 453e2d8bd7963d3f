//! `meaninfo`: the mean information of occupancy maps, from the command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    mean_information_cli::run(std::env::args_os()).into()
}
