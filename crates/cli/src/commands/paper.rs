//! `meaninfo paper`: everything in the report, computed again.

use super::Status;
use crate::failure::Failure;
use crate::output::{Files, PAGE, Writing};
use crate::paper::Paper;
use clap::Args;
use std::path::PathBuf;

/// The arguments of `meaninfo paper`.
#[derive(Args, Debug)]
pub struct Arguments {
    /// Write the figures, as SVG, and a page with all of it, index.html, to this folder; it is made if there is none.
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    #[command(flatten)]
    writing: Writing,
}

impl Arguments {
    pub(super) fn run(&self) -> Result<Status, Failure> {
        let mut files = Files::new();
        if let Some(folder) = &self.out {
            files.make_folder(folder)?;
        }
        let page = self.out.as_ref().map(|folder| folder.join(PAGE));
        self.writing.check(&files, page.as_deref())?;
        let paper = Paper::reproduce()?;
        if let (Some(folder), Some(page)) = (&self.out, &page) {
            for figure in &paper.figures {
                files.add(&folder.join(figure.file), figure.picture.file().into_bytes());
            }
            files.add(page, paper.page().into_bytes());
        }
        self.writing.write(&paper, files)?;
        Ok(if paper.holds() { Status::Done } else { Status::CheckFailed })
    }
}
