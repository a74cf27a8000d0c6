//! Static equilibrium under finite rotations: Newton's method with a tangent by central differences.
//!
//! Dense, for networks of up to a few hundred particles: what the benchmarks of slender beams need.

use super::Corotational;
use crate::error::{Error, Result};
use nalgebra::{DMatrix, DVector};

/// Step of the differences in rad, and in lengths of the network's mean bond: balances truncation and rounding.
const DIFFERENCE: f64 = 1e-6;
/// Newton doubles the digits of a step; a load step that needs more is too large.
const MOST_ITERATIONS: usize = 30;
/// A load step is done when Newton's change is below this, in rad and in mean bond lengths: the unbalanced force itself stalls
/// at the rounding of the stiffest forces, far above that of the softest.
const CHANGE: f64 = 1e-9;

/// Displacements, accumulated rotations and what it took.
#[derive(Debug, Clone)]
pub struct Equilibrium {
    /// Displacements (m) and sums of the rotation increments (rad), particle by particle.
    pub u: Vec<f64>,
    /// Newton iterations of all load steps.
    pub iterations: usize,
}

/// Applies `load` (N, N m in fixed axes; one number per degree of freedom) in `steps` equal parts to a network with
/// `held` degrees of freedom, and leaves the network turned as it then is.
///
/// # Errors
/// A tangent that cannot be solved, or no convergence: take more load steps.
pub fn solve(network: &mut Corotational, held: &[usize], load: &[f64], steps: usize) -> Result<Equilibrium> {
    let n = load.len();
    let free: Vec<usize> = (0..n).filter(|i| !held.contains(i)).collect();
    let length = mean_length(network);
    let (dim, per) = (network.space.dim(), network.space.dofs_per_particle());
    let mut u = vec![0.0; n];
    let mut iterations = 0;
    for step in 1..=steps {
        let factor = step as f64 / steps as f64;
        let mut converged = false;
        for _ in 0..MOST_ITERATIONS {
            let internal = forces(network, &u);
            let unbalanced =
                DVector::from_iterator(free.len(), free.iter().map(|&i| factor * load[i] - internal[i]));
            iterations += 1;
            let change = tangent(network, &u, &free)
                .lu()
                .solve(&unbalanced)
                .filter(|x| x.iter().all(|x| x.is_finite()));
            let Some(change) = change else {
                return Err(Error::Solve {
                    message: format!("load step {step}: the tangent is singular; hold the network"),
                });
            };
            let mut all = vec![0.0; n];
            free.iter().zip(&change).for_each(|(&i, d)| all[i] = *d);
            u.iter_mut().zip(&all).for_each(|(u, d)| *u += d);
            network.turn(&all, 1.0);
            let size = |i: usize, d: f64| if i % per < dim { d.abs() / length } else { d.abs() };
            converged = all.iter().enumerate().all(|(i, d)| size(i, *d) <= CHANGE);
            if converged {
                break;
            }
        }
        if !converged {
            return Err(Error::Solve {
                message: format!("load step {step} of {steps} does not converge; take more load steps"),
            });
        }
    }
    Ok(Equilibrium { u, iterations })
}

fn mean_length(network: &Corotational) -> f64 {
    network.bonds().map(|(_, b)| b.length()).sum::<f64>() / network.bond_count().max(1) as f64
}

fn forces(network: &Corotational, u: &[f64]) -> Vec<f64> {
    let mut f = vec![0.0; u.len()];
    network.add_internal(u, &mut f);
    f
}

/// `∂f/∂u`, rotations by turning the particle on from where it is.
fn tangent(network: &Corotational, u: &[f64], free: &[usize]) -> DMatrix<f64> {
    let length = mean_length(network);
    let (dim, per) = (network.space.dim(), network.space.dofs_per_particle());
    let mut k = DMatrix::zeros(free.len(), free.len());
    for (column, &j) in free.iter().enumerate() {
        let h = if j % per < dim { DIFFERENCE * length } else { DIFFERENCE };
        let moved = |h: f64| {
            let (mut network, mut u, mut change) = (network.clone(), u.to_vec(), vec![0.0; u.len()]);
            u[j] += h;
            change[j] = h;
            network.turn(&change, 1.0);
            forces(&network, &u)
        };
        let (ahead, behind) = (moved(h), moved(-h));
        for (row, &i) in free.iter().enumerate() {
            k[(row, column)] = (ahead[i] - behind[i]) / (2.0 * h);
        }
    }
    k
}
