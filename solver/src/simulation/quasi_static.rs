//! Equilibria under the loads of each time.
//!
//! `ΔE = Δu·f̄ − Δu·Bᵀλ̄` holds between any two equilibria. A state that is handed over is none: its first equilibrium is found under
//! the load of its time, which works on the way there.

use super::clock::Clock;
use super::implicit::{difference, look};
use super::segment::{Look, Stepper};
use crate::checkpoint::{from_bytes, to_bytes};
use crate::dynamics::State;
use crate::dynamics::ledger::WorkDone;
use crate::dynamics::load::LoadFactor;
use crate::dynamics::quasi_static::QuasiStatic;
use crate::dynamics::semidiscrete::{Motion, Semidiscrete, dot, row_product};
use crate::error::Result;
use crate::model::Model;
use crate::work::Work;

/// The whole model from equilibrium to equilibrium.
pub(super) struct Equilibria<'a> {
    system: &'a Semidiscrete,
    solver: QuasiStatic<'a>,
    loads: &'a LoadFactor,
    clock: Clock,
    taken: usize,
    motion: Motion,
    multipliers: Vec<f64>,
    done: WorkDone,
    work: Work,
}

impl<'a> Equilibria<'a> {
    /// Finds the first equilibrium.
    ///
    /// # Errors
    /// As [`QuasiStatic::new`] and [`QuasiStatic::at`].
    pub fn new(
        model: &Model,
        system: &'a Semidiscrete,
        loads: &'a LoadFactor,
        clock: Clock,
        from: &State,
    ) -> Result<Self> {
        let mut work = Work::default();
        let solver = QuasiStatic::new(model, system, &mut work)?;
        let factor = loads.at(from.time);
        let (motion, multipliers) = solver.at(from.time, factor, &mut work)?;
        let moved = difference(&motion.u, &system.motion(from).u);
        let done = WorkDone { external: factor * dot(&system.load, &moved), ..WorkDone::default() };
        Ok(Equilibria { system, solver, loads, clock, taken: 0, motion, multipliers, done, work })
    }

    fn step(&mut self) -> Result<()> {
        let times = [self.taken, self.taken + 1].map(|k| self.clock.time(k));
        let factors = times.map(|t| self.loads.at(t));
        let (motion, multipliers) = self.solver.at(times[1], factors[1], &mut self.work)?;
        let moved = difference(&motion.u, &self.motion.u);
        self.done.external += 0.5 * (factors[0] + factors[1]) * dot(&self.system.load, &moved);
        for (row, (a, b)) in self.system.rows.iter().zip(self.multipliers.iter().zip(&multipliers)) {
            self.done.interface -= 0.5 * (a + b) * row_product(row, &moved);
        }
        (self.motion, self.multipliers) = (motion, multipliers);
        self.taken += 1;
        Ok(())
    }
}

impl Stepper for Equilibria<'_> {
    fn advance(&mut self, steps: usize) -> Result<()> {
        (0..steps).try_for_each(|_| self.step())
    }

    fn displacements(&self) -> Vec<f64> {
        self.system.state(&self.motion).u
    }

    fn look(&mut self) -> Result<Look> {
        let factor = self.loads.at(self.motion.time);
        Ok(look(self.system, &self.motion, &self.multipliers, factor, (0.0, self.done)))
    }

    fn work(&self) -> Work {
        self.work
    }

    fn freeze(&self) -> Vec<u8> {
        to_bytes(&(self.taken, &self.motion, &self.multipliers, self.done, self.work))
    }

    fn thaw(&mut self, bytes: &[u8]) -> Result<()> {
        (self.taken, self.motion, self.multipliers, self.done, self.work) = from_bytes(bytes)?;
        Ok(())
    }
}
