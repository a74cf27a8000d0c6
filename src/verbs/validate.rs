//! `seam` and `seam validate`: run, judge, report.

use super::check::{judge_into, print, style};
use super::report;
use crate::args::Validate;
use crate::{results, running};
use anyhow::Result;
use seam_cases::write::RESULT;
use seam_reports::exit::Exit;
use seam_reports::terminal;

/// Runs a tier of the catalogue, judges it, writes the report and prints the table.
pub fn validate(words: &Validate) -> Result<Exit> {
    let files = running::scenes(&[], &[], words.running.tier)?;
    running::run(&files, &words.out, &words.running)?;
    // Only what has just run: other results may lie in the folder.
    let read =
        |file: &seam_cases::file::SceneFile| results::read(&words.out.join(&file.scene.id).join(RESULT));
    let cases = files.iter().map(read).collect::<Result<Vec<_>>>()?;
    let judged = judge_into(&cases, &words.out)?;
    report::write(&judged, &cases, &words.out)?;
    print(&terminal::table(&judged, style()))?;
    if !words.running.quiet {
        eprintln!("report: {}", words.out.join("report.html").display());
    }
    Ok(judged.exit(words.strict))
}
