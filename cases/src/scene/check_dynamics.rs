//! Checks of `[dynamics]`: keys that belong to another stepping, numbers out of range, loads that come too late.

use super::Scene;
use super::body::Method;
use super::check::{Checked, positive, vector};
use super::dynamics::{Damping, Dynamics, Loads, Ramp, Rotations, Stepping};
use super::number::Number;
use crate::error::Fault;
use crate::expression::Values;
use seam_solver::dynamics::load::LoadFactor;

/// Checks how the scene moves.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene, dynamics: &Dynamics, values: &Values) -> Checked {
    let end = positive(&dynamics.end_s, values, "dynamics.end_s")?;
    let damped = match &dynamics.damping {
        Some(given) => damping(given, dynamics.stepping, values)?,
        None => false,
    };
    keys_of_stepping(dynamics, damped)?;
    steps(dynamics, end, values)?;
    dynamics.outputs.count(values, 1, "dynamics.outputs")?;
    if let Some(alpha) = &dynamics.alpha {
        let alpha = alpha.value(values, "dynamics.alpha")?;
        if !(-1.0 / 3.0..=0.0).contains(&alpha) {
            let mend = "give a number from -1/3 (most damping of high frequencies) to 0 (none)";
            return Err(Fault::new("dynamics.alpha", format!("{alpha} makes HHT unstable"), mend));
        }
    }
    loads(&dynamics.loads, end, values)?;
    if !dynamics.initial_velocity.is_empty() {
        vector(&dynamics.initial_velocity, scene.hypothesis.space(), "dynamics.initial_velocity")?;
    }
    if dynamics.rotations == Rotations::Finite
        && let Some((name, _)) = scene.bodies.iter().find(|(_, body)| body.method == Method::Fe)
    {
        let message = format!("body '{name}' has finite elements, which know small rotations only");
        let mend = "take rotations = \"small\", or compute every body with particles";
        return Err(Fault::new("dynamics.rotations", message, mend));
    }
    Ok(())
}

/// A key that only some steppings know would be ignored: it is refused instead.
fn keys_of_stepping(dynamics: &Dynamics, damped: bool) -> Checked {
    use Stepping::{Explicit, Implicit, TwoRates};
    let keys = [
        ("step_share", dynamics.step_share.is_some(), &[Explicit][..]),
        ("fine_s", dynamics.fine_s.is_some(), &[TwoRates]),
        ("fine_share", dynamics.fine_share.is_some(), &[TwoRates]),
        ("alpha", dynamics.alpha.is_some(), &[Implicit]),
        ("method", dynamics.method.is_some(), &[TwoRates]),
        ("damping", damped, &[Implicit, Explicit]),
        ("initial_velocity", !dynamics.initial_velocity.is_empty(), &[Implicit, Explicit, TwoRates]),
        ("rotations", dynamics.rotations == Rotations::Finite, &[Explicit]),
    ];
    for (key, given, known) in keys {
        if given && !known.contains(&dynamics.stepping) {
            let names: Vec<&str> = known.iter().map(|s| s.name()).collect();
            let message = format!("{} stepping does not know `{key}`", dynamics.stepping.name());
            let mend = format!("remove it, or take stepping = \"{}\"", names.join("\" or \""));
            return Err(Fault::new(format!("dynamics.{key}"), message, mend));
        }
    }
    Ok(())
}

fn steps(dynamics: &Dynamics, end: f64, values: &Values) -> Checked {
    let length = |number: &Option<Number>, key: &str| -> Checked {
        let Some(number) = number else { return Ok(()) };
        let key = format!("dynamics.{key}");
        let step = positive(number, values, &key)?;
        if step > end {
            let message = format!("a step of {step} s is longer than the run of {end} s");
            return Err(Fault::new(key, message, "shorten the step or lengthen the run"));
        }
        Ok(())
    };
    let share = |number: &Option<Number>, key: &str| -> Checked {
        let Some(number) = number else { return Ok(()) };
        let key = format!("dynamics.{key}");
        let share = positive(number, values, &key)?;
        if share > 1.0 {
            let message = format!("{share} times the critical step is unstable");
            return Err(Fault::new(key, message, "give a share of at most 1; 0.8 leaves a margin"));
        }
        Ok(())
    };
    let one_of = |first: &Option<Number>, second: &Option<Number>, names: &str| -> Checked {
        if first.is_some() != second.is_some() {
            return Ok(());
        }
        let message = "the time step is missing, or given twice";
        Err(Fault::new("dynamics", message, format!("give one of {names}")))
    };
    match dynamics.stepping {
        Stepping::Explicit => one_of(&dynamics.step_s, &dynamics.step_share, "step_s, step_share")?,
        Stepping::TwoRates => one_of(&dynamics.fine_s, &dynamics.fine_share, "fine_s, fine_share")?,
        Stepping::QuasiStatic | Stepping::Implicit => {}
    }
    if dynamics.stepping != Stepping::Explicit && dynamics.step_s.is_none() {
        let message = "the time step is missing";
        return Err(Fault::new("dynamics", message, "give step_s, e.g. a hundredth of the first period"));
    }
    length(&dynamics.step_s, "step_s")?;
    length(&dynamics.fine_s, "fine_s")?;
    share(&dynamics.step_share, "step_share")?;
    share(&dynamics.fine_share, "fine_share")
}

/// Whether there is any: a rate of zero is none.
fn damping(damping: &Damping, stepping: Stepping, values: &Values) -> Result<bool, Fault> {
    let key = "dynamics.damping";
    let ways = [damping.rate_per_s.is_some(), damping.ratio.is_some(), damping.share.is_some()];
    let one = ways.iter().filter(|given| **given).count() == 1;
    if !one || damping.ratio.is_some() != damping.period_s.is_some() {
        let mend = "give one of: rate_per_s; ratio with period_s; share";
        return Err(Fault::new(key, "damping is given in exactly one way", mend));
    }
    let mut largest = 0.0f64;
    for (number, name) in
        [(&damping.rate_per_s, "rate_per_s"), (&damping.ratio, "ratio"), (&damping.share, "share")]
    {
        let key = format!("{key}.{name}");
        let Some(number) = number else { continue };
        let value = number.value(values, &key)?;
        if value < 0.0 {
            return Err(Fault::new(key, "damping below zero would feed energy in", "make it positive"));
        }
        if name == "share" && value >= 1.0 {
            let message = format!("{value} is not a share");
            return Err(Fault::new(key, message, "give a number from 0 to below 1"));
        }
        if name == "share" && value > 0.0 && stepping != Stepping::Explicit {
            let message = format!("{} stepping does not know local damping", stepping.name());
            let mend = "give rate_per_s or ratio, or take stepping = \"explicit\"";
            return Err(Fault::new(key, message, mend));
        }
        largest = largest.max(value);
    }
    if let Some(period) = &damping.period_s {
        positive(period, values, &format!("{key}.period_s"))?;
    }
    Ok(largest > 0.0)
}

/// Largest factor that the loads reach before the end.
///
/// # Errors
/// An expression without a value.
pub fn highest_load(dynamics: &Dynamics, values: &Values) -> Result<f64, Fault> {
    let end = dynamics.end_s.value(values, "dynamics.end_s")?;
    match &dynamics.loads {
        Loads::Sudden => Ok(1.0),
        Loads::Ramp(Ramp { start_s, rise_s }) => {
            let start = start_s.value(values, "dynamics.loads.ramp.start_s")?;
            Ok(((end - start) / rise_s.value(values, "dynamics.loads.ramp.rise_s")?).clamp(0.0, 1.0))
        }
        Loads::Table(rows) => {
            let mut points = Vec::new();
            for (i, [time, factor]) in rows.iter().enumerate() {
                let key = format!("dynamics.loads.table[{i}]");
                points.push((time.value(values, &key)?, factor.value(values, &key)?));
            }
            let at_end = LoadFactor::Table(points.clone()).at(end);
            Ok(points.iter().filter(|p| p.0 <= end).map(|p| p.1).fold(at_end, f64::max))
        }
    }
}

fn loads(loads: &Loads, end: f64, values: &Values) -> Checked {
    let (begin, key) = match loads {
        Loads::Sudden => return Ok(()),
        Loads::Ramp(ramp) => {
            let key = "dynamics.loads.ramp";
            positive(&ramp.rise_s, values, &format!("{key}.rise_s"))?;
            let key = format!("{key}.start_s");
            (ramp.start_s.value(values, &key)?, key)
        }
        Loads::Table(rows) => {
            let key = "dynamics.loads.table";
            let mut last = f64::NEG_INFINITY;
            for (i, [time, factor]) in rows.iter().enumerate() {
                let at = format!("{key}[{i}]");
                factor.value(values, &at)?;
                let time = time.value(values, &at)?;
                if time <= last {
                    let message = format!("{time} s is not later than {last} s before it");
                    return Err(Fault::new(at, message, "sort the rows by time, each time once"));
                }
                last = time;
            }
            let Some([first, _]) = rows.first() else {
                return Err(Fault::new(key, "the table is empty", "give at least one row"));
            };
            (first.value(values, key)?, key.to_owned())
        }
    };
    if begin >= end {
        let message = format!("the loads begin at {begin} s, the run ends at {end} s");
        return Err(Fault::new(key, message, "begin them earlier, or run longer"));
    }
    Ok(())
}
