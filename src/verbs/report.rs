//! `seam report`: the report page of a run.

use super::check::judge_into;
use crate::args::Report;
use crate::{references, results};
use anyhow::Result;
use seam_cases::result::CaseResult;
use seam_reports::exit::Exit;
use seam_reports::results::{Results, write_whole};
use seam_reports::{csv, html, validation};
use std::path::Path;

/// Writes the report from results that are there.
pub fn report(words: &Report) -> Result<Exit> {
    let references = references::verified(&words.references)?;
    let cases = results::load(&words.from)?;
    let judged = judge_into(&cases, references, &results::recorded(&words.records)?, &words.from)?;
    write(&judged, &cases, &words.from)?;
    if let Some(file) = &words.markdown {
        write_whole(file, &validation::document(&judged, &cases))?;
    }
    eprintln!("{}", words.from.join("report.html").display());
    Ok(Exit::Pass)
}

/// The page and the tables behind it.
pub fn write(judged: &Results, cases: &[CaseResult], folder: &Path) -> Result<()> {
    html::write_report(judged, cases, folder)?;
    csv::write(judged, cases, folder)?;
    Ok(())
}
