//! `seam study cost`: error against counted work and seconds.

use super::{finish, progress, scenes};
use crate::args::{Alone, Cost};
use crate::memory;
use anyhow::Result;
use seam_cases::file::SceneFile;
use seam_cases::study::cost::{CostStudy, Surroundings};
use seam_cases::study::{Kept, once};
use seam_cases::write::STUDIES;
use seam_reports::exit::Exit;
use std::process::Command;

/// Measures settings at levels, one after the other: timings next to each other would disturb each other.
pub fn cost(words: &Cost) -> Result<Exit> {
    let mut found = Vec::new();
    let studied = &words.studied;
    for file in scenes(studied)? {
        let study = CostStudy::plan(&file, studied.running.tier.into())?;
        let progress = progress(studied, study.len());
        let points = studied.out.join(STUDIES).join("cost").join(&file.scene.id);
        let kept = Kept::new(points, studied.running.resume);
        found.push(study.run(&Surroundings {
            onlooker: &progress,
            kept: &kept,
            longest_s: words.longest,
            memory_mb: &memory_mb,
        })?);
        progress.finish();
    }
    finish(studied, "cost", &found)
}

/// Largest memory of a process that runs a scene alone, so that its memory is its own.
fn memory_mb(file: &SceneFile) -> Option<f64> {
    let mut command = Command::new(std::env::current_exe().ok()?);
    let what = if file.on_disk() { file.name() } else { &file.scene.id };
    command.args(["study", "alone", what]);
    file.overrides().iter().for_each(|change| {
        command.arg("--set").arg(change);
    });
    let output = command.output().ok()?;
    String::from_utf8(output.stdout).ok()?.trim().parse().ok()
}

/// One run of a scene, and what memory it took.
pub fn alone(words: &Alone) -> Result<Exit> {
    for file in
        crate::running::scenes(std::slice::from_ref(&words.case), &words.overrides, crate::args::Tier::Full)?
    {
        once(&file)?;
    }
    println!("{:?}", memory::largest_mb());
    Ok(Exit::Pass)
}
