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
    /// Non-zeros touched by these solves, forwards and backwards.
    #[serde(default)]
    pub solve_entries: u64,
    /// Pairs looked at by the contact search.
    pub contact_checks: u64,
    /// Pairs looked at while random packings were pushed apart.
    #[serde(default)]
    pub packing_checks: u64,
    /// Time or load steps.
    pub steps: u64,
}

impl Work {
    /// Counts a factorisation whose factor has this many non-zeros.
    pub fn factored(&mut self, nonzeros: usize) {
        self.factorisations += 1;
        self.factor_nonzeros += nonzeros as u64;
    }

    /// Counts a solve with a factor of this many non-zeros, each touched on the way forwards and on the way back.
    pub fn solved(&mut self, nonzeros: usize) {
        self.solves += 1;
        self.solve_entries += 2 * nonzeros as u64;
    }

    /// One number for work–precision diagrams: element and bond updates, factor non-zeros touched by factorisations and by
    /// solves, and pairs looked at, all counted alike. That of a sum is the sum of those of its parts.
    pub fn total(&self) -> u64 {
        self.bond_updates
            + self.element_updates
            + self.factor_nonzeros
            + self.solve_entries
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
        self.solve_entries += other.solve_entries;
        self.contact_checks += other.contact_checks;
        self.packing_checks += other.packing_checks;
        self.steps += other.steps;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A large factor that is used once and a small one that is used often: no mean of the two stands for both.
    #[test]
    fn the_work_of_a_sum_is_the_sum_of_the_work() {
        let of = |nonzeros: usize, solves: usize| {
            let mut work = Work::default();
            work.factored(nonzeros);
            (0..solves).for_each(|_| work.solved(nonzeros));
            work
        };
        let (large, small) = (of(100_000, 1), of(100, 1000));
        assert_eq!([large.total(), small.total()], [300_000, 200_100]);
        let mut both = large;
        both += small;
        assert_eq!(both.total(), large.total() + small.total());
    }
}
