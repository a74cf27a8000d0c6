//! `seam show`: a case as its page and its scene file.

use super::check::print;
use crate::args::Show;
use anyhow::Result;
use seam_cases::catalogue;
use seam_reports::exit::Exit;

/// Prints the page of a case, then its scene file.
pub fn show(words: &Show) -> Result<Exit> {
    let page = catalogue::page(&words.id)?;
    let file = catalogue::case(&words.id, &[])?;
    print(&format!("{}\n\n--- {}\n\n{}", page.trim_end(), file.name(), file.text()))?;
    Ok(Exit::Pass)
}
