//! `seam references`: outputs of other codes.

mod inputs;
mod lane;
mod list;
mod race;
mod regenerate;
mod scratch;
mod tools;
mod verify;

use crate::args::References;
use anyhow::Result;
use seam_reports::exit::Exit;

/// Lists, verifies or makes references.
pub fn references(words: &References) -> Result<Exit> {
    match words {
        References::List => list::list(),
        References::Verify(folder) => verify::verify(folder),
        References::Regenerate(words) => regenerate::regenerate(words),
        References::Race(words) => race::race(words),
        References::Lane(words) => lane::lane(words),
    }
}
