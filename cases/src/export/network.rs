//! A network of particles and bonds, its supports, loads and run.

use super::{Code, DISPLACEMENTS, Export, FORCES, point_values};
use crate::error::{Fault, Result};
use crate::file::SceneFile;
use crate::procedures::bond_for_bond::{Motion, Task};
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::network::Network;
use seam_solver::dem::network_csv::{bonds_csv, particles_csv};
use seam_solver::dynamics::critical;
use seam_solver::dynamics::forces::Rotations;
use seam_solver::model::{Model, Part};
use seam_solver::space::Space;
use std::collections::BTreeMap;

/// Share of the critical step at which a code relaxes: its own damping takes some of the margin.
const STEP_SHARE: f64 = 0.7;
/// A code is at rest when no unbalanced force exceeds this share of the largest load: below what is compared,
/// above the rounding of positions.
const RESIDUAL: f64 = 1e-7;

/// A network of the bond-for-bond cases.
pub fn of_task(file: &SceneFile, code: Code, task: &Task) -> Result<Export> {
    let Part::Discrete { network, .. } = &task.model.parts[0] else {
        return Err(no_network(file));
    };
    let run = match &task.motion {
        Motion::Equilibrium => equilibrium(file, &task.model)?,
        Motion::History(h) => format!(
            "motion = \"history\"\nstep_s = {:?}\nsteps = {}\nrise_s = {:?}\nevery = {}\nwatched = {}\nrotations = \"{}\"\n",
            h.step_s,
            h.steps,
            h.rise_s,
            h.every,
            h.watched,
            if h.rotations == Rotations::Finite { "finite" } else { "small" },
        ),
    };
    let files = files(network, task.material, &task.model, &run);
    Ok(Export { case: file.scene.id.clone(), name: task.name.to_owned(), code, files })
}

/// The network of a scene, to be brought to rest.
pub fn of_scene(file: &SceneFile, network: &Network, model: &Model) -> Result<BTreeMap<String, String>> {
    Ok(free(network, model, &equilibrium(file, model)?))
}

/// A network whose micro material is not known any more: the stiffnesses are in the file, and they count.
pub fn free(network: &Network, model: &Model, run: &str) -> BTreeMap<String, String> {
    files(network, BondMaterial { young_pa: 1.0, poisson: 0.0 }, model, run)
}

fn equilibrium(file: &SceneFile, model: &Model) -> Result<String> {
    let critical = critical::bound(model).map_err(|e| file.solver(e))?;
    let step = STEP_SHARE * critical.step_s;
    Ok(format!("motion = \"equilibrium\"\nstep_s = {step:?}\nresidual = {RESIDUAL:?}\n"))
}

fn files(network: &Network, material: BondMaterial, model: &Model, run: &str) -> BTreeMap<String, String> {
    let space = match network.space {
        Space::Plane => "plane",
        Space::Solid => "solid",
    };
    let file = |name: &str, text: String| (name.to_owned(), text);
    BTreeMap::from([
        file("particles.csv", particles_csv(network)),
        file("bonds.csv", bonds_csv(network, material)),
        file("supports.csv", point_values(model, &model.supports, DISPLACEMENTS, "particle")),
        file("loads.csv", point_values(model, &model.loads, FORCES, "particle")),
        file("run.toml", format!("space = \"{space}\"\n{run}")),
    ])
}

fn no_network(file: &SceneFile) -> crate::error::Error {
    file.error(Fault::new("procedure", "has no network to export", "export another case"))
}
