//! From a scene to a [`Model`] of the solver.

mod blueprint;
pub mod calibration;
mod conditions;
pub mod cracking;
mod failure;
mod mesh;
mod particles;
mod place;
mod switches;
pub mod time;

pub use switches::left_out as switches_left_out;

use crate::error::{Error, Fault, Result};
use crate::expression::Values;
use crate::file::SceneFile;
use crate::scene::body::{Body, Method};
use crate::scene::number::Number;
use crate::scene::{Hypothesis, Scene};
use seam_solver::failure::Failure;
use seam_solver::fem::elasticity::{self, Elasticity};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;
use std::cell::Cell;

/// A model and what was found out while it was built.
#[derive(Debug, Clone)]
pub struct Built {
    /// The model; its parts are in the alphabetical order of the scene's bodies.
    pub model: Model,
    /// Name of the support behind each entry of the model's supports.
    pub held_by: Vec<String>,
    /// Laws by which bonds break, with the part of each.
    pub laws: Vec<(usize, Failure)>,
    /// The same for strengths that the list of effects leaves out.
    pub laws_left_out: Vec<(usize, Failure)>,
    /// Packings, calibrations: what a reader must know.
    pub notes: Vec<String>,
    /// Work of the calibrations, whether they were done now or remembered.
    pub calibration: Work,
    /// Work of the random packings.
    pub packing: Work,
}

impl Built {
    /// Number of particles of all bodies.
    pub fn particles(&self) -> usize {
        let count =
            |part: &Part| if matches!(part, Part::Discrete { .. }) { part.positions().len() } else { 0 };
        self.model.parts.iter().map(count).sum()
    }
}

/// What building can fail with: the scene's fault, or the solver's refusal.
pub(crate) enum Refusal {
    Scene(Fault),
    Solver(seam_solver::error::Error),
    File(Error),
}

impl Refusal {
    /// As an error of the solver, for where it asks for particles.
    fn of_switch(self, name: &str) -> seam_solver::error::Error {
        let message = match self {
            Self::Solver(error) => return error,
            Self::Scene(fault) => format!("{}: {}; {}", fault.key, fault.message, fault.mend),
            Self::File(error) => error.to_string(),
        };
        seam_solver::error::Error::Switch { what: format!("switch '{name}'"), message }
    }

    fn of(self, file: &SceneFile) -> Error {
        match self {
            Self::Scene(fault) => file.error(fault),
            Self::Solver(error) => file.solver(error),
            Self::File(error) => error,
        }
    }
}

impl From<Fault> for Refusal {
    fn from(fault: Fault) -> Self {
        Self::Scene(fault)
    }
}

impl From<seam_solver::error::Error> for Refusal {
    fn from(error: seam_solver::error::Error) -> Self {
        Self::Solver(error)
    }
}

impl From<Error> for Refusal {
    fn from(error: Error) -> Self {
        Self::File(error)
    }
}

/// Builds the model of a scene.
///
/// # Errors
/// A fault of the scene that only shows here, or what the solver refuses.
pub fn build(file: &SceneFile) -> Result<Built> {
    let mut built = assemble(file).map_err(|refusal| refusal.of(file))?;
    file.spoil_model(&mut built.model);
    Ok(built)
}

fn assemble(file: &SceneFile) -> std::result::Result<Built, Refusal> {
    let context = Context::new(file)?;
    let mut notes = Vec::new();
    let (mut parts, mut particles_of) = (Vec::new(), Vec::new());
    for (name, body) in &file.scene.bodies {
        parts.push(match body.method {
            Method::Fe => Part::Continuum(mesh::continuum(&context, name, body)?),
            Method::De => {
                let filled = particles::network(&context, name, body, &mut notes)?;
                let network = filled.network.clone();
                particles_of.push((parts.len(), filled));
                Part::Discrete { name: name.clone(), network }
            }
        });
        check_size(&file.scene, &parts[parts.len() - 1])?;
    }
    let ties = conditions::ties(&context)?;
    let supports = conditions::supports(&context, &parts)?;
    let loads = conditions::loads(&context, &parts)?;
    failure::check_zones(&context, &parts, &supports, &loads)?;
    let (held_by, supports): (_, Vec<PointValue>) = supports.into_iter().unzip();
    let laws_among = |all| -> std::result::Result<Vec<(usize, Failure)>, Refusal> {
        let mut laws = Vec::new();
        for (part, filled) in &particles_of {
            if let Some(given) = failure::of_body(all, parts[*part].name()) {
                let held =
                    supports.iter().chain(&loads).filter(|v| v.part == *part).map(|v| v.point).collect();
                laws.push((*part, failure::law(&context, given, filled, &held)?));
            }
        }
        Ok(laws)
    };
    let laws = laws_among(&context.scene.failure)?;
    let laws_left_out = laws_among(&context.scene.left_out.failure)?;
    let model = Model { space: context.space, parts, ties, supports, loads };
    let (calibration, packing) = (context.calibration.get(), context.packing.get());
    Ok(Built { model, held_by, laws, laws_left_out, notes, calibration, packing })
}

fn check_size(scene: &Scene, part: &Part) -> std::result::Result<(), Fault> {
    let (limit, key) = match part {
        Part::Continuum(_) => (scene.limits.nodes, "limits.nodes"),
        Part::Discrete { .. } => (scene.limits.particles, "limits.particles"),
    };
    let count = part.positions().len();
    if count > limit {
        let message = format!("body '{}' has {count} {}s, the limit is {limit}", part.name(), part.noun());
        return Err(Fault::new(key, message, "coarsen the body, or raise the limit if the memory is there"));
    }
    Ok(())
}

fn add(to: &Cell<Work>, work: Work) {
    let mut sum = to.get();
    sum += work;
    to.set(sum);
}

/// What every builder needs.
pub(crate) struct Context<'a> {
    pub file: &'a SceneFile,
    pub scene: &'a Scene,
    pub values: &'a Values,
    pub space: Space,
    pub hypothesis: elasticity::Hypothesis,
    /// Work of the calibrations so far.
    pub calibration: Cell<Work>,
    /// Work of the random packings so far.
    pub packing: Cell<Work>,
}

impl<'a> Context<'a> {
    fn new(file: &'a SceneFile) -> std::result::Result<Self, Fault> {
        let (scene, values) = (&file.scene, &file.values);
        let thickness_m = scene.thickness_m.value(values, "thickness_m")?;
        let hypothesis = match scene.hypothesis {
            Hypothesis::PlaneStress => elasticity::Hypothesis::PlaneStress { thickness_m },
            Hypothesis::PlaneStrain => elasticity::Hypothesis::PlaneStrain { thickness_m },
            Hypothesis::Solid => elasticity::Hypothesis::Solid,
        };
        let space = scene.hypothesis.space();
        let (calibration, packing) = Default::default();
        Ok(Self { file, scene, values, space, hypothesis, calibration, packing })
    }

    /// Counts the work of one calibration.
    pub fn calibrated(&self, work: Work) {
        add(&self.calibration, work);
    }

    /// Counts the pairs that one packing looked at.
    pub fn packed(&self, packing_checks: u64) {
        add(&self.packing, Work { packing_checks, ..Work::default() });
    }

    /// Material of a body.
    fn elasticity(&self, body: &Body) -> std::result::Result<Elasticity, Fault> {
        let material = &self.scene.materials[&body.material];
        let key = |name: &str| format!("materials.{}.{name}", body.material);
        Ok(Elasticity {
            young_pa: material.young_pa.value(self.values, &key("young_Pa"))?,
            poisson: material.poisson.value(self.values, &key("poisson"))?,
            density: material.density_kg_m3.value(self.values, &key("density_kg_m3"))?,
        })
    }

    /// A point or vector; in the plane its third component is zero.
    pub fn vector(&self, numbers: &[Number], key: &str) -> std::result::Result<Vec3, Fault> {
        let mut x = Vec3::zeros();
        for i in 0..self.space.dim().min(numbers.len()) {
            x[i] = numbers[i].value(self.values, &format!("{key}[{i}]"))?;
        }
        Ok(x)
    }
}
