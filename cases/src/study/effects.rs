//! Which effects a static scene simulates, and why the others are left out.

use super::evaluate::Solved;
use crate::file::SceneFile;
use crate::result::EffectUse;

/// Rotations beyond this (rad) are no longer small: `1 − cos θ` is half a percent.
const LARGE_ROTATION: f64 = 0.1;

/// All effects, on or off.
pub fn used(file: &SceneFile, solved: &Solved) -> Vec<EffectUse> {
    let rotations = file.scene.ties.values().any(|tie| tie.rotations);
    let tied = solved.solution.multipliers.iter().filter(|(row, _)| row.label.contains('θ')).count();
    let largest = largest_rotation(solved);
    let finite = if largest > LARGE_ROTATION {
        format!("the largest rotation is {largest:.2} rad, so the scene calls for it: not trusted")
    } else {
        format!("the largest rotation is {largest:.1e} rad, below {LARGE_ROTATION}")
    };
    let coupling = if rotations { "a tie asks for it" } else { "no tie asks for it" };
    let named = |name: &str, on, why: &str, counter| EffectUse {
        name: name.to_owned(),
        on,
        why: why.to_owned(),
        counter,
    };
    vec![
        named("inertia", false, "statics: loads are applied slowly", 0),
        named("finite-rotation", false, &finite, 0),
        named("rotation-coupling", rotations, coupling, tied as u64),
        named("bond-failure", false, "the scene gives no strength", 0),
        named("contact", false, "bonded particles do not meet in small motion", 0),
        named("friction", false, "there is no contact", 0),
        named("damping", false, "statics", 0),
        named("substitution", false, "bodies keep their method", 0),
    ]
}

fn largest_rotation(solved: &Solved) -> f64 {
    let model = &solved.built.model;
    let particles =
        model.parts.iter().enumerate().flat_map(|(part, p)| (0..p.positions().len()).map(move |i| (part, i)));
    particles.map(|(part, i)| solved.solution.rotation(model, part, i).norm()).fold(0.0, f64::max)
}
