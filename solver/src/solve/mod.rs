//! Solving: sparse factors and statics with constraints.

pub mod kkt;
pub mod mechanism;
pub(crate) mod norm;
pub mod order;
pub mod sparse;
pub mod statics;
