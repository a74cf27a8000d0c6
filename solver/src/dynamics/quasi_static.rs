//! Quasi-static steps: where a load grows slowly against the first period, inertia plays no part and
//! each state is an equilibrium `K u + Bᵀλ = f(t)`, `B u = g`. One factorisation for all of them.

use super::semidiscrete::{Motion, Semidiscrete};
use crate::error::Result;
use crate::model::Model;
use crate::solve::kkt::Kkt;
use crate::solve::mechanism;
use crate::work::Work;

/// A factorised system for equilibria.
pub struct QuasiStatic<'a> {
    system: &'a Semidiscrete,
    kkt: Kkt,
}

impl<'a> QuasiStatic<'a> {
    /// Factorises.
    ///
    /// # Errors
    /// A mechanism, or a factorisation that fails.
    pub fn new(model: &Model, system: &'a Semidiscrete, work: &mut Work) -> Result<Self> {
        let kkt = Kkt::new(&system.stiffness, &system.rows, &system.layout(), work)?;
        mechanism::refuse(model, &system.numbering, &system.free, kkt.softest_motion(work))?;
        Ok(QuasiStatic { system, kkt })
    }

    /// Equilibrium at a time (s) when the loads are scaled by `factor`, at rest, and the multipliers.
    ///
    /// # Errors
    /// A solve whose residual stays too large.
    pub fn at(&self, time: f64, factor: f64, work: &mut Work) -> Result<(Motion, Vec<f64>)> {
        let solution = self.kkt.solve(&self.system.force(factor), &self.system.gaps, work)?;
        let rest = vec![0.0; solution.u.len()];
        work.steps += 1;
        Ok((Motion { time, u: solution.u, v: rest.clone(), a: rest }, solution.multipliers))
    }
}
