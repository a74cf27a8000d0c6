//! Which effects a scene simulates, and why the others are left out.

use super::evaluate::Solved;
use super::inertia;
use crate::file::SceneFile;
use crate::result::EffectUse;
use crate::scene::dynamics::{Rotations, Stepping};
use seam_solver::coupling::assemble;
use seam_solver::model::Part;

/// Rotations beyond this (rad) are no longer small: `1 − cos θ` is half a percent.
const LARGE_ROTATION: f64 = 0.1;

/// All effects, on or off.
pub fn used(file: &SceneFile, solved: &Solved) -> Vec<EffectUse> {
    vec![
        inertia::effect(file, solved),
        finite_rotation(file, solved),
        rotation_coupling(file, solved),
        bond_failure(file, solved),
        contact(file, solved),
        friction(file, solved),
        damping(file, solved),
        substitution(file, solved),
    ]
}

/// One effect.
pub fn named(name: &str, on: bool, why: &str, counter: u64) -> EffectUse {
    EffectUse { name: name.to_owned(), on, why: why.to_owned(), counter }
}

fn bond_failure(file: &SceneFile, solved: &Solved) -> EffectUse {
    if file.scene.failure.is_empty() {
        return named("bond-failure", false, "the scene gives no strength", 0);
    }
    if let Some(course) = &solved.course {
        let why = format!("the scene gives a strength: bonds lost stiffness {} times", course.losses);
        return named("bond-failure", true, &why, course.losses as u64);
    }
    let events = solved.cracked.as_ref().map_or(&[][..], |cracked| &cracked.outcome.events);
    let broken = events.iter().flat_map(|e| &e.integrity).filter(|g| **g == 0.0).count();
    let why = format!("the scene gives a strength: {} failures broke {broken} bonds", events.len());
    named("bond-failure", true, &why, events.len() as u64)
}

/// Events know no contact; whether broken pairs have closed says if the scene would have called for it.
fn contact(file: &SceneFile, solved: &Solved) -> EffectUse {
    if file.scene.contact.is_some() {
        let why = "the scene asks for it, for particles that have lost a bond";
        return named("contact", true, why, solved.solution.work.contact_checks);
    }
    let why = match &solved.cracked {
        None if file.scene.failure.is_empty() => "bonded particles do not meet in small motion".to_owned(),
        None => "the scene gives no contact law: broken pairs pass through each other".to_owned(),
        Some(_) => match closed_pairs(solved) {
            0 => "no broken pair has closed".to_owned(),
            n => format!("{n} broken pairs have closed, so the scene calls for it: not trusted"),
        },
    };
    named("contact", false, &why, 0)
}

/// Every touching pair slides or sticks: it is counted with the contacts.
fn friction(file: &SceneFile, solved: &Solved) -> EffectUse {
    let Some(contact) = &file.scene.contact else {
        return named("friction", false, "there is no contact", 0);
    };
    match contact.friction.value(&file.values, "contact.friction") {
        Ok(mu) if mu > 0.0 => named(
            "friction",
            true,
            "the contacts have a coefficient of friction",
            solved.solution.work.contact_checks,
        ),
        _ => named("friction", false, "the contacts have no friction", 0),
    }
}

/// Broken pairs that are closer than they were.
fn closed_pairs(solved: &Solved) -> usize {
    let (model, solution) = (&solved.built.model, &solved.solution);
    let mut closed = 0;
    for (part, body) in model.parts.iter().enumerate() {
        let Part::Discrete { network, .. } = body else { continue };
        for (&[i, j], weight) in network.bonds.ends.iter().zip(&network.bonds.weight) {
            if *weight == 0.0 {
                let apart = network.particles.position[j] - network.particles.position[i];
                let moved = solution.displacement(model, part, j) - solution.displacement(model, part, i);
                closed += usize::from(moved.dot(&apart) < 0.0);
            }
        }
    }
    closed
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
    let moved = solved.course.is_some() || solved.cracked.is_some();
    let tied = match moved {
        false => solved.solution.multipliers.iter().filter(|(row, _)| row.label.contains('θ')).count(),
        // The model has run with these ties, so they can be made.
        true => assemble::rows(&solved.built.model, &solved.solution.numbering)
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

fn substitution(file: &SceneFile, solved: &Solved) -> EffectUse {
    if let Some(last) = solved.cracked.as_ref().and_then(|cracked| cracked.grown.last()) {
        let count = solved.cracked.as_ref().map_or(0, |cracked| cracked.grown.len());
        let why = format!(
            "the scene asks for it: {} elements became {} particles in {count} steps ahead of the crack",
            last.elements, last.particles
        );
        return named("substitution", true, &why, count as u64);
    }
    let reports = solved.course.as_ref().map_or(&[][..], |course| &course.switches.reports);
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
