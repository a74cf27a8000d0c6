//! A run in time: a model, how it is stepped, and the switches from elements to particles on the way.
//!
//! [`plan`] says what to do, [`run()`] does it, [`outcome`] is what comes out, and [`resume`] goes on from a checkpoint. Between two switches the model stays as it is and one
//! of the schemes of [`crate::dynamics`] steps it; a switch builds the next model and hands over the motion ([`crate::transfer`]).

mod boxes;
mod check;
mod checkpoint;
mod clock;
mod explicit;
mod implicit;
pub mod outcome;
pub mod plan;
mod quasi_static;
mod record;
mod run;
mod segment;
mod start;
mod switching;
mod two_rates;

pub use outcome::{Energies, Outcome, Snapshot};
pub use plan::{Plan, Step, Stepping, SwitchRule, When};
pub use run::{resume, run};
