//! `seam references verify`: nothing altered, nothing missing, nothing out of date.

use super::super::check::print;
use super::inputs;
use crate::args::ReferencesFolder;
use crate::references;
use anyhow::Result;
use seam_reports::exit::Exit;

/// Checks every reference; the first that is not whole is an error.
pub fn verify(words: &ReferencesFolder) -> Result<Exit> {
    references::verified(words)?;
    let exports = inputs::all()?;
    let all = match &words.references {
        Some(folder) => seam_references::from_folder(folder)?,
        None => seam_references::all(),
    };
    let mut current = 0;
    for reference in &all {
        if let Some(export) = exports.get(&reference.id()) {
            reference.open()?.made_from(&export.hashes())?;
            current += 1;
        }
    }
    print(&format!(
        "{} references are whole; {current} of them were made from networks that Seam exports, and still does\n",
        all.len()
    ))?;
    Ok(Exit::Pass)
}
