//! Elements implicitly, particles explicitly in smaller steps.

use super::clock::Clock;
use super::implicit::look;
use super::segment::{Look, Stepper};
use crate::checkpoint::{from_bytes, to_bytes};
use crate::dynamics::State;
use crate::dynamics::ledger::WorkDone;
use crate::dynamics::load::LoadFactor;
use crate::dynamics::multirate::side::Stepping;
use crate::dynamics::multirate::{Method, Multirate, Rates};
use crate::dynamics::newmark::start;
use crate::dynamics::semidiscrete::{Motion, Semidiscrete};
use crate::error::Result;
use crate::model::{Model, Part};
use crate::solve::norm::norm;
use crate::work::Work;

/// A run at two rates.
pub(super) struct TwoRates<'a> {
    system: &'a Semidiscrete,
    multirate: Multirate<'a>,
    loads: &'a LoadFactor,
    clock: Clock,
    taken: usize,
    /// Largest gap of the ties so far, in m.
    widest_gap: f64,
    work: Work,
}

impl<'a> TwoRates<'a> {
    /// Starts from a state; its accelerations follow from the forces. `ratio` is the number of fine steps per coarse one.
    ///
    /// # Errors
    /// As [`Multirate::new`] and [`start`].
    pub fn new(
        model: &Model,
        system: &'a Semidiscrete,
        (method, ratio): (Method, usize),
        loads: &'a LoadFactor,
        clock: Clock,
        from: &State,
    ) -> Result<Self> {
        let mut work = Work::default();
        let Motion { u, v, .. } = system.motion(from);
        let (motion, lambda) = start(system, (u, v), from.time, loads.at(from.time), 0.0, &mut work)?;
        let particles = |p: &usize| matches!(model.parts[*p], Part::Discrete { .. });
        let rates = Rates {
            method,
            coarse_step: clock.step,
            ratio,
            coarse: Stepping::Implicit,
            fine: Stepping::Explicit,
            fine_parts: (0..model.parts.len()).filter(particles).collect(),
        };
        let multirate = Multirate::new(model, system, &rates, (&motion, lambda), &mut work)?;
        let widest_gap = multirate.ledger().gap;
        Ok(TwoRates { system, multirate, loads, clock, taken: 0, widest_gap, work })
    }
}

impl Stepper for TwoRates<'_> {
    fn advance(&mut self, steps: usize) -> Result<()> {
        for _ in 0..steps {
            self.multirate.step(|t| self.loads.at(t), &mut self.work)?;
            self.taken += 1;
            self.widest_gap = norm([self.widest_gap, self.multirate.ledger().gap]);
        }
        Ok(())
    }

    fn displacements(&self) -> Vec<f64> {
        self.system.state(&self.multirate.motion()).u
    }

    fn look(&mut self) -> Result<Look> {
        let motion = Motion { time: self.clock.time(self.taken), ..self.multirate.motion() };
        let ledger = self.multirate.ledger();
        let done = WorkDone {
            external: ledger.physical_external,
            damping: 0.0,
            interface: ledger.physical_interface,
            ..WorkDone::default()
        };
        let lambda = self.multirate.multipliers();
        let energies = (self.multirate.kinetic(), done);
        let now = look(self.system, &motion, lambda, self.loads.at(motion.time), energies);
        Ok(Look { widest_gap: self.widest_gap, ..now })
    }

    fn work(&self) -> Work {
        self.work
    }

    fn freeze(&self) -> Vec<u8> {
        to_bytes(&(self.taken, self.multirate.freeze(), self.widest_gap, self.work))
    }

    fn thaw(&mut self, bytes: &[u8]) -> Result<()> {
        let sides: Vec<u8>;
        (self.taken, sides, self.widest_gap, self.work) = from_bytes(bytes)?;
        self.multirate.thaw(&sides)
    }
}
