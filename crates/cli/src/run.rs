//! The command as a function: for the program `meaninfo`, and for packages in other languages that have it within.

use crate::commands::{Arguments, help_of};
use crate::failure::Failure;
use std::ffi::OsString;
use std::io::{self, Write};

/// Runs the command with these arguments, the first of which is the name of the program. Returns the exit status, which
/// `meaninfo --help` explains.
///
/// ```
/// assert_eq!(mean_information_cli::run(["meaninfo", "limit", "--range", "2", "--sigma", "nonsense"]), 2);
/// ```
pub fn run<A: Into<OsString> + Clone>(arguments: impl IntoIterator<Item = A>) -> u8 {
    let arguments: Vec<OsString> = arguments.into_iter().map(Into::into).collect();
    let done = match Arguments::of(&arguments) {
        Ok(arguments) => arguments.command.run(),
        Err(error) if error.use_stderr() => Err(Failure::from(error)),
        // --help and --version; a reader who closes the pipe has seen enough.
        Err(help) => {
            let _ = help.print();
            return 0;
        }
    };
    match done {
        Ok(status) => status.number(),
        Err(failure) => {
            let advice = match failure {
                Failure::Usage(_) => format!("; try '{}'", help_of(&arguments)),
                _ => String::new(),
            };
            // Where stderr cannot be written, the exit status still says it; `eprintln` would panic.
            let _ = writeln!(io::stderr(), "meaninfo: {failure}{advice}");
            2
        }
    }
}
