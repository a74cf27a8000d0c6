//! `seam` and `seam validate`: run, judge, report.

use super::check::{judge_into, print, style};
use super::report;
use crate::args::Validate;
use crate::results::Unmeasured;
use crate::running::Failed;
use crate::{message, references, results, running};
use anyhow::Result;
use seam_cases::checkpoint::Checkpoints;
use seam_cases::file::SceneFile;
use seam_cases::write::RESULT;
use seam_reports::exit::Exit;
use seam_reports::terminal;

/// Runs a tier of the catalogue, judges it, writes the report and prints the table.
pub fn validate(words: &Validate) -> Result<Exit> {
    let references = references::verified(&words.references)?;
    let files = running::scenes(&[], &[], words.running.tier)?;
    let failed = running::run(&files, &words.out, &words.running, &|_| Checkpoints::default())?;
    // Only what has just run: other results may lie in the folder.
    let has_run = |file: &&SceneFile| failed.iter().all(|f| f.id != file.scene.id);
    let read = |file: &SceneFile| results::read(&words.out.join(&file.scene.id).join(RESULT));
    let cases = files.iter().filter(has_run).map(read).collect::<Result<Vec<_>>>()?;
    let judged = judge_into(&cases, references, &words.out)?;
    report::write(&judged, &cases, &words.out)?;
    print(&terminal::table(&judged, style()))?;
    if !words.running.quiet {
        eprintln!("report: {}", words.out.join("report.html").display());
    }
    not_run(&failed)?;
    Ok(judged.exit(words.strict))
}

/// A case of the catalogue that did not run is one that was not measured, whatever the others gave.
fn not_run(failed: &[Failed]) -> Result<(), Unmeasured> {
    if failed.is_empty() {
        return Ok(());
    }
    let reasons: Vec<String> = failed.iter().map(|f| message::of(&f.error)).collect();
    Err(Unmeasured(reasons.join("\nseam: ")))
}
