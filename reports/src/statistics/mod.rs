//! Statistics of ensembles, of refinement studies and of many comparisons at once.

pub mod bias;
pub mod bootstrap;
pub mod convergence;
pub mod ensemble;
pub mod student;

/// One-sided 95 % quantile of the standard normal distribution.
pub const NORMAL_95: f64 = 1.644_853_626_951_472_7;
