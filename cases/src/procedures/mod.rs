//! What computes a case: statics of its scene, or a verification that needs no bodies.
//!
//! A new procedure is one file and one line of the registry.

mod bar_impact;
mod bar_sudden_load;
mod bend;
pub(crate) mod bond_for_bond;
mod bond_for_bond_dynamic;
mod bond_for_bond_networks;
mod bond_for_bond_static;
mod bond_matrix;
pub(crate) mod breaking_bonds;
pub(crate) mod breaking_specimens;
mod calculix;
mod cantilever_eigenfrequencies;
mod compared;
mod cracked_specimens;
mod elastic_bar;
mod elastica;
mod hard;
mod homogenisation;
mod interface_reflection;
mod lattice_constants;
mod long_run;
mod manufactured;
mod notch_singularity;
mod notched_concrete;
mod plane_reflection;
mod rigid_rotation;
mod roll_up;
mod scattering;
mod slender;
mod slit_lattice;
mod specimen;
mod straight;
mod subcycling;
mod time_step_orders;
mod toughness;

use crate::checkpoint::Checkpoints;
use crate::error::{Error, Fault, Result};
use crate::file::SceneFile;
use crate::result::{CaseResult, Observation};
use crate::scene::Tier;
use crate::study::{self, Run};
use seam_references::{Dataset, find};
use std::time::Instant;

/// A verification: fills in the quantities and studies of a result that has its head.
type Procedure = fn(&Setting, &mut CaseResult) -> Result<()>;

/// Names and procedures that need no bodies.
const REGISTRY: &[(&str, Procedure)] = &[
    ("bad-states", hard::bad_states::run),
    ("bar-impact", bar_impact::run),
    ("bar-sudden-load", bar_sudden_load::run),
    (bond_for_bond::DYNAMIC, bond_for_bond_dynamic::run),
    (bond_for_bond::STATIC, bond_for_bond_static::run),
    ("bond-matrix", bond_matrix::run),
    (breaking_bonds::BENT, breaking_bonds::run),
    (breaking_bonds::PULLED, breaking_bonds::run),
    ("bond-radius", hard::bond_radius::run),
    ("calculix", calculix::run),
    ("cantilever-eigenfrequencies", cantilever_eigenfrequencies::run),
    ("constraints", hard::constraints::run),
    ("contact-after-break", hard::contact_after_break::run),
    ("contrast", hard::contrast::run),
    ("critical-step", hard::critical_step::run),
    ("distortion", hard::distortion::run),
    ("elastica", elastica::run),
    ("homogenisation", homogenisation::run),
    ("incompressible", hard::incompressible::run),
    ("interface-reflection", interface_reflection::run),
    ("lattice-constants", lattice_constants::run),
    ("long-run", long_run::run),
    ("manufactured", manufactured::run),
    ("notch-singularity", notch_singularity::run),
    ("notched-concrete", notched_concrete::run),
    ("reproducible", hard::reproducible::run),
    ("rigid-rotation", rigid_rotation::run),
    ("roll-up", roll_up::run),
    ("single-break", hard::single_break::run),
    ("slenderness", hard::slenderness::run),
    ("stability-maps", hard::maps::run),
    ("subcycling", subcycling::run),
    ("time-step-orders", time_step_orders::run),
    ("toughness", toughness::run),
    ("transfer-at-peak", hard::transfer_at_peak::run),
];

/// Names a scene may give as its procedure.
pub fn names() -> impl Iterator<Item = &'static str> + Clone {
    std::iter::once("statics").chain(REGISTRY.iter().map(|(name, _)| *name))
}

/// Runs a case.
///
/// # Errors
/// A fault of the scene, or what the solver refuses.
pub fn run(file: &SceneFile, tier: Tier) -> Result<Run> {
    run_keeping(file, tier, &Checkpoints::default())
}

/// The same with checkpoints of the scene's run in time.
///
/// # Errors
/// As [`run`]; a case that has no run in time; a checkpoint that cannot be read, written or used.
pub fn run_keeping(file: &SceneFile, tier: Tier, checkpoints: &Checkpoints) -> Result<Run> {
    if file.scene.dynamics.is_none() && !checkpoints.is_off() {
        let message = "the case has no run in time to keep or to restart; leave the checkpoints out";
        return Err(file.error(Fault::new("dynamics", message, "name a scene with [dynamics]")));
    }
    let Some((_, procedure)) = REGISTRY.iter().find(|(name, _)| *name == file.scene.procedure) else {
        return study::run(file, tier, checkpoints);
    };
    let start = Instant::now();
    let mut result = study::head(file, tier);
    procedure(&Setting { file, tier }, &mut result)?;
    result.seconds = start.elapsed().as_secs_f64();
    Ok(Run { result, fields: None })
}

/// A scene without bodies: its parameters are the settings of the procedure.
struct Setting<'a> {
    file: &'a SceneFile,
    tier: Tier,
}

impl Setting<'_> {
    /// A parameter that the procedure needs.
    fn number(&self, name: &str) -> Result<f64> {
        self.file.values.get(name).copied().ok_or_else(|| {
            let message =
                format!("the procedure '{}' needs the parameter '{name}'", self.file.scene.procedure);
            self.file.error(Fault::new("parameters", message, "add it"))
        })
    }

    /// A whole number of at least `least`.
    fn count(&self, name: &str, least: usize) -> Result<usize> {
        let value = self.number(name)?;
        if value.fract() != 0.0 || value < least as f64 || value > 1e6 {
            let message = format!("expected a whole number of at least {least}, found {value}");
            return Err(self.file.error(Fault::new(format!("parameters.{name}"), message, "change it")));
        }
        Ok(value as usize)
    }

    /// A parameter with one value per tier: `name_quick`, `name_full`.
    fn count_of_tier(&self, name: &str, least: usize) -> Result<usize> {
        self.count(&format!("{name}_{}", self.tier.name()), least)
    }

    fn solver(&self, source: seam_solver::error::Error) -> Error {
        self.file.solver(source)
    }

    fn reference(&self, source: seam_references::Problem) -> Error {
        Error::Reference { case: self.file.scene.id.clone(), source: Box::new(source) }
    }

    /// The numbers of a reference, once they are known to be whole.
    fn dataset(&self, case: &str, source: &str) -> Result<Dataset> {
        let spoiled = |mut reference| {
            self.file.spoil_reference(&mut reference);
            reference
        };
        let found = find(case, source).map(spoiled);
        found.and_then(|reference| reference.open()).map_err(|problem| self.reference(problem))
    }
}

/// A difference that only rounding may cause.
fn rounding(id: &str, label: &str, value: f64, limit: f64, why: &str, source: &str) -> Observation {
    Observation {
        id: id.to_owned(),
        label: label.to_owned(),
        unit: "1".to_owned(),
        value,
        source: source.to_owned(),
        accepted: Some([0.0, limit]),
        why: why.to_owned(),
        ..Observation::default()
    }
}
