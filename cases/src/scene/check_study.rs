//! Checks of quantities and studies: names that lead nowhere, studies that compare nothing.

use super::check::{Checked, known};
use super::check_cost;
use super::check_peer;
use super::check_probe::{is_history, zone};
use super::probe::Read;
use super::quantity::{Accept, Norm, Quantity};
use super::study::{Claim, FamilyDeclaration, Levels, Seeds};
use super::{Scene, effects};
use crate::error::Fault;
use crate::expression::Values;
use crate::names::hint;
use crate::overrides::label;
use crate::result::ReferenceKind;
use serde_json::Value;

/// Checks quantities and studies.
///
/// # Errors
/// The first fault, with its key.
pub fn check(scene: &Scene, values: &Values) -> Checked {
    for (name, probe) in &scene.probes {
        for (legend, names) in &probe.beside {
            variants(scene, names, &format!("probes.{name}.beside.{legend}"))?;
        }
    }
    for (name, quantity) in &scene.quantities {
        check_quantity(scene, name, quantity, values)?;
    }
    if let Some(reference) = &scene.reference {
        variants(scene, &reference.variants, "reference.variants")?;
        levels(&reference.levels, 1, "reference.levels")?;
    }
    for (name, study) in &scene.convergence {
        let key = format!("convergence.{name}");
        known(&study.quantity, "quantity", scene.quantities.keys(), &format!("{key}.quantity"))?;
        // Two levels always lie on a line: an order needs three.
        levels(&study.levels, 3, &format!("{key}.levels"))?;
    }
    for (name, family) in &scene.families {
        check_family(scene, name, family)?;
    }
    for (name, claim) in &scene.claims {
        check_claim(scene, name, claim)?;
    }
    for (name, budget) in &scene.budgets {
        let key = format!("budgets.{name}");
        known(&budget.quantity, "quantity", scene.quantities.keys(), &format!("{key}.quantity"))?;
        variants(scene, &budget.of, &format!("{key}.of"))?;
        for (i, part) in budget.parts.iter().enumerate() {
            variants(scene, &part.from, &format!("{key}.parts[{i}].from"))?;
            variants(scene, &part.to, &format!("{key}.parts[{i}].to"))?;
        }
    }
    check_cost::check(scene)?;
    for (name, growth) in &scene.growth {
        let key = format!("growth.{name}");
        variants(scene, &growth.variants, &format!("{key}.variants"))?;
        // Two levels always lie on a line: an exponent needs three.
        levels(&growth.levels, 3, &format!("{key}.levels"))?;
        for (part, given) in [("work", Some(growth.work)), ("seconds", growth.seconds)] {
            if given.is_some_and(|[low, high]| !(low <= high && low.is_finite() && high.is_finite())) {
                let key = format!("{key}.{part}");
                return Err(Fault::new(key, "the interval is empty", "give its lower end first"));
            }
        }
    }
    for (name, ablation) in &scene.ablations {
        let key = format!("ablations.{name}");
        if !effects::NAMES.contains(&ablation.effect.as_str()) {
            let message = format!("there is no effect '{}'", ablation.effect);
            return Err(Fault::new(format!("{key}.effect"), message, hint(&ablation.effect, effects::NAMES)));
        }
        variants(scene, &ablation.variants, &format!("{key}.variants"))?;
        if !(ablation.tolerance > 0.0 && ablation.tolerance < 1.0) {
            let message = format!("{} is no tolerance", ablation.tolerance);
            return Err(Fault::new(format!("{key}.tolerance"), message, "give a fraction between 0 and 1"));
        }
        if ablation.why.trim().is_empty() {
            let mend = "say why it is this wide";
            return Err(Fault::new(format!("{key}.why"), "a tolerance needs its reason", mend));
        }
    }
    Ok(())
}

/// Names of variants that must be there.
pub fn variants(scene: &Scene, names: &[String], key: &str) -> Checked {
    names
        .iter()
        .enumerate()
        .try_for_each(|(i, name)| known(name, "variant", scene.variants.keys(), &format!("{key}[{i}]")))
}

pub(super) fn levels(levels: &Levels, least: usize, key: &str) -> Checked {
    if levels.values.len() < least {
        let message = format!("expected at least {least} levels, found {}", levels.values.len());
        return Err(Fault::new(format!("{key}.values"), message, "add levels"));
    }
    Ok(())
}

/// A norm fits what it measures, a zone fits its norm.
fn check_norm(scene: &Scene, quantity: &Quantity, key: &str) -> Checked {
    let probe = &scene.probes[&quantity.probe];
    let history = is_history(scene, probe);
    let good = match quantity.norm {
        // Places have a distance, and no values to compare.
        Some(Norm::Hausdorff) => probe.read == Read::CrackPath,
        Some(_) => probe.line.is_some() || history || probe.read == Read::ForceDisplacement,
        None => probe.line.is_none() && !probe.read.is_crack_curve(),
    };
    if !good {
        let mend = "a curve needs `norm` to become a number, a scalar has none";
        return Err(Fault::new(format!("{key}.norm"), "the norm does not fit the probe", mend));
    }
    if quantity.take.is_some() && (!history || quantity.norm.is_some()) {
        let mend = "remove it: only a history without `norm` has values to choose from";
        return Err(Fault::new(format!("{key}.take"), "there is one value only", mend));
    }
    zone(scene, probe, quantity.zone, &format!("{key}.zone"))
}

fn check_quantity(scene: &Scene, name: &str, quantity: &Quantity, values: &Values) -> Checked {
    let key = format!("quantities.{name}");
    if scene.procedure != "statics" {
        return Err(Fault::new(key, "the procedure brings its own quantities", "remove the table"));
    }
    known(&quantity.probe, "probe", scene.probes.keys(), &format!("{key}.probe"))?;
    variants(scene, &quantity.variants, &format!("{key}.variants"))?;
    check_norm(scene, quantity, &key)?;
    let curve = quantity.norm.is_some();
    let given = quantity
        .reference
        .as_ref()
        .is_some_and(|r| r.value.is_some() || r.variants.is_some() || r.peer.is_some());
    check_peer::check_reference(scene, quantity, &format!("{key}.reference"))?;
    check_own_run(scene, quantity, &format!("{key}.reference"))?;
    if scene.reference.is_none() && !given && (curve || quantity.reference.is_some()) {
        let mend = "add a [reference] model, or give reference.value";
        return Err(Fault::new(key, "there is nothing to compare it with", mend));
    }
    if let Some(number) = quantity.reference.as_ref().and_then(|r| r.value.as_ref()) {
        number.value(values, &format!("{key}.reference.value"))?;
    }
    if quantity.as_share && (quantity.reference.is_none() || curve) {
        let mend = "give a reference, and no norm";
        return Err(Fault::new(format!("{key}.as_share"), "there is nothing it is a share of", mend));
    }
    let refined = scene.convergence.values().any(|c| c.quantity == name);
    if quantity.extrapolated && !refined {
        let mend = "add a [convergence.NAME] table for it";
        return Err(Fault::new(format!("{key}.extrapolated"), "no convergence study refines it", mend));
    }
    quantity.accept.as_ref().map_or(Ok(()), |accept| check_accept(accept, quantity, values, &key))
}

/// A value that Seam computed is called so, and given once.
fn check_own_run(scene: &Scene, quantity: &Quantity, key: &str) -> Checked {
    let Some(reference) = &quantity.reference else { return Ok(()) };
    if reference.variants.is_some() != (reference.kind == ReferenceKind::OwnRun) {
        let mend = "give `variants` with the kind own-run, and only with it";
        return Err(Fault::new(format!("{key}.kind"), "the kind does not fit where the value is from", mend));
    }
    if reference.variants.is_some() && reference.value.is_some() {
        return Err(Fault::new(format!("{key}.value"), "there are two references", "keep one of them"));
    }
    reference.variants.as_ref().map_or(Ok(()), |names| variants(scene, names, &format!("{key}.variants")))
}

fn check_accept(accept: &Accept, quantity: &Quantity, values: &Values, key: &str) -> Checked {
    let key = format!("{key}.accept");
    let Accept { relative, absolute, interval, why } = accept;
    if why.trim().is_empty() {
        return Err(Fault::new(
            format!("{key}.why"),
            "a tolerance needs its reason",
            "say why it is this wide",
        ));
    }
    if interval.is_some() == (relative.is_some() || absolute.is_some()) {
        let mend = "give relative, absolute or both, or else interval";
        return Err(Fault::new(key, "the accepted range is not defined", mend));
    }
    if relative.is_some() && (quantity.reference.is_none() || quantity.as_share) {
        let mend = "add a reference, or give `absolute` or `interval`";
        return Err(Fault::new(format!("{key}.relative"), "it is relative to nothing", mend));
    }
    for (number, part) in [(relative, "relative"), (absolute, "absolute")] {
        if let Some(number) = number
            && number.value(values, &format!("{key}.{part}"))? < 0.0
        {
            return Err(Fault::new(format!("{key}.{part}"), "a tolerance below zero", "make it positive"));
        }
    }
    Ok(())
}

fn check_family(scene: &Scene, name: &str, family: &FamilyDeclaration) -> Checked {
    let key = format!("families.{name}");
    for (axis_name, axis) in &family.axes {
        let key = format!("{key}.axes.{axis_name}");
        variants(scene, &axis.variants, &format!("{key}.variants"))?;
        if axis.key.is_some() != axis.variants.is_empty() || (axis.key.is_some() && axis.values.is_empty()) {
            return Err(Fault::new(key, "an axis without values", "give `key` and `values`, or `variants`"));
        }
        let like = format!("families.{name}.paper_like");
        let Some(value) = family.paper_like.get(axis_name) else {
            let message = format!("the paper-like setting has no value of '{axis_name}'");
            return Err(Fault::new(like, message, "name one value of every axis"));
        };
        on_axis(family, axis_name, value, &format!("{like}.{axis_name}"))?;
    }
    if let Some(axis) = &family.resolution {
        known(axis, "axis", family.axes.keys(), &format!("{key}.resolution"))?;
    }
    check_seeds(scene, &family.seeds, &format!("{key}.seeds"))?;
    for (blocks, tier) in [(&family.full, "full"), (&family.quick, "quick")] {
        for (i, block) in blocks.iter().enumerate() {
            for (axis, listed) in block {
                let key = format!("{key}.{tier}[{i}].{axis}");
                known(axis, "axis", family.axes.keys(), &key)?;
                listed.iter().try_for_each(|value| on_axis(family, axis, value, &key))?;
            }
        }
    }
    Ok(())
}

fn on_axis(family: &FamilyDeclaration, axis: &str, value: &Value, key: &str) -> Checked {
    let axis = &family.axes[axis];
    let labels: Vec<String> = axis.values.iter().map(label).chain(axis.variants.iter().cloned()).collect();
    known(&label(value), "value", labels.iter(), key)
}

fn check_seeds(scene: &Scene, seeds: &Seeds, key: &str) -> Checked {
    let packings = scene.bodies.keys().chain(scene.switches.keys()).chain(&scene.switches_off);
    known(&seeds.body, "body or switch", packings, &format!("{key}.body"))?;
    for (list, tier) in [(&seeds.full, "full"), (&seeds.quick, "quick")] {
        if list.is_empty() {
            return Err(Fault::new(format!("{key}.{tier}"), "no seeds", "give at least one"));
        }
    }
    Ok(())
}

fn check_claim(scene: &Scene, name: &str, claim: &Claim) -> Checked {
    let key = format!("claims.{name}");
    known(&claim.family, "family", scene.families.keys(), &format!("{key}.family"))?;
    known(&claim.main_reading, "reading", claim.readings.keys(), &format!("{key}.main_reading"))?;
    if let Some(other) = &claim.no_more_particles_than {
        known(other, "claim", scene.claims.keys(), &format!("{key}.no_more_particles_than"))?;
    }
    for (reading_name, reading) in &claim.readings {
        let reading_key = format!("{key}.readings.{reading_name}");
        let key = format!("{reading_key}.probe");
        known(&reading.probe, "probe", scene.probes.keys(), &key)?;
        let probe = &scene.probes[&reading.probe];
        if probe.line.is_none() && !is_history(scene, probe) {
            return Err(Fault::new(
                key,
                "a reading compares curves",
                "name a probe along a line or over time",
            ));
        }
        zone(scene, probe, reading.zone, &format!("{reading_key}.zone"))?;
    }
    if scene.reference.is_none() {
        return Err(Fault::new(key, "there is nothing to compare with", "add a [reference] model"));
    }
    Ok(())
}
