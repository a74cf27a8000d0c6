//! The scene file: a case as a page of text.
//!
//! One file per element of the format. A scene is read by [`crate::file::SceneFile`], which knows
//! where every key stands; the types here know nothing of files.

pub mod body;
pub mod check;
mod check_connection;
mod check_cost;
mod check_dynamics;
mod check_failure;
pub mod check_notched_beam;
mod check_peer;
mod check_probe;
mod check_size;
mod check_study;
mod check_switch;
pub mod connection;
pub mod contact;
pub mod cracking;
pub mod de;
pub mod dynamics;
pub mod effects;
pub mod failure;
pub mod fe;
pub mod material;
mod none;
pub mod number;
pub mod parameter;
pub mod peer;
pub mod probe;
pub mod quantity;
mod simulated;
pub mod study;
pub mod switch;

use crate::error::Fault;
use crate::expression::Values;
use schemars::JsonSchema;
use seam_solver::space::Space;
use serde::{Deserialize, Serialize};
use std::collections::{BTreeMap, BTreeSet};

/// A scene.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Scene {
    /// Id, also the name of its folder: lower case, digits, hyphens.
    pub id: String,
    /// One line.
    pub title: String,
    /// What is shown, for whom (Markdown).
    #[serde(default)]
    pub purpose: String,
    /// Author, year, title, figure or equation.
    #[serde(default)]
    pub citation: String,
    /// Words to filter by.
    #[serde(default)]
    pub tags: Vec<String>,
    /// When it runs.
    #[serde(default = "both_tiers")]
    pub tiers: Vec<Tier>,
    /// What computes it: `statics` for the scene itself (in time if it has `[dynamics]`), or a verification that needs no bodies.
    #[serde(default = "statics")]
    pub procedure: String,
    /// What a run takes.
    #[serde(default)]
    pub needs: Needs,
    /// Largest model that is run.
    #[serde(default)]
    pub limits: Limits,
    /// Quantities that are known to fail, by id, each with the reason. One that passes raises an alarm.
    #[serde(default)]
    pub expected_failures: BTreeMap<String, String>,
    /// Effects to simulate: their names, or `["auto"]` for those that the tables ask for.
    #[serde(default = "auto")]
    pub effects: Vec<String>,
    /// Why the problem is posed in linear theory, whatever its displacements, as benchmarks with a modulus of 1 are: rotations may
    /// then be as large as they like.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub linear: Option<String>,
    /// Plane or solid.
    #[serde(default = "plane_stress")]
    pub hypothesis: Hypothesis,
    /// Thickness in the plane, in m; in the solid that of notched beams.
    #[serde(default = "unit_thickness")]
    pub thickness_m: number::Number,
    /// Named numbers.
    #[serde(default)]
    pub parameters: BTreeMap<String, parameter::Parameter>,
    /// Materials.
    #[serde(default)]
    pub materials: BTreeMap<String, material::Material>,
    /// Bodies.
    #[serde(default)]
    pub bodies: BTreeMap<String, body::Body>,
    /// Named nodes or particles.
    #[serde(default)]
    pub sets: BTreeMap<String, connection::Set>,
    /// Interfaces.
    #[serde(default)]
    pub ties: BTreeMap<String, connection::Tie>,
    /// Prescribed displacements.
    #[serde(default)]
    pub supports: BTreeMap<String, connection::Support>,
    /// Forces.
    #[serde(default)]
    pub loads: BTreeMap<String, connection::Load>,
    /// How it moves; without it one equilibrium is computed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub dynamics: Option<dynamics::Dynamics>,
    /// Loads in proportion until bonds fail one by one; instead of `dynamics`.
    #[serde(default, deserialize_with = "none::none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<cracking::Cracking>")]
    pub cracking: Option<cracking::Cracking>,
    /// How particles touch that have lost a bond.
    #[serde(default, deserialize_with = "none::none_or", skip_serializing_if = "Option::is_none")]
    #[schemars(with = "none::Or<contact::Contact>")]
    pub contact: Option<contact::Contact>,
    /// When bonds break.
    #[serde(default)]
    pub failure: BTreeMap<String, failure::Failure>,
    /// Elements that become particles on the way.
    #[serde(default)]
    pub switches: BTreeMap<String, switch::Switch>,
    /// Switches that are not enabled: probes may name them and read nothing.
    #[serde(skip)]
    pub switches_off: BTreeSet<String>,
    /// What the list of effects leaves out.
    #[serde(skip)]
    pub left_out: effects::LeftOut,
    /// What is read off.
    #[serde(default)]
    pub probes: BTreeMap<String, probe::Probe>,
    /// What is judged.
    #[serde(default)]
    pub quantities: BTreeMap<String, quantity::Quantity>,
    /// Named settings.
    #[serde(default)]
    pub variants: BTreeMap<String, study::Variant>,
    /// The model that quantities are compared with.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub reference: Option<study::ReferenceModel>,
    /// What other codes made of it.
    #[serde(default)]
    pub peers: BTreeMap<String, peer::Peer>,
    /// Refinement studies.
    #[serde(default)]
    pub convergence: BTreeMap<String, study::Convergence>,
    /// Families of settings.
    #[serde(default)]
    pub families: BTreeMap<String, study::FamilyDeclaration>,
    /// Claims.
    #[serde(default)]
    pub claims: BTreeMap<String, study::Claim>,
    /// Error budgets.
    #[serde(default)]
    pub budgets: BTreeMap<String, study::BudgetDeclaration>,
    /// Work–precision diagrams.
    #[serde(default)]
    pub costs: BTreeMap<String, study::CostDeclaration>,
    /// How cost grows with size.
    #[serde(default)]
    pub growth: BTreeMap<String, study::GrowthDeclaration>,
    /// Effects that are switched on and off.
    #[serde(default)]
    pub ablations: BTreeMap<String, study::AblationDeclaration>,
}

/// JSON schema of a scene file, ending in a newline; published as `cases/scene.schema.json`.
pub fn schema() -> String {
    // A schema is an object of text and numbers: it can always be written.
    serde_json::to_string_pretty(&schemars::schema_for!(Scene)).unwrap_or_default() + "\n"
}

fn yes() -> bool {
    true
}

fn both_tiers() -> Vec<Tier> {
    vec![Tier::Quick, Tier::Full]
}

fn statics() -> String {
    "statics".to_owned()
}

fn auto() -> Vec<String> {
    vec!["auto".to_owned()]
}

fn plane_stress() -> Hypothesis {
    Hypothesis::PlaneStress
}

fn unit_thickness() -> number::Number {
    number::Number::Literal(1.0)
}

/// How much is run.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Tier {
    /// Under a minute for the whole catalogue.
    Quick,
    /// Everything.
    Full,
}

impl Tier {
    /// Name as in the scene file.
    pub fn name(self) -> &'static str {
        match self {
            Self::Quick => "quick",
            Self::Full => "full",
        }
    }
}

/// Stress state.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum Hypothesis {
    /// Plane, free to change its thickness.
    PlaneStress,
    /// Plane, held in thickness.
    PlaneStrain,
    /// Three dimensions.
    Solid,
}

impl Hypothesis {
    /// The space it lives in.
    pub fn space(self) -> Space {
        match self {
            Self::PlaneStress | Self::PlaneStrain => Space::Plane,
            Self::Solid => Space::Solid,
        }
    }
}

/// `[needs]`: what a run of the full tier takes, for schedulers.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Needs {
    /// Threads it can use.
    pub threads: usize,
    /// Memory, in MB.
    pub mem_mb: usize,
    /// Wall time, in minutes.
    pub minutes: f64,
}

impl Default for Needs {
    fn default() -> Self {
        Self { threads: 1, mem_mb: 200, minutes: 0.1 }
    }
}

/// `[limits]`: refuse larger models instead of running out of memory.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Limits {
    /// Most particles of a body.
    pub particles: usize,
    /// Most nodes of a body.
    pub nodes: usize,
    /// Most stations of a line or a history.
    pub stations: usize,
    /// Most members of a family, seeds included.
    pub members: usize,
}

impl Default for Limits {
    fn default() -> Self {
        Self { particles: 200_000, nodes: 500_000, stations: 100_000, members: 100_000 }
    }
}

impl Scene {
    /// Leaves out what is not enabled.
    pub fn drop_disabled(&mut self) {
        self.bodies.retain(|_, body| body.enabled);
        self.ties.retain(|_, tie| tie.enabled);
        self.supports.retain(|_, support| support.enabled);
        self.loads.retain(|_, load| load.enabled);
        self.failure.retain(|_, failure| failure.enabled);
        let off = self.switches.iter().filter(|(_, switch)| !switch.enabled);
        self.switches_off = off.map(|(name, _)| name.clone()).collect();
        self.switches.retain(|_, switch| switch.enabled);
    }

    /// Values of all parameters.
    ///
    /// # Errors
    /// An expression that cannot be evaluated, or parameters that need each other.
    pub fn values(&self) -> Result<Values, Fault> {
        let mut values = Values::new();
        let mut waiting: Vec<&String> = self.parameters.keys().collect();
        while !waiting.is_empty() {
            let before = waiting.len();
            let mut still = Vec::new();
            for name in waiting {
                let number = &self.parameters[name].value;
                if number.names().iter().any(|n| self.parameters.contains_key(*n) && !values.contains_key(*n))
                {
                    still.push(name);
                } else {
                    values.insert(name.clone(), number.value(&values, &format!("parameters.{name}"))?);
                }
            }
            if still.len() == before {
                return Err(Fault::new(
                    format!("parameters.{}", still[0]),
                    "these parameters need each other, so none of them has a value",
                    "give one of them a number",
                ));
            }
            waiting = still;
        }
        Ok(values)
    }
}
