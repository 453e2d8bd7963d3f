//! `meaninfo man`: manual pages, one of the command and one of each of its commands.

use super::{EXIT_STATUS, Status};
use crate::failure::Failure;
use crate::output::Files;
use clap::builder::Resettable;
use clap::{Args, CommandFactory};
use clap_mangen::Man;
use std::path::PathBuf;

/// The arguments of `meaninfo man`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Write the pages to this folder, such as ~/.local/share/man/man1; it is made if there is none.
    #[arg(long, value_name = "DIR")]
    out: PathBuf,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let mut files = Files::new();
        files.make_folder(&self.out)?;
        for (name, page) in pages()? {
            files.add(&self.out.join(name), page);
        }
        files.write()?;
        Ok(Status::Done)
    }
}

/// Returns each page with the name of its file.
fn pages() -> Result<Vec<(String, Vec<u8>)>, Failure> {
    // The statuses have a section of their own.
    let mut all = super::Arguments::command().disable_help_subcommand(true).after_help(Resettable::Reset);
    all.build();
    let each = std::iter::once(all.clone()).chain(all.get_subcommands().cloned());
    let page = |command| {
        let man =
            Man::new(command).source(concat!("meaninfo ", env!("CARGO_PKG_VERSION"))).manual("meaninfo");
        let mut page = Vec::new();
        man.render(&mut page).map_err(|error| Failure::StandardOutput(error.to_string()))?;
        // A hyphen of roff would be a typographic one.
        page.extend(format!(".SH \"EXIT STATUS\"\n{}\n", EXIT_STATUS.replace('-', "\\-")).into_bytes());
        Ok((man.get_filename(), page))
    };
    each.map(page).collect()
}
