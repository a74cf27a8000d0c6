//! Going through time.

use super::outcome::{Outcome, Snapshot};
use super::plan::Plan;
use crate::error::Result;
use crate::model::Model;

/// Runs a model from rest, or from the plan's velocities, at time zero to the end; `watch` sees the snapshots.
///
/// # Errors
/// What a plan or its schemes refuse; what `watch` returns.
pub fn run(_model: Model, _plan: &Plan, _watch: &mut dyn FnMut(&Snapshot) -> Result<()>) -> Result<Outcome> {
    todo!()
}
