//! Velocities that satisfy the ties: interpolated ones leave a mismatch at the new faces, and a step that ties accelerations
//! would let it drift.

use crate::dynamics::State;
use crate::dynamics::interface::Interface;
use crate::dynamics::system::System;
use crate::error::Result;
use crate::model::Model;
use crate::work::Work;

/// Makes `C v = 0` by the smallest change in kinetic energy, `v −= M⁻¹Cᵀ(C M⁻¹Cᵀ)⁻¹C v`: impulses of the ties, which keep
/// momentum. Prescribed unknowns keep their velocities.
///
/// # Errors
/// As [`System::new`]; ties that cannot be met.
pub fn project_velocities(model: &Model, state: &mut State, work: &mut Work) -> Result<()> {
    let system = System::new(model)?;
    let interface = Interface::new(&system, work)?;
    let mut impulse = vec![0.0; state.v.len()];
    interface.project(&system, &mut state.v, &mut impulse, work)?;
    Ok(())
}
