//! `seam list`: what can be run.

use super::check::print;
use crate::args::List;
use anyhow::Result;
use seam_cases::catalogue;
use seam_reports::exit::Exit;

/// Prints the catalogue.
pub fn list(words: &List) -> Result<Exit> {
    let entries = catalogue::list()?;
    if words.json {
        print(&format!("{}\n", serde_json::to_string_pretty(&entries)?))?;
        return Ok(Exit::Pass);
    }
    let width = entries.iter().map(|e| e.id.chars().count()).max().unwrap_or(0);
    for entry in entries {
        print(&format!("{:<width$}  {}\n", entry.id, entry.title))?;
    }
    Ok(Exit::Pass)
}
