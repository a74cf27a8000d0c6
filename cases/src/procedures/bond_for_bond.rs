//! Networks that YADE and LAMMPS solve too, with the same bonds: what they are asked.

use super::bond_for_bond_networks::Kit;
use super::{Setting, rounding};
use crate::error::Result;
use crate::export::Code;
use crate::file::SceneFile;
use crate::observe::curve::nan_max;
use crate::result::{Agreement, Observation};
use crate::scene::Tier;
use seam_references::Dataset;
use seam_solver::dem::bond::BondMaterial;
use seam_solver::dem::network::Network;
use seam_solver::dynamics::forces::Rotations;
use seam_solver::model::Model;
use seam_solver::space::Vec3;

/// Procedures of this family.
pub(super) const STATIC: &str = "bond-for-bond-static";
pub(super) const DYNAMIC: &str = "bond-for-bond-dynamic";

/// A network, its loads, and what is asked of a code.
pub(crate) struct Task {
    /// Name within the case.
    pub name: &'static str,
    /// One network, clamped and loaded.
    pub model: Model,
    /// Micro material of its bonds.
    pub material: BondMaterial,
    /// Rest or motion.
    pub motion: Motion,
}

/// What a code computes.
pub(crate) enum Motion {
    /// Where it comes to rest.
    Equilibrium,
    /// How one particle moves, undamped, under a load that rises from zero.
    History(History),
}

impl Motion {
    /// In a word.
    fn name(&self) -> &'static str {
        match self {
            Motion::Equilibrium => "at rest",
            Motion::History(_) => "in motion",
        }
    }
}

/// A motion in time.
pub(crate) struct History {
    /// Time step, in s.
    pub step_s: f64,
    /// Number of steps.
    pub steps: usize,
    /// Time in which the load rises, in s.
    pub rise_s: f64,
    /// Steps between two rows.
    pub every: usize,
    /// The particle.
    pub watched: usize,
    /// How far particles turn.
    pub rotations: Rotations,
}

/// Whether a procedure is of this family.
pub(crate) fn answers(procedure: &str) -> bool {
    [STATIC, DYNAMIC].contains(&procedure)
}

/// Networks of a case that a code is to solve; none if the case has none for it.
pub(crate) fn tasks(file: &SceneFile, code: Code) -> Result<Vec<Task>> {
    let setting = Setting { file, tier: Tier::Quick };
    match file.scene.procedure.as_str() {
        STATIC => static_tasks(&setting, code),
        DYNAMIC => dynamic_tasks(&setting, code),
        _ => Ok(Vec::new()),
    }
}

pub(super) fn static_tasks(setting: &Setting, code: Code) -> Result<Vec<Task>> {
    let factor = match code {
        Code::Yade => 1.0,
        // Its angles come from arc cosines: they lose their digits under small loads.
        Code::Lammps => setting.number("lammps_factor")?,
        Code::Calculix => return Ok(Vec::new()),
    };
    let kit = Kit::new(setting)?;
    let mut networks = vec![
        ("chain", kit.chain(11)),
        ("square", kit.square(25, 6)),
        ("triangular", kit.triangular(25, 7)),
        ("hexagonal", kit.hexagonal([12, 4, 4])),
    ];
    // As many lengths as bonds, and LAMMPS wants a type for each length.
    if code == Code::Yade {
        networks.push(("random", kit.random(setting, Vec3::new(12.0, 4.0, 4.0), 8.0)?));
    }
    let task = |(name, network): (&'static str, Network)| {
        let force = factor * setting.number(&format!("{name}_N"))?;
        let model = kit.cantilever(network, Vec3::new(0.0, -force, 0.5 * force));
        Ok(Task { name, model, material: kit.material(), motion: Motion::Equilibrium })
    };
    networks.into_iter().map(task).collect()
}

pub(super) fn dynamic_tasks(setting: &Setting, code: Code) -> Result<Vec<Task>> {
    let factor = match code {
        Code::Yade => 1.0,
        Code::Lammps => setting.number("lammps_factor")?,
        Code::Calculix => return Ok(Vec::new()),
    };
    let kit = Kit::new(setting)?;
    let task = |name: &'static str, network: Network, factor: f64, rotations| {
        let of = |key: &str| format!("{name}_{key}");
        let force = factor * setting.number(&of("N"))?;
        let model = kit.cantilever(network, Vec3::new(0.0, -force, 0.0));
        let history = History {
            step_s: setting.number(&of("step_s"))?,
            steps: setting.count(&of("steps"), 1)?,
            rise_s: setting.number(&of("rise_s"))?,
            every: setting.count(&of("every"), 1)?,
            watched: model.loads[0].point,
            rotations,
        };
        Ok(Task { name, model, material: kit.material(), motion: Motion::History(history) })
    };
    Ok(vec![
        task("ramp", kit.triangular(25, 7), factor, Rotations::Small)?,
        task("turning", kit.chain(21), 1.0, Rotations::Finite)?,
    ])
}

/// The codes that networks are given to.
pub(super) const CODES: [Code; 2] = [Code::Yade, Code::Lammps];

/// What a code made of a task.
pub(super) fn answer(setting: &Setting, task: &Task, code: Code) -> Result<Dataset> {
    let source = format!("{}-{}", task.name, code.name());
    setting.dataset(&setting.file.scene.id, &source)
}

/// The columns `<prefix>x`, `<prefix>y`, `<prefix>z` as vectors; components that the plane does not have are zero.
pub(super) fn vectors(
    setting: &Setting,
    data: &Dataset,
    prefix: &str,
    unit: &str,
    axes: &[usize],
) -> Result<Vec<Vec3>> {
    let mut vectors = vec![Vec3::zeros(); data.rows()];
    for &axis in axes {
        let name = format!("{prefix}{}", ["x", "y", "z"][axis]);
        let column = data.column(&name, unit).map_err(|problem| setting.reference(problem))?;
        vectors.iter_mut().zip(column).for_each(|(v, x)| v[axis] = *x);
    }
    Ok(vectors)
}

/// Largest `|a − b|` over the largest `|b|`; NaN if they are not equally many.
pub(super) fn difference(a: &[Vec3], b: &[Vec3]) -> f64 {
    let largest = b.iter().map(|b| b.norm()).fold(0.0, f64::max);
    match a.len() == b.len() && largest > 0.0 {
        true => a.iter().zip(b).map(|(a, b)| (a - b).norm() / largest).fold(0.0, nan_max),
        false => f64::NAN,
    }
}

/// A difference from a code, to be judged.
pub(super) fn observation(
    task: &Task,
    code: Code,
    what: &str,
    value: f64,
    limit: f64,
    data: &Dataset,
    why: &str,
) -> Observation {
    let title = code.title();
    let id = format!("{}-{}-{what}", task.name, code.name());
    let label = format!("{} network, largest difference of a {what} from {title}", task.name);
    let p = &data.provenance;
    let source = format!("{title} {}, run on {} ({})", p.version, p.date, p.machine);
    let agreement = Agreement {
        code: title.to_owned(),
        version: p.version.clone(),
        date: p.date.to_string(),
        model: format!("{} network, {}", task.name, task.motion.name()),
        compared: what.to_owned(),
        same_model: true,
    };
    Observation {
        kind: code.kind(),
        agreement: Some(agreement),
        ..rounding(&id, &label, value, limit, why, &source)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_difference_is_relative_to_the_largest_vector() {
        let b = [Vec3::new(3.0, 4.0, 0.0), Vec3::zeros()];
        let a = [b[0], Vec3::new(0.0, 0.0, 0.05)];
        assert!((difference(&a, &b) - 0.01).abs() < 1e-15);
        assert!(difference(&a[..1], &b).is_nan());
        assert!(difference(&a, &[Vec3::zeros(); 2]).is_nan());
        assert!(difference(&[Vec3::repeat(f64::NAN), b[1]], &b).is_nan());
    }
}
