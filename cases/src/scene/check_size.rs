//! Declared limits, before any memory is taken: a small file must not ask for a huge model.

use super::Scene;
use super::body::{Body, Cuboid, Method};
use super::check::Checked;
use super::de::De;
use super::study::FamilyDeclaration;
use crate::error::Fault;
use crate::expression::Values;
use std::collections::BTreeMap;

/// Checks the sizes that the text of a scene tells. Meshes and tables from files are counted once they are read.
///
/// # Errors
/// The first size beyond its limit, with its key.
pub fn check(scene: &Scene, values: &Values) -> Checked {
    for (name, body) in &scene.bodies {
        let key = format!("bodies.{name}");
        match (body.method, &body.fe, &body.de, &body.cuboid) {
            (Method::Fe, ..) => nodes(scene, body, values, &key)?,
            (Method::De, _, Some(de), Some(cuboid)) => particles(scene, de, cuboid, values, &key)?,
            _ => {}
        }
    }
    for (name, switch) in &scene.switches {
        if let Some(cuboid) = &switch.cuboid {
            particles(scene, &switch.de, cuboid, values, &format!("switches.{name}"))?;
        }
    }
    let limit = scene.limits.stations;
    for (name, probe) in &scene.probes {
        let intervals = probe.line.as_ref().map_or(0, |line| line.intervals);
        within(intervals as f64, limit, "stations", &format!("probes.{name}.line.intervals"))?;
    }
    if let Some(dynamics) = &scene.dynamics {
        let outputs = dynamics.outputs.count(values, 1, "dynamics.outputs")?;
        within(outputs as f64, limit, "stations", "dynamics.outputs")?;
    }
    scene.families.iter().try_for_each(|(name, family)| members(scene, family, &format!("families.{name}")))
}

fn within(count: f64, limit: usize, what: &str, key: &str) -> Checked {
    // Also refuses what is no number.
    if count <= limit as f64 {
        return Ok(());
    }
    let message = format!("{count:.3e} {what} are more than the limit of {limit}");
    let mend = format!("use fewer, or raise limits.{what} if the memory is there");
    Err(Fault::new(key, message, mend))
}

fn nodes(scene: &Scene, body: &Body, values: &Values, key: &str) -> Checked {
    let Some(fe) = &body.fe else { return Ok(()) };
    let mut nodes = 1.0;
    for (i, number) in fe.divisions.iter().take(scene.hypothesis.space().dim()).enumerate() {
        nodes *= 1.0 + number.count(values, 1, &format!("{key}.fe.divisions[{i}]"))? as f64;
    }
    within(nodes, scene.limits.nodes, "nodes", &format!("{key}.fe.divisions"))
}

/// A cubic cell per particle: lattices and packings have no fewer by more than their faces.
fn particles(scene: &Scene, de: &De, cuboid: &Cuboid, values: &Values, key: &str) -> Checked {
    let rows_key = format!("{key}.de.rows");
    let rows = de.rows.count(values, 1, &rows_key)? as f64;
    let mut sides = Vec::new();
    for i in 0..scene.hypothesis.space().dim() {
        let [low, high] = [(&cuboid.min, "min"), (&cuboid.max, "max")]
            .map(|(corner, end)| corner[i].value(values, &format!("{key}.box.{end}[{i}]")));
        sides.push(high? - low?);
    }
    let spacing = sides[1] / rows;
    let count = sides.iter().map(|side| side / spacing).product();
    within(count, scene.limits.particles, "particles", &rows_key)
}

fn members(scene: &Scene, family: &FamilyDeclaration, key: &str) -> Checked {
    for (tier, blocks, seeds) in
        [("quick", &family.quick, &family.seeds.quick), ("full", &family.full, &family.seeds.full)]
    {
        let of = |block: &BTreeMap<String, Vec<serde_json::Value>>| {
            block.values().map(|values| values.len() as f64).product::<f64>()
        };
        let count = blocks.iter().map(of).sum::<f64>() * seeds.len().max(1) as f64;
        within(count, scene.limits.members, "members", &format!("{key}.{tier}"))?;
    }
    Ok(())
}
