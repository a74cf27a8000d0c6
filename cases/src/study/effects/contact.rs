//! Whether particles touch that have lost a bond, and slide.

use super::super::evaluate::Solved;
use super::{off, on};
use crate::file::SceneFile;
use crate::result::EffectUse;
use seam_solver::model::Part;

/// Contact, on or off; its counter is the number of pairs that were looked at.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    const NAME: &str = "contact";
    if file.scene.contact.is_some() {
        let why = "the scene asks for it, for particles that have lost a bond";
        return on(NAME, why, solved.solution.work.contact_checks);
    }
    if file.scene.failure.is_empty() {
        return off(NAME, "bonded particles do not meet in small motion");
    }
    match closed_pairs(solved) {
        (0, _) => off(NAME, "no broken pair has closed"),
        (n, by) => off(NAME, format!("{n} broken pairs have closed, by up to {by:.1e} of their distance")),
    }
}

/// Friction, on or off; it is looked at with every contact.
pub fn friction(file: &SceneFile, solved: &Solved) -> EffectUse {
    const NAME: &str = "friction";
    let Some(contact) = &file.scene.contact else { return off(NAME, "there is no contact") };
    match contact.friction.value(&file.values, "contact.friction") {
        Ok(mu) if mu > 0.0 => {
            let why = "the contacts have a coefficient of friction";
            on(NAME, why, solved.solution.work.contact_checks)
        }
        _ => off(NAME, "the contacts have no friction"),
    }
}

/// Broken pairs that are closer than they were, and the largest share of their distance by which they are.
fn closed_pairs(solved: &Solved) -> (usize, f64) {
    let (model, solution) = (&solved.built.model, &solved.solution);
    let (mut closed, mut most) = (0, 0.0f64);
    for (part, body) in model.parts.iter().enumerate() {
        let Part::Discrete { network, .. } = body else { continue };
        let broken = network.bonds.ends.iter().zip(&network.bonds.weight).filter(|(_, w)| **w == 0.0);
        for (&[i, j], _) in broken {
            let apart = network.particles.position[j] - network.particles.position[i];
            let moved = solution.displacement(model, part, j) - solution.displacement(model, part, i);
            let by = -moved.dot(&apart) / apart.norm_squared();
            closed += usize::from(by > 0.0);
            most = most.max(by);
        }
    }
    (closed, most)
}
