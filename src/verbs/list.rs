//! `seam list`: what can be run.

use super::check::print;
use crate::args::List;
use crate::select;
use anyhow::Result;
use seam_reports::exit::Exit;

/// Prints the catalogue, or the part of it that is asked for.
pub fn list(words: &List) -> Result<Exit> {
    let entries = select::entries(&words.cases, &words.filter, words.tier)?;
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
