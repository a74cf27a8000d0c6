//! Running a scene: the scene itself, then its studies.

mod budget;
mod convergence;
pub mod cost;
mod digest;
pub mod effects;
mod evaluate;
mod family;
mod growth;
mod kept;
mod peer;
mod picture;
mod plots;
mod quantities;
mod reference;
mod richardson;
mod sketch;
pub mod stability;

use crate::checkpoint::Checkpoints;
use crate::error::{Error, Result};
use crate::file::SceneFile;
use crate::folder::Folder;
use crate::overrides::{Override, label};
use crate::result::{self, CaseResult};
use crate::scene::Tier;
use crate::scene::study::Levels;
use evaluate::{Solved, Tally};
use reference::Library;
use seam_solver::model::Model;
use seam_solver::solve::statics::Solution;
use serde_json::Value;
use std::collections::BTreeMap;
use std::time::Instant;

pub use kept::Kept;

/// A case that has run, with the fields of its scene for ParaView.
pub struct Run {
    /// What was measured.
    pub result: CaseResult,
    /// The model of the scene and its solution; `None` for procedures without a scene.
    pub fields: Option<(Model, Solution)>,
}

/// Runs a scene with all its studies; checkpoints are of its own run in time.
///
/// # Errors
/// A fault of the scene or a refusal of the solver, outside of families and cost diagrams, whose
/// members may fail one by one.
pub fn run(file: &SceneFile, tier: Tier, checkpoints: &Checkpoints) -> Result<Run> {
    let start = Instant::now();
    let tally = Tally::default();
    let library = Library::default();
    let (peers, peer_notes) = peer::all(file)?;
    let study = Study { file, tier, tally: &tally, library: &library, peers: &peers };
    let solved = evaluate::solve_keeping(file, &tally, checkpoints)?;
    let mut result = head(file, tier);
    result.effects = effects::used(file, &solved);
    result.notes = [solved.built.notes.clone(), solved.solution.notes.clone(), peer_notes].concat();
    let convergence = convergence::all(&study)?;
    let (quantities, missing) = quantities::all(&study, &solved, &convergence)?;
    result.quantities = quantities;
    result.effects.extend(missing);
    result.convergence = convergence.into_values().map(|study| study.result).collect();
    result.curves = plots::all(&study, &solved)?;
    result.families = family::all(&study)?;
    result.budgets = budget::all(&study)?;
    result.costs = cost::all(&study)?;
    result.growths = growth::all(&study)?;
    result.ablations = effects::declared(&study)?;
    result.pictures = picture::all(file, &solved);
    result.switches = solved.course.as_ref().map_or_else(Vec::new, |course| course.switches.records());
    result.work = tally.total();
    result.seconds = start.elapsed().as_secs_f64();
    let Solved { built, solution, .. } = solved;
    Ok(Run { result, fields: Some((built.model, solution)) })
}

/// Who looks on while a study runs.
pub trait Onlooker {
    /// A setting begins.
    fn begin(&self, what: &str);
    /// It is done, and how.
    fn done(&self, what: &str, how: &str);
}

/// Builds, solves and reads a scene once.
///
/// # Errors
/// A fault of the scene, or what the solver refuses.
pub fn once(file: &SceneFile) -> Result<()> {
    evaluate::solve(file, &Tally::default()).map(|_| ())
}

/// What every study needs.
struct Study<'a> {
    file: &'a SceneFile,
    tier: Tier,
    tally: &'a Tally,
    library: &'a Library,
    /// What other codes made of the scene.
    peers: &'a BTreeMap<String, peer::Answer>,
}

impl Study<'_> {
    /// Overrides of some variants, in order.
    fn variants(&self, names: &[String]) -> Vec<Override> {
        variants(self.file, names)
    }

    fn error(&self, message: impl Into<String>) -> Error {
        Error::Study { case: self.file.scene.id.clone(), message: message.into() }
    }
}

/// Overrides of some variants of a scene, in order.
pub fn variants(file: &SceneFile, names: &[String]) -> Vec<Override> {
    let of = |name: &String| file.scene.variants[name].iter();
    names
        .iter()
        .flat_map(of)
        .map(|(key, value)| Override { key: key.clone(), value: value.clone() })
        .collect()
}

fn at_level(levels: &Levels, value: &Value) -> Override {
    Override { key: levels.key.clone(), value: value.clone() }
}

/// What a result says about its scene before anything has run.
pub fn head(file: &SceneFile, tier: Tier) -> CaseResult {
    let scene = &file.scene;
    let parameter = |(name, parameter): (&String, &crate::scene::parameter::Parameter)| result::Parameter {
        name: name.clone(),
        value: file.values[name],
        unit: parameter.unit.clone(),
        about: parameter.about.clone(),
    };
    CaseResult {
        schema: result::SCHEMA.to_owned(),
        id: scene.id.clone(),
        title: scene.title.clone(),
        purpose: scene.purpose.clone(),
        citation: scene.citation.clone(),
        tags: scene.tags.clone(),
        tier: tier.name().to_owned(),
        scene_hash: file.hash(),
        command: command(file, tier),
        parameters: scene.parameters.iter().map(parameter).collect(),
        expected_failures: scene.expected_failures.clone(),
        ..CaseResult::default()
    }
}

/// The command that runs just this case again.
fn command(file: &SceneFile, tier: Tier) -> String {
    let what = match file.folder {
        Folder::Catalogue => file.scene.id.as_str(),
        Folder::Disk(_) => file.name(),
    };
    let quote = |word: &str| {
        let plain = |c: char| c.is_alphanumeric() || "._-/=:".contains(c);
        if word.chars().all(plain) { word.to_owned() } else { format!("'{}'", word.replace('\'', r"'\''")) }
    };
    let sets: String = file.overrides().iter().map(|o| format!(" --set {}", quote(o))).collect();
    format!("seam run {} --tier {}{sets}", quote(what), tier.name())
}

/// A level as a number: how many cells.
fn resolution(value: &Value) -> Option<f64> {
    value.as_f64().filter(|v| *v > 0.0)
}

/// `parameters.rows=8` → `rows = 8`.
fn level_name(levels: &Levels, value: &Value) -> String {
    format!("{} = {}", levels.key.rsplit('.').next().unwrap_or(&levels.key), label(value))
}
