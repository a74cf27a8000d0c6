//! `seam study effects`: which effects a scene calls for.

use super::{finish, progress, scenes};
use crate::args::Studied;
use anyhow::Result;
use seam_cases::study::Onlooker;
use seam_cases::study::effects;
use seam_reports::exit::Exit;

/// Runs scenes and says which effects were simulated, which were left out, and why.
pub fn effects(words: &Studied) -> Result<Exit> {
    let mut found = Vec::new();
    for file in scenes(words)? {
        let progress = progress(words, 1);
        Onlooker::begin(&progress, &file.scene.id);
        found.push(effects::study(&file, words.running.tier.into())?);
        Onlooker::done(&progress, &file.scene.id, "done");
        progress.finish();
    }
    finish(words, "effects", &found)
}
