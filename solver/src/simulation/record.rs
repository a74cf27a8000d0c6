//! What a run leaves behind besides its end, and the choice of its steps.

use super::clock::Clock;
use super::plan::{Plan, Step};
use crate::dynamics::State;
use crate::dynamics::breaking::Breaking;
use crate::dynamics::critical;
use crate::dynamics::semidiscrete::Semidiscrete;
use crate::error::Result;
use crate::model::{Model, Part};
use crate::transfer::report::SwitchReport;
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// What a run leaves behind.
#[derive(Debug, Clone, Default, Serialize, Deserialize)]
pub(super) struct Record {
    /// Counted work.
    pub work: Work,
    /// In words, each once.
    pub notes: Vec<String>,
    /// Name of the body and report of every switch.
    pub switches: Vec<(String, SwitchReport)>,
    /// Wall time of the switches, in s.
    pub switch_seconds: f64,
    /// Bonds that have broken, with what is left of them; `None` where nothing breaks.
    #[serde(skip)]
    pub breaking: Option<Breaking>,
}

impl Record {
    /// Keeps a note once.
    pub fn note(&mut self, note: String) {
        if !self.notes.contains(&note) {
            self.notes.push(note);
        }
    }

    /// Matrices of a model.
    ///
    /// # Errors
    /// As [`Semidiscrete::new`].
    pub fn assemble(&mut self, model: &Model) -> Result<Semidiscrete> {
        let system = Semidiscrete::new(model, &mut self.work)?;
        system.notes.iter().for_each(|n| self.note(n.clone()));
        Ok(system)
    }

    /// Equal steps from a state to the end of the plan, none longer than `longest` (s).
    pub fn steps(&mut self, from: &State, plan: &Plan, longest: f64) -> Clock {
        let clock = Clock::within(from.time, plan.end_s, longest);
        self.note_steps(from, &clock, &format!("{longest:e} s asked"));
        clock
    }

    /// As [`Record::steps`] for central differences.
    ///
    /// # Errors
    /// As [`critical::bound`].
    pub fn explicit_steps(&mut self, model: &Model, from: &State, plan: &Plan, step: Step) -> Result<Clock> {
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

    /// Fine steps of the particles per coarse step.
    ///
    /// # Errors
    /// A fine step beyond what the particles bear.
    pub fn ratio(&mut self, model: &Model, from: &State, clock: &Clock, fine: Step) -> Result<usize> {
        let particles = model.parts.iter().filter(|p| matches!(p, Part::Discrete { .. }));
        let critical = critical::bound_of(particles)?;
        let ratio = match fine {
            Step::Seconds(longest) => Clock::within(0.0, clock.step, longest).count,
            Step::ShareOfCritical(share) => {
                Clock::strictly_within(0.0, clock.step, share * critical.step_s).count
            }
        };
        critical.admit(clock.step / ratio as f64)?;
        self.note(format!("from {:e} s: {ratio} steps of the particles in one of the elements", from.time));
        Ok(ratio)
    }

    fn note_steps(&mut self, from: &State, clock: &Clock, asked: &str) {
        self.note(format!("from {:e} s: {} steps of {:e} s ({asked})", from.time, clock.count, clock.step));
    }
}
