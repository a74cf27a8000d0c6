//! What another code would have to do for the same answer: the very network in explicit steps, the very mesh solved once.
//!
//! Codes are raced in bond updates and in unknowns, so that is what is counted. An explicit code has no equilibria: it
//! must wait until the network has come to rest. Nothing rests sooner than a lowest mode that is damped critically,
//! whose distance from equilibrium falls as `(1 + ωt) e^−ωt`, so that is what it is given: the least it can take.

use super::super::evaluate::Solved;
use crate::file::SceneFile;
use crate::result::Elsewhere;
use crate::scene::dynamics::{Dynamics, Stepping};
use seam_solver::dynamics::critical;
use seam_solver::dynamics::modes::lowest;
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::model::{Model, Part};
use seam_solver::work::Work;

/// Distance from equilibrium at which a network counts as at rest: the finest accuracy that is asked of a diagram.
const REST: f64 = 1e-3;

/// Work of another code; `None` where the scene does what no other code is raced in (coupled bodies, cracks, motion of a mesh), or has
/// no mass to move.
pub fn elsewhere(file: &SceneFile, solved: &Solved) -> Option<Elsewhere> {
    let (scene, model) = (&file.scene, &solved.built.model);
    if scene.cracking.is_some() || !scene.failure.is_empty() {
        return None;
    }
    let discrete = |part: &Part| matches!(part, Part::Discrete { .. });
    if model.parts.iter().all(discrete) {
        let steps = match &scene.dynamics {
            Some(dynamics) if dynamics.stepping == Stepping::Explicit => solved.solution.work.steps as f64,
            Some(dynamics) if dynamics.stepping != Stepping::QuasiStatic => through(file, dynamics, model)?,
            _ => to_rest(model)?,
        };
        let updates = steps * bonds(model) as f64;
        return updates.is_finite().then(|| Elsewhere::BondUpdates(updates.ceil() as u64));
    }
    let still = scene.dynamics.is_none() && !model.parts.iter().any(discrete);
    still.then(|| Elsewhere::Unknowns(solved.solution.numbering.len() as u64))
}

fn bonds(model: &Model) -> usize {
    let of = |part: &Part| match part {
        Part::Discrete { network, .. } => network.bonds.len(),
        Part::Continuum(_) => 0,
    };
    model.parts.iter().map(of).sum()
}

/// Explicit steps through the motion of the scene, at the bound of stability.
fn through(file: &SceneFile, dynamics: &Dynamics, model: &Model) -> Option<f64> {
    let end = dynamics.end_s.value(&file.values, "dynamics.end_s").ok()?;
    Some((end / critical::bound(model).ok()?.step_s).ceil())
}

/// Explicit steps until the lowest mode, damped critically, is within [`REST`] of equilibrium.
fn to_rest(model: &Model) -> Option<f64> {
    let mut work = Work::default();
    let system = Semidiscrete::new(model, &mut work).ok()?;
    let omega = lowest(model, &system, 1, &mut work).ok()?.first()?.omega;
    Some((rest() / (omega * critical::bound(model).ok()?.step_s)).ceil())
}

/// `ωt` at which `(1 + ωt) e^−ωt` has fallen to [`REST`]: fixed point of `ωt = ln((1 + ωt)/REST)`.
fn rest() -> f64 {
    (0..50).fold(1.0, |x: f64, _| ((1.0 + x) / REST).ln())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::overrides::Override;
    use crate::study::cost::settings::generated;
    use crate::study::evaluate::{Tally, solve};

    /// The clamped beam of four rows in one of its settings.
    fn of(setting: &str) -> (Option<Elsewhere>, SceneFile, Solved) {
        let rows = Override::parse("parameters.rows=4").unwrap();
        let beam = catalogue::case("clamped-beam-rotation", &[rows]).unwrap();
        let setting = generated(&beam).into_iter().find(|s| s.name == setting).unwrap();
        let file = beam.with(&setting.changes).unwrap();
        let solved = solve(&file, &Tally::default()).unwrap();
        (elsewhere(&file, &solved), file, solved)
    }

    #[test]
    fn the_fixed_point_is_one() {
        let x = rest();
        assert!(((1.0 + x) * (-x).exp() / REST - 1.0).abs() < 1e-12, "{x}");
    }

    /// The first mode of the beam is Euler–Bernoulli's within a tenth: shear and the lattice take some.
    #[test]
    fn an_explicit_code_waits_for_the_lowest_mode() {
        let (found, file, solved) = of("all particles");
        let Some(Elsewhere::BondUpdates(updates)) = found else { panic!("{found:?}") };
        let material = file.scene.materials.values().next().unwrap();
        let [young, density] =
            [&material.young_pa, &material.density_kg_m3].map(|n| n.value(&file.values, "").unwrap());
        let (length, height) = (file.values["length_m"], file.values["height_m"]);
        let omega = (1.8751041 / length).powi(2) * height * (young / density / 12.0).sqrt();
        let steps = updates as f64 / bonds(&solved.built.model) as f64;
        let step = critical::bound(&solved.built.model).unwrap().step_s;
        let ratio = steps * step * omega / rest();
        assert!((ratio - 1.0).abs() < 0.1, "{ratio}");
    }

    #[test]
    fn a_mesh_is_solved_once_and_coupled_bodies_have_no_match() {
        let (found, _, solved) = of("all finite elements");
        assert_eq!(found, Some(Elsewhere::Unknowns(solved.solution.numbering.len() as u64)));
        assert_eq!(of("as given").0, None);
    }
}
