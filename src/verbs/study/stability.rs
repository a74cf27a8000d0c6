//! `seam study stability`: how far hard cases and scenes are from breaking.

use super::finish;
use crate::args::{Stability, Studied};
use crate::progress::Progress;
use crate::running::pool;
use anyhow::Result;
use rayon::prelude::*;
use seam_cases::catalogue;
use seam_cases::file::SceneFile;
use seam_cases::result::CaseResult;
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
    let one = |file: &SceneFile| {
        let parts = out.join(STUDIES).join("stability").join(&file.scene.id);
        let study = StabilityStudy::new(file, running.tier.into());
        study.run(&progress, &Kept::new(parts, running.resume))
    };
    // Nothing is timed here, so that cases may share the machine.
    let found: Result<Vec<CaseResult>, _> =
        pool(running)?.install(|| files.par_iter().with_max_len(1).map(one).collect());
    progress.finish();
    finish(&studied, "stability", &found?)
}

fn hard() -> Result<Vec<String>> {
    let all = catalogue::list()?.into_iter();
    Ok(all.filter(|entry| entry.tags.iter().any(|tag| tag == HARD)).map(|entry| entry.id).collect())
}
