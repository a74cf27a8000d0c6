//! Settings of a cost study, made out of a scene by changing one thing at a time.

use super::levels::text;
use crate::file::SceneFile;
use crate::overrides::Override;
use crate::scene::body::{Body, Method};
use crate::scene::connection::TieMethod;
use crate::scene::de::{Arrangement, De, Section, Skin};
use crate::scene::dynamics::{Dynamics, Rotations, Stepping};
use crate::scene::fe::{Fe, Formulation};
use crate::scene::number::Number;
use crate::scene::{Hypothesis, Scene};
use serde::Serialize;
use serde_json::{Value, json};

/// A legend and what makes the setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Setting {
    /// Legend.
    pub name: String,
    /// Changes to the scene.
    pub changes: Vec<Override>,
}

/// Whole steps of the particles per step of the elements that a study of two rates tries, as shares of the critical step.
const FINE_SHARES: [f64; 3] = [0.8, 0.4, 0.2];

/// The scene as it is and everything one change away from it.
pub fn generated(file: &SceneFile) -> Vec<Setting> {
    let scene = &file.scene;
    let mut all = vec![setting("as given", Vec::new())];
    all.extend(all_elements(scene));
    all.extend(all_particles(scene));
    all.extend(from_the_start(scene));
    all.extend(formulations(scene));
    all.extend(skins(scene));
    all.extend(sections(scene));
    all.extend(ties(scene));
    all.extend(schemes(scene));
    all
}

fn setting(name: impl Into<String>, changes: Vec<Override>) -> Setting {
    Setting { name: name.into(), changes }
}

fn change(key: impl Into<String>, value: impl Serialize) -> Override {
    Override { key: key.into(), value: serde_json::to_value(value).unwrap_or(Value::Null) }
}

/// The same value of one key in every section of particles.
fn in_particles(scene: &Scene, key: &str, value: impl Serialize + Copy) -> Vec<Override> {
    particles(scene).map(|(table, _)| change(format!("{table}.{key}"), value)).collect()
}

/// Every section `de` that counts, with its table.
pub fn particles(scene: &Scene) -> impl Iterator<Item = (String, &De)> {
    let bodies = scene.bodies.iter().filter(|(_, body)| body.method == Method::De);
    let bodies = bodies.filter_map(|(name, body)| Some((format!("bodies.{name}.de"), body.de.as_ref()?)));
    bodies.chain(scene.switches.iter().map(|(name, switch)| (format!("switches.{name}.de"), &switch.de)))
}

/// Particles become elements as large as they were, and nothing is switched. `None` where elements cannot do what the scene
/// asks: turn by any angle, or break.
pub fn all_elements(scene: &Scene) -> Option<Setting> {
    let turns = scene.dynamics.as_ref().is_some_and(|d| d.rotations == Rotations::Finite);
    if turns || scene.cracking.is_some() || !scene.failure.is_empty() {
        return None;
    }
    let discrete: Vec<_> = scene.bodies.iter().filter(|(_, body)| body.method == Method::De).collect();
    if discrete.is_empty() && scene.switches.is_empty() {
        return None;
    }
    let mut changes = Vec::new();
    for (name, body) in discrete {
        changes.push(change(format!("bodies.{name}.method"), Method::Fe));
        if body.fe.is_none() {
            let formulation = scene
                .bodies
                .values()
                .find_map(|b| b.fe.as_ref())
                .map_or_else(Formulation::default, |fe| fe.formulation);
            let fe = Fe {
                divisions: cells(body)?,
                grading: Vec::new(),
                formulation,
                distortion: None,
                refinement: None,
            };
            changes.push(change(format!("bodies.{name}.fe"), fe));
        }
    }
    changes.extend(scene.switches.keys().map(|name| change(format!("switches.{name}.enabled"), false)));
    Some(setting("all finite elements", changes))
}

/// As many cells along each side as particles fit: `round(L n/H)` for n rows across the height H.
fn cells(body: &Body) -> Option<Vec<Number>> {
    let (de, shape) = (body.de.as_ref()?, body.cuboid.as_ref()?);
    let side = |i: usize| Some(format!("(({})-({}))", text(shape.max.get(i)?), text(shape.min.get(i)?)));
    let height = side(1)?;
    let along = |i: usize| number(&format!("max(1, round({}*({})/{height}))", side(i)?, text(&de.rows)));
    (0..shape.max.len().min(shape.min.len())).map(along).collect()
}

fn number(text: &str) -> Option<Number> {
    serde_json::from_value(json!(text)).ok()
}

/// Elements become particles like those the scene has elsewhere, with the same spacing.
fn all_particles(scene: &Scene) -> Option<Setting> {
    let continuous: Vec<_> = scene.bodies.iter().filter(|(_, body)| body.method == Method::Fe).collect();
    if continuous.is_empty() {
        return None;
    }
    let mut changes = Vec::new();
    for (name, body) in continuous {
        changes.push(change(format!("bodies.{name}.method"), Method::De));
        if body.de.is_none() {
            let (like, template) = template(scene)?;
            let [own, theirs] = [height(body)?, height(like)?];
            let rows = number(&format!("max(1, round(({})*{own}/{theirs}))", text(&template.rows)))?;
            changes.push(change(format!("bodies.{name}.de"), without_null(&De { rows, ..template.clone() })));
        }
    }
    changes.extend(scene.switches.keys().map(|name| change(format!("switches.{name}.enabled"), false)));
    Some(setting("all particles", changes))
}

/// Particles to copy, and the body whose height their rows count across.
fn template(scene: &Scene) -> Option<(&Body, &De)> {
    let of_bodies = scene.bodies.values().find_map(|body| Some((body, body.de.as_ref()?)));
    of_bodies.or_else(|| scene.switches.values().find_map(|s| Some((scene.bodies.get(&s.body)?, &s.de))))
}

fn height(body: &Body) -> Option<String> {
    let shape = body.cuboid.as_ref()?;
    Some(format!("(({})-({}))", text(shape.max.get(1)?), text(shape.min.get(1)?)))
}

/// TOML has no null: what is not given is left out.
fn without_null(de: &De) -> Value {
    fn clean(value: Value) -> Value {
        match value {
            Value::Object(members) => {
                members.into_iter().filter(|(_, v)| !v.is_null()).map(|(k, v)| (k, clean(v))).collect()
            }
            other => other,
        }
    }
    clean(serde_json::to_value(de).unwrap_or(Value::Null))
}

/// Switches with a given place happen before the first step.
fn from_the_start(scene: &Scene) -> Option<Setting> {
    let mut changes = Vec::new();
    for (name, switch) in &scene.switches {
        match (&switch.at_s, &switch.at_load) {
            (Some(_), _) => changes.push(change(format!("switches.{name}.at_s"), 0.0)),
            (_, Some(_)) => changes.push(change(format!("switches.{name}.at_load"), 0.0)),
            // A criterion needs stress before it can find its place.
            (None, None) => return None,
        }
    }
    (!changes.is_empty()).then(|| setting("coupled from the start", changes))
}

fn formulations(scene: &Scene) -> Vec<Setting> {
    let bodies: Vec<(&String, Formulation)> = scene
        .bodies
        .iter()
        .filter(|(_, body)| body.method == Method::Fe)
        .filter_map(|(name, body)| Some((name, body.fe.as_ref()?.formulation)))
        .collect();
    let kinds = [
        (Formulation::Plain, "plain elements"),
        (Formulation::Incompatible, "elements with incompatible modes"),
        (Formulation::BBar, "B-bar elements"),
    ];
    // B-bar does not exist in plane stress, which does not lock by volume.
    let exists = |kind: Formulation| kind != Formulation::BBar || scene.hypothesis != Hypothesis::PlaneStress;
    let other = kinds.into_iter().filter(|(kind, _)| exists(*kind));
    let other = other.filter(|(kind, _)| bodies.iter().any(|(_, given)| given != kind));
    other
        .map(|(kind, name)| {
            let of =
                |(body, _): &(&String, Formulation)| change(format!("bodies.{body}.fe.formulation"), kind);
            setting(name, bodies.iter().map(of).collect())
        })
        .collect()
}

fn skins(scene: &Scene) -> Vec<Setting> {
    let kinds = [
        (Skin::Full, "full skin bonds"),
        (Skin::Weighted, "half skin bonds"),
        (Skin::SecondMoment, "second-moment skin bonds"),
    ];
    let other = kinds.into_iter().filter(|(kind, _)| particles(scene).any(|(_, de)| de.skin != *kind));
    other.map(|(kind, name)| setting(name, in_particles(scene, "skin", kind))).collect()
}

fn sections(scene: &Scene) -> Vec<Setting> {
    let kinds =
        [(Section::Uniform, "one bond radius"), (Section::Voronoi, "bond sections from Voronoi facets")];
    let other = kinds.into_iter().filter(|(kind, _)| particles(scene).any(|(_, de)| de.section != *kind));
    other.map(|(kind, name)| setting(name, in_particles(scene, "section", kind))).collect()
}

fn ties(scene: &Scene) -> Vec<Setting> {
    let methods = || {
        let bodies = scene.ties.iter().map(|(name, tie)| (format!("ties.{name}"), tie.method));
        bodies.chain(scene.switches.iter().map(|(name, s)| (format!("switches.{name}.ties"), s.ties.method)))
    };
    let kinds = [(TieMethod::Pointwise, "pointwise ties"), (TieMethod::Mortar, "mortar ties")];
    let other = kinds.into_iter().filter(|(kind, _)| methods().any(|(_, given)| given != *kind));
    other
        .map(|(kind, name)| {
            setting(name, methods().map(|(key, _)| change(format!("{key}.method"), kind)).collect())
        })
        .collect()
}

/// Other ways through time, and how finely two rates divide a step.
fn schemes(scene: &Scene) -> Vec<Setting> {
    // Only explicit steps turn particles by any angle, and only they let bonds fail.
    let free = |d: &&Dynamics| d.rotations == Rotations::Small && scene.failure.is_empty();
    let Some(dynamics) = scene.dynamics.as_ref().filter(free) else {
        return Vec::new();
    };
    let step = dynamics
        .step_s
        .as_ref()
        .map_or_else(|| format!("({})/({})", text(&dynamics.end_s), text(&dynamics.outputs)), text);
    let plain = |stepping: Stepping, keys: Vec<Override>| {
        let mut changes = vec![change("dynamics.stepping", stepping)];
        let cleared = ["step_share", "fine_s", "fine_share", "alpha", "method"];
        changes.extend(cleared.map(|key| change(format!("dynamics.{key}"), "none")));
        changes.extend(keys);
        changes
    };
    let (step_s, damping) = (change("dynamics.step_s", &step), change("dynamics.damping", "none"));
    let mut all = Vec::new();
    if dynamics.stepping != Stepping::QuasiStatic {
        let changes = plain(Stepping::QuasiStatic, vec![step_s.clone(), damping.clone()]);
        all.push(setting("without inertia", changes));
    }
    if dynamics.stepping != Stepping::Implicit {
        all.push(setting("implicit", plain(Stepping::Implicit, vec![step_s.clone()])));
    }
    if dynamics.stepping != Stepping::Explicit {
        let keys = vec![change("dynamics.step_s", "none"), change("dynamics.step_share", 0.8)];
        all.push(setting("explicit", plain(Stepping::Explicit, keys)));
    }
    if particles(scene).next().is_some() && scene.bodies.values().any(|body| body.method == Method::Fe) {
        for share in FINE_SHARES {
            let keys = vec![step_s.clone(), damping.clone(), change("dynamics.fine_share", share)];
            all.push(setting(
                format!("two rates, particles at {share} of their critical step"),
                plain(Stepping::TwoRates, keys),
            ));
        }
    }
    all
}

/// Changes that make other packings of a setting, one per seed; none where nothing is random.
pub fn packings(scene: &Scene, seeds: u64) -> Vec<Vec<Override>> {
    let random: Vec<(String, bool)> = particles(scene)
        .filter(|(_, de)| de.arrangement == Arrangement::Random)
        .map(|(table, de)| (table, de.packing.is_some()))
        .collect();
    if random.is_empty() {
        return Vec::new();
    }
    let of = |seed: u64| {
        let one = |(table, given): &(String, bool)| match given {
            true => change(format!("{table}.packing.seed"), seed),
            false => change(format!("{table}.packing"), json!({ "seed": seed })),
        };
        random.iter().map(one).collect()
    };
    (1..=seeds).map(of).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::catalogue;
    use crate::procedures;

    /// Every setting that is made for a scene of the catalogue reads as a scene, or is refused for a reason of the scene's own.
    #[test]
    fn settings_of_the_catalogue_read() {
        let mut made = 0;
        for id in catalogue::ids() {
            let file = catalogue::case(id, &[]).unwrap();
            if file.scene.procedure != procedures::names().next().unwrap() {
                continue;
            }
            for setting in generated(&file) {
                let read = file.with(&setting.changes);
                assert!(read.is_ok(), "{id}, {}: {}", setting.name, read.err().unwrap());
                made += 1;
            }
        }
        assert!(made > 50, "{made}");
    }

    #[test]
    fn one_thing_changes_at_a_time() {
        let beam = catalogue::case("clamped-beam-rotation", &[]).unwrap();
        let all = generated(&beam);
        let of = |name: &str| {
            let setting = all.iter().find(|s| s.name == name).unwrap_or_else(|| panic!("no '{name}'"));
            beam.with(&setting.changes).unwrap().scene
        };
        assert!(of("all finite elements").bodies.values().all(|b| b.method == Method::Fe));
        assert!(of("all particles").bodies.values().all(|b| b.method == Method::De));
        assert_eq!(of("full skin bonds").bodies["middle"].de.as_ref().unwrap().skin, Skin::Full);
        assert_eq!(of("plain elements").bodies["left"].fe.as_ref().unwrap().formulation, Formulation::Plain);
        assert!(!all.iter().any(|s| s.name == "second-moment skin bonds"), "the scene has them already");
    }
}
