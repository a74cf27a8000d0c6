//! `results.json`: judged results, the only source of every view.

use crate::ablation::AblationJudgement;
use crate::claims::ReadingResult;
use crate::claims::decides::AxisEffect;
use crate::claims::particles::Needed;
use crate::cost::CostJudgement;
use crate::growth::TimedGrowth;
use crate::loosened::Loosened;
use crate::margins::MarginResult;
use crate::race::Race;
use crate::record::{RecordState, RecordedClaim};
use crate::verdict::{ClaimVerdict, Verdict};
use schemars::JsonSchema;
use seam_cases::result::{Agreement, EffectUse, ReferenceKind};
use seam_solver::work::Work;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;
use std::io::Write;
use std::path::Path;
use thiserror::Error;

/// Name and version of the format.
pub const SCHEMA: &str = "seam.results/1";

/// Judged results of a run. Two runs of one commit give the same bytes, [`Provenance::machine`] and fields whose name
/// contains `seconds` apart.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Results {
    /// [`SCHEMA`].
    pub schema: String,
    /// What produced them.
    pub provenance: Provenance,
    /// The cases, in the order they were given.
    pub cases: Vec<CaseJudgement>,
    /// Several codes side by side, where that was measured or is recorded.
    #[serde(default)]
    pub race: Option<Race>,
}

/// What produced the results.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Provenance {
    /// Version of Seam.
    pub version: String,
    /// Commit it was built from, where known.
    pub commit: Option<String>,
    /// Command that was given.
    pub command: String,
    /// Versions of the tools and libraries that matter for the numbers.
    pub versions: BTreeMap<String, String>,
    /// SHA-256 of every reference file that was verified, by `<case>/<source>.{csv,toml}`.
    pub references: BTreeMap<String, String>,
    /// The part that differs from machine to machine and from run to run.
    pub machine: Machine,
}

/// The machine and the moment. Not deterministic.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Machine {
    /// Operating system and architecture.
    pub system: String,
    /// Processor.
    pub processor: String,
    /// Threads used.
    pub threads: usize,
    /// When the run started, UTC, ISO 8601.
    pub started: String,
}

/// Judgement of one case.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CaseJudgement {
    /// Id of the case.
    pub id: String,
    /// One line.
    pub title: String,
    /// `quick` or `full`.
    pub tier: String,
    /// Blake3 of the scene as it was run.
    pub scene_hash: String,
    /// The command that runs just this case again.
    pub command: String,
    /// Effects that were on or off, and why.
    pub effects: Vec<EffectUse>,
    /// Whether no effect was left out that the scene calls for.
    pub trusted: bool,
    /// Judged numbers, observed orders and exponents of counted work included.
    pub quantities: Vec<QuantityResult>,
    /// Curves compared with their reference.
    pub curves: Vec<CurveResult>,
    /// Judged claims.
    pub claims: Vec<ClaimResult>,
    /// Judged margins of hard cases.
    #[serde(default)]
    pub margins: Vec<MarginResult>,
    /// What accuracy costs, one entry per diagram.
    pub costs: Vec<CostJudgement>,
    /// Exponents of wall time.
    pub timed: Vec<TimedGrowth>,
    /// Effects on and off.
    pub ablations: Vec<AblationJudgement>,
    /// Counted work of the case.
    #[schemars(with = "BTreeMap<String, u64>")]
    pub work: Work,
    /// Recorded work of the same scene (`Work::total`), where there is one.
    pub recorded_work: Option<u64>,
    /// Recorded counters of the same scene, by name as in `work`.
    #[serde(default)]
    pub recorded_counters: BTreeMap<String, u64>,
    /// Tolerances that are wider than recorded, or gone.
    #[serde(default)]
    pub loosened: Vec<Loosened>,
    /// Ids whose failure the scene expects and that it does not measure.
    #[serde(default)]
    pub expected_in_vain: Vec<String>,
    /// Words to filter by.
    #[serde(default)]
    pub tags: Vec<String>,
    /// Wall time in seconds. Not deterministic.
    pub seconds: f64,
}

/// A judged number.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct QuantityResult {
    /// Unique within the case.
    pub id: String,
    /// What it is, in words.
    pub label: String,
    /// SI unit, `1` for a pure number.
    pub unit: String,
    /// The measured value; `null` if it is not finite.
    pub value: Option<f64>,
    /// Reference value.
    pub reference: Option<f64>,
    /// Kind of the reference.
    pub kind: ReferenceKind,
    /// Where the reference comes from.
    pub source: String,
    /// Signed error as a fraction of the reference, positive where the value is the larger one in magnitude; in
    /// the unit of the quantity where the reference is zero.
    pub error: Option<f64>,
    /// Standard numerical uncertainty of the value, in its unit.
    pub u_num: Option<f64>,
    /// Standard uncertainty of the reference, in its unit.
    pub u_ref: Option<f64>,
    /// Interval the value must lie in; an end that is `null` is open. `null` where nothing is promised.
    pub accepted: Option<[Option<f64>; 2]>,
    /// Why the interval is as wide as it is.
    pub why: String,
    /// Share of the accepted half width that is left; negative outside.
    pub headroom: Option<f64>,
    /// Change against our own last accepted value, signed, as a fraction of it.
    pub regression: Option<f64>,
    /// The verdict; `null` where nothing is promised.
    pub verdict: Option<Verdict>,
    /// What was compared with another code, where that is what it is.
    #[serde(default)]
    pub agreement: Option<Agreement>,
    /// Why it is known to fail, if it is.
    #[serde(default)]
    pub expected_failure: Option<String>,
}

/// A curve compared with the reference of its plot.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CurveResult {
    /// Id of the plot.
    pub plot: String,
    /// Name of the model's series.
    pub series: String,
    /// Kind of the reference.
    pub kind: ReferenceKind,
    /// Share of the reference's stations inside the model's range.
    pub coverage: f64,
    /// Relative L² error; `null` where the reference is zero throughout.
    pub e2: Option<f64>,
    /// Relative largest error; `null` where the reference is zero throughout.
    pub e_max: Option<f64>,
    /// Largest error, in the unit of the ordinate.
    pub absolute: f64,
    /// Pass if the comparison covers enough of the reference.
    pub verdict: Verdict,
    /// Why it did not pass; empty if it did.
    pub why: String,
}

/// A judged claim.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct ClaimResult {
    /// Id of the claim.
    pub id: String,
    /// The claim in words.
    pub statement: String,
    /// Paper, figure, sentence.
    pub source: String,
    /// Whether it is Seam's own, which must be supported.
    pub own: bool,
    /// Largest allowed error, as a fraction.
    pub bound: f64,
    /// The verdict.
    pub verdict: ClaimVerdict,
    /// Share of the settings that meet the bound under the main reading.
    pub share: f64,
    /// Why, in a few sentences.
    pub reason: String,
    /// Each reading, the main one first.
    pub readings: Vec<ReadingResult>,
    /// Seeds of the random packings, ascending.
    pub seeds: Vec<u64>,
    /// Number of settings.
    pub settings: usize,
    /// Whether these are all settings of the family, or the quick subset.
    pub complete: bool,
    /// Axes, the one that decides first.
    pub decides: Vec<AxisEffect>,
    /// Particles that the paper-like setting needs for the bound.
    pub needed: Option<Needed>,
    /// Largest number of particles a setting may have.
    pub most_particles: Option<f64>,
    /// What could not be measured.
    pub unmeasured: Option<String>,
    /// Hash of the family: what was asked, and which members were run.
    pub hash: String,
    /// How the verdict relates to the recorded one of this tier.
    pub record: RecordState,
    /// The recorded verdict of this tier.
    pub recorded: Option<RecordedClaim>,
    /// The recorded verdict over the whole family, where this run is a subset.
    pub recorded_full: Option<RecordedClaim>,
}

/// Why results cannot be written or read.
#[derive(Debug, Error)]
pub enum ResultsError {
    /// A file or folder could not be written.
    #[error("{path}: {source}; nothing was overwritten")]
    Write {
        /// Path as given.
        path: String,
        /// What the system said.
        source: std::io::Error,
    },
    /// A file could not be read.
    #[error("{path}: {message}; run `seam check` to make it again")]
    Read {
        /// Path as given.
        path: String,
        /// What is wrong.
        message: String,
    },
    /// A view could not be made.
    #[error("{view}: {message}")]
    View {
        /// Which view.
        view: &'static str,
        /// What is wrong.
        message: String,
    },
}

impl Results {
    /// The results as JSON, ending in a newline.
    ///
    /// # Errors
    /// A value that JSON cannot hold.
    pub fn to_json(&self) -> Result<String, ResultsError> {
        let text = serde_json::to_string_pretty(self)
            .map_err(|e| ResultsError::View { view: "results.json", message: e.to_string() })?;
        Ok(text + "\n")
    }

    /// Writes `results.json`, whole or not at all.
    ///
    /// # Errors
    /// The file cannot be written.
    pub fn write(&self, path: &Path) -> Result<(), ResultsError> {
        write_whole(path, &self.to_json()?)
    }

    /// Reads `results.json`.
    ///
    /// # Errors
    /// The file cannot be read, or is not of schema [`SCHEMA`].
    pub fn read(path: &Path) -> Result<Self, ResultsError> {
        let fail = |message: String| ResultsError::Read { path: path.display().to_string(), message };
        let text = std::fs::read_to_string(path).map_err(|e| fail(e.to_string()))?;
        let results: Results = serde_json::from_str(&text).map_err(|e| fail(e.to_string()))?;
        if results.schema != SCHEMA {
            return Err(fail(format!("schema '{}' is not '{SCHEMA}'", results.schema)));
        }
        Ok(results)
    }
}

/// Writes a file by way of a temporary one beside it, so that a reader never sees half of it.
///
/// # Errors
/// The folder or the file cannot be written.
pub fn write_whole(path: &Path, text: &str) -> Result<(), ResultsError> {
    let fail = |source| ResultsError::Write { path: path.display().to_string(), source };
    if let Some(folder) = path.parent() {
        std::fs::create_dir_all(folder).map_err(fail)?;
    }
    let beside = path.with_added_extension(format!("{}.tmp", std::process::id()));
    let written = std::fs::File::create(&beside)
        .and_then(|mut file| file.write_all(text.as_bytes()).and_then(|()| file.sync_all()))
        .and_then(|()| std::fs::rename(&beside, path));
    written.map_err(|e| {
        // Best effort: the error worth telling is the first one.
        let _ = std::fs::remove_file(&beside);
        fail(e)
    })
}
