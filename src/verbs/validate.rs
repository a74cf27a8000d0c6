//! `seam` and `seam validate`: run, judge, report.

use super::check::{judge_into, print, style};
use super::report;
use super::run::plan;
use crate::args::{Choice, Validate};
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
    let recorded = results::recorded(&words.records)?;
    let how = (&words.choice, &words.running, words.out.as_path());
    let files = running::selected(&[], &[], how, &recorded)?;
    if words.choice.dry_run {
        print(&plan(&files))?;
        return Ok(Exit::Pass);
    }
    let failed = running::run(&files, &words.out, &words.running, &|_| Checkpoints::default())?;
    // Only what this run is about: other results may lie in the folder. With `--failed` those that are green
    // already belong to it too.
    let all = Choice { failed: false, ..words.choice.clone() };
    let files = running::selected(&[], &[], (&all, &words.running, &words.out), &recorded)?;
    let has_run = |file: &&SceneFile| failed.iter().all(|f| f.id != file.scene.id);
    let read = |file: &SceneFile| results::read(&words.out.join(&file.scene.id).join(RESULT));
    let cases = files.iter().filter(has_run).map(read).collect::<Result<Vec<_>>>()?;
    let judged = judge_into(&cases, references, &recorded, &words.out)?;
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
