//! How cost grows with size: counted work, and wall time where it is asked for.

use super::evaluate::{self, Solved, Tally};
use super::{Study, at_level};
use crate::error::Result;
use crate::file::SceneFile;
use crate::result::Growth;
use crate::scene::study::{GrowthDeclaration, GrowthOf};
use seam_solver::model::Part;
use seam_solver::stage::{STAGES, Seconds, Stage, measured};

/// Timed runs of each level; the shortest counts, since anything that disturbs only lengthens it.
const RUNS: usize = 5;

/// All of the scene in this tier.
pub fn all(study: &Study) -> Result<Vec<Growth>> {
    let now = study.file.scene.growth.iter().filter(|(_, declared)| declared.tiers.contains(&study.tier));
    now.map(|(name, declared)| one(study, name, declared)).collect()
}

fn one(study: &Study, name: &str, declared: &GrowthDeclaration) -> Result<Growth> {
    let mut growth = Growth {
        id: name.to_owned(),
        label: declared.label.clone(),
        size_label: size_label(declared.of).to_owned(),
        accepted_work: Some(declared.work),
        accepted_seconds: declared.seconds,
        why: declared.why.clone(),
        ..Growth::default()
    };
    for value in &declared.levels.values {
        let mut changes = study.variants(&declared.variants);
        changes.push(at_level(&declared.levels, value));
        let file = study.file.with(&changes)?;
        let (solved, mut shortest) = timed(&file, study.tally, declared.of)?;
        growth.size.push(size(&solved, declared.of));
        growth.work.push(work(&solved, declared.of));
        if declared.seconds.is_some() {
            for _ in 1..RUNS {
                shortest = shortest.min(timed(&file, &Tally::default(), declared.of)?.1);
            }
            growth.seconds.push(shortest);
        }
    }
    Ok(growth)
}

fn timed(file: &SceneFile, tally: &Tally, of: GrowthOf) -> Result<(Solved, f64)> {
    let (solved, stages): (Result<Solved>, Seconds) = measured(|| evaluate::solve(file, tally));
    let solved = solved?;
    let in_stage =
        |wanted: Stage| STAGES.iter().position(|(stage, _)| *stage == wanted).map_or(f64::NAN, |i| stages[i]);
    let seconds = match of {
        GrowthOf::BondUpdatesPerStep => in_stage(Stage::Steps) / steps(&solved),
        GrowthOf::FactorEntries => in_stage(Stage::Factorisation),
    };
    Ok((solved, seconds))
}

fn size_label(of: GrowthOf) -> &'static str {
    match of {
        GrowthOf::BondUpdatesPerStep => "bonds",
        GrowthOf::FactorEntries => "unknowns",
    }
}

fn size(solved: &Solved, of: GrowthOf) -> f64 {
    match of {
        GrowthOf::BondUpdatesPerStep => bonds(solved) as f64,
        GrowthOf::FactorEntries => solved.solution.numbering.len() as f64,
    }
}

fn work(solved: &Solved, of: GrowthOf) -> f64 {
    let work = &solved.solution.work;
    match of {
        GrowthOf::BondUpdatesPerStep => work.bond_updates as f64 / steps(solved),
        GrowthOf::FactorEntries => work.factor_nonzeros as f64,
    }
}

fn steps(solved: &Solved) -> f64 {
    solved.solution.work.steps.max(1) as f64
}

fn bonds(solved: &Solved) -> usize {
    let of = |part: &Part| match part {
        Part::Discrete { network, .. } => network.bonds.len(),
        Part::Continuum(_) => 0,
    };
    solved.built.model.parts.iter().map(of).sum()
}
