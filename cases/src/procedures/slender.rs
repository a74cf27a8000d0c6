//! A slender cantilever of bonds under finite rotations: what elastica and roll-up share.

use super::Setting;
use super::straight::Chain;
use crate::error::Result;
use seam_solver::dem::corotational::{Corotational, equilibrium};
use seam_solver::dem::network::BondStiffness;
use seam_solver::space::Vec3;
use seam_solver::work::Work;

/// Length and bending stiffness one; held at its first particle.
#[derive(Debug, Clone, Copy)]
pub struct Slender {
    /// `EAL²/EI`: so large that stretching does not count.
    pub slenderness: f64,
    /// Equal parts of the load.
    pub load_steps: usize,
}

impl Slender {
    /// From the parameters of a scene.
    ///
    /// # Errors
    /// A missing parameter.
    pub fn new(setting: &Setting) -> Result<Self> {
        let load_steps = setting.count("load_steps", 1)?;
        Ok(Slender { slenderness: setting.number("slenderness")?, load_steps })
    }

    /// Displacements and rotations of `n + 1` particles, with a load on one component of the last.
    ///
    /// # Errors
    /// As [`equilibrium::solve`].
    pub fn solve(
        &self,
        setting: &Setting,
        n: usize,
        component: usize,
        load: f64,
        work: &mut Work,
    ) -> Result<Vec<f64>> {
        let h = 1.0 / n as f64;
        let stiffness =
            BondStiffness { kn: self.slenderness / h, ks: 12.0 / h.powi(3), kb: 1.0 / h, kt: 1.0 / h };
        let chain = Chain { bonds: n, spacing: h, stiffness, mass: h, inertia: h.powi(3) };
        let mut loads = vec![0.0; 3 * (n + 1)];
        loads[3 * n + component] = load;
        let solved = Corotational::new(&chain.network(Vec3::zeros()), "beam")
            .and_then(|mut bonds| equilibrium::solve(&mut bonds, &[0, 1, 2], &loads, self.load_steps));
        let found = solved.map_err(|e| setting.solver(e))?;
        // Each iteration: the forces once, and twice per free unknown for the tangent.
        work.bond_updates += (found.iterations * (1 + 6 * n) * n) as u64;
        work.steps += self.load_steps as u64;
        Ok(found.u)
    }
}
