//! Studies of a scene: refinement, reference model, families, claims, budgets, costs.
//!
//! All of them run the scene again with some keys set to other values, exactly as
//! `--set key.path=value` does.

use super::Scene;
use super::Tier;
use super::de::De;
use super::number::Number;
use super::quantity::{Norm, Zone};
use crate::result::{Cheaper, Expected};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use serde_json::Value;
use std::collections::BTreeMap;

/// `[variants.NAME]`: keys and the values they are set to.
pub type Variant = BTreeMap<String, Value>;

/// One key at several values, coarse to fine.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Levels {
    /// Key that is set, e.g. `parameters.rows`.
    pub key: String,
    /// Its values.
    pub values: Vec<Value>,
}

/// `[convergence.NAME]`: a quantity at several levels.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Convergence {
    /// Name of the quantity.
    pub quantity: String,
    /// What is refined.
    pub levels: Levels,
    /// Size of a cell at a level, in m.
    pub cell_m: Number,
    /// Order that theory gives.
    pub formal_order: f64,
    /// Half width of the accepted interval around it; without it the order is shown and not judged.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub tolerance: Option<f64>,
}

/// `[reference]`: the model that quantities without a given reference value are compared with.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ReferenceModel {
    /// What it is.
    pub about: String,
    /// Variants that make it out of the scene.
    pub variants: Vec<String>,
    /// Refinement: three levels or more are extrapolated, with the grid convergence index as their
    /// uncertainty; one level is taken as it is.
    pub levels: Levels,
    /// Order that theory gives.
    pub formal_order: f64,
}

/// `[families.NAME]`: settings that claims are checked over.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct FamilyDeclaration {
    /// What may vary.
    pub axes: BTreeMap<String, Axis>,
    /// One value of every axis: the setting a paper most likely used, and the value of each axis
    /// that a block does not mention.
    pub paper_like: BTreeMap<String, Value>,
    /// The axis that sets the number of particles: what the paper-like setting is looked at over, so that
    /// "at the same cost" has a number.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub resolution: Option<String>,
    /// Blocks of the full tier: all combinations of the listed values; members that occur twice run once.
    pub full: Vec<BTreeMap<String, Vec<Value>>>,
    /// Blocks of the quick tier: a subset of the full ones.
    pub quick: Vec<BTreeMap<String, Vec<Value>>>,
    /// Seeds of members with a random packing.
    pub seeds: Seeds,
}

/// `axes.NAME`: a key with its values, or a choice between variants.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Axis {
    /// Key that is set.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub key: Option<String>,
    /// Its values.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub values: Vec<Value>,
    /// Or names of variants.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<String>,
}

/// Seeds of the random members of a family.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Seeds {
    /// The body, or the switch, whose particles may be packed at random.
    pub body: String,
    /// Seeds of the full tier, at least ten for a verdict.
    pub full: Vec<u64>,
    /// Seeds of the quick tier.
    pub quick: Vec<u64>,
}

impl Seeds {
    /// The key that is set to a seed.
    pub fn key(&self, scene: &Scene) -> String {
        let table = if scene.bodies.contains_key(&self.body) { "bodies" } else { "switches" };
        format!("{table}.{}.de.packing.seed", self.body)
    }

    /// The particles that may be packed at random; `None` where none are.
    pub fn particles<'a>(&self, scene: &'a Scene) -> Option<&'a De> {
        match scene.bodies.get(&self.body) {
            Some(body) => body.de.as_ref(),
            None => scene.switches.get(&self.body).map(|switch| &switch.de),
        }
    }
}

/// `[claims.NAME]`: a sentence with a bound.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Claim {
    /// The claim in words.
    pub statement: String,
    /// Paper, figure, sentence.
    pub source: String,
    /// Whether it is Seam's own claim, which must be supported.
    #[serde(default)]
    pub own: bool,
    /// Largest allowed error, as a fraction.
    pub bound: f64,
    /// Name of the family.
    pub family: String,
    /// "At the same cost": members count only up to the number of particles at which the paper-like
    /// setting meets the bound of this other claim.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub no_more_particles_than: Option<String>,
    /// The reading the claim most likely meant.
    pub main_reading: String,
    /// Every sensible reading of the error.
    pub readings: BTreeMap<String, Reading>,
}

/// `readings.NAME`: one way to measure the distance of a curve from the reference model.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Reading {
    /// What it means, in words.
    pub about: String,
    /// Name of a probe along a line or over time.
    pub probe: String,
    /// Where.
    pub zone: Zone,
    /// How.
    pub norm: Norm,
}

/// `[budgets.NAME]`: signed parts of the error of a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct BudgetDeclaration {
    /// Caption.
    pub title: String,
    /// When it is computed.
    #[serde(default = "super::both_tiers")]
    pub tiers: Vec<Tier>,
    /// Name of the quantity; its reference is the whole.
    pub quantity: String,
    /// Variants of the run whose error is split.
    #[serde(default)]
    pub of: Vec<String>,
    /// The parts; what they leave is called unexplained.
    pub parts: Vec<Part>,
}

/// One part of a budget: the difference between two runs that differ in one thing.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Part {
    /// Short name.
    pub name: String,
    /// What is changed, in words.
    pub how: String,
    /// Variants of the first run; empty and `from_reference` is the converged reference.
    #[serde(default)]
    pub from: Vec<String>,
    /// Take the converged reference as the first run.
    #[serde(default)]
    pub from_reference: bool,
    /// Variants of the second run.
    #[serde(default)]
    pub to: Vec<String>,
    /// Repeat both runs for each seed of this body and give the mean and the scatter.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seeds: Option<Seeds>,
}

/// `[costs.NAME]`: error against cost for several settings.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CostDeclaration {
    /// Caption.
    pub title: String,
    /// When it is computed.
    #[serde(default = "super::both_tiers")]
    pub tiers: Vec<Tier>,
    /// Name of the quantity whose relative error counts.
    pub quantity: String,
    /// One reference for all settings; each setting's own `[reference]` model if not given.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<ReferenceModel>,
    /// Variants that every setting starts from.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<String>,
    /// Resolutions.
    pub levels: Levels,
    /// Settings: legend and variants.
    pub settings: BTreeMap<String, Vec<String>>,
    /// What is promised of the counted work against the setting `paper-like`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub cheaper: Option<Cheaper>,
}

/// `[ablations.NAME]`: one effect on and off, everything else alike, and what that is expected to show.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AblationDeclaration {
    /// What is looked at, in words.
    pub label: String,
    /// When it is run.
    #[serde(default = "super::both_tiers")]
    pub tiers: Vec<Tier>,
    /// Name of the effect.
    pub effect: String,
    /// Variants of the scene that is looked at.
    #[serde(default)]
    pub variants: Vec<String>,
    /// What it is expected to show.
    pub expect: Expected,
    /// Change of a quantity that counts as none, as a fraction.
    pub tolerance: f64,
    /// Why the tolerance is as wide as it is.
    pub why: String,
}

/// `[growth.NAME]`: how cost grows with size.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GrowthDeclaration {
    /// What is done, in words.
    pub label: String,
    /// When it is run.
    #[serde(default = "super::both_tiers")]
    pub tiers: Vec<Tier>,
    /// Variants of the scene.
    #[serde(default)]
    pub variants: Vec<String>,
    /// Sizes.
    pub levels: Levels,
    /// What is counted, and over what.
    pub of: GrowthOf,
    /// Interval of the exponent of counted work.
    pub work: [f64; 2],
    /// Interval of the exponent of wall time; without it time is not measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub seconds: Option<[f64; 2]>,
    /// Why the intervals are as wide as they are.
    pub why: String,
}

/// What cost is counted over what size.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum GrowthOf {
    /// Bond updates, and time in the steps, per step, over bonds.
    BondUpdatesPerStep,
    /// Entries of the factor, and time of the factorisation, over unknowns.
    FactorEntries,
}
