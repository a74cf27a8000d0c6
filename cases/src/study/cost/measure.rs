//! One point of a diagram: the error of a setting at a level, its counted work and its seconds.

use super::super::evaluate::{self, Solved, Tally};
use super::super::{Study, effects};
use super::elsewhere::elsewhere;
use super::target::Target;
use crate::error::Result;
use crate::file::SceneFile;
use crate::model::calibration;
use crate::overrides::Override;
use crate::result::{CostPoint, Elsewhere};
use seam_solver::stage::{STAGES, Seconds, measured};
use seam_solver::work::Work;
use std::collections::BTreeMap;

/// Runs shorter than this are repeated, in s.
const SHORT_S: f64 = 0.2;
/// How often, after one run to warm up.
const REPEATS: usize = 5;

/// Which runs are timed again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Repeats {
    /// Those shorter than [`SHORT_S`]: the diagrams of a run.
    IfShort,
    /// All that are shorter than this many seconds: a study by itself.
    Below(f64),
}

/// Runs a setting, once for each of some changes that make another packing of it, or once as it is.
///
/// # Errors
/// What the scene or the solver refuses; nothing to compare with.
pub fn measure(
    study: &Study,
    target: &Target,
    file: &SceneFile,
    packings: &[Vec<Override>],
    repeats: Repeats,
) -> Result<CostPoint> {
    let mut runs = Vec::new();
    if packings.is_empty() {
        runs.push(once(study, target, file)?);
    }
    for packing in packings {
        runs.push(once(study, target, &file.with(packing)?)?);
    }
    // Neither the best nor the worst packing: the one in the middle.
    runs.sort_by(|a, b| a.error.total_cmp(&b.error));
    let (least, most) = (runs[0].error, runs[runs.len() - 1].error);
    let middle = &runs[runs.len() / 2];
    let mut times: Vec<(f64, Seconds)> = runs.iter().map(|run| (run.seconds, run.stages)).collect();
    let again = match repeats {
        Repeats::IfShort => middle.seconds < SHORT_S,
        Repeats::Below(limit) => middle.seconds < limit,
    };
    if again {
        times.clear();
        for _ in 0..REPEATS {
            let (solved, stages) = timed(&middle.file, &Tally::default())?;
            times.push((solved.seconds, stages));
        }
    }
    times.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (seconds, stages) = times[times.len() / 2];
    Ok(CostPoint {
        level: String::new(),
        error: Some(middle.error),
        spread: (runs.len() > 1).then_some([least, most]),
        failed: None,
        particles: middle.particles,
        unknowns: middle.unknowns,
        work: middle.work,
        calibration_work: middle.calibration.total(),
        run_work: middle.run.total(),
        seconds,
        seconds_spread: [times[0].0, times[times.len() - 1].0],
        seconds_runs: times.len(),
        seconds_of_stages: named(&stages, seconds),
        memory_mb: None,
        elsewhere: middle.elsewhere,
    })
}

/// One run.
struct Once {
    file: SceneFile,
    error: f64,
    particles: usize,
    unknowns: usize,
    work: Work,
    run: Work,
    calibration: Work,
    seconds: f64,
    stages: Seconds,
    elsewhere: Option<Elsewhere>,
}

fn once(study: &Study, target: &Target, file: &SceneFile) -> Result<Once> {
    let (solved, stages) = timed(file, study.tally)?;
    if let Some(why) = effects::distrust(file, &solved) {
        return Err(study.error(why));
    }
    let mut work = solved.solution.work;
    work += solved.built.calibration;
    work += solved.built.packing;
    Ok(Once {
        file: file.clone(),
        particles: solved.built.particles(),
        unknowns: solved.solution.numbering.len(),
        work,
        run: solved.solution.work,
        calibration: solved.built.calibration,
        seconds: solved.seconds,
        stages,
        elsewhere: elsewhere(file, &solved),
        error: target.error(study, file, solved.readings)?,
    })
}

/// A run that pays for its own packing and calibration.
fn timed(file: &SceneFile, tally: &Tally) -> Result<(Solved, Seconds)> {
    calibration::forget();
    let (solved, stages) = measured(|| evaluate::solve(file, tally));
    Ok((solved?, stages))
}

/// Stages that took time, and what none of them claims.
fn named(stages: &Seconds, whole: f64) -> BTreeMap<String, f64> {
    let claimed: f64 = stages.iter().sum();
    let all = STAGES.iter().map(|(stage, name)| (*name, stages[*stage as usize]));
    let all = all.chain([("other", (whole - claimed).max(0.0))]);
    all.filter(|(_, seconds)| *seconds > 0.0).map(|(name, seconds)| (name.to_owned(), seconds)).collect()
}
