//! One factorised stiffness and its solutions, checked on the true residual.

use crate::error::{Error, Result};
use crate::solve::norm::norm;
use crate::solve::sparse::{Factor, SymmetricMatrix, Triplets, minimum_degree};
use crate::work::Work;

/// Largest relative residual that is accepted: one refinement reaches the rounding floor, some 1e-13.
const LARGEST_RESIDUAL: f64 = 1e-10;

/// A positive definite stiffness and its factor.
pub struct Equilibrium {
    matrix: SymmetricMatrix,
    factor: Factor,
}

impl Equilibrium {
    /// Sums and factorises `unknowns` equations.
    pub fn new(unknowns: usize, triplets: &Triplets, work: &mut Work) -> Result<Self> {
        let matrix = SymmetricMatrix::from_triplets(unknowns, triplets);
        let factor = Factor::new(&matrix, &minimum_degree(&matrix)?)?;
        work.factored(factor.nonzeros());
        Ok(Self { matrix, factor })
    }

    /// `K⁻¹ f`, refined once.
    pub fn solve(&self, f: &[f64], work: &mut Work) -> Result<Vec<f64>> {
        let mut x = f.to_vec();
        self.factor.solve_in_place(&mut x);
        let mut correction = self.residual(&x, f);
        self.factor.solve_in_place(&mut correction);
        x.iter_mut().zip(&correction).for_each(|(x, c)| *x += c);
        (0..2).for_each(|_| work.solved(self.factor.nonzeros()));
        // Forces that balance to rounding are nothing to be relative to: what the unknowns push does as well.
        let pushed = self.matrix.diagonal().iter().zip(&x).map(|(k, x)| (k * x).abs()).fold(0.0, f64::max);
        let size = pushed.max(norm(f));
        let rest = norm(self.residual(&x, f));
        if rest <= LARGEST_RESIDUAL * size {
            return Ok(x);
        }
        Err(Error::Solve {
            message: format!(
                "calibration: residual {rest:.1e} of forces of {size:.1e}; look for a mechanism in the network"
            ),
        })
    }

    fn residual(&self, x: &[f64], f: &[f64]) -> Vec<f64> {
        let mut r = vec![0.0; f.len()];
        self.matrix.multiply_add(x, &mut r);
        r.iter_mut().zip(f).for_each(|(r, f)| *r = f - *r);
        r
    }
}
