//! Velocities that satisfy the ties: `(C M⁻¹ Cᵀ) Λ = C v*`, `v = v* − M⁻¹ Cᵀ Λ`.
//!
//! Prescribed unknowns count as infinitely heavy. `H = C M⁻¹ Cᵀ` is constant in small motion and is factorised once,
//! scaled to a unit diagonal, so that light and heavy sides, displacements and rotations weigh alike.

use super::semidiscrete::row_product;
use super::system::System;
use crate::error::{Error, Result};
use crate::solve::sparse::{Factor, SymmetricMatrix, Triplets, minimum_degree};
use crate::stage::{Stage, timed};
use crate::work::Work;

/// `C v` must be this small beside the terms it sums.
pub const LARGEST_MISMATCH: f64 = 1e-10;
/// The factor of a well-scaled H needs one solve; refinement is for nearly dependent rows.
const MOST_SOLVES: usize = 4;

/// The factorised interface problem.
pub struct Interface {
    inverse_mass: Vec<f64>,
    scale: Vec<f64>,
    factor: Option<Factor>,
}

impl Interface {
    /// Factorises `H` for the rows of a system.
    ///
    /// # Errors
    /// A factorisation that fails.
    pub fn new(system: &System, work: &mut Work) -> Result<Self> {
        let free_inverse = |(i, m): (usize, &f64)| if system.is_prescribed(i) { 0.0 } else { 1.0 / m };
        let inverse_mass: Vec<f64> = system.mass.iter().enumerate().map(free_inverse).collect();
        let rows = &system.rows;
        if rows.is_empty() {
            return Ok(Interface { inverse_mass, scale: Vec::new(), factor: None });
        }
        let mut touching: Vec<Vec<(usize, f64)>> = vec![Vec::new(); system.mass.len()];
        for (r, row) in rows.iter().enumerate() {
            row.terms.iter().for_each(|&(i, c)| touching[i].push((r, c)));
        }
        let mut diagonal = vec![0.0; rows.len()];
        for (i, through) in touching.iter().enumerate() {
            through.iter().for_each(|&(r, c)| diagonal[r] += c * c * inverse_mass[i]);
        }
        let scale: Vec<f64> = diagonal.iter().map(|h| 1.0 / h.sqrt()).collect();
        let mut h = Triplets::default();
        for (i, through) in touching.iter().enumerate().filter(|(i, _)| inverse_mass[*i] > 0.0) {
            for &(r, a) in through {
                for &(s, b) in through {
                    h.push(r, s, a * b * inverse_mass[i] * scale[r] * scale[s]);
                }
            }
        }
        let h = SymmetricMatrix::from_triplets(rows.len(), &h);
        let factor = timed(Stage::Factorisation, || Factor::new(&h, &minimum_degree(&h)?))?;
        work.factored(factor.nonzeros());
        Ok(Interface { inverse_mass, scale, factor: Some(factor) })
    }

    /// `1/m` of each unknown, zero for prescribed ones; in 1/kg and 1/(kg m²).
    pub(super) fn inverse_mass(&self) -> &[f64] {
        &self.inverse_mass
    }

    /// Makes `C v = 0`; adds the impulses `−Cᵀ Λ` that do it (N s, N m s) to `impulse`, and returns Λ.
    ///
    /// # Errors
    /// Velocities that are not finite or still violate a row: H is too ill-conditioned.
    pub fn project(
        &self,
        system: &System,
        v: &mut [f64],
        impulse: &mut [f64],
        work: &mut Work,
    ) -> Result<Vec<f64>> {
        let mut multipliers = vec![0.0; system.rows.len()];
        self.project_adding(system, v, impulse, [&mut multipliers, &mut Vec::new()], work)?;
        Ok(multipliers)
    }

    /// The same without allocation: adds Λ to the first vector; the second one is for the right-hand side.
    pub(super) fn project_adding(
        &self,
        system: &System,
        v: &mut [f64],
        impulse: &mut [f64],
        [multipliers, scaled]: [&mut Vec<f64>; 2],
        work: &mut Work,
    ) -> Result<()> {
        let rows = &system.rows;
        let Some(factor) = &self.factor else { return Ok(()) };
        let size = |v: &[f64]| {
            let of_row = |terms: &[(usize, f64)]| terms.iter().map(|&(i, c)| (c * v[i]).abs()).sum::<f64>();
            rows.iter().map(|row| of_row(&row.terms)).fold(0.0, f64::max)
        };
        let bound = LARGEST_MISMATCH * size(v);
        let mut mismatch = 0.0;
        for _ in 0..MOST_SOLVES {
            scaled.clear();
            scaled.extend(rows.iter().zip(&self.scale).map(|(row, s)| s * row_product(&row.terms, v)));
            factor.solve_in_place(scaled);
            work.solved(factor.nonzeros());
            for ((row, s), (z, multiplier)) in
                rows.iter().zip(&self.scale).zip(scaled.iter().zip(multipliers.iter_mut()))
            {
                let change = s * z;
                *multiplier += change;
                for &(i, c) in &row.terms {
                    impulse[i] -= c * change;
                    v[i] -= self.inverse_mass[i] * c * change;
                }
            }
            mismatch = rows.iter().map(|row| row_product(&row.terms, v).abs()).fold(0.0, f64::max);
            if mismatch <= bound {
                return Ok(());
            }
            if !mismatch.is_finite() {
                break;
            }
        }
        let message = format!(
            "the ties leave a velocity mismatch of {mismatch:.1e} m/s, more than {bound:.1e}; \
             look for nearly dependent ties or an extreme mass contrast"
        );
        Err(Error::Solve { message })
    }
}
