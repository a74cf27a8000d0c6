//! Going through time.

use super::checkpoint::Frozen;
use super::clock::Clock;
use super::explicit::Central;
use super::implicit::Implicit;
use super::outcome::{Outcome, Snapshot};
use super::plan::{Plan, Stepping};
use super::quasi_static::Equilibria;
use super::record::Record;
use super::segment::{Beginning, Course, Ending, SoFar, Stepper};
use super::switching::{Job, Rules};
use super::two_rates::TwoRates;
use super::{check, start};
use crate::checkpoint::refuse;
use crate::contact::ContactEnergy;
use crate::dynamics::State;
use crate::dynamics::breaking::Breaking;
use crate::error::Error;
use crate::model::{Model, Numbering, Part};
use crate::stage::{Stage, timed};
use std::time::Instant;

/// Runs a model from rest, or from the plan's velocities, at time zero to the end; `watch` sees the snapshots.
///
/// # Errors
/// What a plan or its schemes refuse; what `watch` returns.
pub fn run<E: From<Error>>(
    model: Model,
    plan: &Plan,
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Outcome, E> {
    timed(Stage::Steps, || through(model, plan, watch))
}

fn through<E: From<Error>>(
    mut model: Model,
    plan: &Plan,
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Outcome, E> {
    check::plan(&model, plan)?;
    let mut record = Record::default();
    let mut state = start::state(&model, plan, &mut record.work)?;
    let mut course = Course::new(plan, Rules::new(&model, plan));
    let jobs = course.rules.ask(&model, &state.u, 0.0)?;
    switch(&mut course, (&mut model, &mut state), &mut record, (jobs, 0.0))?;
    let ending = segment(&mut course, &model, &state, (&mut record, None), watch)?;
    to_the_end(course, model, record, ending, watch)
}

/// Goes on from a [`Snapshot::checkpoint`] of a run of the same model and plan. The snapshots that follow, the outcome and the
/// counted work are those of the run without a stop, bit by bit.
///
/// # Errors
/// A checkpoint that is damaged, or of another model or plan; otherwise as [`run`].
pub fn resume<E: From<Error>>(
    model: Model,
    plan: &Plan,
    checkpoint: &[u8],
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Outcome, E> {
    timed(Stage::Steps, || on_from(checkpoint, model, plan, watch))
}

fn on_from<E: From<Error>>(
    checkpoint: &[u8],
    mut model: Model,
    plan: &Plan,
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Outcome, E> {
    check::plan(&model, plan)?;
    if !plan.laws.is_empty() {
        return Err(refuse("a run that breaks bonds has no checkpoints; run it through").into());
    }
    let mut course = Course::new(plan, Rules::new(&model, plan));
    let frozen = Frozen::open(checkpoint, &mut model, &mut course)?;
    let from = State { time: frozen.since, ..State::at_rest(Numbering::new(&model).len()) };
    let mut record = Record::default();
    let ending = segment(&mut course, &model, &from, (&mut record, Some(&frozen)), watch)?;
    to_the_end(course, model, record, ending, watch)
}

/// Switches and steps until nothing is left to switch.
fn to_the_end<E: From<Error>>(
    mut course: Course,
    mut model: Model,
    mut record: Record,
    mut ending: Ending,
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Outcome, E> {
    while !ending.jobs.is_empty() {
        let mut state = ending.look.state;
        switch(&mut course, (&mut model, &mut state), &mut record, (ending.jobs, ending.now))?;
        ending = segment(&mut course, &model, &state, (&mut record, None), watch)?;
    }
    let SoFar { merged, worst_closure, .. } = course.so_far;
    if merged > 0 {
        record
            .note(format!("{merged} outputs share a step boundary with another: fewer snapshots were taken"));
    }
    let Ending { look, energies, .. } = ending;
    let Record { work, notes, switches, switch_seconds, breaking } = record;
    for (part, left) in breaking.iter().flat_map(Breaking::networks) {
        if let Part::Discrete { network, .. } = &mut model.parts[part] {
            network.bonds.weight.clone_from(&left.bonds.weight);
        }
    }
    Ok(Outcome {
        model,
        state: look.state,
        energies,
        worst_closure,
        switches,
        losses: breaking.as_ref().map_or_else(Vec::new, |b| b.losses().to_vec()),
        contact: breaking.as_ref().map_or_else(ContactEnergy::default, Breaking::contact_energy),
        notes,
        work,
        switch_seconds,
    })
}

/// Replaces elements until no rule is due any more.
fn switch(
    course: &mut Course,
    (model, state): (&mut Model, &mut State),
    record: &mut Record,
    (mut jobs, now): (Vec<Job>, f64),
) -> Result<(), Error> {
    while !jobs.is_empty() {
        let began = Instant::now();
        let factor = course.plan.loads.at(state.time);
        for job in &jobs {
            let reports = course.rules.apply(job, model, state, factor, &mut record.work)?;
            course.so_far.switches += reports.len();
            record.switches.extend(reports);
        }
        record.switch_seconds += began.elapsed().as_secs_f64();
        // Another rule may be due at the same time.
        jobs = course.rules.ask(model, &state.u, now)?;
    }
    Ok(())
}

/// One stepper on one model.
fn segment<E: From<Error>>(
    course: &mut Course,
    model: &Model,
    from: &State,
    (record, frozen): (&mut Record, Option<&Frozen>),
    watch: &mut dyn FnMut(&Snapshot) -> Result<(), E>,
) -> Result<Ending, E> {
    let plan = course.plan;
    let beginning = Beginning { since: from.time, frozen };
    let mut follow = |stepper: &mut dyn Stepper, clock: &Clock, record: &mut Record| {
        if let Some(frozen) = frozen {
            // Making the stepper once more is not part of the run.
            record.clone_from(&frozen.record);
        }
        let ending = course.follow(model, stepper, clock, (&beginning, record), watch);
        record.work += stepper.work();
        record.breaking = stepper.breaking().cloned();
        ending
    };
    match stepping_of(model, plan) {
        Stepping::QuasiStatic { step_s } => {
            let system = record.assemble(model)?;
            let clock = record.steps(from, plan, step_s);
            let mut stepper = Equilibria::new(model, &system, &plan.loads, clock, from)?;
            follow(&mut stepper, &clock, record)
        }
        Stepping::Implicit { scheme, step_s } => {
            let system = record.assemble(model)?;
            let clock = record.steps(from, plan, step_s);
            let scheme = (scheme, plan.damping.rate());
            let mut stepper = Implicit::new(&system, scheme, &plan.loads, clock, from)?;
            follow(&mut stepper, &clock, record)
        }
        Stepping::Explicit { step } => {
            let clock = record.explicit_steps(model, from, plan, step)?;
            let mut stepper = Central::new(model, plan, &clock, from)?;
            stepper.0.system().notes.iter().for_each(|n| record.note(n.clone()));
            follow(&mut stepper, &clock, record)
        }
        Stepping::TwoRates { method, step_s, fine, .. } => {
            let system = record.assemble(model)?;
            let clock = record.steps(from, plan, step_s);
            let ratio = record.ratio(model, from, &clock, fine)?;
            let mut stepper = TwoRates::new(model, &system, (method, ratio), &plan.loads, clock, from)?;
            follow(&mut stepper, &clock, record)
        }
    }
}

/// Two rates need two sides: elements alone are stepped implicitly, particles alone explicitly.
fn stepping_of(model: &Model, plan: &Plan) -> Stepping {
    let particles = model.parts.iter().filter(|p| matches!(p, Part::Discrete { .. })).count();
    match plan.stepping {
        Stepping::TwoRates { scheme, step_s, .. } if particles == 0 => Stepping::Implicit { scheme, step_s },
        Stepping::TwoRates { fine, .. } if particles == model.parts.len() => {
            Stepping::Explicit { step: fine }
        }
        other => other,
    }
}
