//! Quantities: measured values, their references and accepted intervals.

use super::Study;
use super::convergence::Refined;
use super::effects;
use super::evaluate::{self, Solved, distance};
use super::reference::Reference;
use crate::error::Result;
use crate::file::SceneFile;
use crate::result::{Agreement, EffectUse, Observation, ReferenceKind};
use crate::scene::number::Number;
use crate::scene::probe::Read;
use crate::scene::quantity::{Accept, Norm, Quantity};
use std::collections::btree_map::Entry;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

/// All quantities of the scene; those of the same variants share one run. Beside them the effects that such a run left out although
/// it calls for them or simulated in vain, where a number of it is judged.
pub fn all(
    study: &Study,
    solved: &Solved,
    refined: &BTreeMap<String, Refined>,
) -> Result<(Vec<Observation>, Vec<EffectUse>)> {
    let mut runs: BTreeMap<&[String], (SceneFile, Solved)> = BTreeMap::new();
    let (mut all, mut missing, mut guarded) = (Vec::new(), Vec::new(), BTreeSet::new());
    let peer_of = |q: &Quantity| q.reference.as_ref().and_then(|r| r.peer.clone());
    let now = |q: &Quantity| {
        q.tiers.contains(&study.tier) && peer_of(q).is_none_or(|name| study.peers.contains_key(&name))
    };
    for (name, quantity) in study.file.scene.quantities.iter().filter(|(_, q)| now(q)) {
        let refined = refined.get(name);
        if quantity.variants.is_empty() {
            all.push(one(study, study, name, quantity, solved, refined)?);
            continue;
        }
        let (file, solved) = match runs.entry(&quantity.variants) {
            Entry::Occupied(run) => run.into_mut(),
            Entry::Vacant(place) => {
                let file = study.file.with(&study.variants(&quantity.variants))?;
                let solved = evaluate::solve(&file, study.tally)?;
                place.insert((file, solved))
            }
        };
        if quantity.accept.is_some() && guarded.insert((&quantity.variants, &quantity.leaves_out)) {
            let called_for = |e: &EffectUse| e.called_for && (e.on || !quantity.leaves_out.contains(&e.name));
            let left_out = effects::used(file, solved).into_iter().filter(called_for);
            missing.extend(left_out.map(|e| EffectUse { variants: quantity.variants.clone(), ..e }));
        }
        all.push(one(study, &Study { file, ..*study }, name, quantity, solved, refined)?);
    }
    Ok((all, missing))
}

/// A quantity of a variant of the scene `root`.
fn one(
    root: &Study,
    study: &Study,
    name: &str,
    quantity: &Quantity,
    solved: &Solved,
    refined: Option<&Refined>,
) -> Result<Observation> {
    let probe = &study.file.scene.probes[&quantity.probe];
    let default_unit = match quantity.norm {
        None | Some(Norm::Hausdorff) => probe.read.unit(),
        Some(_) => "1",
    };
    let mut observation = Observation {
        id: name.to_owned(),
        label: quantity.label.clone(),
        unit: quantity.unit.clone().unwrap_or_else(|| default_unit.to_owned()),
        ..Observation::default()
    };
    match (quantity.norm, refined) {
        (Some(norm), _) => {
            let reference = reference_of(root, study, quantity)?;
            let what = (quantity.probe.as_str(), norm, quantity.zone);
            let distance = distance(study.file, &solved.readings, &reference, what);
            observation.value = distance
                .ok_or_else(|| study.error(format!("quantity '{name}': its zone holds no station")))?;
            observation.kind = quantity.reference.as_ref().map_or(ReferenceKind::OwnFem, |r| r.kind);
            observation.source = reference.about.clone();
            observation.u_ref = reference.curves[&quantity.probe].1;
        }
        (None, Some(refined)) if quantity.extrapolated => {
            observation.value = refined.estimate.value;
            observation.u_num = refined.estimate.u;
        }
        _ => {
            let value = solved.readings.value(quantity);
            observation.value =
                value.ok_or_else(|| study.error(format!("quantity '{name}' has no value")))?;
        }
    }
    if quantity.norm.is_none() || !is_of_a_run(quantity) {
        compare(root, study, name, quantity, &mut observation)?;
    }
    observation.agreement = agreement(root, quantity);
    if let (true, Some(whole)) = (quantity.as_share, observation.reference) {
        // Judged by itself: one is no value it should have.
        (observation.value, observation.unit) = (observation.value / whole, "1".to_owned());
        (observation.reference, observation.u_ref) = (None, 0.0);
    }
    if let Some(accept) = &quantity.accept {
        observation.accepted = Some(accepted(study, name, accept, observation.reference)?);
        observation.why = accept.why.clone();
    }
    Ok(observation)
}

/// What the table of agreements says of a quantity that is compared with another code.
fn agreement(root: &Study, quantity: &Quantity) -> Option<Agreement> {
    let name = quantity.reference.as_ref()?.peer.as_ref()?;
    let (peer, answer) = (&root.file.scene.peers[name], root.peers.get(name)?);
    let read = root.file.scene.probes[&quantity.probe].read;
    let rotation = matches!(read, Read::SecantRotation | Read::SectionRotation);
    Some(Agreement {
        compared: if rotation { "rotation" } else { "displacement" }.to_owned(),
        same_model: peer.variants == quantity.variants && !peer.variants.is_empty(),
        ..answer.agreement.clone()
    })
}

/// Whether it is compared with another run, of Seam or of another code: with a norm the distance is the value.
fn is_of_a_run(quantity: &Quantity) -> bool {
    quantity.reference.as_ref().is_some_and(|r| r.variants.is_some() || r.peer.is_some())
}

/// What another code computed, the run that the quantity names, or the scene's `[reference]` model.
fn reference_of(root: &Study, study: &Study, quantity: &Quantity) -> Result<Arc<Reference>> {
    let peer = quantity.reference.as_ref().and_then(|r| r.peer.as_ref());
    if let Some(answer) = peer.and_then(|name| root.peers.get(name)) {
        return Ok(Arc::clone(&answer.reference));
    }
    match quantity.reference.as_ref().and_then(|r| Some((r.variants.as_ref()?, &r.source))) {
        Some((names, source)) => {
            root.library.own_run(&root.file.with(&root.variants(names))?, source, root.tally)
        }
        None => study.library.of(study.file, study.tally),
    }
}

fn compare(
    root: &Study,
    study: &Study,
    name: &str,
    quantity: &Quantity,
    observation: &mut Observation,
) -> Result<()> {
    let Some(declared) = &quantity.reference else { return Ok(()) };
    observation.kind = declared.kind;
    observation.source = declared.source.clone();
    match &declared.value {
        Some(value) => {
            observation.reference = Some(number(study, value, &format!("quantities.{name}.reference.value"))?)
        }
        None => {
            let reference = reference_of(root, study, quantity)?;
            if let Some(estimate) = reference.estimate(quantity) {
                observation.reference = Some(estimate.value);
                observation.u_ref = estimate.u;
            }
        }
    }
    if let Some(uncertainty) = &declared.uncertainty {
        observation.u_ref = number(study, uncertainty, &format!("quantities.{name}.reference.uncertainty"))?;
    }
    Ok(())
}

/// `|a − ref| ≤ max(relative·|ref|, absolute)` as an interval of a.
fn accepted(study: &Study, name: &str, accept: &Accept, reference: Option<f64>) -> Result<[f64; 2]> {
    let part = |given: &Option<Number>, part: &str| match given {
        Some(given) => number(study, given, &format!("quantities.{name}.accept.{part}")),
        None => Ok(0.0),
    };
    if let Some([low, high]) = &accept.interval {
        let key = format!("quantities.{name}.accept.interval");
        return Ok([number(study, low, &format!("{key}[0]"))?, number(study, high, &format!("{key}[1]"))?]);
    }
    let reference = reference.unwrap_or(0.0);
    let half =
        (part(&accept.relative, "relative")? * reference.abs()).max(part(&accept.absolute, "absolute")?);
    Ok([reference - half, reference + half])
}

fn number(study: &Study, number: &Number, key: &str) -> Result<f64> {
    number.value(&study.file.values, key).map_err(|fault| study.file.error(fault))
}
