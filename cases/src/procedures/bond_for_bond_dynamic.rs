//! Networks in motion: the tip at every instant, against YADE and LAMMPS.

use super::Setting;
use super::bond_for_bond::{
    CODES, History, Motion, Task, answer, difference, dynamic_tasks, observation, vectors,
};
use crate::error::Result;
use crate::export::Code;
use crate::result::{CaseResult, Plot, Role, Series};
use seam_solver::dynamics::State;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::forces::Rotations;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::model::Numbering;
use seam_solver::space::Vec3;

/// One difference of displacements and one of rotations for each history and code, and the histories as curves.
pub fn run(setting: &Setting, result: &mut CaseResult) -> Result<()> {
    for code in CODES {
        for task in dynamic_tasks(setting, code)? {
            if let Motion::History(history) = &task.motion {
                compare(setting, &task, history, code, result)?;
            }
        }
    }
    Ok(())
}

fn compare(
    setting: &Setting,
    task: &Task,
    history: &History,
    code: Code,
    result: &mut CaseResult,
) -> Result<()> {
    let data = answer(setting, task, code)?;
    let (u, r) = integrate(setting, task, history, history.rotations, result)?;
    let u_theirs = vectors(setting, &data, "u", "m", &[0, 1])?;
    let r_theirs = vectors(setting, &data, "r", "rad", &[2])?;
    let time = data.column("t", "s").map_err(|problem| setting.reference(problem))?.to_vec();
    let title = code.name().to_uppercase();
    let series = |name: &str, role, u: &[Vec3]| Series {
        name: name.to_owned(),
        role,
        x: time.clone(),
        y: u.iter().map(|u| u.y).collect(),
    };
    result.curves.push(Plot {
        id: format!("{}-{}", task.name, code.name()),
        title: format!("Deflection of the tip, {} network", task.name),
        x_label: "time (s)".to_owned(),
        y_label: "u_y (m)".to_owned(),
        series: vec![series("Seam", Role::Model, &u), series(&title, Role::Reference, &u_theirs)],
        ..Plot::default()
    });
    if history.rotations == Rotations::Finite && code == Code::Yade {
        let (small, _) = integrate(setting, task, history, Rotations::Small, result)?;
        let value = difference(&small, &u_theirs);
        let why = "A check of the check: bonds for small rotations must show on a chain that turns this far.";
        let mut apart = observation(task, code, "displacement", value, 1.0, &data, why);
        apart.id = format!("{}-small", task.name);
        apart.label = format!("{}, with small rotations: must differ", apart.label);
        apart.accepted = Some([0.02, 1.0]);
        apart.agreement = None;
        result.quantities.push(apart);
    }
    for (what, own, theirs) in [("displacement", u, u_theirs), ("rotation", r, r_theirs)] {
        let (limit, why) = limit(history, code, what);
        let limit = setting.number(limit)?;
        let value = difference(&own, &theirs);
        result.quantities.push(observation(task, code, what, value, limit, &data, why));
    }
    Ok(())
}

/// Displacement and rotation of the watched particle, from rest and after every so many steps.
fn integrate(
    setting: &Setting,
    task: &Task,
    history: &History,
    rotations: Rotations,
    result: &mut CaseResult,
) -> Result<(Vec<Vec3>, Vec<Vec3>)> {
    let numbering = Numbering::new(&task.model);
    let options = Options {
        step_s: history.step_s,
        loads: LoadFactor::Ramp { start_s: 0.0, rise_s: history.rise_s },
        rotations,
        ..Options::default()
    };
    let refuse = |e| setting.solver(e);
    let rest = State::at_rest(numbering.len());
    let mut motion = Explicit::new(&task.model, options, &rest).map_err(refuse)?;
    let first = numbering.unknown(0, history.watched, 0);
    let (mut u, mut r) = (vec![Vec3::zeros()], vec![Vec3::zeros()]);
    for _ in 0..history.steps / history.every {
        motion.advance(history.every as u64).map_err(refuse)?;
        let now = &motion.u()[first..];
        u.push(Vec3::new(now[0], now[1], 0.0));
        r.push(Vec3::new(0.0, 0.0, now[2]));
    }
    result.work += motion.work();
    Ok((u, r))
}

/// The parameter that bounds a difference, and why there is one.
fn limit(history: &History, code: Code, what: &str) -> (&'static str, &'static str) {
    match (history.rotations, code, what) {
        (Rotations::Finite, ..) => (
            "turning_tolerance",
            "Each code has its own bond for large rotations; they differ by the square of the rotation within one bond.",
        ),
        (Rotations::Small, Code::Yade, _) => (
            "yade_tolerance",
            "The same leapfrog; YADE follows the particles as they move, second order in deflection over length.",
        ),
        (Rotations::Small, _, "displacement") => (
            "lammps_tolerance",
            "The same leapfrog; LAMMPS takes angles from arc cosines, which round at 1e-8 rad.",
        ),
        (Rotations::Small, ..) => (
            "lammps_rotation_tolerance",
            "LAMMPS takes angles from arc cosines, which round at 1e-8 rad, some 1e-5 of the largest rotation.",
        ),
    }
}
