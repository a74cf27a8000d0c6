//! Motion in time: `M a + f_int(u) = f_ext(t) + Cᵀλ`, `C u = 0`, and the schemes that step it.
//!
//! Explicit: [`system`] is what the schemes share: lumped masses, supports, loads and constraint rows on
//! the unknowns of a [`crate::model::Numbering`]. [`load`] scales supports and loads in time. [`explicit`] takes steps below
//! the [`critical`] one, keeps the ties by an [`interface`] solve and a [`ledger`] of energies; a [`checkpoint`] lets it go on later.
//! Implicit: [`semidiscrete`] has the matrices on the free unknowns for [`newmark`] steps, two rates ([`multirate`]),
//! equilibria ([`quasi_static`]) and natural [`modes`].

pub mod breaking;
pub mod checkpoint;
pub mod critical;
pub mod damping;
pub mod explicit;
pub mod forces;
pub mod interface;
pub mod ledger;
pub mod load;
pub mod modes;
pub mod multirate;
pub mod newmark;
pub mod quasi_static;
pub mod semidiscrete;
pub mod system;

/// Motion at one time; all vectors in the order of the [`crate::model::Numbering`].
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Time, in s.
    pub time: f64,
    /// Displacements (m) and rotations (rad).
    pub u: Vec<f64>,
    /// Velocities (m/s, rad/s).
    pub v: Vec<f64>,
    /// Accelerations (m/s², rad/s²).
    pub a: Vec<f64>,
}

impl State {
    /// `n` unknowns at rest at time zero.
    pub fn at_rest(n: usize) -> Self {
        State { time: 0.0, u: vec![0.0; n], v: vec![0.0; n], a: vec![0.0; n] }
    }
}
