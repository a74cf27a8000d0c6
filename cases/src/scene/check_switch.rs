//! Checks of `[switches.NAME]`: when and where are given once, a body that can be switched, particles that fill boxes.

use super::Scene;
use super::body::Method;
use super::check::{Checked, check_box, check_filling, known, positive};
use super::check_dynamics::highest_load;
use super::de::Arrangement;
use super::dynamics::Dynamics;
use super::switch::{Criterion, Switch};
use crate::error::Fault;
use crate::expression::Values;

/// Checks all switches.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene, values: &Values) -> Checked {
    for (name, switch) in &scene.switches {
        let key = format!("switches.{name}");
        match (&scene.dynamics, &scene.cracking) {
            (Some(dynamics), _) => when(dynamics, switch, values, &key)?,
            (None, Some(_)) => while_cracking(scene, switch, values, &key)?,
            (None, None) => {
                let mend = "add a [dynamics] or [cracking] table, or set enabled = false";
                return Err(Fault::new(key, "a scene that stands still never switches", mend));
            }
        }
        one(scene, switch, values, &key)?;
    }
    Ok(())
}

/// Events have no time: only a criterion can tell when, and it grows one region.
fn while_cracking(scene: &Scene, switch: &Switch, values: &Values, key: &str) -> Checked {
    let Some(criterion) =
        switch.criterion.as_ref().filter(|_| switch.at_s.is_none() && switch.at_load.is_none())
    else {
        let mend = "give a `criterion` alone; a body that is particles from the start has method = \"de\"";
        return Err(Fault::new(key, "events of cracking have no time at which to switch", mend));
    };
    if scene.switches.len() > 1 {
        return Err(Fault::new(key, "one region grows while it cracks, not several", "keep one switch"));
    }
    if criterion.every_s.is_some() {
        let key = format!("{key}.criterion.every_s");
        return Err(Fault::new(
            key,
            "events of cracking have no time",
            "remove it: it is asked before every event",
        ));
    }
    if criterion.stress.is_none() || criterion.release.is_some() {
        let mend = "give `stress` and no `release`: what has become particles stays so";
        return Err(Fault::new(format!("{key}.criterion"), "this criterion cannot follow a crack", mend));
    }
    if switch.de.arrangement == Arrangement::Random {
        let message = "a region that grows is filled anew, and a random packing would not be the same";
        return Err(Fault::new(format!("{key}.de.arrangement"), message, "take a lattice"));
    }
    if let Some(stride) = &criterion.stride_m {
        at_least_zero(stride, values, &format!("{key}.criterion.stride_m"))?;
    }
    criterion.holds.as_ref().map_or(Ok(()), |holds| {
        check_box(holds, scene.hypothesis.space(), values, &format!("{key}.criterion.holds"))
    })
}

fn one(scene: &Scene, switch: &Switch, values: &Values, key: &str) -> Checked {
    let on = format!("{key}.body");
    known(&switch.body, "body", scene.bodies.keys(), &on)?;
    if scene.bodies[&switch.body].method != Method::Fe {
        let message = format!("body '{}' has no finite elements to switch", switch.body);
        return Err(Fault::new(on, message, "name a body with method = \"fe\""));
    }
    let space = scene.hypothesis.space();
    match (&switch.cuboid, &switch.criterion) {
        (Some(cuboid), None) => check_box(cuboid, space, values, &format!("{key}.box"))?,
        (None, Some(criterion)) => check_criterion(criterion, values, &format!("{key}.criterion"))?,
        (None, None) => {
            return Err(Fault::new(key, "the switch does not say where", "give a `box`"));
        }
        (Some(_), Some(_)) => {
            let message = "a criterion finds its own place";
            return Err(Fault::new(format!("{key}.box"), message, "remove `box`, or give at_s or at_load"));
        }
    }
    check_filling(&switch.de, space, values, key)
}

fn when(dynamics: &Dynamics, switch: &Switch, values: &Values, key: &str) -> Checked {
    let ways = [switch.at_s.is_some(), switch.at_load.is_some(), switch.criterion.is_some()];
    if ways.iter().filter(|given| **given).count() != 1 {
        let mend = "give one of: at_s, at_load, criterion";
        return Err(Fault::new(key, "a switch happens in exactly one way", mend));
    }
    if let Some(criterion) = &switch.criterion {
        let key = format!("{key}.criterion");
        if criterion.every_s.is_none() {
            return Err(Fault::new(key, "it is not said how often it is asked", "give every_s, in s"));
        }
        if criterion.stride_m.is_some() {
            let message = "only a region that grows while it cracks grows in strides";
            return Err(Fault::new(format!("{key}.stride_m"), message, "remove it, or widen buffer_m"));
        }
        if criterion.holds.is_some() {
            let message = "only a region that grows while it cracks holds a box from the start";
            return Err(Fault::new(format!("{key}.holds"), message, "remove it, or widen buffer_m"));
        }
    }
    if let Some(time) = &switch.at_s {
        let key = format!("{key}.at_s");
        let time = time.value(values, &key)?;
        let end = dynamics.end_s.value(values, "dynamics.end_s")?;
        if !(0.0..=end).contains(&time) {
            let message = format!("{time} s is outside of the run from 0 to {end} s");
            return Err(Fault::new(key, message, "switch earlier, or run longer"));
        }
    }
    if let Some(level) = &switch.at_load {
        let key = format!("{key}.at_load");
        let level = at_least_zero(level, values, &key)?;
        let highest = highest_load(dynamics, values)?;
        if level > highest {
            let message = format!("the load factor never gets to {level}, only to {highest}");
            return Err(Fault::new(key, message, "switch at a lower load, or run longer"));
        }
    }
    Ok(())
}

fn check_criterion(criterion: &Criterion, values: &Values, key: &str) -> Checked {
    match (&criterion.stress, &criterion.error) {
        (Some(stress), None) => {
            let key = format!("{key}.stress");
            let Some(strength) = &stress.strength_pa else {
                let message = "stress is compared with a strength that is not given";
                return Err(Fault::new(key, message, "give strength_Pa"));
            };
            positive(strength, values, &format!("{key}.strength_Pa"))?;
            at_least_zero(&stress.length_m, values, &format!("{key}.length_m"))?;
        }
        (None, Some(_)) => {}
        _ => {
            let mend = "give one of: stress, error";
            return Err(Fault::new(key, "a criterion has exactly one indicator", mend));
        }
    }
    let trigger = positive(&criterion.trigger, values, &format!("{key}.trigger"))?;
    at_least_zero(&criterion.buffer_m, values, &format!("{key}.buffer_m"))?;
    if let Some(every) = &criterion.every_s {
        positive(every, values, &format!("{key}.every_s"))?;
    }
    criterion.most.count(values, 1, &format!("{key}.most"))?;
    if let Some(release) = &criterion.release {
        let key = format!("{key}.release");
        let release = release.value(values, &key)?;
        if !(0.0..trigger).contains(&release) {
            let message = format!("{release} does not lie from 0 to below the trigger {trigger}");
            return Err(Fault::new(key, message, "lower it"));
        }
    }
    Ok(())
}

fn at_least_zero(number: &super::number::Number, values: &Values, key: &str) -> Result<f64, Fault> {
    let value = number.value(values, key)?;
    if value >= 0.0 {
        return Ok(value);
    }
    Err(Fault::new(key, format!("expected zero or more, found {value}"), "give zero or a positive number"))
}
