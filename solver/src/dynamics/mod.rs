//! Motion in time: the semi-discrete equations and the schemes that step them.

pub mod modes;
pub mod multirate;
pub mod newmark;
pub mod quasi_static;
pub mod semidiscrete;
