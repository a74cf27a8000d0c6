//! Recorded verdicts, values, margins and work: what the last accepted run gave.
//!
//! A paper's claim may have any honest verdict; the gate goes red when it *changes*. The records
//! are kept per tier, since the quick tier runs a subset of each family.

use crate::results::Results;
use crate::verdict::ClaimVerdict;
use crate::{counted, loosened};
use schemars::JsonSchema;
use seam_cases::result::Family;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::path::Path;
use thiserror::Error;

/// Name and version of the format.
pub const SCHEMA: &str = "seam.recorded/1";

/// The records of this project.
const PROJECT: &str = include_str!("../recorded.toml");

/// Tier → id → record.
type PerTier<T> = BTreeMap<String, BTreeMap<String, T>>;

/// What the last accepted run gave, by tier (`quick`, `full`).
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Recorded {
    /// [`SCHEMA`].
    pub schema: String,
    /// Verdicts of claims.
    #[serde(default)]
    pub claims: PerTier<RecordedClaim>,
    /// Counted work of cases.
    #[serde(default)]
    pub work: PerTier<RecordedWork>,
    /// Values of quantities, by case and quantity.
    #[serde(default)]
    pub values: PerTier<BTreeMap<String, f64>>,
    /// Widths of accepted intervals ([`loosened::width`]), by case and quantity.
    #[serde(default)]
    pub tolerances: PerTier<BTreeMap<String, f64>>,
    /// Margins of hard cases, by case and margin.
    #[serde(default)]
    pub margins: PerTier<BTreeMap<String, f64>>,
}

/// Recorded verdict of a claim.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RecordedClaim {
    /// The verdict.
    pub verdict: ClaimVerdict,
    /// Share of the settings that met the bound.
    pub share: f64,
    /// [`family_hash`] of the family that gave it.
    pub hash: String,
}

/// Recorded work of a case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct RecordedWork {
    /// Hash of the scene that was run; the work of another scene is not compared.
    pub scene: String,
    /// `Work::total`.
    pub total: u64,
    /// Each counter by its name.
    #[serde(default)]
    pub counters: BTreeMap<String, u64>,
}

/// How a verdict relates to the recorded one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum RecordState {
    /// Nothing is recorded.
    #[default]
    Unrecorded,
    /// Same family, same verdict.
    Same,
    /// Same family, another verdict.
    Changed,
    /// The record belongs to a family that was declared or run differently.
    OtherFamily,
}

/// Why records cannot be used.
#[derive(Debug, Error)]
pub enum RecordError {
    /// The file cannot be read.
    #[error("{path}: {source}; records are read from a TOML file of schema {SCHEMA}")]
    Read {
        /// Path as given.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// The file is not of this format.
    #[error("{path}: {message}")]
    Format {
        /// Path as given.
        path: String,
        /// What is wrong, and where.
        message: String,
    },
}

impl Recorded {
    /// The records of this project, as committed.
    ///
    /// # Errors
    /// The committed file is damaged.
    pub fn project() -> Result<Self, RecordError> {
        Self::parse(PROJECT, "reports/recorded.toml")
    }

    /// Reads records from a file.
    ///
    /// # Errors
    /// The file cannot be read or is not of schema [`SCHEMA`].
    pub fn load(path: &Path) -> Result<Self, RecordError> {
        let name = path.display().to_string();
        let text = std::fs::read_to_string(path)
            .map_err(|source| RecordError::Read { path: name.clone(), source })?;
        Self::parse(&text, &name)
    }

    /// Reads records from text; `path` is named in errors.
    ///
    /// # Errors
    /// The text is not TOML of schema [`SCHEMA`].
    pub fn parse(text: &str, path: &str) -> Result<Self, RecordError> {
        let fail = |message: String| RecordError::Format { path: path.to_owned(), message };
        let recorded: Recorded = toml::from_str(text).map_err(|e| fail(e.to_string()))?;
        if recorded.schema != SCHEMA {
            return Err(fail(format!("schema '{}' is not '{SCHEMA}'", recorded.schema)));
        }
        Ok(recorded)
    }

    /// The records with those of a run put in their place: what a run becomes once it is accepted.
    #[must_use]
    pub fn updated(&self, results: &Results) -> Self {
        let mut new = self.clone();
        SCHEMA.clone_into(&mut new.schema);
        for case in &results.cases {
            let counters = counted::counters(&case.work);
            let work = RecordedWork { scene: case.scene_hash.clone(), total: case.work.total(), counters };
            new.work.entry(case.tier.clone()).or_default().insert(case.id.clone(), work);
            let values = case.quantities.iter().filter_map(|q| Some((q.id.clone(), q.value?))).collect();
            new.values.entry(case.tier.clone()).or_default().insert(case.id.clone(), values);
            let judged = case.quantities.iter();
            let widths = judged.filter_map(|q| Some((q.id.clone(), loosened::width(q)?))).collect();
            new.tolerances.entry(case.tier.clone()).or_default().insert(case.id.clone(), widths);
            let margins: BTreeMap<_, _> =
                case.margins.iter().filter_map(|m| Some((m.id.clone(), m.value?))).collect();
            if !margins.is_empty() {
                new.margins.entry(case.tier.clone()).or_default().insert(case.id.clone(), margins);
            }
            for c in case.claims.iter().filter(|c| c.unmeasured.is_none()) {
                let claim = RecordedClaim { verdict: c.verdict, share: c.share, hash: c.hash.clone() };
                new.claims.entry(case.tier.clone()).or_default().insert(c.id.clone(), claim);
            }
        }
        new
    }

    /// The records as TOML.
    ///
    /// # Errors
    /// A recorded value cannot be written, e.g. work beyond the 63 bits of a TOML integer.
    pub fn to_toml(&self) -> Result<String, toml::ser::Error> {
        toml::to_string(self)
    }

    /// Record of a claim at a tier.
    pub fn claim(&self, tier: &str, id: &str) -> Option<&RecordedClaim> {
        self.claims.get(tier)?.get(id)
    }

    /// Recorded value of a quantity.
    pub fn value(&self, tier: &str, case: &str, quantity: &str) -> Option<f64> {
        self.values.get(tier)?.get(case)?.get(quantity).copied()
    }

    /// Recorded margin of a hard case.
    pub fn margin(&self, tier: &str, case: &str, margin: &str) -> Option<f64> {
        self.margins.get(tier)?.get(case)?.get(margin).copied()
    }

    /// Recorded work of a case, if it is of the same scene.
    pub fn work(&self, tier: &str, case: &str, scene: &str) -> Option<&RecordedWork> {
        self.work.get(tier)?.get(case).filter(|w| w.scene == scene)
    }

    /// Recorded widths of the accepted intervals of a case, by quantity.
    pub fn tolerances(&self, tier: &str, case: &str) -> Option<&BTreeMap<String, f64>> {
        self.tolerances.get(tier)?.get(case)
    }
}

/// Compares a verdict with its record.
pub fn compare(record: Option<&RecordedClaim>, verdict: ClaimVerdict, hash: &str) -> RecordState {
    match record {
        None => RecordState::Unrecorded,
        Some(r) if r.hash != hash => RecordState::OtherFamily,
        Some(r) if r.verdict != verdict => RecordState::Changed,
        Some(_) => RecordState::Same,
    }
}

/// Blake3 of what a family asked and which members it ran, errors left out: it tells whether a recorded verdict
/// answers the same question.
pub fn family_hash(family: &Family) -> String {
    let mut hasher = blake3::Hasher::new();
    let mut add = |text: &str| {
        hasher.update(&(text.len() as u64).to_le_bytes());
        hasher.update(text.as_bytes());
    };
    add(&family.claim);
    add(&family.bound.to_string());
    add(&family.main_reading);
    add(family.no_more_particles_than.as_deref().unwrap_or_default());
    add(&format!("{:?}", family.readings));
    add(&format!("{:?}", family.axes));
    add(&format!("{:?}", family.paper_like));
    for member in &family.members {
        add(&format!("{:?} {:?}", member.settings, member.seed));
    }
    hasher.finalize().to_hex().to_string()
}
