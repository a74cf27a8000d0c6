//! What a switch did to forces, energies and momentum.

use super::momentum::Momentum;
use crate::dynamics::State;
use crate::dynamics::semidiscrete::{Semidiscrete, dot, lumped};
use crate::error::Result;
use crate::model::{Model, Numbering, Part};
use crate::solve::kkt::Kkt;
use crate::solve::statics;
use crate::space::{Vec3, components};
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// Forces, energies and momentum of a model in a state.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct Balance {
    /// Strain energy, in J.
    pub strain: f64,
    /// Kinetic energy, in J.
    pub kinetic: f64,
    /// Momentum about the origin.
    pub momentum: Momentum,
    /// `Σ m|v|`, in N s: what a jump of momentum is relative to.
    pub momentum_scale: f64,
    /// `‖r‖/‖f_int‖` with `r = f − K u − Bᵀλ = M a` and norms `√(rᵀM⁻¹r)`, in which forces and moments weigh alike.
    pub unbalanced: f64,
    /// Largest gap of a constraint, in m.
    pub gap: f64,
}

/// The state of a model under its loads scaled by `factor`.
///
/// # Errors
/// As [`Semidiscrete::new`]; a solve that fails.
pub fn balance(model: &Model, state: &State, factor: f64, work: &mut Work) -> Result<Balance> {
    let system = Semidiscrete::new(model, work)?;
    let stiffness = statics::assemble_stiffness(model, &system.numbering, work)?;
    let mass = lumped(model, &system.numbering)?;
    let mut internal = vec![0.0; mass.len()];
    stiffness.multiply_add(&state.u, &mut internal);
    let inner: Vec<f64> = system.free.iter().map(|&i| internal[i]).collect();
    let rhs: Vec<f64> = system.load.iter().zip(&inner).map(|(f, k)| factor * f - k).collect();
    let kkt = Kkt::new(&system.mass_matrix(), &system.rows, &system.layout(), work)?;
    let alone: Vec<f64> = inner.iter().zip(&system.mass).map(|(k, m)| k / m).collect();
    let a = kkt.solve_beside(&rhs, &vec![0.0; system.rows.len()], [&inner, &alone], work)?.u;
    let unbalanced = a.iter().zip(&system.mass).map(|(a, m)| m * a * a).sum::<f64>().sqrt();
    let forces = inner.iter().zip(&system.mass).map(|(k, m)| k * k / m).sum::<f64>().sqrt();
    let motion = system.motion(state);
    Ok(Balance {
        strain: 0.5 * dot(&state.u, &internal),
        kinetic: 0.5 * mass.iter().zip(&state.v).map(|(m, v)| m * v * v).sum::<f64>(),
        momentum: Momentum::of(model, &mass, &state.v),
        momentum_scale: mass.iter().zip(&state.v).map(|(m, v)| (m * v).abs()).sum(),
        unbalanced: if forces > 0.0 { unbalanced / forces } else { 0.0 },
        gap: system.gap(&motion.u),
    })
}

/// Force that a body of a model exerts on some of its points, in N.
///
/// # Errors
/// Bad elements or bonds.
pub fn force_on(model: &Model, part: usize, state: &State, points: &[usize]) -> Result<Vec3> {
    let alone = Model {
        space: model.space,
        parts: vec![model.parts[part].clone()],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    let first = Numbering::new(model).offset(part);
    let numbering = Numbering::new(&alone);
    let stiffness = statics::assemble_stiffness(&alone, &numbering, &mut Work::default())?;
    let mut internal = vec![0.0; numbering.len()];
    stiffness.multiply_add(&state.u[first..first + numbering.len()], &mut internal);
    let mut force = Vec3::zeros();
    for &point in points {
        (0..model.space.dim()).for_each(|c| force[c] += internal[numbering.unknown(0, point, c)]);
    }
    Ok(force)
}

/// Force through one face of the region.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct InterfaceForce {
    /// Name of the face.
    pub face: String,
    /// By the elements that went, in N.
    #[serde(with = "components")]
    pub before: Vec3,
    /// By the particles that came, in N.
    #[serde(with = "components")]
    pub after: Vec3,
}

/// A switch, before and after.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub struct SwitchReport {
    /// Time of the switch, in s.
    pub time: f64,
    /// Elements replaced.
    pub elements: usize,
    /// Particles that came.
    pub particles: usize,
    /// The model of elements.
    pub before: Balance,
    /// The new model as its fields were mapped, before any relaxation.
    pub mapped: Balance,
    /// The new model as it goes on.
    pub after: Balance,
    /// Force through each coupled face.
    pub interface: Vec<InterfaceForce>,
}

impl SwitchReport {
    /// `(E_after − E_before) / E_before` of the strain energy; zero where there was none.
    pub fn strain_energy_jump(&self) -> f64 {
        relative(self.after.strain - self.before.strain, self.before.strain)
    }

    /// Jump of linear momentum over `Σ m|v|`.
    pub fn momentum_jump(&self) -> f64 {
        let jump = self.after.momentum - self.before.momentum;
        relative(jump.linear.norm(), self.before.momentum_scale)
    }

    /// Jump of angular momentum over `Σ m|v|` times `length` (m).
    pub fn angular_momentum_jump(&self, length: f64) -> f64 {
        let jump = self.after.momentum - self.before.momentum;
        relative(jump.angular.norm(), self.before.momentum_scale * length)
    }

    /// Largest jump of force through a face over the largest force before.
    pub fn reaction_jump(&self) -> f64 {
        let largest = self.interface.iter().map(|f| f.before.norm()).fold(0.0, f64::max);
        let jumps = self.interface.iter().map(|f| (f.after - f.before).norm());
        relative(jumps.fold(0.0, f64::max), largest)
    }
}

fn relative(change: f64, size: f64) -> f64 {
    if size > 0.0 { change / size } else { 0.0 }
}

/// The points of a part on a face of the region, for [`force_on`].
pub(super) fn points_on(part: &Part, on_face: impl Fn(Vec3) -> bool) -> Vec<usize> {
    let positions = part.positions();
    (0..positions.len()).filter(|&i| on_face(positions[i])).collect()
}
