//! `seam study stability`: how far hard cases and scenes are from breaking.

use super::finish;
use crate::args::{Stability, Studied};
use crate::progress::Progress;
use anyhow::Result;
use seam_cases::catalogue;
use seam_cases::study::Kept;
use seam_cases::study::stability::StabilityStudy;
use seam_cases::write::STUDIES;
use seam_reports::exit::Exit;

/// Word by which the catalogue marks its hard cases.
const HARD: &str = "hard";

/// Studies the cases that are named, or all hard ones.
pub fn stability(words: &Stability) -> Result<Exit> {
    let Stability { cases, overrides, out, running } = words;
    let cases = if cases.is_empty() { hard()? } else { cases.clone() };
    let studied = Studied { cases, overrides: overrides.clone(), out: out.clone(), running: *running };
    let files = super::scenes(&studied)?;
    let progress = Progress::new(files.len(), running.quiet);
    let mut found = Vec::new();
    for file in &files {
        let parts = out.join(STUDIES).join("stability").join(&file.scene.id);
        let study = StabilityStudy::new(file, running.tier.into());
        found.push(study.run(&progress, &Kept::new(parts, running.resume))?);
    }
    progress.finish();
    finish(&studied, "stability", &found)
}

fn hard() -> Result<Vec<String>> {
    let all = catalogue::list()?.into_iter();
    Ok(all.filter(|entry| entry.tags.iter().any(|tag| tag == HARD)).map(|entry| entry.id).collect())
}
