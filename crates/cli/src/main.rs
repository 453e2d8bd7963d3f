//! `meaninfo`: the mean information of occupancy maps, from the command line.

use mean_information_cli::Failure;
use mean_information_cli::commands::Arguments;
use std::io::{self, Write};
use std::process::ExitCode;

fn main() -> ExitCode {
    let done = match Arguments::of_command_line() {
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
            // Where stderr cannot be written, the exit status still says it; `eprintln` would panic.
            let _ = writeln!(io::stderr(), "meaninfo: {failure}");
            ExitCode::from(2)
        }
    }
}
