//! Whether motion is damped, and what the damping that was left out would have taken.

use super::super::evaluate::Solved;
use super::inertia::period;
use super::{off, on, watched};
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};
use crate::scene::dynamics::{Damping, Dynamics, Stepping};
use crate::scene::number::Number;
use std::f64::consts::PI;

/// Damping that takes more than this share of the amplitude of the first mode shows.
const LARGE_LOSS: f64 = 0.05;

const NAME: &str = "damping";

/// Damping, on or off.
pub fn effect(file: &SceneFile, solved: &Solved) -> EffectUse {
    let Some(dynamics) = &file.scene.dynamics else { return off(NAME, "statics") };
    if dynamics.damping.as_ref().is_some_and(|given| strength(file, given) > 0.0) {
        let taken = solved.course.as_ref().and_then(|c| c.energies.last()).map_or(0.0, |(_, e)| e.damping);
        let why = format!("the scene asks for it; its work is {taken:.2e} J");
        return on(NAME, why, solved.solution.work.steps);
    }
    if dynamics.stepping == Stepping::QuasiStatic {
        return off(NAME, "there is no velocity in equilibrium");
    }
    match file.scene.left_out.damping.as_ref().and_then(|given| loss(file, dynamics, given)) {
        Some(value) => {
            let about =
                "the share of the first mode that the scene's damping would take by the end".to_owned();
            watched(NAME, Indicator { about, value, limit: LARGE_LOSS })
        }
        None => off(NAME, "the scene asks for none"),
    }
}

fn number(file: &SceneFile, number: &Option<Number>) -> f64 {
    number.as_ref().and_then(|n| n.value(&file.values, "").ok()).unwrap_or(0.0)
}

fn strength(file: &SceneFile, given: &Damping) -> f64 {
    number(file, &given.rate_per_s) + number(file, &given.ratio) + number(file, &given.share)
}

/// `1 − exp(−ζωT)`: a mass-proportional rate α has ζω = α/2; a share of the unbalanced force is about ζ = share/π (Itasca, FLAC
/// manual, local damping).
fn loss(file: &SceneFile, dynamics: &Dynamics, given: &Damping) -> Option<f64> {
    let end = dynamics.end_s.value(&file.values, "").ok()?;
    let rate = number(file, &given.rate_per_s) / 2.0;
    let by_ratio = match &given.period_s {
        Some(_) => number(file, &given.ratio) * 2.0 * PI / number(file, &given.period_s),
        None => 0.0,
    };
    let by_share = match number(file, &given.share) {
        0.0 => 0.0,
        share => share / PI * 2.0 * PI / period(file)?,
    };
    Some(1.0 - (-(rate + by_ratio + by_share) * end).exp())
}
