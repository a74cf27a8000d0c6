//! `seam completions`: what a shell completes after `seam`.

use crate::args::{Command, Completions};
use anyhow::Result;
use clap::CommandFactory;
use seam_reports::exit::Exit;

/// Prints the script that a shell sources.
pub fn completions(words: &Completions) -> Result<Exit> {
    let mut script = Vec::new();
    clap_complete::generate(words.shell, &mut Command::command(), "seam", &mut script);
    super::check::print(&String::from_utf8(script)?)?;
    Ok(Exit::Pass)
}
