//! Which effects a scene simulates, why the others are left out, and whether they may be.
//!
//! One file per effect; each gives its counter where the effect is on, and an indicator with a limit where it is off, or where it
//! is on and may still be simulated badly.

mod ablation;
mod bond_failure;
mod contact;
mod coupling;
mod damping;
mod inertia;
mod rotation;
mod substitution;

pub use ablation::EffectStudy;
pub(super) use ablation::declared;

use super::evaluate::Solved;
use crate::file::SceneFile;
use crate::result::{EffectUse, Indicator};

/// All effects, on or off, in the order of [`crate::scene::effects::NAMES`].
pub fn used(file: &SceneFile, solved: &Solved) -> Vec<EffectUse> {
    vec![
        inertia::effect(file, solved),
        rotation::effect(file, solved),
        coupling::effect(file, solved),
        bond_failure::effect(file, solved),
        contact::effect(file, solved),
        contact::friction(file, solved),
        damping::effect(file, solved),
        substitution::effect(file, solved),
    ]
}

/// Why a result is not trusted though its effects were simulated: particles came too late, or ties drifted open.
pub(super) fn distrust(file: &SceneFile, solved: &Solved) -> Option<String> {
    let mut simulated =
        inertia::simulated(file, solved).into_iter().chain([substitution::effect(file, solved)]);
    simulated.find(|e| e.on && e.called_for).map(|e| e.why)
}

/// An effect that was simulated, with the work done for it alone.
fn on(name: &str, why: impl Into<String>, counter: u64) -> EffectUse {
    EffectUse { name: name.to_owned(), on: true, why: why.into(), counter, ..EffectUse::default() }
}

/// An effect that was left out and that nothing could call for.
fn off(name: &str, why: impl Into<String>) -> EffectUse {
    EffectUse { name: name.to_owned(), why: why.into(), ..EffectUse::default() }
}

/// An effect that was left out, with what tells whether it may be.
fn watched(name: &str, indicator: Indicator) -> EffectUse {
    let Indicator { about, value, limit } = &indicator;
    let called_for = indicator.is_past();
    let why = match called_for {
        true => format!(
            "{about} is {value:.2e}, past {limit}: the scene calls for this effect, the result is not trusted"
        ),
        false => format!("{about} is {value:.1e}, below {limit}"),
    };
    EffectUse { called_for, indicator: Some(indicator), ..off(name, why) }
}
