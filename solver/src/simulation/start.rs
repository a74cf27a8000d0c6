//! States that a run may start from: held by the supports, moving with the ties.

use super::plan::Plan;
use crate::dynamics::State;
use crate::error::Result;
use crate::model::{Model, Numbering, PointValue};
use crate::transfer::ties::project_velocities;
use crate::work::Work;

/// The state at time zero.
///
/// # Errors
/// As [`admit`].
pub(super) fn state(model: &Model, plan: &Plan, work: &mut Work) -> Result<State> {
    let numbering = Numbering::new(model);
    let mut state = State::at_rest(numbering.len());
    let Some(velocity) = plan.initial_velocity else {
        hold(model, &mut state);
        return Ok(state);
    };
    for (p, part) in model.parts.iter().enumerate() {
        for (point, &x) in part.positions().iter().enumerate() {
            let v = velocity(p, x);
            (0..model.space.dim()).for_each(|c| state.v[numbering.unknown(p, point, c)] = v[c]);
        }
    }
    admit(model, &mut state, work)?;
    Ok(state)
}

/// Puts prescribed unknowns at rest at their values, and the velocities of the others on the ties.
///
/// # Errors
/// Ties that cannot be made or met.
pub(super) fn admit(model: &Model, state: &mut State, work: &mut Work) -> Result<()> {
    hold(model, state);
    project_velocities(model, state, work)
}

fn hold(model: &Model, state: &mut State) {
    let numbering = Numbering::new(model);
    for &PointValue { part, point, component, value } in &model.supports {
        let i = numbering.unknown(part, point, component);
        (state.u[i], state.v[i], state.a[i]) = (value, 0.0, 0.0);
    }
}
