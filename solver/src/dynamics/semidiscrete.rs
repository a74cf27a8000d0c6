//! A model discretised in space, not yet in time: `M a + c M v + K u + Bᵀλ = f(t)`, `B u = g`.
//!
//! M is lumped: row sums for elements, mass and inertia for particles. Prescribed unknowns are taken out; they keep
//! their value for all time.

use super::State;
use crate::error::{Error, Result};
use crate::fem::loads::lumped_mass;
use crate::model::{Model, Numbering, Part, PointValue};
use crate::solve::kkt::Layout;
use crate::solve::norm::norm;
use crate::solve::sparse::{SymmetricMatrix, Triplets};
use crate::solve::statics;
use crate::space::{Space, Vec3};
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// Matrices and vectors of a model on its free unknowns.
pub struct Semidiscrete {
    /// Numbering of all unknowns.
    pub numbering: Numbering,
    /// The free ones, ascending.
    pub free: Vec<usize>,
    /// Value of each prescribed unknown, in m and rad.
    pub prescribed: Vec<Option<f64>>,
    /// K, in N/m, N, N m.
    pub stiffness: SymmetricMatrix,
    /// Diagonal of M, in kg and kg m².
    pub mass: Vec<f64>,
    /// Rows of B.
    pub rows: Vec<Vec<(usize, f64)>>,
    /// g: what the prescribed unknowns leave for each row.
    pub gaps: Vec<f64>,
    /// The model's loads, to be scaled in time; in N and N m.
    pub load: Vec<f64>,
    /// What each row ties, in words.
    pub labels: Vec<String>,
    /// Constraint rows that were dropped, and why.
    pub notes: Vec<String>,
    /// Forces of the prescribed displacements: constant.
    held: Vec<f64>,
    /// Strain energy of the prescribed displacements alone, in J.
    held_energy: f64,
    /// Stiffness in the rows of the prescribed unknowns, on all unknowns.
    held_stiffness: Vec<(usize, usize, f64)>,
    /// Loads on prescribed unknowns, in N and N m.
    held_load: Vec<(usize, f64)>,
    /// Work of one product with K.
    product: Work,
    space: Space,
    group: Vec<u32>,
    positions: Vec<Vec3>,
    row_positions: Vec<Vec3>,
}

/// Displacement, velocity and acceleration on the free unknowns of a [`Semidiscrete`].
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Motion {
    /// Time, in s.
    pub time: f64,
    /// Displacements and rotations, in m and rad.
    pub u: Vec<f64>,
    /// Velocities and spins, in m/s and rad/s.
    pub v: Vec<f64>,
    /// Accelerations, in m/s² and rad/s².
    pub a: Vec<f64>,
}

impl Semidiscrete {
    /// Assembles a model.
    ///
    /// # Errors
    /// As [`statics::solve`] for bodies and ties; an unknown without mass.
    pub fn new(model: &Model, work: &mut Work) -> Result<Self> {
        crate::check::model(model)?;
        let numbering = Numbering::new(model);
        let n = numbering.len();
        let mut product = Work::default();
        let full = statics::assemble_stiffness(model, &numbering, &mut product)?;
        *work += product;
        let mut prescribed: Vec<Option<f64>> = vec![None; n];
        for PointValue { part, point, component, value } in &model.supports {
            prescribed[numbering.unknown(*part, *point, *component)] = Some(*value);
        }
        let free: Vec<usize> = (0..n).filter(|&i| prescribed[i].is_none()).collect();
        let mut place = vec![usize::MAX; n];
        free.iter().enumerate().for_each(|(k, &i)| place[i] = k);
        let tied = statics::constraints(model, &numbering, &prescribed, &place)?;
        let (stiffness, held) = statics::eliminate(&full, &vec![0.0; n], &prescribed, &free, &place);
        let alone: Vec<f64> = prescribed.iter().map(|p| p.unwrap_or(0.0)).collect();
        let mut internal = vec![0.0; n];
        full.multiply_add(&alone, &mut internal);
        let mut load = vec![0.0; n];
        for PointValue { part, point, component, value } in &model.loads {
            load[numbering.unknown(*part, *point, *component)] += value;
        }
        let mass = lumped(model, &numbering)?;
        let (group, positions) = statics::points_of(model, &numbering, &free);
        let mut held_stiffness = Vec::new();
        for (r, c, k) in full.entries() {
            let both = [(r, c), (c, r)];
            let halves = &both[..if r == c { 1 } else { 2 }];
            held_stiffness.extend(halves.iter().filter(|h| prescribed[h.0].is_some()).map(|h| (h.0, h.1, k)));
        }
        let loaded = |i: &usize| prescribed[*i].is_some() && load[*i] != 0.0;
        Ok(Semidiscrete {
            held_load: (0..n).filter(loaded).map(|i| (i, load[i])).collect(),
            mass: free.iter().map(|&i| mass[i]).collect(),
            load: free.iter().map(|&i| load[i]).collect(),
            held_energy: 0.5 * dot(&alone, &internal),
            row_positions: tied.rows.iter().map(|r| r.position).collect(),
            labels: tied.rows.into_iter().map(|r| r.label).collect(),
            rows: tied.reduced,
            gaps: tied.rhs,
            notes: tied.notes,
            space: model.space,
            numbering,
            free,
            prescribed,
            stiffness,
            held,
            held_stiffness,
            product,
            group,
            positions,
        })
    }

    /// What an elimination order is made from.
    pub fn layout(&self) -> Layout<'_> {
        Layout {
            space: self.space,
            group: &self.group,
            positions: &self.positions,
            row_positions: &self.row_positions,
        }
    }

    /// M as a matrix.
    pub fn mass_matrix(&self) -> SymmetricMatrix {
        diagonal(&self.mass)
    }

    /// `M + s K`.
    pub fn mass_plus(&self, s: f64) -> SymmetricMatrix {
        let mut triplets = Triplets::default();
        self.mass.iter().enumerate().for_each(|(i, &m)| triplets.push(i, i, m));
        self.stiffness.entries().for_each(|(r, c, k)| triplets.push(r, c, s * k));
        SymmetricMatrix::from_triplets(self.mass.len(), &triplets)
    }

    /// Forces on the free unknowns with the loads scaled by `factor`, those of the prescribed displacements included.
    pub fn force(&self, factor: f64) -> Vec<f64> {
        self.load.iter().zip(&self.held).map(|(f, h)| factor * f + h).collect()
    }

    /// `K u`.
    pub fn internal(&self, u: &[f64], work: &mut Work) -> Vec<f64> {
        let mut internal = vec![0.0; u.len()];
        self.stiffness.multiply_add(u, &mut internal);
        *work += self.product;
        internal
    }

    /// Kinetic energy `½ vᵀM v`, in J.
    pub fn kinetic(&self, v: &[f64]) -> f64 {
        0.5 * self.mass.iter().zip(v).map(|(m, v)| m * v * v).sum::<f64>()
    }

    /// Strain energy, in J.
    pub fn strain(&self, u: &[f64]) -> f64 {
        let mut internal = vec![0.0; u.len()];
        self.stiffness.multiply_add(u, &mut internal);
        0.5 * dot(u, &internal) - dot(u, &self.held) + self.held_energy
    }

    /// Largest `|B u − g|`, in m.
    pub fn gap(&self, u: &[f64]) -> f64 {
        norm(self.rows.iter().zip(&self.gaps).map(|(row, g)| row_product(row, u) - g))
    }

    /// Forces of supports and ties on each of all unknowns, `K u − f` and `−Bᵀλ`, at displacements `u` of all unknowns; in N
    /// and N m.
    pub fn reactions(&self, u: &[f64], multipliers: &[f64], factor: f64) -> Vec<f64> {
        let mut reactions = vec![0.0; u.len()];
        self.held_stiffness.iter().for_each(|&(i, j, k)| reactions[i] += k * u[j]);
        self.held_load.iter().for_each(|&(i, f)| reactions[i] -= factor * f);
        for (row, l) in self.rows.iter().zip(multipliers) {
            row.iter().for_each(|&(i, b)| reactions[self.free[i]] -= b * l);
        }
        reactions
    }

    /// The motion of all unknowns; prescribed ones rest at their values.
    pub fn state(&self, motion: &Motion) -> State {
        let held: Vec<f64> = self.prescribed.iter().map(|p| p.unwrap_or(0.0)).collect();
        let rest = vec![0.0; held.len()];
        let mut state = State { time: motion.time, u: held, v: rest.clone(), a: rest };
        for (k, &i) in self.free.iter().enumerate() {
            (state.u[i], state.v[i], state.a[i]) = (motion.u[k], motion.v[k], motion.a[k]);
        }
        state
    }

    /// The motion of the free unknowns.
    pub fn motion(&self, state: &State) -> Motion {
        let of = |full: &[f64]| self.free.iter().map(|&i| full[i]).collect();
        Motion { time: state.time, u: of(&state.u), v: of(&state.v), a: of(&state.a) }
    }
}

/// `Σ b_i x_i` of one row.
pub(crate) fn row_product(row: &[(usize, f64)], x: &[f64]) -> f64 {
    row.iter().map(|&(i, b)| b * x[i]).sum()
}

pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

pub(crate) fn diagonal(values: &[f64]) -> SymmetricMatrix {
    let mut triplets = Triplets::with_capacity(values.len());
    values.iter().enumerate().for_each(|(i, &m)| triplets.push(i, i, m));
    SymmetricMatrix::from_triplets(values.len(), &triplets)
}

/// Lumped mass of every unknown of a model, in kg and kg m².
///
/// # Errors
/// An inverted element; a mass or inertia that is not positive and finite.
pub fn lumped(model: &Model, numbering: &Numbering) -> Result<Vec<f64>> {
    let dim = model.space.dim();
    let mut mass = Vec::with_capacity(numbering.len());
    for part in &model.parts {
        let first = mass.len();
        match part {
            Part::Continuum(body) => {
                mass.extend(lumped_mass(body)?.into_iter().flat_map(|m| std::iter::repeat_n(m, dim)));
            }
            Part::Discrete { network, .. } => {
                let particles = &network.particles;
                for (&m, &j) in particles.mass.iter().zip(&particles.inertia) {
                    mass.extend(std::iter::repeat_n(m, dim));
                    mass.extend(std::iter::repeat_n(j, model.space.rotations()));
                }
            }
        }
        if let Some(bad) = mass[first..].iter().position(|m| !(m.is_finite() && *m > 0.0)) {
            return Err(Error::Geometry {
                what: format!("body '{}'", part.name()),
                message: format!(
                    "{} {} has mass or inertia {}; give a positive density, and every node a cell",
                    part.noun(),
                    bad / part.dofs_per_point(),
                    mass[first + bad]
                ),
            });
        }
    }
    Ok(mass)
}
