//! `effects = [...]`: which effects a scene simulates. `["auto"]` leaves that to its tables; a list of names switches each
//! effect on or off, whatever the tables say.

use super::Scene;
use super::contact::Contact;
use super::dynamics::{Damping, Dynamics, Rotations, Stepping};
use super::failure::Failure;
use super::number::Number;
use super::switch::Switch;
use crate::error::Fault;
use crate::names::hint;
use std::collections::BTreeMap;

/// The effects, in the order they are reported.
pub const NAMES: [&str; 8] = [
    "inertia",
    "finite-rotation",
    "rotation-coupling",
    "bond-failure",
    "contact",
    "friction",
    "damping",
    "substitution",
];

/// The word that leaves the choice to the tables.
pub const AUTO: &str = "auto";

/// What the tables of a scene ask for and its list of effects leaves out: what the result is checked for.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct LeftOut {
    /// The damping.
    pub damping: Option<Damping>,
    /// The switches.
    pub switches: BTreeMap<String, Switch>,
    /// The strengths.
    pub failure: BTreeMap<String, Failure>,
    /// The law of contact.
    pub contact: Option<Contact>,
    /// The coefficient of friction of contacts that are on.
    pub friction: Option<Number>,
}

impl Scene {
    /// Whether the list names effects instead of leaving the choice to the tables.
    pub fn names_effects(&self) -> bool {
        self.effects != [AUTO]
    }

    /// The effects that the scene simulates as it stands.
    pub fn asks_for(&self) -> Vec<&'static str> {
        let dynamics = self.dynamics.as_ref();
        let coupled = self.ties.values().any(|tie| tie.rotations)
            || self.switches.values().any(|switch| switch.ties.rotations);
        let asked = [
            ("inertia", dynamics.is_some_and(|d| d.stepping != Stepping::QuasiStatic)),
            ("finite-rotation", dynamics.is_some_and(|d| d.rotations == Rotations::Finite)),
            ("rotation-coupling", coupled),
            ("bond-failure", !self.failure.is_empty()),
            ("contact", self.contact.is_some()),
            ("friction", self.contact.as_ref().is_some_and(Contact::has_friction)),
            ("damping", dynamics.is_some_and(|d| d.damping.is_some())),
            ("substitution", !self.switches.is_empty()),
        ];
        asked.into_iter().filter_map(|(name, on)| on.then_some(name)).collect()
    }

    /// Switches effects on and off as the list says, before the scene is checked.
    ///
    /// # Errors
    /// An effect that is not known, or that the tables say too little about.
    pub fn apply_effects(&mut self) -> Result<(), Fault> {
        if !self.names_effects() {
            return Ok(());
        }
        for (i, name) in self.effects.iter().enumerate() {
            if !NAMES.contains(&name.as_str()) {
                let message = match name.as_str() {
                    AUTO => "\"auto\" stands alone or not at all".to_owned(),
                    _ => format!("there is no effect '{name}'"),
                };
                return Err(Fault::new(format!("effects[{i}]"), message, hint(name, NAMES)));
            }
        }
        let on = |name: &str| self.effects.iter().any(|e| e == name);
        let [inertia, finite, coupling] = ["inertia", "finite-rotation", "rotation-coupling"].map(on);
        let [damping, substitution] = ["damping", "substitution"].map(on);
        let given = [
            !self.failure.is_empty(),
            self.contact.is_some(),
            self.contact.as_ref().is_some_and(Contact::has_friction),
        ];
        for (name, given) in ["bond-failure", "contact", "friction"].into_iter().zip(given) {
            if on(name) && !given {
                return Err(Fault::new(
                    "effects",
                    format!("nothing in the scene gives {name}"),
                    "leave it out",
                ));
            }
        }
        if !inertia && (finite || damping) {
            let mend = "add \"inertia\", or leave them out";
            return Err(Fault::new(
                "effects",
                "finite rotation and damping act on motion, which needs inertia",
                mend,
            ));
        }
        self.turn_failure(["bond-failure", "contact", "friction"].map(on))?;
        self.turn_substitution(substitution)?;
        self.turn_coupling(coupling)?;
        match &mut self.dynamics {
            Some(dynamics) => {
                self.left_out.damping = turn_damping(dynamics, damping)?;
                turn_inertia(dynamics, inertia, !self.switches.is_empty());
                dynamics.rotations = if finite { Rotations::Finite } else { Rotations::Small };
                Ok(())
            }
            None if inertia || finite || damping => Err(Fault::new(
                "effects",
                "a scene without motion has no inertia, finite rotation or damping",
                "add a [dynamics] table, or leave them out",
            )),
            None => Ok(()),
        }
    }

    /// Particles touch once they have lost a bond, and slide where they touch: each needs the one before.
    fn turn_failure(&mut self, [failure, contact, friction]: [bool; 3]) -> Result<(), Fault> {
        let pairs =
            [(contact, failure, "contact", "bond-failure"), (friction, contact, "friction", "contact")];
        if let Some((.., name, first)) = pairs.into_iter().find(|(on, first, ..)| *on && !first) {
            let message = format!("{name} acts on what has failed, which needs {first}");
            return Err(Fault::new("effects", message, format!("add \"{first}\", or leave it out")));
        }
        // A path of events is nothing but failure: the check of strengths says so.
        if !failure && self.cracking.is_none() {
            self.left_out.failure = std::mem::take(&mut self.failure);
        }
        if !contact {
            self.left_out.contact = self.contact.take();
        }
        if let Some(contact) = self.contact.as_mut().filter(|contact| !friction && contact.has_friction()) {
            self.left_out.friction = Some(std::mem::replace(&mut contact.friction, Number::Literal(0.0)));
        }
        Ok(())
    }

    fn turn_substitution(&mut self, on: bool) -> Result<(), Fault> {
        if on && self.switches.is_empty() {
            let mend = "add a [switches.NAME] table, or leave it out";
            return Err(Fault::new("effects", "no switch says what substitution is", mend));
        }
        if !on {
            self.left_out.switches = std::mem::take(&mut self.switches);
            self.switches_off.extend(self.left_out.switches.keys().cloned());
        }
        Ok(())
    }

    fn turn_coupling(&mut self, on: bool) -> Result<(), Fault> {
        if on && self.ties.is_empty() && self.switches.is_empty() {
            let mend = "add a [ties.NAME] table, or leave it out";
            return Err(Fault::new("effects", "there is no tie that could couple rotations", mend));
        }
        self.ties.values_mut().for_each(|tie| tie.rotations = on);
        self.switches.values_mut().for_each(|switch| switch.ties.rotations = on);
        Ok(())
    }
}

/// Takes the damping away, or sees that there is one; gives what was taken away.
fn turn_damping(dynamics: &mut Dynamics, on: bool) -> Result<Option<Damping>, Fault> {
    if on && dynamics.damping.is_none() {
        let mend = "give dynamics.damping, or leave it out";
        return Err(Fault::new("effects", "the scene does not say how it is damped", mend));
    }
    Ok(if on { None } else { dynamics.damping.take() })
}

/// Without inertia a run is a row of equilibria; with it equilibria become implicit steps.
fn turn_inertia(dynamics: &mut Dynamics, on: bool, switches: bool) {
    match (on, dynamics.stepping) {
        (true, Stepping::QuasiStatic) => dynamics.stepping = Stepping::Implicit,
        (true, _) | (false, Stepping::QuasiStatic) => {}
        (false, _) => {
            // Equilibria need no steps of their own, unless a switch has to find its moment among them.
            let step = match dynamics.step_s.take() {
                Some(step) if switches => step,
                _ => between_outputs(dynamics),
            };
            *dynamics = Dynamics {
                stepping: Stepping::QuasiStatic,
                step_s: Some(step),
                step_share: None,
                fine_s: None,
                fine_share: None,
                alpha: None,
                method: None,
                damping: None,
                initial_velocity: Vec::new(),
                ..dynamics.clone()
            };
        }
    }
}

/// One equilibrium per output.
fn between_outputs(dynamics: &Dynamics) -> Number {
    let text = |number: &Number| match number {
        Number::Literal(value) => format!("{value:?}"),
        Number::Formula(formula) => formula.to_string(),
    };
    let step = format!("({})/({})", text(&dynamics.end_s), text(&dynamics.outputs));
    serde_json::from_value(step.into()).unwrap_or_else(|_| dynamics.end_s.clone())
}
