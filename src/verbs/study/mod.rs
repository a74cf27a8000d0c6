//! `seam study`: what lies beyond one run of a case. Each study is one file here and one subcommand.
//!
//! A study leaves `studies/<kind>/<id>.json` in the folder of results, where `seam check` and `seam report` find it.

mod cost;
mod effects;
mod stability;

use super::check::{print, style};
use crate::args::{Studied, Study};
use crate::progress::Progress;
use crate::{results, running};
use anyhow::Result;
use seam_cases::file::SceneFile;
use seam_cases::result::CaseResult;
use seam_cases::write;
use seam_reports::exit::Exit;
use seam_reports::record::Recorded;
use seam_reports::terminal;
use std::collections::BTreeMap;

/// Runs a study.
pub fn study(words: &Study) -> Result<Exit> {
    match words {
        Study::Cost(words) => cost::cost(words),
        Study::Effects(words) => effects::effects(words),
        Study::Stability(words) => stability::stability(words),
        Study::Alone(words) => cost::alone(words),
    }
}

/// The scenes that are studied.
fn scenes(words: &Studied) -> Result<Vec<SceneFile>> {
    running::scenes(&words.cases, &words.overrides, words.running.tier)
}

/// Shows how far a study of so many settings has come.
fn progress(words: &Studied, settings: usize) -> Progress {
    Progress::new(settings, words.running.quiet)
}

/// Writes what a study of each scene found, prints it judged, and gives the exit code.
fn finish(words: &Studied, kind: &str, found: &[CaseResult]) -> Result<Exit> {
    for result in found {
        let path = write::write_study(&words.out, kind, result)?;
        if !words.running.quiet {
            eprintln!("{}", path.display());
        }
    }
    let judged = results::judged(found, BTreeMap::new(), &Recorded::project()?);
    print(&terminal::table(&judged, style()))?;
    Ok(judged.exit(false))
}
