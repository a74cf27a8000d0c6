//! Solving: sparse factors and statics with constraints.

pub mod sparse;
