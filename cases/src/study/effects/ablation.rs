//! One effect on and off, everything else alike: what changes, what it costs, and whether the guard speaks.

use super::super::evaluate::{self, Readings, Solved, Tally};
use super::super::kept::Kept;
use super::super::{Onlooker, Study, head};
use super::used;
use crate::error::Result;
use crate::file::SceneFile;
use crate::overrides::Override;
use crate::result::{Ablation, AblationChange, AblationRun, CaseResult, EffectUse};
use crate::scene::Tier;
use crate::scene::effects::NAMES;
use crate::scene::quantity::Norm;
use serde_json::json;
use std::time::Instant;

/// Change that counts as none where a scene declares no tolerance of its own.
const TOLERANCE: f64 = 0.01;

/// The ablations that the scene declares.
pub fn declared(study: &Study) -> Result<Vec<Ablation>> {
    let now = study.file.scene.ablations.iter().filter(|(_, declared)| declared.tiers.contains(&study.tier));
    now.map(|(name, declared)| {
        let file = study.file.with(&study.variants(&declared.variants))?;
        Ok(Ablation {
            id: name.clone(),
            label: declared.label.clone(),
            tolerance: declared.tolerance,
            expected: Some(declared.expect),
            ..ablate(&file, &declared.effect, study.tally)
        })
    })
    .collect()
}

/// Every effect of one scene on and off.
pub struct EffectStudy<'a> {
    file: &'a SceneFile,
    tier: Tier,
}

impl<'a> EffectStudy<'a> {
    /// A study of a scene.
    pub fn new(file: &'a SceneFile, tier: Tier) -> Self {
        Self { file, tier }
    }

    /// Number of parts: the scene itself, and each effect.
    pub fn parts(&self) -> usize {
        1 + NAMES.len()
    }

    /// Runs the scene, then each effect on and off.
    ///
    /// # Errors
    /// The scene itself cannot run; a part that cannot be kept. An effect that cannot be switched is told with the reason.
    pub fn run(&self, onlooker: &dyn Onlooker, kept: &Kept) -> Result<CaseResult> {
        let start = Instant::now();
        let mut result = CaseResult { study_alone: true, ..head(self.file, self.tier) };
        result.command = result.command.replacen("seam run", "seam study effects", 1);
        let id = &self.file.scene.id;
        onlooker.begin(id);
        let solved =
            evaluate::solve(self.file, &Tally::default()).inspect_err(|_| onlooker.done(id, "failed"))?;
        result.effects = used(self.file, &solved);
        onlooker.done(id, &format!("{:.2} s", solved.seconds));
        for effect in NAMES {
            onlooker.begin(effect);
            let key = format!("{effect}-{}", &self.file.hash()[..32]);
            let make = || ablate(self.file, effect, &Tally::default());
            let (ablation, was_kept) = kept.part(&key, make)?;
            let how = match (was_kept, &ablation.failed) {
                (true, _) => "kept".to_owned(),
                (false, Some(_)) => "cannot be switched".to_owned(),
                (false, None) => format!("{:.2} s", ablation.with.seconds + ablation.without.seconds),
            };
            onlooker.done(effect, &how);
            result.ablations.push(ablation);
        }
        result.seconds = start.elapsed().as_secs_f64();
        Ok(result)
    }
}

/// Runs a scene with an effect and without it; what cannot be run is told.
fn ablate(file: &SceneFile, effect: &str, tally: &Tally) -> Ablation {
    let empty = Ablation {
        id: effect.to_owned(),
        label: effect.to_owned(),
        effect: effect.to_owned(),
        tolerance: TOLERANCE,
        ..Ablation::default()
    };
    match both(file, effect, tally) {
        Ok((with, without, changes)) => Ablation { with, without, changes, ..empty },
        Err(error) => Ablation { failed: Some(reason(&error)), ..empty },
    }
}

/// The first line that says something: a diagnostic goes on with the place, which is a list that no file holds.
fn reason(error: &crate::error::Error) -> String {
    match error {
        crate::error::Error::Scene(diagnostic) => diagnostic.fault.message.clone(),
        other => other.to_string(),
    }
}

type Both = (AblationRun, AblationRun, Vec<AblationChange>);

fn both(file: &SceneFile, effect: &str, tally: &Tally) -> Result<Both> {
    let others: Vec<&str> = file.scene.asks_for().into_iter().filter(|name| *name != effect).collect();
    let mut with_list = others.clone();
    with_list.push(effect);
    // What needs the effect goes with it.
    let needs: &[&str] = match effect {
        "inertia" => &["damping", "finite-rotation"],
        "bond-failure" => &["contact", "friction"],
        "contact" => &["friction"],
        _ => &[],
    };
    let without_list: Vec<&str> = others.iter().filter(|name| !needs.contains(name)).copied().collect();
    let (with_file, with) = run(file, &with_list, tally)?;
    let (without_file, without) = run(file, &without_list, tally)?;
    let changes = changes(file, &with.readings, &without.readings);
    Ok((side(&with_file, &with, effect), side(&without_file, &without, effect), changes))
}

fn run(file: &SceneFile, effects: &[&str], tally: &Tally) -> Result<(SceneFile, Solved)> {
    let listed = file.with(&[Override { key: "effects".to_owned(), value: json!(effects) }])?;
    let solved = evaluate::solve(&listed, tally)?;
    Ok((listed, solved))
}

fn side(file: &SceneFile, solved: &Solved, effect: &str) -> AblationRun {
    let found = used(file, solved).into_iter().find(|e| e.name == effect);
    let EffectUse { counter, called_for, indicator, .. } = found.unwrap_or_default();
    let mut work = solved.solution.work;
    work += solved.built.calibration;
    work += solved.built.packing;
    AblationRun { counter, called_for, indicator, work, seconds: solved.seconds }
}

/// Change of each quantity that is read off the scene itself; of each probe where there is none.
fn changes(file: &SceneFile, with: &Readings, without: &Readings) -> Vec<AblationChange> {
    let scene = &file.scene;
    let own = || scene.quantities.values().filter(|q| q.variants.is_empty());
    if own().next().is_none() {
        return scene.probes.keys().map(|probe| of_probe(probe.clone(), probe, with, without)).collect();
    }
    own()
        .map(|quantity| match quantity.norm {
            Some(_) => of_probe(quantity.label.clone(), &quantity.probe, with, without),
            None => {
                let unit = scene.probes[&quantity.probe].read.unit();
                scalar(quantity.label.clone(), unit, with.value(quantity), without.value(quantity))
            }
        })
        .collect()
}

fn of_probe(label: String, probe: &str, with: &Readings, without: &Readings) -> AblationChange {
    match (with.curve(probe), without.curve(probe)) {
        (Some(with), Some(without)) => {
            let change = without.distance(with, Norm::Largest, |_| true);
            AblationChange { label, change, ..AblationChange::default() }
        }
        _ => scalar(label, "", with.scalar(probe), without.scalar(probe)),
    }
}

fn scalar(label: String, unit: &str, with: Option<f64>, without: Option<f64>) -> AblationChange {
    let change = with.zip(without).map(|(a, b)| {
        let size = a.abs().max(b.abs());
        if size > 0.0 { (b - a).abs() / size } else { 0.0 }
    });
    AblationChange { label, unit: unit.to_owned(), with, without, change }
}
