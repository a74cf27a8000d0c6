//! Checks of `[failure.NAME]` and `[cracking]`: strengths given once, bodies with bonds, something that lets them fail.

use super::Scene;
use super::body::Method;
use super::check::{Checked, check_box, known, positive};
use super::contact::Contact;
use super::dynamics::Stepping;
use super::failure::{Failure, Strength};
use crate::error::Fault;
use crate::expression::Values;

/// Checks laws and cracking.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene, values: &Values) -> Checked {
    if let Some(cracking) = &scene.cracking {
        if scene.dynamics.is_some() {
            let mend = "keep one of [cracking] and [dynamics]";
            return Err(Fault::new("cracking", "events of cracking have no time", mend));
        }
        if scene.failure.is_empty() {
            let mend = "add a [failure.NAME] table with a strength";
            return Err(Fault::new("cracking", "nothing can fail", mend));
        }
        cracking.events.count(values, 1, "cracking.events")?;
        if let Some(limit) = &cracking.factor_limit {
            positive(limit, values, "cracking.factor_limit")?;
        }
        let key = "cracking.least_stiffness";
        let least = cracking.least_stiffness.value(values, key)?;
        if !(0.0..1.0).contains(&least) {
            let message = format!("{least} is no share of the first stiffness");
            return Err(Fault::new(key, message, "give a number from zero to below one"));
        }
    }
    if let Some(contact) = &scene.contact {
        check_contact(scene, contact, values)?;
    }
    for (name, failure) in &scene.failure {
        one(scene, name, failure, values)?;
    }
    Ok(())
}

fn check_contact(scene: &Scene, contact: &Contact, values: &Values) -> Checked {
    let explicit = scene.dynamics.as_ref().is_some_and(|d| d.stepping == Stepping::Explicit);
    if !explicit || scene.failure.is_empty() {
        let message = "particles touch between explicit steps, once they have lost a bond";
        let mend = "add a [failure.NAME] table and stepping = \"explicit\", or remove [contact]";
        return Err(Fault::new("contact", message, mend));
    }
    match (&contact.linear, &contact.hertz) {
        (Some(linear), None) => {
            positive(&linear.stiffness_n_m, values, "contact.linear.stiffness_N_m").map(|_| ())
        }
        (None, Some(hertz)) => positive(&hertz.young_pa, values, "contact.hertz.young_Pa").map(|_| ()),
        _ => Err(Fault::new("contact", "the normal force has exactly one law", "give one of: linear, hertz")),
    }
}

fn one(scene: &Scene, name: &str, failure: &Failure, values: &Values) -> Checked {
    let key = format!("failure.{name}");
    known(&failure.body, "body", scene.bodies.keys(), &format!("{key}.body"))?;
    effect(scene, &key)?;
    let becomes = scene.switches.values().any(|switch| switch.body == failure.body);
    if becomes && failure.zone.is_none() {
        let mend = "add zone = { min = …, max = … }";
        return Err(Fault::new(key, "it is not said where bonds of new particles may break", mend));
    }
    if scene.dynamics.is_some() && becomes {
        let mend = "crack by events, or start with particles";
        return Err(Fault::new(key, "a run in time that switches does not break bonds", mend));
    }
    if scene.bodies[&failure.body].method == Method::Fe && !becomes {
        let message = format!("body '{}' has no bonds that could break", failure.body);
        let mend = "compute it with method = \"de\", or add a switch that makes particles of its elements";
        return Err(Fault::new(format!("{key}.body"), message, mend));
    }
    let twice = scene.failure.iter().find(|(other, law)| *other != name && law.body == failure.body);
    if let Some((other, _)) = twice {
        let message = format!("'{other}' is a law for body '{}' too", failure.body);
        return Err(Fault::new(format!("{key}.body"), message, "keep one law per body"));
    }
    if let Some(zone) = &failure.zone {
        check_box(zone, scene.hypothesis.space(), values, &format!("{key}.zone"))?;
    }
    if let Some(scatter) = &failure.scatter {
        positive(&scatter.modulus, values, &format!("{key}.scatter.modulus"))?;
        if becomes {
            let message =
                "scatter belongs to the bonds of one network, and a region that grows is filled anew";
            let mend = "leave the scatter out, or start with particles";
            return Err(Fault::new(format!("{key}.scatter"), message, mend));
        }
    }
    law(failure, values, &key)
}

/// A strength without the effect would be ignored.
fn effect(scene: &Scene, key: &str) -> Checked {
    let named = |effect: &str| scene.effects.iter().any(|e| e == effect);
    if !named("auto") && !named("bond-failure") {
        let message = "a strength is given, but the effect `bond-failure` is off";
        let mend = "add \"bond-failure\" to `effects`, or set enabled = false here";
        return Err(Fault::new(key, message, mend));
    }
    let explicit = scene.dynamics.as_ref().is_some_and(|d| d.stepping == Stepping::Explicit);
    if scene.cracking.is_none() && !explicit {
        let message = "a strength is given, but nothing lets bonds fail";
        let mend = "add [cracking], or [dynamics] with stepping = \"explicit\", or set enabled = false here";
        return Err(Fault::new(key, message, mend));
    }
    Ok(())
}

fn law(failure: &Failure, values: &Values, key: &str) -> Checked {
    match (&failure.bond_stress, &failure.virial_stress, &failure.softening) {
        (Some(law), None, None) => {
            let given = [(&law.tensile, "tensile"), (&law.shear, "shear")];
            if given.iter().all(|(strength, _)| strength.is_none()) {
                let mend = "give tensile, shear or both";
                return Err(Fault::new(format!("{key}.bond_stress"), "no stress breaks a bond", mend));
            }
            for (given, name) in given {
                if let Some(given) = given {
                    strength(given, values, &format!("{key}.bond_stress.{name}"))?;
                }
            }
            Ok(())
        }
        (None, Some(law), None) => strength(&law.strength, values, &format!("{key}.virial_stress.strength")),
        (None, None, Some(law)) => {
            let key = format!("{key}.softening");
            strength(&law.tensile, values, &format!("{key}.tensile"))?;
            positive(&law.fracture_energy_j_m2, values, &format!("{key}.fracture_energy_J_m2"))?;
            for (i, number) in law.kink.iter().flatten().enumerate() {
                positive(number, values, &format!("{key}.kink[{i}]"))?;
            }
            law.teeth.count(values, 1, &format!("{key}.teeth")).map(|_| ())
        }
        _ => {
            let mend = "give one of: bond_stress, virial_stress, softening";
            Err(Fault::new(key, "a law is given in exactly one way", mend))
        }
    }
}

fn strength(strength: &Strength, values: &Values, key: &str) -> Checked {
    match (&strength.stress_pa, &strength.toughness_pa_sqrt_m, &strength.factor) {
        (Some(stress), None, None) => positive(stress, values, &format!("{key}.stress_Pa")).map(|_| ()),
        (None, Some(toughness), Some(factor)) => {
            positive(toughness, values, &format!("{key}.toughness_Pa_sqrt_m"))?;
            positive(factor, values, &format!("{key}.factor")).map(|_| ())
        }
        _ => {
            let mend = "give stress_Pa, or toughness_Pa_sqrt_m with factor";
            Err(Fault::new(key, "a strength is given in exactly one way", mend))
        }
    }
}
