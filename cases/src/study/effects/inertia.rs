//! Whether inertia is simulated, and whether it may be left out; whether two rates can follow it.

use super::super::evaluate::{Course, Solved};
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::model;
use crate::observe::guard::Seen;
use crate::result::{EffectUse, Indicator};
use crate::scene::dynamics::Stepping;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::modes;
use seam_solver::dynamics::semidiscrete::Semidiscrete;
use seam_solver::work::Work;
use std::f64::consts::PI;

const NAME: &str = "inertia";

/// Sway about the equilibria beyond this share of the largest deflection shows: slower loads, or inertia.
const LARGE_SWAY: f64 = 0.05;

/// Two rates tie velocities, and displacements drift apart by what the coarse steps cannot follow. The deflection of a beam misses
/// several times the gap: it turns what lies beyond the tie. On `ramp-transfer` it misses 0.3 % at just this limit, no more than with one
/// rate below half of it, and 1 % or more from 1.7 times of it on.
const LARGE_GAP: f64 = 1e-3;

/// What to do then.
const MEND: &str = "the coarse steps cannot follow the waves, the result is not trusted; re-equilibrate what is switched, or take \
                    shorter steps";

/// Inertia, on or off.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    if let Some(simulated) = simulated(file, solved) {
        return simulated;
    }
    let Some(dynamics) = file.scene.dynamics.as_ref().filter(|_| solved.course.is_some()) else {
        return off(NAME, "statics: loads are applied slowly");
    };
    let end = dynamics.end_s.value(&file.values, "").ok();
    let sway = end.zip(model::time::factor(file, dynamics).ok()).zip(period(file));
    match sway.map(|((end, factor), period)| (sway_of(&factor, end, period), period)) {
        Some((value, period)) => {
            let about = format!(
                "the sway that inertia would add to the largest deflection, the first period being {period:.2e} s,"
            );
            watched(NAME, Indicator { about, value, limit: LARGE_SWAY })
        }
        None => {
            off(NAME, "the scene asks for equilibria; there is no first period to compare the loads with")
        }
    }
}

/// Inertia where it is on, and whether its steps can be trusted.
pub fn simulated(file: &SceneFile, solved: &Solved) -> Option<EffectUse> {
    let (dynamics, course) = (file.scene.dynamics.as_ref()?, solved.course.as_ref()?);
    if dynamics.stepping == Stepping::QuasiStatic {
        return None;
    }
    let why = match kinetic_share(course) {
        Some(share) => {
            format!("the scene asks for it; the kinetic energy gets to {share:.1e} of the strain energy")
        }
        None => "the scene asks for it".to_owned(),
    };
    let simulated = on(NAME, why, solved.solution.work.steps);
    Some(match drift(dynamics.stepping, &solved.guard.seen).filter(Indicator::is_past) {
        Some(indicator) => EffectUse {
            called_for: true,
            why: format!("{}, but {} is {:.1e}: {MEND}", simulated.why, indicator.about, indicator.value),
            indicator: Some(indicator),
            ..simulated
        },
        None => simulated,
    })
}

/// How far the ties of a run at two rates have opened; `None` where displacements themselves are tied, and at rest.
fn drift(stepping: Stepping, seen: &Seen) -> Option<Indicator> {
    let about = "the widest gap of the ties over the largest displacement beside the mean".to_owned();
    let opens = stepping == Stepping::TwoRates && seen.displacement != 0.0;
    opens.then(|| Indicator { about, value: seen.gap / seen.displacement, limit: LARGE_GAP })
}

/// Largest kinetic over largest strain energy; `None` if nothing was ever strained.
fn kinetic_share(course: &Course) -> Option<f64> {
    let largest = |of: fn(&seam_solver::simulation::Energies) -> f64| {
        course.energies.iter().map(|(_, e)| of(e)).fold(0.0, f64::max)
    };
    let (kinetic, strain) = (largest(|e| e.kinetic), largest(|e| e.strain));
    (strain > 0.0).then_some(kinetic / strain)
}

/// First period of the model as it starts, in s; `None` for mechanisms and the like.
pub fn period(file: &SceneFile) -> Option<f64> {
    let model = model::build(file).ok()?.model;
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).ok()?;
    let mode = modes::lowest(&model, &system, 1, &mut work).ok()?;
    mode.first().map(|mode| 2.0 * PI / mode.omega)
}

/// Bound on the sway of one mode of period T about its equilibria, over the largest load factor: every jump `Δf` of the
/// factor leaves an oscillation of that amplitude, every kink one of `|Δḟ| T/2π` (Duhamel's integral).
fn sway_of(factor: &LoadFactor, end: f64, period: f64) -> f64 {
    let points = match factor {
        LoadFactor::Sudden => vec![(0.0, 1.0)],
        LoadFactor::Ramp { start_s, rise_s } => vec![(*start_s, 0.0), (start_s + rise_s, 1.0)],
        LoadFactor::Table(points) => points.clone(),
    };
    let mut slopes = vec![0.0];
    slopes.extend(points.windows(2).map(|w| (w[1].1 - w[0].1) / (w[1].0 - w[0].0)));
    slopes.push(0.0);
    let kinks = slopes.windows(2).zip(&points).filter(|(_, point)| point.0 < end);
    let kinks: f64 = kinks.map(|(s, _)| (s[1] - s[0]).abs()).sum();
    let reached = points.iter().filter(|p| p.0 <= end).map(|p| p.1.abs());
    let largest = reached.fold(factor.at(end).abs(), f64::max);
    if largest > 0.0 { (factor.at(0.0).abs() + kinks * period / (2.0 * PI)) / largest } else { 0.0 }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp of n periods sways by |sin nπ|/nπ after its end (Biggs 1964): the bound is its envelope 1/nπ.
    #[test]
    fn a_ramp_sways_within_its_envelope() {
        let ramp = LoadFactor::Ramp { start_s: 0.0, rise_s: 3.5 };
        assert!((sway_of(&ramp, 9.0, 1.0) - 1.0 / (3.5 * PI)).abs() < 1e-15);
        let table = LoadFactor::Table(vec![(0.0, 0.0), (3.5, 1.0)]);
        assert_eq!(sway_of(&ramp, 9.0, 1.0), sway_of(&table, 9.0, 1.0));
        assert_eq!(sway_of(&LoadFactor::Sudden, 9.0, 1.0), 1.0);
        // The run ends where the ramp ends: its upper kink never sways.
        assert!((sway_of(&ramp, 3.5, 1.0) - 0.5 / (3.5 * PI)).abs() < 1e-15);
    }
}
