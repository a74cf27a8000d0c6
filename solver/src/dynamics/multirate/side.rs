//! One side of a model that is stepped at two rates: its own matrices, step and scheme.
//!
//! Newmark with `γ = ½`: `M̃ a_{n+1} = f_{n+1} − K ũ − Lᵀλ`, `M̃ = M + βΔt² K`. The step is split into a free one, without
//! λ, and the link `a = −M̃⁻¹Lᵀλ`, which adds to it.

use crate::dynamics::newmark::check_step;
use crate::dynamics::semidiscrete::{Semidiscrete, dot, row_product};
use crate::error::{Error, Result};
use crate::model::{Model, Part};
use crate::solve::kkt::{Kkt, Layout};
use crate::solve::sparse::{SymmetricMatrix, Triplets};
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// How a side goes through time.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Stepping {
    /// Central differences, `β = 0`.
    Explicit,
    /// Trapezoidal rule, `β = ¼`.
    Implicit,
}

impl Stepping {
    const fn beta(self) -> f64 {
        match self {
            Stepping::Explicit => 0.0,
            Stepping::Implicit => 0.25,
        }
    }
}

/// `M̃⁻¹`.
enum Inverse {
    Diagonal(Vec<f64>),
    Factor(Box<Kkt>),
}

/// Displacement, velocity and acceleration of a side.
#[derive(Debug, Clone, Serialize, Deserialize)]
pub(super) struct SideMotion {
    pub u: Vec<f64>,
    pub v: Vec<f64>,
    pub a: Vec<f64>,
}

impl SideMotion {
    pub fn zero(n: usize) -> Self {
        SideMotion { u: vec![0.0; n], v: vec![0.0; n], a: vec![0.0; n] }
    }

    pub fn add(&mut self, factor: f64, other: &SideMotion) {
        for (x, y) in [(&mut self.u, &other.u), (&mut self.v, &other.v), (&mut self.a, &other.a)] {
            x.iter_mut().zip(y).for_each(|(x, y)| *x += factor * y);
        }
    }
}

/// Matrices of a side on its own free unknowns.
pub(super) struct Side {
    /// Place of each unknown among the free ones of the system.
    pub unknowns: Vec<usize>,
    /// Δt, in s.
    pub step: f64,
    beta: f64,
    mass: Vec<f64>,
    stiffness: SymmetricMatrix,
    /// What each row of the system has on this side.
    rows: Vec<Vec<(usize, f64)>>,
    inverse: Inverse,
    product: Work,
}

impl Side {
    /// The parts of the system for which `mine` holds.
    ///
    /// # Errors
    /// No free unknowns, a step that is not positive, an explicit step beyond the critical one, a failed factorisation.
    pub fn new(
        model: &Model,
        system: &Semidiscrete,
        mine: impl Fn(usize) -> bool,
        stepping: Stepping,
        step: f64,
        work: &mut Work,
    ) -> Result<Self> {
        check_step(step)?;
        let part_of = |k: usize| system.numbering.locate(system.free[k]).0;
        let unknowns: Vec<usize> = (0..system.free.len()).filter(|&k| mine(part_of(k))).collect();
        if unknowns.is_empty() {
            let message = "one side has no free unknowns; put at least one body on each side".to_owned();
            return Err(Error::Geometry { what: "two time steps".to_owned(), message });
        }
        let mut place = vec![usize::MAX; system.free.len()];
        unknowns.iter().enumerate().for_each(|(k, &i)| place[i] = k);
        let beta = stepping.beta();
        let mass: Vec<f64> = unknowns.iter().map(|&k| system.mass[k]).collect();
        let (mut stiff, mut effective) = (Triplets::default(), Triplets::default());
        mass.iter().enumerate().for_each(|(i, &m)| effective.push(i, i, m));
        // Bodies are tied by multipliers only: K has no entries between the sides.
        for (r, c, k) in system.stiffness.entries().filter(|e| place[e.0] != usize::MAX) {
            stiff.push(place[r], place[c], k);
            effective.push(place[r], place[c], beta * step * step * k);
        }
        let stiffness = SymmetricMatrix::from_triplets(mass.len(), &stiff);
        let inverse = match stepping {
            Stepping::Explicit => {
                refuse_unstable(&stiffness, &mass, step)?;
                Inverse::Diagonal(mass.iter().map(|m| 1.0 / m).collect())
            }
            Stepping::Implicit => {
                let matrix = SymmetricMatrix::from_triplets(mass.len(), &effective);
                Inverse::Factor(Box::new(factorise(system, &unknowns, &matrix, work)?))
            }
        };
        let on_side = |row: &Vec<(usize, f64)>| {
            row.iter().filter(|t| place[t.0] != usize::MAX).map(|&(i, b)| (place[i], b)).collect()
        };
        let rows = system.rows.iter().map(on_side).collect();
        let mut product = Work::default();
        for (_, part) in model.parts.iter().enumerate().filter(|(p, _)| mine(*p)) {
            match part {
                Part::Continuum(body) => product.element_updates += body.mesh.cell_count() as u64,
                Part::Discrete { network, .. } => product.bond_updates += network.bonds.len() as u64,
            }
        }
        Ok(Side { unknowns, step, beta, mass, stiffness, rows, inverse, product })
    }

    /// Whether a row ties anything on this side.
    pub fn touches(&self, row: usize) -> bool {
        !self.rows[row].is_empty()
    }

    /// Values on this side.
    pub fn restrict(&self, values: &[f64]) -> Vec<f64> {
        self.unknowns.iter().map(|&k| values[k]).collect()
    }

    /// `L x`.
    pub fn trace(&self, x: &[f64]) -> Vec<f64> {
        self.rows.iter().map(|row| row_product(row, x)).collect()
    }

    /// `−Lᵀλ`.
    pub fn push(&self, lambda: &[f64]) -> Vec<f64> {
        let mut force = vec![0.0; self.mass.len()];
        for (row, l) in self.rows.iter().zip(lambda) {
            row.iter().for_each(|&(i, b)| force[i] -= b * l);
        }
        force
    }

    /// One step under the force at its end (N).
    pub fn step(&self, motion: &mut SideMotion, force: &[f64], work: &mut Work) -> Result<()> {
        let dt = self.step;
        for i in 0..motion.u.len() {
            motion.u[i] += dt * motion.v[i] + (0.5 - self.beta) * dt * dt * motion.a[i];
            motion.v[i] += 0.5 * dt * motion.a[i];
        }
        let internal = self.internal(&motion.u, work);
        let rest: Vec<f64> = force.iter().zip(&internal).map(|(f, k)| f - k).collect();
        motion.a.fill(0.0);
        let change = self.respond(&rest, [&internal, &motion.u], work)?;
        motion.add(1.0, &change);
        work.steps += 1;
        Ok(())
    }

    /// What the multipliers add at the end of a step.
    pub fn link(&self, lambda: &[f64], work: &mut Work) -> Result<SideMotion> {
        self.respond(&self.push(lambda), [&[], &[]], work)
    }

    /// `a = M̃⁻¹f` with what it adds to `u` and `v` in one step; judged beside larger forces and displacements.
    fn respond(&self, force: &[f64], beside: [&[f64]; 2], work: &mut Work) -> Result<SideMotion> {
        let dt = self.step;
        let on_u = self.beta * dt * dt;
        let a: Vec<f64> = match &self.inverse {
            Inverse::Diagonal(inverse) => force.iter().zip(inverse).map(|(f, m)| f * m).collect(),
            Inverse::Factor(kkt) => {
                let motions: Vec<f64> = beside[1].iter().map(|u| u / on_u).collect();
                kkt.solve_beside(force, &[], [beside[0], &motions], work)?.u
            }
        };
        let scaled = |s: f64| a.iter().map(|a| s * a).collect();
        Ok(SideMotion { u: scaled(on_u), v: scaled(0.5 * dt), a })
    }

    /// Algorithmic energy `½ aᵀA a + ½ vᵀK v`, `A = M + (β−¼)Δt² K` (Hughes 1983, for γ = ½), in J/s².
    pub fn algorithmic_energy(&self, motion: &SideMotion) -> f64 {
        let n = motion.a.len();
        let (mut ka, mut kv) = (vec![0.0; n], vec![0.0; n]);
        self.stiffness.multiply_add(&motion.a, &mut ka);
        self.stiffness.multiply_add(&motion.v, &mut kv);
        let inertia: f64 = motion.a.iter().zip(&self.mass).map(|(a, m)| m * a * a).sum();
        let shift = (self.beta - 0.25) * self.step * self.step;
        0.5 * (inertia + shift * dot(&motion.a, &ka) + dot(&motion.v, &kv))
    }

    /// `½ vᵀM v + ½(β−¼)Δt² aᵀM a`, in J.
    pub fn kinetic(&self, motion: &SideMotion) -> f64 {
        let weigh = |x: &[f64]| x.iter().zip(&self.mass).map(|(x, m)| m * x * x).sum::<f64>();
        0.5 * (weigh(&motion.v) + (self.beta - 0.25) * self.step * self.step * weigh(&motion.a))
    }

    fn internal(&self, u: &[f64], work: &mut Work) -> Vec<f64> {
        let mut internal = vec![0.0; u.len()];
        self.stiffness.multiply_add(u, &mut internal);
        *work += self.product;
        internal
    }
}

fn factorise(
    system: &Semidiscrete,
    unknowns: &[usize],
    matrix: &SymmetricMatrix,
    work: &mut Work,
) -> Result<Kkt> {
    let whole = system.layout();
    let (mut group, mut positions, mut last) = (Vec::new(), Vec::new(), None);
    for &k in unknowns {
        let point = whole.group[k];
        if last != Some(point) {
            last = Some(point);
            positions.push(whole.positions[point as usize]);
        }
        group.push(positions.len() as u32 - 1);
    }
    let layout = Layout { space: whole.space, group: &group, positions: &positions, row_positions: &[] };
    Kkt::new(matrix, &[], &layout, work)
}

/// Rounds of power iteration: from below, so that only steps that are certainly unstable are refused.
const POWER_ROUNDS: usize = 200;

/// # Errors
/// A step beyond `2/ω` of the highest frequency found.
fn refuse_unstable(stiffness: &SymmetricMatrix, mass: &[f64], step: f64) -> Result<()> {
    let n = mass.len();
    // Neighbours in opposite directions, as in the highest modes, with irrational steps against symmetry.
    let sign = |i: usize| if i.is_multiple_of(2) { 1.0 } else { -1.0 };
    let mut x: Vec<f64> = (0..n).map(|i| sign(i) * (1.5 + (i as f64 * 0.754_877_666).sin())).collect();
    let mut omega2 = 0.0;
    for _ in 0..POWER_ROUNDS {
        let mut y = vec![0.0; n];
        stiffness.multiply_add(&x, &mut y);
        let weight: f64 = x.iter().zip(mass).map(|(x, m)| m * x * x).sum();
        omega2 = dot(&x, &y) / weight;
        y.iter_mut().zip(mass).for_each(|(y, m)| *y /= m);
        let length = y.iter().zip(mass).map(|(y, m)| m * y * y).sum::<f64>().sqrt();
        if length == 0.0 {
            return Ok(());
        }
        x = y.into_iter().map(|y| y / length).collect();
    }
    let critical = 2.0 / omega2.sqrt();
    if step <= critical {
        return Ok(());
    }
    Err(Error::Solve {
        message: format!(
            "explicit side: step {step:.3e} s is beyond the critical one, {critical:.3e} s; use a smaller step, more steps per \
             large step, or the implicit scheme"
        ),
    })
}
