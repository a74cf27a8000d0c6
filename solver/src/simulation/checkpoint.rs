//! A run at a snapshot, and back: what [`Snapshot::checkpoint`](super::Snapshot::checkpoint) gives and [`super::resume`] takes.
//!
//! The model is not kept. It follows from the one at the start and from the boxes that were replaced: the switches are made
//! again, and a fingerprint tells whether the same model came out.

use super::plan::{Plan, SwitchRule};
use super::record::Record;
use super::segment::{Course, SoFar, Stepper};
use super::switching::{Job, Progress};
use crate::checkpoint::{self, Fingerprint, refuse};
use crate::dynamics::State;
use crate::error::Result;
use crate::model::{Model, Numbering};
use crate::work::Work;
use serde::{Deserialize, Serialize};

/// Everything of a run that changes on its way.
#[derive(Serialize, Deserialize)]
pub(super) struct Frozen {
    plan: Fingerprint,
    model: Fingerprint,
    jobs: Vec<Job>,
    progress: Vec<Progress>,
    so_far: SoFar,
    pub record: Record,
    /// When the present stepper began, in s.
    pub since: f64,
    /// Steps that it has taken.
    pub steps: usize,
    pub stepper: Vec<u8>,
}

impl Frozen {
    /// A run as it is now.
    pub fn of(
        course: &Course,
        (model, record): (&Model, &Record),
        since: f64,
        (steps, stepper): (usize, &dyn Stepper),
    ) -> Self {
        Frozen {
            plan: of_plan(course.plan),
            model: Fingerprint::of(model),
            jobs: course.rules.done.clone(),
            progress: course.rules.progress.clone(),
            so_far: course.so_far.clone(),
            record: record.clone(),
            since,
            steps,
            stepper: stepper.freeze(),
        }
    }

    pub fn seal(&self) -> Vec<u8> {
        checkpoint::seal(self)
    }

    /// Reads a checkpoint, and brings a model at its start and a course to where they were.
    ///
    /// # Errors
    /// Bytes that are damaged, or of another model or plan.
    pub fn open(bytes: &[u8], model: &mut Model, course: &mut Course) -> Result<Self> {
        let another =
            || refuse("it was written for another model or another plan; resume those, or start again");
        let frozen: Frozen = checkpoint::open(bytes)?;
        if frozen.plan != of_plan(course.plan) {
            return Err(another());
        }
        for job in &frozen.jobs {
            // What becomes of the motion does not matter here: it is kept.
            let mut state = State::at_rest(Numbering::new(model).len());
            let made = course.rules.apply(job, model, &mut state, 0.0, &mut Work::default());
            made.map_err(|_| another())?;
        }
        if frozen.model != Fingerprint::of(model) {
            return Err(another());
        }
        course.rules.progress.clone_from(&frozen.progress);
        course.so_far = frozen.so_far.clone();
        Ok(frozen)
    }
}

/// All of a plan but what it starts from and what it packs: that shows in the model.
fn of_plan(plan: &Plan) -> Fingerprint {
    let Plan {
        stepping,
        end_s,
        initial_velocity: _,
        loads,
        damping,
        rotations,
        outputs,
        switches,
        laws,
        contact,
    } = plan;
    let rule = |rule: &SwitchRule| {
        let SwitchRule { name, body, when, fill: _, method, multipliers, rotations, mode, finite } = rule;
        format!("{name:?} {body:?} {when:?} {method:?} {multipliers:?} {rotations} {mode:?} {finite}")
    };
    let rules: Vec<String> = switches.iter().map(rule).collect();
    Fingerprint::of(&(stepping, end_s, loads, damping, rotations, outputs, rules, laws, contact))
}
