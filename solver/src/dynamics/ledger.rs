//! Where the energy is, and which way it came.
//!
//! With forces `q_n` at the steps and velocities at the half steps the sums
//! `T_n = ½ v₋ᵀ M v₊`, `W = Σ ½ (q_n + q_{n+1})·Δu` balance exactly for central differences of a linear system: what does
//! not is rounding. Finite rotations add an oscillation of second order in the step.

use serde::{Deserialize, Serialize};
use std::ops::{Add, AddAssign, Mul};

/// Work done on the bodies since the start, in J.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct WorkDone {
    /// By loads and moving supports.
    pub external: f64,
    /// By damping: negative.
    pub damping: f64,
    /// By the ties; zero up to rounding where both sides take the same steps.
    pub interface: f64,
    /// By contacts: negative while they close.
    pub contact: f64,
    /// Taken by bonds that failed: negative.
    pub fracture: f64,
}

impl WorkDone {
    /// All work together, in J.
    pub fn total(&self) -> f64 {
        self.external + self.damping + self.interface + self.contact + self.fracture
    }
}

impl Add for WorkDone {
    type Output = WorkDone;
    fn add(self, other: WorkDone) -> WorkDone {
        WorkDone {
            external: self.external + other.external,
            damping: self.damping + other.damping,
            interface: self.interface + other.interface,
            contact: self.contact + other.contact,
            fracture: self.fracture + other.fracture,
        }
    }
}

impl AddAssign for WorkDone {
    fn add_assign(&mut self, other: WorkDone) {
        *self = *self + other;
    }
}

impl Mul<WorkDone> for f64 {
    type Output = WorkDone;
    fn mul(self, w: WorkDone) -> WorkDone {
        WorkDone {
            external: self * w.external,
            damping: self * w.damping,
            interface: self * w.interface,
            contact: self * w.contact,
            fracture: self * w.fracture,
        }
    }
}

/// Energies at one time, in J.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Ledger {
    /// `½ v₋ᵀ M v₊`.
    pub kinetic: f64,
    /// `½ uᵀ f_int`, or the energy of bonds under finite rotations.
    pub strain: f64,
    /// Work since the start.
    pub work: WorkDone,
    /// Kinetic and strain energy at the start.
    pub initial: f64,
}

impl Ledger {
    /// Kinetic and strain energy, in J.
    pub fn energy(&self) -> f64 {
        self.kinetic + self.strain
    }

    /// Energy that no work accounts for, in J.
    pub fn imbalance(&self) -> f64 {
        self.energy() - self.initial - self.work.total()
    }

    /// [`Ledger::imbalance`] over the largest entry of the ledger; zero if all are zero.
    pub fn closure(&self) -> f64 {
        let WorkDone { external, damping, interface, contact, fracture } = self.work;
        let work = [external, damping, interface, contact, fracture];
        let entries = [self.kinetic, self.strain, self.initial].into_iter().chain(work);
        let largest = entries.fold(0.0f64, |m, e| m.max(e.abs()));
        if largest > 0.0 { self.imbalance().abs() / largest } else { 0.0 }
    }
}
