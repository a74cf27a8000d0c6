//! Networks at rest: displacement and rotation of every particle, against YADE and LAMMPS.

use super::Setting;
use super::bond_for_bond::{CODES, Task, answer, difference, observation, static_tasks, vectors};
use crate::error::Result;
use crate::export::Code;
use crate::result::CaseResult;
use seam_solver::solve::statics;
use seam_solver::space::Vec3;

/// One difference of displacements and one of rotations for each network and code.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    for code in CODES {
        for mut task in static_tasks(setting, code)? {
            setting.file.spoil_model(&mut task.model);
            compare(setting, &task, code, result)?;
        }
    }
    Ok(())
}

fn compare(setting: &Setting, task: &Task, code: Code, result: &mut CaseResult) -> Result<()> {
    let model = &task.model;
    let data = answer(setting, task, code)?;
    let solution = statics::solve(model).map_err(|e| setting.solver(e))?;
    result.work += solution.work;
    let particles = 0..model.parts[0].positions().len();
    let u: Vec<Vec3> = particles.clone().map(|p| solution.displacement(model, 0, p)).collect();
    let r: Vec<Vec3> = particles.map(|p| solution.rotation(model, 0, p)).collect();
    let axes: Vec<usize> = (0..model.space.dim()).collect();
    let turns = model.space.rotation_axes();
    let (u_theirs, r_theirs) =
        (vectors(setting, &data, "u", "m", &axes)?, vectors(setting, &data, "r", "rad", turns)?);
    for (what, own, theirs) in [("displacement", u, u_theirs), ("rotation", r, r_theirs)] {
        let (limit, why) = limit(task, code, what);
        let limit = setting.number(limit)?;
        let value = difference(&own, &theirs);
        result.quantities.push(observation(task, code, what, value, limit, &data, why));
    }
    Ok(())
}

/// The parameter that bounds a difference, and why there is one.
fn limit(task: &Task, code: Code, what: &str) -> (&'static str, &'static str) {
    match (code, what) {
        (Code::Yade, "displacement") if task.name == "chain" => (
            "yade_chain_tolerance",
            "YADE follows the particles as they move: a bending chain grows shorter by a second-order amount.",
        ),
        (Code::Yade, _) => (
            "yade_tolerance",
            "YADE follows the particles as they move, second order in deflection over length, and comes to rest to 1e-7 of the load.",
        ),
        (_, "displacement") => (
            "lammps_displacement_tolerance",
            "LAMMPS takes angles from arc cosines, which round at 1e-8 rad; third order in deflection over length is left.",
        ),
        _ => (
            "lammps_rotation_tolerance",
            "LAMMPS takes angles from arc cosines, which round at 1e-8 rad, some 1e-5 of the largest rotation.",
        ),
    }
}
