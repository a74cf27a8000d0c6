//! `seam check`: the error table, `results.json`, `junit.xml`, `summary.md` and the exit code.

use crate::args::Check;
use crate::{references, results, select};
use anyhow::Result;
use seam_cases::result::CaseResult;
use seam_reports::exit::Exit;
use seam_reports::record::Recorded;
use seam_reports::results::Results;
use seam_reports::terminal::{self, Style};
use seam_reports::{baseline, junit, markdown};
use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::path::Path;

/// Judges the results of a run.
pub fn check(words: &Check) -> Result<Exit> {
    let references = references::verified(&words.references)?;
    // Read before anything is written: the baseline may be the file that is replaced.
    let baseline = words.baseline.as_deref().map(Results::read).transpose()?;
    let recorded = results::recorded(&words.records)?;
    let cases = select::results(results::load(&words.from)?, &words.cases, &words.filter, words.tier)?;
    let judged = judge_into(&cases, references, &recorded, &words.from)?;
    let changes = baseline.map(|baseline| baseline::compare(&baseline, &judged));
    let changed = changes.as_deref().map_or_else(String::new, |c| terminal::changes(c, style()));
    print(&(changed + &terminal::table(&judged, style())))?;
    Ok(judged.exit(words.strict).or(changes.map_or(Exit::Pass, |changes| baseline::exit(&changes))))
}

/// Judges cases, beside references of these hashes, and writes `results.json` and the views that a CI service reads.
pub fn judge_into(
    cases: &[CaseResult],
    references: BTreeMap<String, String>,
    recorded: &Recorded,
    folder: &Path,
) -> Result<Results> {
    let mut judged = results::judged(cases, references, recorded);
    judged.race = results::race(folder)?;
    judged.write(&folder.join("results.json"))?;
    junit::write(&judged, &folder.join("junit.xml"))?;
    markdown::write(&judged, &folder.join("summary.md"))?;
    Ok(judged)
}

/// Colours belong on a terminal whose user has not asked for none.
pub fn style() -> Style {
    let colours = std::io::stdout().is_terminal() && std::env::var_os("NO_COLOR").is_none();
    if colours { Style::Colour } else { Style::Plain }
}

/// Prints; a reader that has gone away, as in `seam check | head`, is no failure.
pub fn print(text: &str) -> Result<()> {
    match std::io::stdout().write_all(text.as_bytes()) {
        Err(e) if e.kind() == std::io::ErrorKind::BrokenPipe => Ok(()),
        written => Ok(written?),
    }
}
