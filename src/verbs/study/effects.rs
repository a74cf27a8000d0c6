//! `seam study effects`: which effects a scene calls for.

use super::{finish, progress, scenes};
use crate::args::Studied;
use anyhow::Result;
use seam_cases::study::Kept;
use seam_cases::study::effects::EffectStudy;
use seam_cases::write::STUDIES;
use seam_reports::exit::Exit;

/// Runs each scene as it is, then with each effect on and off.
pub fn effects(words: &Studied) -> Result<Exit> {
    let mut found = Vec::new();
    for file in scenes(words)? {
        let study = EffectStudy::new(&file, words.running.tier.into());
        let progress = progress(words, study.parts());
        let parts = words.out.join(STUDIES).join("effects").join(&file.scene.id);
        found.push(study.run(&progress, &Kept::new(parts, words.running.resume))?);
        progress.finish();
    }
    finish(words, "effects", &found)
}
