//! From the folders of a run to judged results.

use crate::args::Records;
use crate::provenance;
use anyhow::Result;
use seam_cases::result::CaseResult;
use seam_reports::judge::judge;
use seam_reports::race::Race;
use seam_reports::record::Recorded;
use seam_reports::results::Results;
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

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
    for study in studies(from)? {
        take_in(&mut cases, study);
    }
    if cases.is_empty() {
        return Err(Unmeasured(format!("{}: no results; {}", from.display(), run_first(from))).into());
    }
    Ok(cases)
}

/// What studies found, by kind and case.
fn studies(from: &Path) -> Result<Vec<CaseResult>> {
    let mut found = Vec::new();
    for kind in sorted(&from.join(seam_cases::write::STUDIES))? {
        let files = sorted(&kind)?;
        for file in files.iter().filter(|file| file.extension().is_some_and(|e| e == "json")) {
            found.push(read(file)?);
        }
    }
    Ok(found)
}

/// What a folder holds, by name; nothing if it is not there.
fn sorted(folder: &Path) -> Result<Vec<PathBuf>> {
    if !folder.is_dir() {
        return Ok(Vec::new());
    }
    let entries = std::fs::read_dir(folder)?.collect::<std::io::Result<Vec<_>>>()?;
    let mut paths: Vec<PathBuf> = entries.into_iter().map(|entry| entry.path()).collect();
    paths.sort();
    Ok(paths)
}

/// A study belongs to the run of its case; without one it stands for itself.
fn take_in(cases: &mut Vec<CaseResult>, study: CaseResult) {
    match cases.iter_mut().find(|case| case.id == study.id) {
        Some(case) if case.scene_hash == study.scene_hash => case.absorb(study),
        Some(case) => case.notes.push(format!(
            "a study of another version of this scene is not shown: {}; run it again",
            study.command
        )),
        None => cases.push(study),
    }
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

/// Judges cases, beside references of these hashes, and compares the verdicts with recorded ones.
pub fn judged(cases: &[CaseResult], references: BTreeMap<String, String>, recorded: &Recorded) -> Results {
    judge(cases, provenance::here(references), recorded)
}

/// The built-in records, or those of a file.
pub fn recorded(words: &Records) -> Result<Recorded> {
    Ok(match &words.recorded {
        Some(file) => Recorded::load(file)?,
        None => Recorded::project()?,
    })
}
