//! From the folders of a run to judged results.

use crate::provenance;
use anyhow::Result;
use seam_cases::result::CaseResult;
use seam_reports::judge::judge;
use seam_reports::race::Race;
use seam_reports::record::Recorded;
use seam_reports::results::Results;
use std::collections::BTreeMap;
use std::path::Path;

/// There is nothing that could be judged.
#[derive(Debug)]
pub struct Unmeasured(pub String);

impl std::fmt::Display for Unmeasured {
    fn fmt(&self, f: &mut std::fmt::Formatter) -> std::fmt::Result {
        f.write_str(&self.0)
    }
}

impl std::error::Error for Unmeasured {}

/// Results of all cases below a folder, by id.
pub fn load(from: &Path) -> Result<Vec<CaseResult>> {
    let unreadable = |e: std::io::Error| Unmeasured(format!("{}: {e}; {}", from.display(), run_first(from)));
    let entries = std::fs::read_dir(from).map_err(unreadable)?;
    let mut folders: Vec<_> =
        entries.collect::<std::io::Result<Vec<_>>>()?.into_iter().map(|e| e.path()).collect();
    folders.sort();
    let hidden = |p: &Path| p.file_name().is_some_and(|n| n.to_string_lossy().starts_with('.'));
    let mut cases = Vec::new();
    for folder in folders.iter().filter(|p| !hidden(p)) {
        let file = folder.join(seam_cases::write::RESULT);
        if file.is_file() {
            cases.push(read(&file)?);
        }
    }
    if cases.is_empty() {
        return Err(Unmeasured(format!("{}: no results; {}", from.display(), run_first(from))).into());
    }
    Ok(cases)
}

fn run_first(folder: &Path) -> String {
    format!("run cases first: seam run --out {}", folder.display())
}

/// One `result.json`.
pub fn read(file: &Path) -> Result<CaseResult> {
    let unreadable =
        |e: &dyn std::error::Error| Unmeasured(format!("{}: {e}; run the case again", file.display()));
    let text = std::fs::read_to_string(file).map_err(|e| unreadable(&e))?;
    Ok(serde_json::from_str(&text).map_err(|e| unreadable(&e))?)
}

/// The race in a folder of results; the recorded one where there is none. `None` if none is recorded.
///
/// # Errors
/// A race that was altered.
pub fn race(folder: &Path) -> Result<Option<Race>> {
    if let Some(own) = seam_references::in_folder(folder, "race", "race")? {
        return Ok(Some(Race::of(&own.open()?, false)?));
    }
    let recorded = seam_references::all().into_iter().find(|r| r.id() == "race/race");
    Ok(recorded.map(|r| Race::of(&r.open()?, true)).transpose()?)
}

/// Judges cases, beside references of these hashes, and compares the verdicts with the recorded ones.
pub fn judged(cases: &[CaseResult], references: BTreeMap<String, String>) -> Result<Results> {
    Ok(judge(cases, provenance::here(references), &Recorded::project()?))
}
