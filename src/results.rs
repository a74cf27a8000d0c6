//! From the folders of a run to judged results.

use crate::provenance;
use anyhow::{Context, Result};
use seam_cases::result::CaseResult;
use seam_reports::judge::judge;
use seam_reports::record::Recorded;
use seam_reports::results::Results;
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
    let entries = std::fs::read_dir(from)
        .map_err(|e| Unmeasured(format!("{}: {e}; run cases first: seam run --out {0}", from.display())))?;
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
        return Err(Unmeasured(format!(
            "{}: no results; run cases first: seam run --out {0}",
            from.display()
        ))
        .into());
    }
    Ok(cases)
}

/// One `result.json`.
pub fn read(file: &Path) -> Result<CaseResult> {
    let text = std::fs::read_to_string(file).with_context(|| file.display().to_string())?;
    let unreadable = |e| Unmeasured(format!("{}: {e}; run the case again", file.display()));
    Ok(serde_json::from_str(&text).map_err(unreadable)?)
}

/// Judges cases against their references and the recorded verdicts. Every reference must be whole: one that
/// is altered makes the rest suspect too.
pub fn judged(cases: &[CaseResult]) -> Result<Results> {
    let mut provenance = provenance::here();
    for reference in seam_references::all() {
        let data = reference.open().map_err(|problem| Unmeasured(format!("reference {problem}")))?;
        provenance.references.insert(reference.id(), data.provenance.csv_sha256.as_str().to_owned());
    }
    Ok(judge(cases, provenance, &Recorded::project()?))
}
