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
    /// Non-zeros that all solves together went through: those of the factor, forward and back. Small and large factors of one run count for
    /// what they are.
    #[serde(default)]
    pub solve_nonzeros: u64,
    /// Pairs looked at by the contact search.
    pub contact_checks: u64,
    /// Time or load steps.
    pub steps: u64,
}

impl Work {
    /// One number for work–precision diagrams: element and bond updates, and factor
    /// non-zeros touched once by the factorisation and twice by each solve, all counted alike.
    pub fn total(&self) -> u64 {
        self.bond_updates
            + self.element_updates
            + self.factor_nonzeros
            + self.solve_nonzeros
            + self.contact_checks
    }

    /// Counts solves with a factor of `nonzeros` stored values.
    pub fn count_solves(&mut self, solves: usize, nonzeros: usize) {
        self.solves += solves as u64;
        self.solve_nonzeros += 2 * (solves * nonzeros) as u64;
    }
}

impl AddAssign for Work {
    fn add_assign(&mut self, other: Work) {
        self.bond_updates += other.bond_updates;
        self.element_updates += other.element_updates;
        self.factorisations += other.factorisations;
        self.factor_nonzeros += other.factor_nonzeros;
        self.solves += other.solves;
        self.solve_nonzeros += other.solve_nonzeros;
        self.contact_checks += other.contact_checks;
        self.steps += other.steps;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A small factor beside a large one does not make the solves of the large one cheaper.
    #[test]
    fn every_solve_counts_its_own_factor() {
        let mut work = Work { factorisations: 2, factor_nonzeros: 1010, ..Work::default() };
        work.count_solves(3, 1000);
        work.count_solves(1, 10);
        assert_eq!((work.solves, work.solve_nonzeros), (4, 6020));
        let mut twice = work;
        twice += work;
        assert_eq!(twice.total(), 2 * 7030);
    }
}
