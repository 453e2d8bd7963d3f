//! `meaninfo completions`: what a shell needs to complete the command's words.

use super::Status;
use crate::failure::Failure;
use crate::output::{Files, write_text};
use clap::{Args, CommandFactory};
use clap_complete::Shell;
use std::path::PathBuf;

/// The arguments of `meaninfo completions`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// The shell.
    #[arg(value_enum)]
    shell: Shell,
    /// Write the script to this file instead of standard output, such as
    /// ~/.local/share/bash-completion/completions/meaninfo, ~/.config/fish/completions/meaninfo.fish, or _meaninfo in a folder
    /// of zsh's fpath.
    #[arg(long, value_name = "FILE")]
    output: Option<PathBuf>,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let mut script = Vec::new();
        let mut command = super::Arguments::command();
        let name = command.get_name().to_owned();
        clap_complete::generate(self.shell, &mut command, name, &mut script);
        write_text(&String::from_utf8_lossy(&script), self.output.as_deref(), Files::new())?;
        Ok(Status::Done)
    }
}
