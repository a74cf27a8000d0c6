//! Lowest natural frequencies: `K φ + Bᵀλ = ω² M φ`, `B φ = 0`.
//!
//! Subspace iteration (Bathe 1996, §11.6): inverse iteration on a block of vectors, then the
//! small eigenproblem of their projections.

use super::semidiscrete::{Semidiscrete, dot};
use crate::error::{Error, Result};
use crate::model::Model;
use crate::solve::kkt::Kkt;
use crate::solve::mechanism;
use crate::work::Work;
use nalgebra::DMatrix;

/// A natural frequency and its shape.
#[derive(Debug, Clone, PartialEq)]
pub struct Mode {
    /// Circular frequency ω, in rad/s.
    pub omega: f64,
    /// Shape on the free unknowns, `φᵀMφ = 1`.
    pub shape: Vec<f64>,
}

/// Iteration ends when no frequency moves by more than this, relatively: errors in ω go with the square of those in φ.
const SETTLED: f64 = 1e-12;
/// The block converges by the ratio of eigenvalues inside and outside of it; a hundred rounds allow for a ratio of 0.75.
const MOST_ROUNDS: usize = 100;

/// The `count` lowest modes of a supported model.
///
/// # Errors
/// A mechanism; more modes than free unknowns; an iteration that does not settle.
pub fn lowest(model: &Model, system: &Semidiscrete, count: usize, work: &mut Work) -> Result<Vec<Mode>> {
    let n = system.mass.len();
    // Extra vectors speed convergence of the wanted ones (Bathe's min(2p, p + 8)).
    let block = (2 * count).min(count + 8);
    let independent = n.saturating_sub(system.rows.len());
    if count == 0 || count > independent {
        return Err(Error::Solve {
            message: format!("{count} modes asked for; the model has 1 to {independent}"),
        });
    }
    let block = block.min(independent);
    let kkt = Kkt::new(&system.stiffness, &system.rows, &system.layout(), work)?;
    mechanism::refuse(model, &system.numbering, &system.free, kkt.softest_motion(work))?;
    let zero = vec![0.0; system.rows.len()];
    // Irrational steps repeat no pattern of the model.
    let phase = |k: usize, i: usize| (1.0 + (k + 1) as f64 * i as f64 * 0.754_877_666).sin();
    let mut shapes: Vec<Vec<f64>> = (0..block).map(|k| (0..n).map(|i| phase(k, i)).collect()).collect();
    let mut omegas: Vec<f64> = vec![0.0; block];
    for _ in 0..MOST_ROUNDS {
        let mut next = Vec::with_capacity(block);
        for shape in &shapes {
            let inertia: Vec<f64> = shape.iter().zip(&system.mass).map(|(x, m)| x * m).collect();
            next.push(kkt.solve(&inertia, &zero, work)?.u);
        }
        let (new_omegas, new_shapes) = ritz(system, &next)?;
        let moved = |k: usize| (new_omegas[k] - omegas[k]).abs() > SETTLED * new_omegas[k];
        let settled = !(0..count).any(moved);
        (omegas, shapes) = (new_omegas, new_shapes);
        if settled {
            return Ok(omegas
                .into_iter()
                .zip(shapes)
                .take(count)
                .map(|(omega, shape)| Mode { omega, shape })
                .collect());
        }
    }
    Err(Error::Solve {
        message: "natural frequencies do not settle; ask for one more or one fewer mode".into(),
    })
}

/// Frequencies and shapes of the model restricted to a subspace, ascending: `K̂ y = ω² M̂ y` with `M̂ = RᵀR`.
fn ritz(system: &Semidiscrete, basis: &[Vec<f64>]) -> Result<(Vec<f64>, Vec<Vec<f64>>)> {
    let p = basis.len();
    let weighted = |x: &[f64]| x.iter().zip(&system.mass).map(|(x, m)| x * m).collect::<Vec<f64>>();
    let unit: Vec<Vec<f64>> = basis
        .iter()
        .map(|x| {
            let length = dot(x, &weighted(x)).sqrt();
            x.iter().map(|v| v / length).collect()
        })
        .collect();
    let stiff: Vec<Vec<f64>> = unit
        .iter()
        .map(|x| {
            let mut y = vec![0.0; x.len()];
            system.stiffness.multiply_add(x, &mut y);
            y
        })
        .collect();
    let heavy: Vec<Vec<f64>> = unit.iter().map(|x| weighted(x)).collect();
    let k = DMatrix::from_fn(p, p, |i, j| dot(&unit[i], &stiff[j]));
    let m = DMatrix::from_fn(p, p, |i, j| dot(&unit[i], &heavy[j]));
    let dependent =
        || Error::Solve { message: "vectors of the subspace became dependent; ask for fewer modes".into() };
    let inverse = m.cholesky().ok_or_else(dependent)?.l().try_inverse().ok_or_else(dependent)?;
    let eigen = (&inverse * k * inverse.transpose()).symmetric_eigen();
    let mut order: Vec<usize> = (0..p).collect();
    order.sort_by(|&a, &b| eigen.eigenvalues[a].total_cmp(&eigen.eigenvalues[b]));
    let coefficients = inverse.transpose() * &eigen.eigenvectors;
    let combine = |column: usize| {
        let mut shape = vec![0.0; unit[0].len()];
        for (x, c) in unit.iter().zip(coefficients.column(column).iter()) {
            shape.iter_mut().zip(x).for_each(|(s, x)| *s += c * x);
        }
        shape
    };
    let omegas = order.iter().map(|&i| eigen.eigenvalues[i].max(0.0).sqrt()).collect();
    Ok((omegas, order.into_iter().map(combine).collect()))
}
