//! Which effects were simulated, and whether those that were not may be left out.

use schemars::JsonSchema;
use seam_solver::work::Work;
use serde::{Deserialize, Serialize};

/// One effect of a scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct EffectUse {
    /// Name as in the scene file, e.g. `rotation-coupling`.
    pub name: String,
    /// Whether it was simulated.
    pub on: bool,
    /// Why it was switched on or left out.
    pub why: String,
    /// Work done for it alone; exactly zero when off.
    pub counter: u64,
    /// Whether it was left out although the scene calls for it, or simulated in vain (particles that came too late, ties that drifted
    /// open): the result is then not trusted.
    #[serde(default)]
    pub called_for: bool,
    /// What tells whether it may be left out, or that it was simulated in vain; `null` where nothing could tell.
    #[serde(default)]
    pub indicator: Option<Indicator>,
    /// Variants of the scene that this is about; none for the scene itself.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub variants: Vec<String>,
}

impl EffectUse {
    /// Its name, with the variants that it is about: `inertia (quasi-static)`.
    pub fn place(&self) -> String {
        match self.variants.as_slice() {
            [] => self.name.clone(),
            variants => format!("{} ({})", self.name, variants.join(", ")),
        }
    }
}

/// A number that tells whether an effect may be left out.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Indicator {
    /// What it is, in words that a value can follow.
    pub about: String,
    /// Its value.
    pub value: f64,
    /// Its limit: past it the scene calls for the effect.
    pub limit: f64,
}

impl Indicator {
    /// Whether it is past its limit; a number that is not finite is.
    pub fn is_past(&self) -> bool {
        !self.value.is_finite() || self.value > self.limit
    }
}

/// One effect on and off, everything else alike.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Ablation {
    /// Unique within the case.
    pub id: String,
    /// What is looked at, in words.
    pub label: String,
    /// Name of the effect.
    pub effect: String,
    /// Change of a quantity that counts as none, as a fraction.
    pub tolerance: f64,
    /// Whether leaving the effect out is expected to be right or to be caught; `None` where it is only shown.
    pub expected: Option<Expected>,
    /// With the effect.
    pub with: AblationRun,
    /// Without it.
    pub without: AblationRun,
    /// What each quantity changes by.
    pub changes: Vec<AblationChange>,
    /// Why one of the two could not be run; then the rest is empty.
    pub failed: Option<String>,
}

/// What an ablation is expected to show.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Expected {
    /// The effect may be left out: nothing changes, it costs less, and the indicator is silent.
    MayBeLeftOut,
    /// It may not: something changes, and the indicator says so.
    IsCalledFor,
}

/// One of the two runs of an ablation.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct AblationRun {
    /// Work done for the effect alone.
    pub counter: u64,
    /// Whether the run says that the effect is missing.
    pub called_for: bool,
    /// What it says so by.
    pub indicator: Option<Indicator>,
    /// Counted work, calibrations included.
    pub work: Work,
    /// Wall seconds. Not deterministic.
    pub seconds: f64,
}

/// A quantity with an effect and without it.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct AblationChange {
    /// The quantity, in words.
    pub label: String,
    /// SI unit; empty for curves.
    pub unit: String,
    /// With the effect; `None` for curves.
    pub with: Option<f64>,
    /// Without it; `None` for curves.
    pub without: Option<f64>,
    /// Change as a fraction of the larger one, or of the curve's largest value; `None` where there is nothing to compare.
    pub change: Option<f64>,
}
