//! Reading values off a solution.

pub mod curve;
pub mod field;
pub mod moving_least_squares;
pub mod probes;
pub mod section;
