//! `meaninfo`: the mean information of occupancy maps, from the command line.

use clap::Parser;
use mean_information_cli::Failure;
use mean_information_cli::arguments::Arguments;
use std::process::ExitCode;

fn main() -> ExitCode {
    let done = match Arguments::try_parse() {
        Ok(arguments) => arguments.command.run(),
        Err(error) if error.use_stderr() => Err(Failure::from(error)),
        // --help and --version; a reader who closes the pipe has seen enough.
        Err(help) => {
            let _ = help.print();
            return ExitCode::SUCCESS;
        }
    };
    match done {
        Ok(status) => status.into(),
        Err(failure) => {
            eprintln!("meaninfo: {failure}");
            ExitCode::from(2)
        }
    }
}
