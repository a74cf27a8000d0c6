//! Checks of probes: what is read and where it is read have to fit.

use super::Scene;
use super::check::{Checked, known, positive, vector};
use super::probe::{Probe, Read, Where};
use super::quantity::Zone;
use crate::error::Fault;
use crate::expression::Values;
use seam_solver::space::Space;

/// Checks one probe.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene, name: &str, probe: &Probe, values: &Values) -> Checked {
    let key = format!("probes.{name}");
    let space = scene.hypothesis.space();
    place(scene, probe, &key)?;
    let points = probe.point.iter().map(|p| (p, "point"));
    let ends = probe.line.iter().flat_map(|l| [(&l.from, "line.from"), (&l.to, "line.to")]);
    for (point, part) in points.chain(ends) {
        vector(point, space, &format!("{key}.{part}"))?;
        for (i, number) in point.iter().enumerate() {
            number.value(values, &format!("{key}.{part}[{i}]"))?;
        }
    }
    if let Some(limit) = &probe.up_to_m {
        positive(limit, values, &format!("{key}.up_to_m"))?;
    }
    if probe.line.as_ref().is_some_and(|line| line.intervals == 0) {
        return Err(Fault::new(
            format!("{key}.line.intervals"),
            "a line without stations",
            "give at least 1",
        ));
    }
    if !probe.beside.is_empty() && probe.line.is_none() && !is_history(scene, probe) {
        let mend = "remove it, or read the probe along a line or over time";
        return Err(Fault::new(format!("{key}.beside"), "a single number has no curve to draw beside", mend));
    }
    check_exact(probe, space, &key)
}

/// What is read and where it is read have to fit.
fn place(scene: &Scene, probe: &Probe, key: &str) -> Checked {
    let place = probe.read.place();
    // A variant may go the other road: what its run does not tell is not read.
    let breaks = scene.cracking.is_some() || (scene.dynamics.is_some() && !scene.failure.is_empty());
    if scene.dynamics.is_none() && !breaks && [Where::Run, Where::Switch, Where::End].contains(&place) {
        let mend = "add a [dynamics] table, or remove the probe";
        return Err(Fault::new(format!("{key}.read"), "it is read in a run in time", mend));
    }
    if !breaks && place == Where::Crack {
        let mend = "add a [cracking] table, or remove the probe";
        return Err(Fault::new(format!("{key}.read"), "it is read off a path of cracking", mend));
    }
    if probe.up_to_m.is_some() != (probe.read == Read::EnvelopeWork) {
        let mend = "give it with read = \"envelope-work\", and only there";
        return Err(Fault::new(format!("{key}.up_to_m"), "the displacement does not fit the probe", mend));
    }
    let given = [
        ("point", probe.point.is_some()),
        ("line", probe.line.is_some()),
        ("support", probe.support.is_some()),
        ("switch", probe.switch.is_some()),
    ];
    let given: Vec<&str> = given.into_iter().filter_map(|(name, given)| given.then_some(name)).collect();
    let (good, mend) = match place {
        Where::Place => (matches!(given[..], ["point"] | ["line"]), "give either `point` or `line`"),
        Where::Line => (given == ["line"], "it is read along a line: give `line` alone"),
        Where::Support => (given == ["support"], "give `support` alone, the name of a support"),
        Where::Switch => (matches!(given[..], [] | ["switch"]), "give `switch`, or nothing for all switches"),
        Where::Model | Where::Run | Where::End | Where::Crack => (
            given.is_empty(),
            "it is read off the whole model: remove `point`, `line`, `support` and `switch`",
        ),
    };
    if !good {
        return Err(Fault::new(key, "the probe does not say where, or says it twice", mend));
    }
    if let Some(support) = &probe.support {
        known(support, "support", scene.supports.keys(), &format!("{key}.support"))?;
    }
    if let Some(switch) = &probe.switch {
        let names = scene.switches.keys().chain(&scene.switches_off);
        known(switch, "switch", names, &format!("{key}.switch"))?;
    }
    Ok(())
}

/// Whether a probe gives a history in this scene.
pub fn is_history(scene: &Scene, probe: &Probe) -> bool {
    scene.dynamics.is_some() && probe.is_history()
}

/// A zone of time belongs to a history, one of space to a line.
pub fn zone(scene: &Scene, probe: &Probe, given: Zone, key: &str) -> Checked {
    let history = is_history(scene, probe);
    if given != Zone::Whole && given.is_time() != history {
        let mend = if history { "take whole, after-switch or end" } else { "take whole or de" };
        return Err(Fault::new(key, "the zone does not fit the probe", mend));
    }
    Ok(())
}

fn check_exact(probe: &Probe, space: Space, key: &str) -> Checked {
    let expected = if probe.read.is_error() { space.dim() } else { 1 };
    let missing = probe.read.is_error() && probe.exact.is_empty();
    if missing || (!probe.exact.is_empty() && probe.exact.len() < expected) {
        let message = format!("expected {expected} exact components, found {}", probe.exact.len());
        return Err(Fault::new(format!("{key}.exact"), message, "give one expression per component"));
    }
    Ok(())
}
