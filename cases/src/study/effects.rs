//! Which effects a scene simulates, and why the others are left out.

use super::evaluate::{self, Course, Solved, Tally};
use super::{head, inertia};
use crate::error::Result;
use crate::file::SceneFile;
use crate::result::{CaseResult, EffectUse};
use crate::scene::Tier;
use crate::scene::dynamics::{Rotations, Stepping};
use seam_solver::coupling::assemble;
use seam_solver::model::Part;

/// Rotations beyond this (rad) are no longer small: `1 − cos θ` is half a percent.
const LARGE_ROTATION: f64 = 0.1;

/// Runs a scene and says which effects it simulated.
///
/// # Errors
/// As running it.
pub fn study(file: &SceneFile, tier: Tier) -> Result<CaseResult> {
    let solved = evaluate::solve(file, &Tally::default())?;
    Ok(CaseResult { effects: used(file, &solved), ..head(file, tier) })
}

/// All effects, on or off.
pub fn used(file: &SceneFile, solved: &Solved) -> Vec<EffectUse> {
    vec![
        inertia::effect(file, solved),
        finite_rotation(file, solved),
        rotation_coupling(file, solved),
        named("bond-failure", false, "the scene gives no strength", 0),
        named("contact", false, "bonded particles do not meet in small motion", 0),
        named("friction", false, "there is no contact", 0),
        damping(file, solved),
        substitution(file, solved.course.as_ref()),
    ]
}

/// One effect.
pub fn named(name: &str, on: bool, why: &str, counter: u64) -> EffectUse {
    EffectUse { name: name.to_owned(), on, why: why.to_owned(), counter }
}

fn finite_rotation(file: &SceneFile, solved: &Solved) -> EffectUse {
    let largest = largest_rotation(solved);
    let finite = file.scene.dynamics.as_ref().is_some_and(|d| d.rotations == Rotations::Finite);
    if finite {
        let why = format!("the scene asks for it; the largest rotation is {largest:.1e} rad");
        return named("finite-rotation", true, &why, solved.solution.work.bond_updates);
    }
    let why = if largest > LARGE_ROTATION {
        format!("the largest rotation is {largest:.2} rad, so the scene calls for it: not trusted")
    } else {
        format!("the largest rotation is {largest:.1e} rad, below {LARGE_ROTATION}")
    };
    named("finite-rotation", false, &why, 0)
}

fn rotation_coupling(file: &SceneFile, solved: &Solved) -> EffectUse {
    let scene = &file.scene;
    let on = scene.ties.values().any(|tie| tie.rotations)
        || scene.switches.values().any(|switch| switch.ties.rotations);
    let why = if on { "a tie asks for it" } else { "no tie asks for it" };
    if !on {
        return named("rotation-coupling", false, why, 0);
    }
    let tied = match &solved.course {
        None => solved.solution.multipliers.iter().filter(|(row, _)| row.label.contains('θ')).count(),
        // The model has run with these ties, so they can be made.
        Some(_) => assemble::rows(&solved.built.model, &solved.solution.numbering)
            .map_or(0, |rows| rows.iter().filter(|row| row.label.contains('θ')).count()),
    };
    named("rotation-coupling", true, why, tied as u64)
}

fn damping(file: &SceneFile, solved: &Solved) -> EffectUse {
    let Some(dynamics) = &file.scene.dynamics else {
        return named("damping", false, "statics", 0);
    };
    let value = |number: &Option<crate::scene::number::Number>| {
        number.as_ref().and_then(|n| n.value(&file.values, "").ok()).unwrap_or(0.0)
    };
    let given = dynamics.damping.as_ref();
    let on = given.is_some_and(|d| value(&d.rate_per_s) + value(&d.ratio) + value(&d.share) > 0.0);
    if !on {
        let why = match dynamics.stepping {
            Stepping::QuasiStatic => "there is no velocity in equilibrium",
            _ => "the scene asks for none",
        };
        return named("damping", false, why, 0);
    }
    let taken = solved.course.as_ref().and_then(|c| c.energies.last()).map_or(0.0, |(_, e)| e.damping);
    let why = format!("the scene asks for it; its work is {taken:.2e} J");
    named("damping", true, &why, solved.solution.work.steps)
}

fn substitution(file: &SceneFile, course: Option<&Course>) -> EffectUse {
    let reports = course.map_or(&[][..], |course| &course.switches.reports);
    let why = match (file.scene.switches.is_empty(), reports) {
        (true, _) => return named("substitution", false, "bodies keep their method", 0),
        (false, []) => {
            return named("substitution", false, "no element met the criterion", 0);
        }
        (false, [(_, first), ..]) => {
            let elements: usize = reports.iter().map(|(_, r)| r.elements).sum();
            let particles: usize = reports.iter().map(|(_, r)| r.particles).sum();
            let at = first.time;
            format!(
                "the scene asks for it: {elements} elements became {particles} particles, first at {at:.3e} s"
            )
        }
    };
    named("substitution", true, &why, reports.len() as u64)
}

fn largest_rotation(solved: &Solved) -> f64 {
    let model = &solved.built.model;
    let discrete = model.parts.iter().enumerate().filter(|(_, p)| matches!(p, Part::Discrete { .. }));
    let particles = discrete.flat_map(|(part, p)| (0..p.positions().len()).map(move |i| (part, i)));
    particles.map(|(part, i)| solved.solution.rotation(model, part, i).norm()).fold(0.0, f64::max)
}
