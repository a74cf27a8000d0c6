//! From one switch to the next: steps, snapshots, and rules asked on step boundaries.

use super::clock::Clock;
use super::outcome::{Energies, Snapshot};
use super::plan::Plan;
use super::switching::{Job, Rules};
use crate::dynamics::State;
use crate::dynamics::breaking::Breaking;
use crate::dynamics::ledger::WorkDone;
use crate::error::{Error, Result};
use crate::model::Model;
use crate::stage::{Stage, timed};
use crate::work::Work;

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
    /// `‖C u‖`, in m.
    pub gap: f64,
    /// Forces of supports and ties, in N and N m.
    pub reactions: Vec<f64>,
}

/// What a run has come to, over all its steppers.
pub(super) struct Course<'a> {
    pub plan: &'a Plan<'a>,
    pub rules: Rules<'a>,
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
        Course {
            plan,
            rules,
            base: Energies::default(),
            ended: None,
            next_output: 0,
            merged: 0,
            switches: 0,
            worst_closure: 0.0,
        }
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
        watch: &mut dyn FnMut(&Snapshot) -> std::result::Result<(), E>,
    ) -> std::result::Result<Ending, E> {
        self.begin(&stepper.look()?);
        let mut k = 0;
        loop {
            if clock.reaching(self.rules.next_time()) <= k {
                let now = clock.time(k) + clock.slack();
                let jobs = self.rules.ask(model, &stepper.displacements(), now)?;
                if !jobs.is_empty() {
                    return Ok(self.end(stepper.look()?, jobs, now));
                }
            }
            if self.next_output <= self.plan.outputs && clock.nearest(self.output_time()) <= k {
                let look = stepper.look()?;
                let losses = stepper.breaking().map_or(0, |b| b.losses().len());
                self.show(model, &look, losses, watch)?;
                self.next_output += 1;
                while self.next_output <= self.plan.outputs && clock.nearest(self.output_time()) <= k {
                    self.next_output += 1;
                    self.merged += 1;
                }
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

    fn output_time(&self) -> f64 {
        self.next_output as f64 * self.plan.end_s / self.plan.outputs as f64
    }

    /// What a new stepper begins with is new energy, less what work brought.
    fn begin(&mut self, look: &Look) {
        let energy = look.kinetic + look.strain;
        match self.ended {
            None => {
                // Nothing came before: the first state is where work begins to count.
                self.base.initial = energy;
                self.add_work(&(-1.0 * look.done));
            }
            Some(before) => self.base.transfer += energy - before - look.done.total(),
        }
    }

    fn add_work(&mut self, done: &WorkDone) {
        self.base.external += done.external;
        self.base.damping += done.damping;
        self.base.interface += done.interface;
        self.base.contact += done.contact;
        self.base.fracture += done.fracture;
    }

    fn energies(&self, look: &Look) -> Energies {
        Energies {
            kinetic: look.kinetic,
            strain: look.strain,
            external: self.base.external + look.done.external,
            damping: self.base.damping + look.done.damping,
            interface: self.base.interface + look.done.interface,
            contact: self.base.contact + look.done.contact,
            fracture: self.base.fracture + look.done.fracture,
            ..self.base
        }
    }

    fn end(&mut self, look: Look, jobs: Vec<Job>, now: f64) -> Ending {
        let energies = self.energies(&look);
        self.add_work(&look.done);
        self.ended = Some(look.kinetic + look.strain);
        Ending { look, energies, jobs, now }
    }

    fn show<E>(
        &mut self,
        model: &Model,
        look: &Look,
        losses: usize,
        watch: &mut dyn FnMut(&Snapshot) -> std::result::Result<(), E>,
    ) -> std::result::Result<(), E> {
        let energies = self.energies(look);
        self.worst_closure = self.worst_closure.max(energies.closure());
        let snapshot = Snapshot {
            model,
            state: &look.state,
            factor: self.plan.loads.at(look.state.time),
            energies,
            gap: look.gap,
            reactions: &look.reactions,
            switches: self.switches,
            losses,
        };
        timed(Stage::Output, || watch(&snapshot))
    }
}
