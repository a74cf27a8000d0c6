//! `seam check`: the error table, `results.json` and the exit code.

use crate::args::Check;
use crate::{references, results};
use anyhow::Result;
use seam_cases::result::CaseResult;
use seam_reports::exit::Exit;
use seam_reports::results::Results;
use seam_reports::terminal::{self, Style};
use std::collections::BTreeMap;
use std::io::{IsTerminal, Write};
use std::path::Path;

/// Judges the results of a run.
pub fn check(words: &Check) -> Result<Exit> {
    let references = references::verified(&words.references)?;
    let cases = results::load(&words.from)?;
    let judged = judge_into(&cases, references, &words.from)?;
    print(&terminal::table(&judged, style()))?;
    Ok(judged.exit(words.strict))
}

/// Judges cases, beside references of these hashes, and writes `results.json`.
pub fn judge_into(
    cases: &[CaseResult],
    references: BTreeMap<String, String>,
    folder: &Path,
) -> Result<Results> {
    let mut judged = results::judged(cases, references)?;
    judged.race = results::race(folder)?;
    judged.write(&folder.join("results.json"))?;
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
