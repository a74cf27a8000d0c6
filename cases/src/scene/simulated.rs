//! Effects that a scene asks for, as far as its text tells: what a run shows is in its result.

use super::Scene;
use super::dynamics::{Rotations, Stepping};

impl Scene {
    /// Names of the effects that the scene names, or, with `auto`, of those that its keys switch on.
    pub fn simulated_effects(&self) -> Vec<String> {
        if self.effects.iter().all(|name| name != "auto") {
            return self.effects.clone();
        }
        let dynamics = self.dynamics.as_ref();
        let tied = self.ties.values().any(|tie| tie.rotations)
            || self.switches.values().any(|switch| switch.ties.rotations);
        let found = [
            ("inertia", dynamics.is_some_and(|d| d.stepping != Stepping::QuasiStatic)),
            ("finite-rotation", dynamics.is_some_and(|d| d.rotations == Rotations::Finite)),
            ("rotation-coupling", tied),
            ("damping", dynamics.is_some_and(|d| d.damping.is_some())),
            ("substitution", !self.switches.is_empty()),
        ];
        let named = self.effects.iter().filter(|name| *name != "auto").cloned();
        let on = found.iter().filter(|(_, on)| *on).map(|(name, _)| (*name).to_owned());
        named.chain(on).collect()
    }
}
