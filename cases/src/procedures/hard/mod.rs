//! Hard cases: each says when it passes, and how far it is from not passing.

pub(super) mod bad_states;
pub(super) mod bodies;
pub(super) mod bond_radius;
pub(super) mod constraints;
pub(super) mod contact_after_break;
pub(super) mod contrast;
pub(super) mod critical_step;
pub(super) mod distortion;
pub(super) mod incompressible;
pub(super) mod maps;
pub(super) mod reproducible;
pub(super) mod single_break;
pub(super) mod slenderness;
pub(super) mod transfer_at_peak;
mod two_rates;
mod unrefused;
