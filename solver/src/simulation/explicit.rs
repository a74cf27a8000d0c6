//! Central differences for the whole model.
//!
//! Kinetic energy is `½ v₋ᵀM v₊`, with which the energies balance exactly ([`crate::dynamics::ledger`]).

use super::clock::Clock;
use super::plan::Plan;
use super::segment::{Look, Stepper};
use crate::dynamics::State;
use crate::dynamics::breaking::Breaking;
use crate::dynamics::explicit::{Explicit, Observation, Options};
use crate::dynamics::ledger::Ledger;
use crate::dynamics::load::LoadFactor;
use crate::error::Result;
use crate::model::Model;
use crate::work::Work;

/// A run of central differences.
pub(super) struct Central(pub Explicit);

impl Central {
    /// Starts from a state; its accelerations follow from the forces.
    ///
    /// # Errors
    /// As [`Explicit::new`].
    pub fn new(model: &Model, plan: &Plan, clock: &Clock, from: &State) -> Result<Self> {
        let options = Options {
            step_s: clock.step,
            loads: plan.loads.clone(),
            // Supports keep their values from the start on.
            supports: LoadFactor::Sudden,
            damping: plan.damping,
            rotations: plan.rotations,
        };
        if plan.laws.is_empty() {
            return Ok(Central(Explicit::new(model, options, from)?));
        }
        let breaking = Breaking::new(model, plan.laws.clone(), plan.contact)?;
        Ok(Central(Explicit::with_breaking(model, options, from, breaking)?))
    }
}

impl Stepper for Central {
    fn advance(&mut self, steps: usize) -> Result<()> {
        self.0.advance(steps as u64)
    }

    fn displacements(&self) -> Vec<f64> {
        self.0.u().to_vec()
    }

    fn look(&mut self) -> Result<Look> {
        let Observation { state, ledger, gap, reactions } = self.0.observe()?;
        let Ledger { kinetic, strain, work, .. } = ledger;
        Ok(Look { state, kinetic, strain, done: work, gap, widest_gap: gap, reactions })
    }

    fn work(&self) -> Work {
        self.0.work()
    }

    fn breaking(&self) -> Option<&Breaking> {
        self.0.breaking()
    }

    fn freeze(&self) -> Vec<u8> {
        self.0.freeze()
    }

    fn thaw(&mut self, bytes: &[u8]) -> Result<()> {
        self.0.thaw(bytes)
    }
}
