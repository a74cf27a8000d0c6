//! Discrete elements: particles joined by cylindrical Euler–Bernoulli beams.
//!
//! From nothing to a body: an [`arrangement`] of particles (a [`lattice`] or a random packing),
//! pairs of neighbours, bonds with a section and a skin weight, and the [`network`] they form.

pub mod arrangement;
pub mod block;
pub mod bond;
pub mod bonding;
pub mod calibration;
pub mod clusters;
pub mod corotational;
pub mod grid;
pub mod kernel;
pub mod lattice;
pub mod network;
pub mod network_csv;
pub mod notch;
pub mod packing;
pub mod section;
pub mod skin;
pub mod voronoi;
