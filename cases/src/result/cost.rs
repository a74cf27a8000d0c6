//! What accuracy costs: error against counted work and seconds.

use schemars::JsonSchema;
use seam_solver::work::Work;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Error against cost for several settings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CostDiagram {
    /// Unique within the case.
    pub id: String,
    /// Caption.
    pub title: String,
    /// What the error is of.
    pub error_label: String,
    /// What the error is measured against.
    #[serde(default)]
    pub reference: String,
    /// Accuracies that a claim of somebody else is about, as fractions: where the paper-like setting is compared with the rest.
    #[serde(default)]
    pub claimed: Vec<f64>,
    /// Legend of the paper-like setting, if there is one.
    #[serde(default)]
    pub paper_like: Option<String>,
    /// What is promised of the counted work, if something is.
    #[serde(default)]
    pub cheaper: Option<Cheaper>,
    /// One entry per setting.
    pub settings: Vec<CostSetting>,
}

/// The variant, and the legend, of the setting that others are compared with.
pub const PAPER_LIKE: &str = "paper-like";

impl CostDiagram {
    /// Notes which of its settings is the paper-like one, if one is called so.
    pub fn name_paper_like(&mut self) {
        self.paper_like = self.settings.iter().map(|s| &s.name).find(|name| *name == PAPER_LIKE).cloned();
    }
}

/// What is promised: at an accuracy, so many times less counted work than the setting `paper-like`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Cheaper {
    /// The accuracy, as a fraction.
    pub error: f64,
    /// Interval of the counted work of the paper-like setting over that of the cheapest other one with particles.
    pub times: [f64; 2],
    /// Why the interval is as wide as it is.
    pub why: String,
}

/// One setting at several resolutions.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CostSetting {
    /// Legend.
    pub name: String,
    /// Points, coarse to fine.
    pub points: Vec<CostPoint>,
}

/// One run of a cost diagram; where packings are random, one per seed.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CostPoint {
    /// Resolution, in words, e.g. `8 rows`.
    pub level: String,
    /// Error as a fraction, the median over the seeds; `None` if the run failed.
    pub error: Option<f64>,
    /// Smallest and largest error over the seeds, where there are several.
    #[serde(default)]
    pub spread: Option<[f64; 2]>,
    /// Why there is no error.
    #[serde(default)]
    pub failed: Option<String>,
    /// Number of particles.
    pub particles: usize,
    /// Number of unknowns, rotations and prescribed ones included.
    #[serde(default)]
    pub unknowns: usize,
    /// Counted work, calibrations included; the median over the seeds.
    pub work: Work,
    /// The part of [`Work::total`] that calibrations took.
    #[serde(default)]
    pub calibration_work: u64,
    /// [`Work::total`] of the run alone, without packings and calibrations.
    #[serde(default)]
    pub run_work: u64,
    /// Median wall seconds, packing and calibration included. Not deterministic.
    pub seconds: f64,
    /// Shortest and longest run. Not deterministic.
    #[serde(default)]
    pub seconds_spread: [f64; 2],
    /// Timed runs behind the median, the one that warms up left out.
    #[serde(default)]
    pub seconds_runs: usize,
    /// Seconds of each stage of the median run, `other` included. Not deterministic.
    #[serde(default)]
    pub seconds_of_stages: BTreeMap<String, f64>,
    /// Largest memory of a process that does this run alone, in MB, where it was measured. Not deterministic.
    #[serde(default)]
    pub memory_mb: Option<f64>,
    /// What another code would have to do for the same answer, where it is known.
    #[serde(default)]
    pub elsewhere: Option<Elsewhere>,
}

/// Work of another code for the same answer, counted in what the race of codes counts.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Elsewhere {
    /// Of a code of bonded particles with explicit steps, on the same network.
    BondUpdates(u64),
    /// Unknowns of a code of finite elements, on the same mesh, solved once.
    Unknowns(u64),
}

/// Cost over size at several levels, and what is promised of its exponent p in `cost ∝ sizeᵖ`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Growth {
    /// Unique within the case.
    pub id: String,
    /// What is done, in words.
    pub label: String,
    /// What size is counted in.
    pub size_label: String,
    /// Size at each level.
    pub size: Vec<f64>,
    /// Counted work at each level.
    pub work: Vec<f64>,
    /// Wall seconds at each level; empty where they were not measured. Not deterministic.
    pub seconds: Vec<f64>,
    /// Interval of the exponent of counted work; `None` shows it only.
    pub accepted_work: Option<[f64; 2]>,
    /// Interval of the exponent of wall time; `None` where nothing is promised.
    pub accepted_seconds: Option<[f64; 2]>,
    /// Why the intervals are as wide as they are.
    pub why: String,
}
