//! Going through time.

use super::clock::Clock;
use super::explicit::Central;
use super::implicit::Implicit;
use super::outcome::{Outcome, Snapshot};
use super::plan::{Plan, Step, Stepping};
use super::quasi_static::Equilibria;
use super::segment::{Course, Ending, Stepper};
use super::switching::Rules;
use super::{check, start};
use crate::dynamics::State;
use crate::dynamics::critical;
use crate::dynamics::semidiscrete::Semidiscrete;
use crate::error::Error;
use crate::model::Model;
use crate::transfer::report::SwitchReport;
use crate::work::Work;
use std::time::Instant;

/// Runs a model from rest, or from the plan's velocities, at time zero to the end; `watch` sees the snapshots.
///
/// # Errors
/// What a plan or its schemes refuse; what `watch` returns.
pub fn run<E: From<Error>>(
    mut model: Model,
    plan: &Plan,
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Outcome, E> {
    check::plan(&model, plan)?;
    let mut record = Record::default();
    let mut state = start::state(&model, plan, &mut record.work)?;
    let mut course = Course::new(plan, Rules::new(&model, plan));
    let mut now = 0.0;
    let mut jobs = course.rules.ask(&model, &state.u, now)?;
    loop {
        while !jobs.is_empty() {
            let began = Instant::now();
            let factor = plan.loads.at(state.time);
            for job in &jobs {
                let reports = course.rules.apply(job, &mut model, &mut state, factor, &mut record.work)?;
                course.switches += reports.len();
                record.switches.extend(reports);
            }
            record.switch_seconds += began.elapsed().as_secs_f64();
            // Another rule may be due at the same time.
            jobs = course.rules.ask(&model, &state.u, now)?;
        }
        let ending = segment(&mut course, &model, &state, &mut record, watch)?;
        if ending.jobs.is_empty() {
            let Ending { look, energies, .. } = ending;
            let Record { work, notes, switches, switch_seconds } = record;
            return Ok(Outcome {
                model,
                state: look.state,
                energies,
                worst_closure: course.worst_closure,
                switches,
                notes,
                work,
                switch_seconds,
            });
        }
        state = ending.look.state;
        (jobs, now) = (ending.jobs, ending.now);
    }
}

/// What a run leaves behind.
#[derive(Default)]
struct Record {
    work: Work,
    notes: Vec<String>,
    switches: Vec<(String, SwitchReport)>,
    switch_seconds: f64,
}

impl Record {
    fn note(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    fn assemble(&mut self, model: &Model) -> crate::error::Result<Semidiscrete> {
        let system = Semidiscrete::new(model, &mut self.work)?;
        system.notes.iter().for_each(|n| self.note(n.clone()));
        Ok(system)
    }

    /// Equal steps from a state to the end of the plan, none longer than `longest` (s).
    fn steps(&mut self, from: &State, plan: &Plan, longest: f64) -> Clock {
        let clock = Clock::within(from.time, plan.end_s, longest);
        self.note_steps(from, &clock, &format!("{longest:e} s asked"));
        clock
    }

    /// As [`Record::steps`] for central differences.
    fn explicit_steps(
        &mut self,
        model: &Model,
        from: &State,
        plan: &Plan,
        step: Step,
    ) -> crate::error::Result<Clock> {
        let share = match step {
            Step::Seconds(longest) => return Ok(self.steps(from, plan, longest)),
            Step::ShareOfCritical(share) => share,
        };
        let critical = critical::bound(model)?;
        let longest = share * plan.damping.step_factor() * critical.step_s;
        let clock = Clock::strictly_within(from.time, plan.end_s, longest);
        self.note_steps(
            from,
            &clock,
            &format!("at most {share} of the critical step, set by {}", critical.what),
        );
        Ok(clock)
    }

    fn note_steps(&mut self, from: &State, clock: &Clock, asked: &str) {
        self.note(format!("from {:e} s: {} steps of {:e} s ({asked})", from.time, clock.count, clock.step));
    }
}

/// One stepper on one model.
fn segment<E: From<Error>>(
    course: &mut Course,
    model: &Model,
    from: &State,
    record: &mut Record,
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Ending, E> {
    let plan = course.plan;
    let mut follow = |stepper: &mut dyn Stepper, clock: &Clock, record: &mut Record| {
        let ending = course.follow(model, stepper, clock, watch);
        record.work += stepper.work();
        ending
    };
    match plan.stepping {
        Stepping::QuasiStatic { step_s } => {
            let system = record.assemble(model)?;
            let clock = record.steps(from, plan, step_s);
            let mut stepper = Equilibria::new(model, &system, &plan.loads, clock, from)?;
            follow(&mut stepper, &clock, record)
        }
        Stepping::Implicit { scheme, step_s } => {
            let system = record.assemble(model)?;
            let clock = record.steps(from, plan, step_s);
            let rates = (scheme, plan.damping.rate());
            let mut stepper = Implicit::new(&system, rates, &plan.loads, clock, from)?;
            follow(&mut stepper, &clock, record)
        }
        Stepping::Explicit { step } => {
            let clock = record.explicit_steps(model, from, plan, step)?;
            let mut stepper = Central::new(model, plan, &clock, from)?;
            stepper.0.system().notes.iter().for_each(|n| record.note(n.clone()));
            follow(&mut stepper, &clock, record)
        }
        Stepping::TwoRates { .. } => {
            let message = "two rates are not here yet; step implicitly or explicitly".to_owned();
            Err(Error::Solve { message }.into())
        }
    }
}
