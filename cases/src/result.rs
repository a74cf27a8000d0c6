//! What a case hands to the reports: measured values, curves, family members, pictures.
//!
//! A [`CaseResult`] holds what was *measured* and what it is to be compared *with*; it holds no
//! judgement. `result.json` in the folder of a case is this type.

mod cost;
mod effects;

use crate::map::StabilityMap;
use crate::margin::Margin;
pub use cost::{Cheaper, CostDiagram, CostPoint, CostSetting, Elsewhere, Growth, PAPER_LIKE};
pub use effects::{Ablation, AblationChange, AblationRun, EffectUse, Expected, Indicator};
use schemars::JsonSchema;
use seam_solver::work::Work;
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Name and version of the format.
pub const SCHEMA: &str = "seam.case/1";

/// Result of one case.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct CaseResult {
    /// [`SCHEMA`].
    pub schema: String,
    /// Id of the case, also the name of its folder.
    pub id: String,
    /// One line.
    pub title: String,
    /// What is shown, for whom, in a few sentences (Markdown).
    pub purpose: String,
    /// Author, year, title, figure or equation.
    pub citation: String,
    /// Words to filter by.
    pub tags: Vec<String>,
    /// `quick` or `full`.
    pub tier: String,
    /// Blake3 of the scene as it was run, overrides included.
    pub scene_hash: String,
    /// The command that runs just this case again.
    pub command: String,
    /// Whether this is a study by itself, which does not measure what else a run of its case does.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub study_alone: bool,
    /// Effects that were on or off, and why.
    pub effects: Vec<EffectUse>,
    /// Parameters with their units.
    pub parameters: Vec<Parameter>,
    /// Numbers to be judged.
    pub quantities: Vec<Observation>,
    /// Refinement studies.
    pub convergence: Vec<Convergence>,
    /// Curves to be drawn.
    pub curves: Vec<Plot>,
    /// Families that answer claims.
    pub families: Vec<Family>,
    /// Signed parts of the total error.
    pub budgets: Vec<Budget>,
    /// Error against cost.
    pub costs: Vec<CostDiagram>,
    /// How cost grows with size.
    #[serde(default)]
    pub growths: Vec<Growth>,
    /// Effects on and off.
    #[serde(default)]
    pub ablations: Vec<Ablation>,
    /// Bodies drawn from the model.
    pub pictures: Vec<Picture>,
    /// Elements that became particles on the way, in order.
    #[serde(default)]
    pub switches: Vec<SwitchRecord>,
    /// How far the hard cases are from breaking.
    #[serde(default)]
    pub margins: Vec<Margin>,
    /// Where stability ends over two parameters.
    #[serde(default)]
    pub maps: Vec<StabilityMap>,
    /// Counted work of all runs of the case.
    pub work: Work,
    /// Wall time of the case, in seconds. Not deterministic.
    pub seconds: f64,
    /// Things a reader must know (dropped constraint rows …).
    pub notes: Vec<String>,
    /// Quantities that are known to fail, by id, each with the reason.
    #[serde(default)]
    pub expected_failures: BTreeMap<String, String>,
}

impl CaseResult {
    /// Takes in what a study of the same scene found: what has an id takes the place of the run's own.
    pub fn absorb(&mut self, study: CaseResult) {
        replace(&mut self.quantities, study.quantities, |q| &q.id);
        replace(&mut self.curves, study.curves, |c| &c.id);
        replace(&mut self.costs, study.costs, |c| &c.id);
        replace(&mut self.growths, study.growths, |g| &g.id);
        replace(&mut self.ablations, study.ablations, |a| &a.id);
        replace(&mut self.pictures, study.pictures, |p| &p.id);
        replace(&mut self.margins, study.margins, |m| &m.id);
        replace(&mut self.maps, study.maps, |m| &m.id);
        self.notes.extend(study.notes);
    }
}

/// Puts each of `new` in the place of the one with its id, or at the end.
fn replace<T>(all: &mut Vec<T>, new: Vec<T>, id: impl Fn(&T) -> &String) {
    for one in new {
        match all.iter().position(|old| id(old) == id(&one)) {
            Some(place) => all[place] = one,
            None => all.push(one),
        }
    }
}

/// One parameter of a scene.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Parameter {
    /// Name as in the scene file.
    pub name: String,
    /// Value.
    pub value: f64,
    /// SI unit, `1` for a pure number.
    pub unit: String,
    /// What it is, and where it comes from.
    pub about: String,
}

/// Where a reference value comes from.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "kebab-case")]
pub enum ReferenceKind {
    /// A closed form or an exactly known number.
    #[default]
    Exact,
    /// Our own converged finite elements.
    OwnFem,
    /// CalculiX.
    Calculix,
    /// YADE.
    Yade,
    /// LAMMPS.
    Lammps,
    /// An independent prototype: other code, same method.
    Prototype,
    /// A measurement.
    Experiment,
    /// Seam itself with other settings: shows a difference, not an accuracy.
    OwnRun,
    /// Our own last accepted value.
    Regression,
}

/// A measured number and what it is compared with.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Observation {
    /// Unique within the case, e.g. `tip-deflection`.
    pub id: String,
    /// What it is, in words.
    pub label: String,
    /// SI unit, `1` for a pure number.
    pub unit: String,
    /// The measured value.
    pub value: f64,
    /// Reference value, if there is one.
    pub reference: Option<f64>,
    /// Kind of the reference.
    pub kind: ReferenceKind,
    /// Author, year, equation, or how the reference was computed.
    pub source: String,
    /// Standard numerical uncertainty of the value, in its unit.
    pub u_num: f64,
    /// Standard uncertainty of the reference, in its unit.
    pub u_ref: f64,
    /// Interval the value must lie in; `None` shows the number without judging it.
    pub accepted: Option<[f64; 2]>,
    /// Why the interval is as wide as it is.
    pub why: String,
    /// What was compared with another code, where that is what it is.
    #[serde(default)]
    pub agreement: Option<Agreement>,
}

/// A comparison with another code: what the table of agreements shows beside value and interval.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Agreement {
    /// The code.
    pub code: String,
    /// Its version.
    pub version: String,
    /// When it ran, ISO 8601.
    pub date: String,
    /// The network or mesh that the code was given.
    pub model: String,
    /// What is compared: `displacement`, `rotation` or something else in a few words.
    pub compared: String,
    /// Whether Seam was given the very same; otherwise it is another model of the same body.
    pub same_model: bool,
}

/// A refinement study of one quantity.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Convergence {
    /// Id of the quantity that is refined.
    pub id: String,
    /// What it is, in words.
    pub label: String,
    /// Size of a cell at each level, in metres, coarse to fine.
    pub h: Vec<f64>,
    /// Error norm at each level, where the exact answer is known.
    pub error: Vec<f64>,
    /// Order that theory gives.
    pub formal_order: f64,
    /// Half width of the accepted interval around the formal order; `None` shows the order only.
    pub tolerance: Option<f64>,
}

/// Role of a series in a plot: model solid, reference dashed, data as dots.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Role {
    /// What Seam computed.
    #[default]
    Model,
    /// What it is compared with.
    Reference,
    /// Single points.
    Data,
}

/// One line or cloud of dots.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Series {
    /// Legend.
    pub name: String,
    /// How it is drawn.
    pub role: Role,
    /// Abscissa.
    pub x: Vec<f64>,
    /// Ordinate.
    pub y: Vec<f64>,
}

/// A plot of one or more series.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Plot {
    /// Unique within the case; also the name of its CSV file.
    pub id: String,
    /// Caption.
    pub title: String,
    /// Abscissa with unit, e.g. `x / L (1)`.
    pub x_label: String,
    /// Ordinate with unit.
    pub y_label: String,
    /// Logarithmic axes (x, y).
    pub log: [bool; 2],
    /// Relative half width of the tolerance band around the first reference series.
    pub band: Option<f64>,
    /// What the first reference series is.
    #[serde(default)]
    pub against: ReferenceKind,
    /// Intervals of x to shade, e.g. the DE part.
    pub shaded: Vec<[f64; 2]>,
    /// The series.
    pub series: Vec<Series>,
}

/// Elements that became particles, and what that did.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct SwitchRecord {
    /// Name in the scene file, with a number from the second switch of a rule on.
    pub name: String,
    /// Time, in s.
    pub time_s: f64,
    /// Elements that went.
    pub elements: usize,
    /// Particles that came.
    pub particles: usize,
    /// Unbalanced over internal forces.
    pub unbalanced: Stages,
    /// Strain energy, in J.
    pub strain_energy: Stages,
    /// Kinetic energy, in J.
    pub kinetic_energy: Stages,
    /// Jump of the strain energy over the energy before.
    pub strain_energy_jump: f64,
    /// Jump of the momentum over `Σ m|v|`.
    pub momentum_jump: f64,
    /// Jump of the angular momentum over `Σ m|v|` times the largest extent of the bodies.
    pub angular_momentum_jump: f64,
    /// Jump of the force through each coupled face over the largest such force before.
    pub reaction_jump: BTreeMap<String, f64>,
}

/// A number on the way through a switch.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Stages {
    /// Of the elements.
    pub before: f64,
    /// Of the particles with the fields they took over.
    pub mapped: f64,
    /// Of the particles as the run goes on.
    pub after: f64,
}

/// A claim checked over a family of settings.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Family {
    /// Id of the claim, e.g. `rotation-7-percent`.
    pub claim: String,
    /// The claim in words.
    pub statement: String,
    /// Paper, figure, sentence.
    pub source: String,
    /// Whether it is Seam's own claim, which must be supported.
    pub own: bool,
    /// Largest allowed error, as a fraction (0.07).
    pub bound: f64,
    /// Readings of the metric: id and meaning. The first is the one the claim most likely meant.
    pub readings: BTreeMap<String, String>,
    /// Id of the reading that the claim most likely meant.
    pub main_reading: String,
    /// Axes of the family: name and the values it takes, as text.
    pub axes: BTreeMap<String, Vec<String>>,
    /// Settings of the paper-like member, without the axis that sets the number of particles.
    pub paper_like: BTreeMap<String, String>,
    /// The members that were run.
    pub members: Vec<Member>,
    /// Whether these are all members of the family, or the quick subset.
    pub complete: bool,
    /// "At the same cost": id of the claim, in the same case, whose paper-like setting says how many
    /// particles a member may have. The claim then asks every member for the bound *and* the count.
    #[serde(default)]
    pub no_more_particles_than: Option<String>,
}

/// One member of a family.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Member {
    /// Value of each axis, as text. Seeds are not an axis.
    pub settings: BTreeMap<String, String>,
    /// Seed of a random packing.
    pub seed: Option<u64>,
    /// Error (fraction) under each reading.
    pub errors: BTreeMap<String, f64>,
    /// Standard uncertainty of the errors from discretisation and reference, as a fraction.
    pub u: f64,
    /// Number of particles.
    pub particles: usize,
    /// Counted work.
    pub work: Work,
    /// Wall seconds. Not deterministic.
    pub seconds: f64,
    /// Why it could not be run; then `errors` is empty.
    pub failed: Option<String>,
}

/// A total error and its signed parts.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Budget {
    /// Unique within the case.
    pub id: String,
    /// Caption.
    pub title: String,
    /// What is split, e.g. `relative error of the tip deflection`.
    pub quantity: String,
    /// Signed total, as a fraction.
    pub total: f64,
    /// Signed parts in order; they add up to the total (the last one is what stays unexplained).
    pub parts: Vec<BudgetPart>,
}

/// One rung of the ladder.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BudgetPart {
    /// Short name.
    pub name: String,
    /// Signed share, as a fraction of the reference.
    pub value: f64,
    /// Which two runs it is the difference of.
    pub how: String,
    /// Standard deviation over seeds, where there are seeds.
    pub scatter: Option<f64>,
}

/// A drawing of the bodies, undeformed and deformed, in the x–y plane.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Picture {
    /// Unique within the case.
    pub id: String,
    /// Caption.
    pub title: String,
    /// Factor the displacements are enlarged by.
    pub scale: f64,
    /// Elements as polygons: undeformed corner positions.
    pub elements: Vec<Vec<[f64; 2]>>,
    /// The same polygons, displaced by `scale` times the displacement.
    pub deformed_elements: Vec<Vec<[f64; 2]>>,
    /// Particle centres, undeformed.
    pub particles: Vec<[f64; 2]>,
    /// Particle centres, displaced.
    pub deformed_particles: Vec<[f64; 2]>,
    /// Particle radii.
    pub radii: Vec<f64>,
    /// Bonds as pairs of particle indices.
    pub bonds: Vec<[usize; 2]>,
    /// Bonds that are broken, likewise.
    #[serde(default)]
    pub broken: Vec<[usize; 2]>,
    /// Points that are held.
    pub supports: Vec<[f64; 2]>,
    /// Loads as start point and direction (unit vector).
    pub loads: Vec<[[f64; 2]; 2]>,
    /// The bodies, for their names and dimensions.
    #[serde(default)]
    pub bodies: Vec<BodyOutline>,
    /// The coupled faces.
    #[serde(default)]
    pub ties: Vec<TiedFace>,
}

/// A body of a picture.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BodyOutline {
    /// Name as in the scene file.
    pub name: String,
    /// `FE` or `DE`.
    pub method: String,
    /// Lower left and upper right corner of the box around its nodes or particles, undeformed, in metres.
    pub extent: [[f64; 2]; 2],
}

/// A coupled face of a picture.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct TiedFace {
    /// Name of the tie as in the scene file.
    pub name: String,
    /// How it is tied, e.g. `mortar`.
    pub method: String,
    /// Nodes or particles of its first face, in order along it, undeformed, in metres.
    pub line: Vec<[f64; 2]>,
}
