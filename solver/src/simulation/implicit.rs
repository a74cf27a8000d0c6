//! Newmark and HHT steps with their energies.
//!
//! With bars for means and Δ for changes over a step, and `r = f − K u − c M v − Bᵀλ − M a` (zero unless α ≠ 0), the formulas of
//! Newmark's method give the change of energy exactly:
//!
//! `ΔE = Δu·f̄ − Δu·Bᵀλ̄ − c Δu·M v̄ + A`,
//! `A = −Δu·r̄ + (γ−½) Δu·M Δa − (β−γ/2) Δt² Δa·M (ā + (γ−½) Δa)`.
//!
//! A is the work of the scheme itself (compare Krenk 2006): zero for the trapezoidal rule. It is damping on the whole, though single
//! steps may give back.

use super::clock::Clock;
use super::segment::{Look, Stepper};
use crate::checkpoint::{from_bytes, to_bytes};
use crate::dynamics::State;
use crate::dynamics::ledger::WorkDone;
use crate::dynamics::load::LoadFactor;
use crate::dynamics::newmark::{Newmark, Scheme, start};
use crate::dynamics::semidiscrete::{Motion, Semidiscrete, dot, row_product};
use crate::error::Result;
use crate::work::Work;

/// The whole model by one implicit scheme.
pub(super) struct Implicit<'a> {
    system: &'a Semidiscrete,
    newmark: Newmark<'a>,
    loads: &'a LoadFactor,
    clock: Clock,
    scheme: Scheme,
    /// c, in 1/s.
    rate: f64,
    taken: usize,
    motion: Motion,
    multipliers: Vec<f64>,
    /// r.
    left_over: Vec<f64>,
    done: WorkDone,
    work: Work,
}

impl<'a> Implicit<'a> {
    /// Starts from a state; its accelerations follow from the forces.
    ///
    /// # Errors
    /// As [`Newmark::new`] and [`start`].
    pub fn new(
        system: &'a Semidiscrete,
        (scheme, rate): (Scheme, f64),
        loads: &'a LoadFactor,
        clock: Clock,
        from: &State,
    ) -> Result<Self> {
        let mut work = Work::default();
        let Motion { u, v, .. } = system.motion(from);
        let left_over = vec![0.0; u.len()];
        let factor = loads.at(from.time);
        let (motion, multipliers) = start(system, (u, v), from.time, factor, rate, &mut work)?;
        let newmark = Newmark::new(system, scheme, clock.step, rate, &mut work)?;
        let done = WorkDone::default();
        Ok(Implicit {
            system,
            newmark,
            loads,
            clock,
            scheme,
            rate,
            taken: 0,
            motion,
            multipliers,
            left_over,
            done,
            work,
        })
    }

    fn step(&mut self) -> Result<()> {
        let (before, first) = (self.motion.clone(), self.multipliers.clone());
        let times = [self.taken, self.taken + 1].map(|k| self.clock.time(k));
        let factors = times.map(|t| self.loads.at(t));
        self.multipliers = self.newmark.step(&mut self.motion, factors, &mut self.work)?;
        self.motion.time = times[1];
        self.taken += 1;
        let moved = difference(&self.motion.u, &before.u);
        let mean =
            |x: &[f64], y: &[f64]| -> Vec<f64> { x.iter().zip(y).map(|(x, y)| 0.5 * (x + y)).collect() };
        self.done.external += 0.5 * (factors[0] + factors[1]) * dot(&self.system.load, &moved);
        let lambda = mean(&first, &self.multipliers);
        let gaps = self.system.rows.iter().map(|row| row_product(row, &moved));
        self.done.interface -= gaps.zip(&lambda).map(|(g, l)| g * l).sum::<f64>();
        if self.rate > 0.0 {
            let v = mean(&before.v, &self.motion.v);
            self.done.damping -= self.rate * self.weigh(&moved, &v);
        }
        if self.scheme != Scheme::TRAPEZOIDAL {
            self.done.damping += self.work_of_scheme(&before, &moved, factors);
        }
        Ok(())
    }

    /// A of the last step.
    fn work_of_scheme(&mut self, before: &Motion, moved: &[f64], factors: [f64; 2]) -> f64 {
        let Scheme { beta, gamma, alpha } = self.scheme;
        let dt = self.clock.step;
        let gained = difference(&self.motion.a, &before.a);
        let off = gamma - 0.5;
        let a: Vec<f64> = (0..gained.len()).map(|i| before.a[i] + (0.5 + off) * gained[i]).collect();
        let mut done =
            off * self.weigh(moved, &gained) - (beta - 0.5 * gamma) * dt * dt * self.weigh(&gained, &a);
        if alpha != 0.0 {
            // M a + c M v_α + K u_α + Bᵀλ = f_α leaves r = −α (Δf − K Δu − c M Δv) at its end.
            let internal = self.system.internal(moved, &mut self.work);
            let left: Vec<f64> = (0..moved.len())
                .map(|i| {
                    let damped = self.rate * self.system.mass[i] * (self.motion.v[i] - before.v[i]);
                    let load = (factors[1] - factors[0]) * self.system.load[i];
                    -alpha * (load - internal[i] - damped)
                })
                .collect();
            done -= 0.5 * (dot(moved, &self.left_over) + dot(moved, &left));
            self.left_over = left;
        }
        done
    }

    /// `xᵀM y`.
    fn weigh(&self, x: &[f64], y: &[f64]) -> f64 {
        self.system.mass.iter().zip(x.iter().zip(y)).map(|(m, (x, y))| m * x * y).sum()
    }
}

impl Stepper for Implicit<'_> {
    fn advance(&mut self, steps: usize) -> Result<()> {
        (0..steps).try_for_each(|_| self.step())
    }

    fn displacements(&self) -> Vec<f64> {
        self.system.state(&self.motion).u
    }

    fn look(&mut self) -> Result<Look> {
        let (kinetic, done) = (self.system.kinetic(&self.motion.v), self.done);
        let factor = self.loads.at(self.motion.time);
        Ok(look(self.system, &self.motion, &self.multipliers, factor, (kinetic, done)))
    }

    fn work(&self) -> Work {
        self.work
    }

    fn freeze(&self) -> Vec<u8> {
        let state = (self.taken, &self.motion, &self.multipliers, &self.left_over, self.done, self.work);
        to_bytes(&state)
    }

    fn thaw(&mut self, bytes: &[u8]) -> Result<()> {
        (self.taken, self.motion, self.multipliers, self.left_over, self.done, self.work) =
            from_bytes(bytes)?;
        Ok(())
    }
}

/// What there is to see of a motion of the free unknowns.
pub(super) fn look(
    system: &Semidiscrete,
    motion: &Motion,
    multipliers: &[f64],
    factor: f64,
    (kinetic, done): (f64, WorkDone),
) -> Look {
    let state = system.state(motion);
    let gap = system.gap(&motion.u);
    Look {
        reactions: system.reactions(&state.u, multipliers, factor),
        state,
        kinetic,
        strain: system.strain(&motion.u),
        done,
        gap,
        widest_gap: gap,
    }
}

pub(super) fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
