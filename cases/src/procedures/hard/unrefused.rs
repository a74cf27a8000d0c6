//! Central differences at any step: what would happen if a step beyond the bound were not refused.
//!
//! The same masses, forces and ties as [`seam_solver::dynamics::explicit`], without its refusal and its ledger.

use crate::observe::curve::nan_max;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::forces::{InternalForces, Rotations};
use seam_solver::dynamics::interface::Interface;
use seam_solver::dynamics::system::System;
use seam_solver::error::Result;
use seam_solver::model::Model;
use seam_solver::work::Work;

/// Growth at which a motion counts as unbounded. Up to 0.9999 of the critical step the exact invariant
/// `½ v₊ᵀ(M − ¼Δt²K) v₊ + ½ ūᵀK ū` allows a growth of `1/√(1 − 0.9999²)` = 71.
pub const UNBOUNDED: f64 = 100.0;
/// Steps between two looks.
const LOOK: usize = 50;

/// A model that can be stepped.
pub struct Unrefused {
    system: System,
    forces: InternalForces,
    interface: Interface,
    /// What was done.
    pub work: Work,
}

impl Unrefused {
    /// Prepares a model without supports; loads do not act.
    ///
    /// # Errors
    /// As [`System::new`], [`Interface::new`].
    pub fn new(model: &Model) -> Result<Self> {
        let mut work = Work::default();
        let system = System::new(model)?;
        let forces = InternalForces::new(model, &system.numbering, Rotations::Small)?;
        let interface = Interface::new(&system, &mut work)?;
        Ok(Unrefused { system, forces, interface, work })
    }

    /// `2/ω_max` of the untied parts by power iteration, in s: from above.
    pub fn critical_step(&self, iterations: usize) -> f64 {
        critical::iterate(&self.system, &self.forces, iterations)
    }

    /// Largest `√(uᵀM u)` over that of the start, which is at rest and has a share of every mode; it is not followed beyond 1e9.
    ///
    /// # Errors
    /// Ties that cannot be met.
    pub fn growth(&mut self, step_s: f64, steps: usize) -> Result<f64> {
        let mass = &self.system.mass;
        let n = mass.len();
        let mut u: Vec<f64> = (0..n).map(|i| (i as f64 * 12.9898).sin() / mass[i].sqrt()).collect();
        let mut impulse = vec![0.0; n];
        self.interface.project(&self.system, &mut u, &mut impulse, &mut self.work)?;
        let size = |u: &[f64]| u.iter().zip(mass).map(|(u, m)| m * u * u).sum::<f64>().sqrt();
        let start = size(&u);
        let (mut v, mut f) = (vec![0.0; n], vec![0.0; n]);
        let mut largest = 1.0;
        for k in 1..=steps {
            f.fill(0.0);
            self.forces.add(&u, &mut f, &mut self.work);
            v.iter_mut().zip(f.iter().zip(mass)).for_each(|(v, (f, m))| *v -= step_s * f / m);
            self.interface.project(&self.system, &mut v, &mut impulse, &mut self.work)?;
            u.iter_mut().zip(&v).for_each(|(u, v)| *u += step_s * v);
            if k % LOOK == 0 || k == steps {
                largest = nan_max(largest, size(&u) / start);
                if largest.is_nan() || largest > 1e9 {
                    break;
                }
            }
        }
        self.work.steps += steps as u64;
        Ok(largest)
    }

    /// Whether the motion stays bounded at this step.
    ///
    /// # Errors
    /// As [`Unrefused::growth`].
    pub fn bounded(&mut self, step_s: f64, steps: usize) -> Result<bool> {
        Ok(self.growth(step_s, steps)? <= UNBOUNDED)
    }
}
