//! A network of particles and bonds, its supports, loads and run.

use super::{Code, DISPLACEMENTS, Export, FORCES, point_values};
use crate::error::{Fault, Result};
use crate::file::SceneFile;
use crate::observe::field::Field;
use crate::procedures::bond_for_bond::{Motion, Task};
use crate::procedures::breaking_specimens::Specimen;
use crate::scene::dynamics::{Dynamics, Loads, Stepping};
use crate::scene::number::Number;
use crate::scene::probe::Read;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::network::Network;
use seam_solver::dem::network_csv::{bonds_csv, particles_csv};
use seam_solver::dynamics::critical;
use seam_solver::dynamics::forces::Rotations;
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::space::{Space, Vec3};
use std::collections::{BTreeMap, BTreeSet};

/// Share of the critical step at which a code relaxes: its own damping takes some of the margin.
const STEP_SHARE: f64 = 0.7;
/// A code is at rest when no displacement changes by more than this share of the largest within a period of the slowest
/// mode. Critical damping leaves e^-2π of what was missing, so that what is still missing is far smaller; the rounding of
/// LAMMPS's angles is a tenth. Unbalanced forces would be the wrong sign: those of fast modes are mostly the rounding of
/// positions, and a slow mode needs little.
const SETTLED: f64 = 1e-6;
/// Codes that follow the particles as they move are given this share of a scene's loads, and their answers scaled.
const LOAD_SHARE: f64 = 1e-3;
/// While bonds break, no unbalanced force exceeds this share of the force on what is moved: far below the lead of the bond that breaks over the next.
const BREAKING_RESIDUAL: f64 = 1e-6;

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

/// The network of a variant of a scene, at rest or in motion.
pub fn of_peer(file: &SceneFile, network: &Network, model: &Model) -> Result<BTreeMap<String, String>> {
    let run = match &file.scene.dynamics {
        None => equilibrium(file, model)?,
        Some(dynamics) => history(file, dynamics, model)?,
    };
    Ok(free(network, model, &format!("{run}load_share = {LOAD_SHARE:?}\n")))
}

/// A notched network with the strengths of its bonds.
pub fn of_specimen(file: &SceneFile, specimen: &Specimen) -> Result<Export> {
    let Part::Discrete { network, .. } = &specimen.model.parts[0] else {
        return Err(no_network(file));
    };
    let critical = critical::bound(&specimen.model).map_err(|e| file.solver(e))?;
    let run = format!(
        "motion = \"breaking\"\nstep_s = {:?}\nresidual = {BREAKING_RESIDUAL:?}\nevents = {}\n",
        STEP_SHARE * critical.step_s,
        specimen.events
    );
    let mut files = files(network, specimen.material, &specimen.model, &run);
    let mut strengths = String::from("bond,strength_Pa\n");
    for bond in (0..network.bonds.len()).filter(|&b| specimen.breakable[b]) {
        strengths += &format!("{bond},{:?}\n", specimen.strength_pa);
    }
    files.insert("strengths.csv".to_owned(), strengths);
    Ok(Export { case: file.scene.id.clone(), name: String::new(), code: Code::Yade, files })
}

/// A network whose micro material is not known any more: the stiffnesses are in the file, and they count.
pub fn free(network: &Network, model: &Model, run: &str) -> BTreeMap<String, String> {
    files(network, BondMaterial { young_pa: 1.0, poisson: 0.0 }, model, run)
}

/// A run of central differences under a ramp, watched around the points of the probes.
fn history(file: &SceneFile, dynamics: &Dynamics, model: &Model) -> Result<String> {
    let value = |number: &Number, key: &str| {
        number.value(&file.values, &format!("dynamics.{key}")).map_err(|fault| file.error(fault))
    };
    let (Stepping::Explicit, Some(step), Loads::Ramp(ramp)) =
        (dynamics.stepping, &dynamics.step_s, &dynamics.loads)
    else {
        let mend = "let its variants be explicit with `step_s`, under a ramp";
        return Err(file.error(Fault::new("dynamics", "no other code is given such a motion", mend)));
    };
    let (end, outputs) = (value(&dynamics.end_s, "end_s")?, value(&dynamics.outputs, "outputs")?);
    let steps = (end / value(step, "step_s")? - 1e-9).ceil();
    if value(&ramp.start_s, "loads.ramp.start_s")? != 0.0 || steps % outputs != 0.0 {
        let mend = "start the ramp at zero, and let each output be a whole number of steps";
        return Err(file.error(Fault::new("dynamics", "no other code is given such a motion", mend)));
    }
    let still = vec![0.0; Numbering::new(model).len()];
    let field = Field::new(model, &still);
    let mut watched = BTreeSet::new();
    for (name, probe) in &file.scene.probes {
        let displacement = matches!(probe.read, Read::Ux | Read::Uy | Read::Uz);
        if let Some(point) = probe.point.as_ref().filter(|_| displacement && probe.is_history()) {
            let mut x = Vec3::zeros();
            for (i, number) in point.iter().enumerate().take(model.space.dim()) {
                let key = format!("probes.{name}.point[{i}]");
                x[i] = number.value(&file.values, &key).map_err(|fault| file.error(fault))?;
            }
            watched.extend(field.particles_read_at(x));
        }
    }
    Ok(format!(
        "motion = \"history\"\nstep_s = {:?}\nsteps = {steps}\nrise_s = {:?}\nevery = {}\nwatched = {:?}\nrotations = \"small\"\n",
        end / steps,
        value(&ramp.rise_s, "loads.ramp.rise_s")?,
        steps / outputs,
        Vec::from_iter(watched),
    ))
}

fn equilibrium(file: &SceneFile, model: &Model) -> Result<String> {
    let critical = critical::bound(model).map_err(|e| file.solver(e))?;
    let step = STEP_SHARE * critical.step_s;
    Ok(format!("motion = \"equilibrium\"\nstep_s = {step:?}\nsettled = {SETTLED:?}\n"))
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
