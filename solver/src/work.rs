//! Exact counters of the work a run has done: the deterministic side of cost.

use serde::{Deserialize, Serialize};
use std::ops::AddAssign;

/// How often each unit of work was done. Timings are noisy; these are not.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Bond force or bond stiffness evaluations.
    pub bond_updates: u64,
    /// Element force or element stiffness evaluations.
    pub element_updates: u64,
    /// Sparse factorisations.
    pub factorisations: u64,
    /// Non-zeros of all factors together: what a direct solver's time grows with.
    pub factor_nonzeros: u64,
    /// Triangular solves with a factor.
    pub solves: u64,
    /// Pairs looked at by the contact search.
    pub contact_checks: u64,
    /// Pairs looked at while random packings were pushed apart.
    #[serde(default)]
    pub packing_checks: u64,
    /// Time or load steps.
    pub steps: u64,
}

impl Work {
    /// One number for work–precision diagrams: element and bond updates, and factor
    /// non-zeros touched once by the factorisation and twice by each solve, all counted alike.
    pub fn total(&self) -> u64 {
        let per_factor = self.factor_nonzeros.checked_div(self.factorisations).unwrap_or(0);
        self.bond_updates
            + self.element_updates
            + self.factor_nonzeros
            + 2 * per_factor * self.solves
            + self.contact_checks
            + self.packing_checks
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Work) {
        self.bond_updates += other.bond_updates;
        self.element_updates += other.element_updates;
        self.factorisations += other.factorisations;
        self.factor_nonzeros += other.factor_nonzeros;
        self.solves += other.solves;
        self.contact_checks += other.contact_checks;
        self.packing_checks += other.packing_checks;
        self.steps += other.steps;
    }
}
