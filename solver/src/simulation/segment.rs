//! From one switch to the next: steps, snapshots, and rules asked on step boundaries.

use super::checkpoint::Frozen;
use super::clock::Clock;
use super::outcome::{Energies, Snapshot};
use super::plan::Plan;
use super::record::Record;
use super::switching::{Job, Rules};
use crate::dynamics::State;
use crate::dynamics::breaking::Breaking;
use crate::dynamics::ledger::WorkDone;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::solve::norm::norm;
use crate::stage::{Stage, timed};
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// A scheme on one model.
pub(super) trait Stepper {
    /// Takes steps.
    fn advance(&mut self, steps: usize) -> Result<()>;
    /// Displacements of all unknowns, in m and rad.
    fn displacements(&self) -> Vec<f64>;
    /// What there is to see now.
    fn look(&mut self) -> Result<Look>;
    /// What was done so far.
    fn work(&self) -> Work;
    /// Bonds that have broken; `None` where nothing breaks.
    fn breaking(&self) -> Option<&Breaking> {
        None
    }
    /// All that changes from step to step.
    fn freeze(&self) -> Vec<u8>;
    /// Puts back what the same stepper gave.
    fn thaw(&mut self, bytes: &[u8]) -> Result<()>;
}

/// A moment of a stepper.
pub(super) struct Look {
    pub state: State,
    /// Kinetic energy, in J.
    pub kinetic: f64,
    /// Strain energy, in J.
    pub strain: f64,
    /// Work since the stepper began.
    pub done: WorkDone,
    /// Largest gap of the ties now, in m.
    pub gap: f64,
    /// Largest gap of the ties since the stepper began, in m.
    pub widest_gap: f64,
    /// Forces of supports and ties, in N and N m.
    pub reactions: Vec<f64>,
}

/// A run on its way, over all its steppers.
pub(super) struct Course<'a> {
    pub plan: &'a Plan<'a>,
    pub rules: Rules<'a>,
    pub so_far: SoFar,
}

/// What a run has come to.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct SoFar {
    /// Energies when the present stepper began, its own kinetic and strain energy left out.
    base: Energies,
    /// Kinetic and strain energy when the last stepper ended; `None` before the first.
    ended: Option<f64>,
    /// The output that comes next.
    next_output: usize,
    /// Outputs that fell on a step boundary with another.
    pub merged: usize,
    /// Switches so far.
    pub switches: usize,
    /// Largest closure of the snapshots.
    pub worst_closure: f64,
    /// Largest gap of the ties, in m.
    widest_gap: f64,
}

/// Where a stepper begins: at the state it was made from, or where a checkpoint was.
pub(super) struct Beginning<'a> {
    /// Time of that state, in s.
    pub since: f64,
    pub frozen: Option<&'a Frozen>,
}

/// How a segment ended.
pub(super) struct Ending {
    pub look: Look,
    pub energies: Energies,
    /// What to switch; nothing at the end of the run.
    pub jobs: Vec<Job>,
    /// Rules up to this time are due, in s.
    pub now: f64,
}

impl<'a> Course<'a> {
    pub fn new(plan: &'a Plan<'a>, rules: Rules<'a>) -> Self {
        Course { plan, rules, so_far: SoFar::default() }
    }

    /// Goes on until something is to be switched, or to the end.
    ///
    /// # Errors
    /// What the stepper, a criterion or `watch` refuses.
    pub fn follow<E: From<Error>>(
        &mut self,
        model: &Model,
        stepper: &mut dyn Stepper,
        clock: &Clock,
        (beginning, record): (&Beginning, &Record),
        watch: &mut dyn FnMut(&Snapshot) -> std::result::Result<(), E>,
    ) -> std::result::Result<Ending, E> {
        let mut k = match beginning.frozen {
            None => {
                self.begin(&stepper.look()?);
                0
            }
            Some(frozen) => {
                stepper.thaw(&frozen.stepper)?;
                frozen.steps
            }
        };
        loop {
            if clock.reaching(self.rules.next_time()) <= k {
                let now = clock.time(k) + clock.slack();
                let jobs = self.rules.ask(model, &stepper.displacements(), now)?;
                if !jobs.is_empty() {
                    return Ok(self.end(stepper.look()?, jobs, now));
                }
            }
            if self.output_is_due(clock, k) {
                let look = stepper.look()?;
                self.so_far.next_output += 1;
                while self.output_is_due(clock, k) {
                    self.so_far.next_output += 1;
                    self.so_far.merged += 1;
                }
                let energies = self.energies(&look);
                self.so_far.widest_gap = norm([self.so_far.widest_gap, look.widest_gap]);
                self.so_far.worst_closure = self.so_far.worst_closure.max(energies.closure());
                let (course, stepper) = (&*self, &*stepper);
                let snapshot = Snapshot {
                    model,
                    state: &look.state,
                    factor: course.plan.loads.at(look.state.time),
                    energies,
                    gap: look.gap,
                    widest_gap: course.so_far.widest_gap,
                    reactions: &look.reactions,
                    switches: course.so_far.switches,
                    breaking: stepper.breaking(),
                    freeze: &|| Frozen::of(course, (model, record), beginning.since, (k, stepper)).seal(),
                };
                timed(Stage::Output, || watch(&snapshot))?;
            }
            if k == clock.count {
                return Ok(self.end(stepper.look()?, Vec::new(), clock.time(k)));
            }
            let next = clock.nearest(self.output_time()).min(clock.reaching(self.rules.next_time()));
            let next = next.max(k + 1);
            stepper.advance(next - k)?;
            k = next;
        }
    }

    fn output_is_due(&self, clock: &Clock, step: usize) -> bool {
        self.so_far.next_output <= self.plan.outputs && clock.nearest(self.output_time()) <= step
    }

    fn output_time(&self) -> f64 {
        self.so_far.next_output as f64 * self.plan.end_s / self.plan.outputs as f64
    }

    /// What a new stepper begins with is new energy, less what work brought.
    fn begin(&mut self, look: &Look) {
        let energy = look.kinetic + look.strain;
        match self.so_far.ended {
            None => {
                // Nothing came before: the first state is where work begins to count.
                self.so_far.base.initial = energy;
                self.add_work(&(-1.0 * look.done));
            }
            Some(before) => self.so_far.base.transfer += energy - before - look.done.total(),
        }
    }

    fn add_work(&mut self, done: &WorkDone) {
        self.so_far.base.external += done.external;
        self.so_far.base.damping += done.damping;
        self.so_far.base.interface += done.interface;
        self.so_far.base.contact += done.contact;
        self.so_far.base.fracture += done.fracture;
    }

    fn energies(&self, look: &Look) -> Energies {
        Energies {
            kinetic: look.kinetic,
            strain: look.strain,
            external: self.so_far.base.external + look.done.external,
            damping: self.so_far.base.damping + look.done.damping,
            interface: self.so_far.base.interface + look.done.interface,
            contact: self.so_far.base.contact + look.done.contact,
            fracture: self.so_far.base.fracture + look.done.fracture,
            ..self.so_far.base
        }
    }

    fn end(&mut self, look: Look, jobs: Vec<Job>, now: f64) -> Ending {
        let energies = self.energies(&look);
        self.so_far.widest_gap = norm([self.so_far.widest_gap, look.widest_gap]);
        self.add_work(&look.done);
        self.so_far.ended = Some(look.kinetic + look.strain);
        Ending { look, energies, jobs, now }
    }
}
