//! Reading values off a solution, or off a run.

pub mod bond_stress;
pub mod crack;
pub mod curve;
pub mod field;
pub mod guard;
pub mod history;
pub mod moving_least_squares;
pub mod probes;
pub mod section;
pub mod supports;
pub mod switches;
