//! Claims over families of settings: verdict, share, and what decides.

pub mod decides;
pub mod meaning;
pub mod particles;
mod reason;
pub mod settings;

use crate::verdict::ClaimVerdict;
use decides::AxisEffect;
use particles::Needed;
use schemars::JsonSchema;
use seam_cases::result::Family;
use serde::{Deserialize, Serialize};
use settings::{Outcome, Setting};

/// How a family fares under one reading of the metric.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ReadingResult {
    /// Id of the reading.
    pub id: String,
    /// What it means.
    pub meaning: String,
    /// Whether it is the reading that the claim most likely meant.
    pub main: bool,
    /// Share of the settings that meet the bound.
    pub share: f64,
    /// Settings whose upper bound meets it.
    pub meets: usize,
    /// Settings whose lower bound exceeds it.
    pub fails: usize,
    /// Settings the evidence does not decide, or that could not be run.
    pub unclear: usize,
    /// Smallest and largest mean error of a setting, as fractions; `None` if none was measured.
    pub errors: Option<[f64; 2]>,
}

/// Judgement of a claim, before it is compared with the recorded one.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The verdict.
    pub verdict: ClaimVerdict,
    /// Share of the settings that meet the bound under the main reading.
    pub share: f64,
    /// Why, in a few sentences.
    pub reason: String,
    /// Each reading, the main one first.
    pub readings: Vec<ReadingResult>,
    /// Number of settings.
    pub settings: usize,
    /// Axes, the one that decides first.
    pub decides: Vec<AxisEffect>,
    /// What the paper-like setting needs, where there is one.
    pub needed: Option<Needed>,
    /// Largest number of particles a setting may have.
    pub most_particles: Option<f64>,
    /// What could not be measured; the verdict is then undetermined.
    pub unmeasured: Option<String>,
}

/// Judges a claim over its family. `paper` is the family whose paper-like setting limits the number of
/// particles, where this claim names one.
pub fn judge(family: &Family, paper: Option<&Family>) -> Judgement {
    let settings = settings::settings(family);
    let limit = paper.and_then(particles::needed);
    let most_particles = limit.map(Needed::particles);
    let readings = read(family, &settings, most_particles);
    let unmeasured = find_unmeasured(family, &settings, limit);
    let verdict = if unmeasured.is_some() { ClaimVerdict::Undetermined } else { verdict(&readings) };
    let mut judgement = Judgement {
        verdict,
        share: readings.iter().find(|r| r.main).map_or(0.0, |r| r.share),
        reason: String::new(),
        decides: decides::ranked(family, &settings, most_particles),
        settings: settings.len(),
        readings,
        needed: particles::needed(family),
        most_particles,
        unmeasured,
    };
    judgement.reason = reason::of(family, &settings, limit, &judgement);
    judgement
}

fn read(family: &Family, settings: &[Setting<'_>], most_particles: Option<f64>) -> Vec<ReadingResult> {
    let mut readings: Vec<ReadingResult> = family
        .readings
        .iter()
        .map(|(id, meaning)| {
            let count = |wanted: Outcome| {
                let is = |s: &&Setting<'_>| s.outcome(id, family.bound, most_particles) == wanted;
                settings.iter().filter(is).count()
            };
            let meets = count(Outcome::Meets);
            let means = settings.iter().filter_map(|s| s.error(id)).map(|e| e.mean);
            ReadingResult {
                id: id.clone(),
                meaning: meaning.clone(),
                main: *id == family.main_reading,
                share: if settings.is_empty() { 0.0 } else { meets as f64 / settings.len() as f64 },
                meets,
                fails: count(Outcome::Fails),
                unclear: count(Outcome::Unclear),
                errors: means.fold(None, |range: Option<[f64; 2]>, e| {
                    Some(range.map_or([e, e], |[lo, hi]| [lo.min(e), hi.max(e)]))
                }),
            }
        })
        .collect();
    readings.sort_by_key(|r| !r.main);
    readings
}

fn verdict(readings: &[ReadingResult]) -> ClaimVerdict {
    let sum = |of: fn(&ReadingResult) -> usize| readings.iter().map(of).sum::<usize>();
    match (sum(|r| r.meets), sum(|r| r.fails), sum(|r| r.unclear)) {
        (1.., 0, 0) => ClaimVerdict::Supported,
        (0, 1.., 0) => ClaimVerdict::Contradicted,
        (1.., 1.., _) => ClaimVerdict::Conditional,
        _ => ClaimVerdict::Undetermined,
    }
}

fn find_unmeasured(family: &Family, settings: &[Setting<'_>], limit: Option<Needed>) -> Option<String> {
    if settings.is_empty() {
        return Some("the family has no members".to_owned());
    }
    if let Some(why) = family.members.iter().map(|m| m.failed.as_ref()).collect::<Option<Vec<_>>>() {
        return Some(format!("no member of the family could be run: {}", why[0]));
    }
    if !family.readings.contains_key(&family.main_reading) {
        return Some(format!("the main reading '{}' is not among the readings", family.main_reading));
    }
    if !(family.bound.is_finite() && family.bound > 0.0) {
        return Some(format!("the bound {} is no positive number", family.bound));
    }
    if let Some((member, reading)) = settings::unmeasured(family) {
        let setting: Vec<String> = member.settings.iter().map(|(k, v)| format!("{k} = {v}")).collect();
        return Some(format!("no finite error under reading '{reading}' for {}", setting.join(", ")));
    }
    match (&family.no_more_particles_than, limit) {
        (Some(claim), None) => Some(format!("the paper-like setting of '{claim}' was not measured")),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
