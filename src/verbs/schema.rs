//! `seam schema`: JSON schemas, for editors that complete keys and programs that read results.

use crate::args::{Schema, Text};
use anyhow::Result;
use seam_reports::exit::Exit;

/// Prints the schema.
pub fn schema(words: &Schema) -> Result<Exit> {
    super::check::print(&match words.of {
        Text::Scene => seam_cases::scene::schema(),
        Text::Results => seam_reports::schema::results_schema(),
    })?;
    Ok(Exit::Pass)
}
