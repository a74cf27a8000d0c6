//! Checks of `[switches.NAME]`: when and where are given once, a body that can be switched, particles that fill boxes.

use super::Scene;
use super::body::Method;
use super::check::{Checked, check_box, check_filling, known, positive};
use super::check_dynamics::highest_load;
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
        let Some(dynamics) = &scene.dynamics else {
            let mend = "add a [dynamics] table, or set enabled = false";
            return Err(Fault::new(key, "a scene that stands still never switches", mend));
        };
        one(scene, dynamics, switch, values, &key)?;
    }
    Ok(())
}

fn one(scene: &Scene, dynamics: &Dynamics, switch: &Switch, values: &Values, key: &str) -> Checked {
    let on = format!("{key}.body");
    known(&switch.body, "body", scene.bodies.keys(), &on)?;
    if scene.bodies[&switch.body].method != Method::Fe {
        let message = format!("body '{}' has no finite elements to switch", switch.body);
        return Err(Fault::new(on, message, "name a body with method = \"fe\""));
    }
    when(dynamics, switch, values, key)?;
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
    positive(&criterion.every_s, values, &format!("{key}.every_s"))?;
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
