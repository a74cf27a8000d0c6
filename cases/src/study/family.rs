//! Families: the claims of a scene over many settings.

use super::evaluate::{self, distance};
use super::{Study, variants};
use crate::error::Result;
use crate::file::SceneFile;
use crate::overrides::{Override, label};
use crate::result::{Family, Member};
use crate::scene::Tier;
use crate::scene::de::Arrangement;
use crate::scene::study::{Axis, Claim, FamilyDeclaration, Reading, Seeds};
use rayon::prelude::*;
use std::collections::{BTreeMap, BTreeSet};

/// Value of each axis, as text.
type Settings = BTreeMap<String, String>;

/// One [`Family`] per claim; claims over the same family share its runs.
pub fn all(study: &Study) -> Result<Vec<Family>> {
    let scene = &study.file.scene;
    let mut families = Vec::new();
    for (name, declared) in &scene.families {
        let claims: Vec<(&String, &Claim)> = scene.claims.iter().filter(|(_, c)| &c.family == name).collect();
        let members = members(study, declared, &claims)?;
        for (id, claim) in claims {
            families.push(answer(study, id, claim, declared, &members));
        }
    }
    Ok(families)
}

fn answer(
    study: &Study,
    id: &str,
    claim: &Claim,
    declared: &FamilyDeclaration,
    members: &[(Member, BTreeMap<String, f64>)],
) -> Family {
    let axis = |(name, axis): (&String, &Axis)| (name.clone(), labels(axis));
    let own_readings = |(member, errors): &(Member, BTreeMap<String, f64>)| {
        let mut member = member.clone();
        let of = |reading: &String| Some((reading.clone(), *errors.get(&format!("{id}.{reading}"))?));
        member.errors = claim.readings.keys().filter_map(of).collect();
        member
    };
    Family {
        claim: id.to_owned(),
        statement: claim.statement.clone(),
        source: claim.source.clone(),
        own: claim.own,
        bound: claim.bound,
        readings: claim.readings.iter().map(|(name, r)| (name.clone(), r.about.clone())).collect(),
        main_reading: claim.main_reading.clone(),
        axes: declared.axes.iter().map(axis).collect(),
        paper_like: declared
            .paper_like
            .iter()
            .filter(|(name, _)| declared.resolution.as_ref() != Some(name))
            .map(|(name, value)| (name.clone(), label(value)))
            .collect(),
        members: members.iter().map(own_readings).collect(),
        complete: study.tier == Tier::Full,
        no_more_particles_than: claim.no_more_particles_than.clone(),
    }
}

fn labels(axis: &Axis) -> Vec<String> {
    axis.values.iter().map(label).chain(axis.variants.iter().cloned()).collect()
}

/// Runs all members, two or more at a time; the order is that of the blocks.
fn members(
    study: &Study,
    declared: &FamilyDeclaration,
    claims: &[(&String, &Claim)],
) -> Result<Vec<(Member, BTreeMap<String, f64>)>> {
    let (blocks, seeds) = match study.tier {
        Tier::Quick => (&declared.quick, &declared.seeds.quick),
        Tier::Full => (&declared.full, &declared.seeds.full),
    };
    let mut plan: Vec<(Settings, Option<u64>, Result<SceneFile>)> = Vec::new();
    let mut planned = BTreeSet::new();
    for block in blocks {
        for settings in combinations(declared, block) {
            if !planned.insert(settings.clone()) {
                continue;
            }
            let file = study.file.with(&overrides(study.file, declared, &settings));
            match file {
                Ok(file) if is_random(&file, &declared.seeds) => {
                    let key = declared.seeds.key(&file.scene);
                    for &seed in seeds {
                        let change = Override { key: key.clone(), value: seed.into() };
                        plan.push((settings.clone(), Some(seed), file.with(&[change])));
                    }
                }
                file => plan.push((settings, None, file)),
            }
        }
    }
    Ok(plan
        .into_par_iter()
        .map(|(settings, seed, file)| member(study, claims, settings, seed, file))
        .collect())
}

fn is_random(file: &SceneFile, seeds: &Seeds) -> bool {
    seeds.particles(&file.scene).is_some_and(|de| de.arrangement == Arrangement::Random)
}

/// All combinations of the listed values; axes that are not listed keep the paper-like value.
fn combinations(
    declared: &FamilyDeclaration,
    block: &BTreeMap<String, Vec<serde_json::Value>>,
) -> Vec<Settings> {
    let like = declared.paper_like.iter().map(|(axis, value)| (axis.clone(), label(value))).collect();
    let mut all: Vec<Settings> = vec![like];
    for (axis, values) in block {
        let one_more = |settings: &Settings| -> Vec<Settings> {
            let with = |value: &serde_json::Value| {
                let mut settings = settings.clone();
                settings.insert(axis.clone(), label(value));
                settings
            };
            values.iter().map(with).collect()
        };
        all = all.iter().flat_map(one_more).collect();
    }
    all
}

fn overrides(file: &SceneFile, declared: &FamilyDeclaration, settings: &Settings) -> Vec<Override> {
    let mut changes = Vec::new();
    for (name, axis) in &declared.axes {
        let setting = &settings[name];
        match (&axis.key, axis.values.iter().find(|value| &label(value) == setting)) {
            (Some(key), Some(value)) => changes.push(Override { key: key.clone(), value: value.clone() }),
            _ => changes.extend(variants(file, std::slice::from_ref(setting))),
        }
    }
    changes
}

/// Runs one member; what fails becomes its reason.
fn member(
    study: &Study,
    claims: &[(&String, &Claim)],
    settings: Settings,
    seed: Option<u64>,
    file: Result<SceneFile>,
) -> (Member, BTreeMap<String, f64>) {
    let mut member = Member { settings, seed, ..Member::default() };
    let errors = file.and_then(|file| errors(study, claims, &file, &mut member));
    match errors {
        Ok(errors) => (member, errors),
        Err(error) => {
            member.failed = Some(error.to_string());
            (member, BTreeMap::new())
        }
    }
}

/// Error under each reading, by `claim.reading`.
fn errors(
    study: &Study,
    claims: &[(&String, &Claim)],
    file: &SceneFile,
    member: &mut Member,
) -> Result<BTreeMap<String, f64>> {
    let reference = study.library.of(file, study.tally)?;
    let solved = evaluate::solve(file, study.tally)?;
    member.particles = solved.built.particles();
    member.work = solved.solution.work;
    member.seconds = solved.seconds;
    let mut errors = BTreeMap::new();
    for (id, claim) in claims {
        for (name, Reading { probe, zone, norm, .. }) in &claim.readings {
            member.u = member.u.max(reference.curves.get(probe).map_or(0.0, |(_, u)| *u));
            let distance = distance(file, &solved.readings, &reference, (probe.as_str(), *norm, *zone))
                .ok_or_else(|| study.error(format!("reading '{name}': its zone holds no station")))?;
            errors.insert(format!("{id}.{name}"), distance.abs());
        }
    }
    Ok(errors)
}
