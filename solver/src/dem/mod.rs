//! Discrete elements: particles joined by cylindrical Euler–Bernoulli beams.

pub mod bond;
pub mod network;
