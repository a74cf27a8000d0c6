//! Counted work against what is recorded: exact, apart from counts of iterations.

use crate::results::CaseJudgement;
use seam_solver::work::Work;
use std::collections::BTreeMap;

/// Counters of iterations, which rounding moves: solves include the steps of iterative refinement.
const ITERATIONS: [&str; 2] = ["solves", "solve_entries"];

/// What a count of iterations may differ by.
const ITERATIONS_SHARE: f64 = 0.1;

/// A counter that is not what it was.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Counter {
    /// Name, as in `results.json`.
    pub name: String,
    /// Recorded count.
    pub was: u64,
    /// Count of this run.
    pub now: u64,
}

impl Counter {
    /// What is counted, in words.
    pub fn words(&self) -> String {
        match self.name.as_str() {
            "total" => "units of counted work".to_owned(),
            name => name.replace('_', " "),
        }
    }
}

/// The counters by name.
pub fn counters(work: &Work) -> BTreeMap<String, u64> {
    // A struct of whole numbers is always an object of them.
    serde_json::to_value(work).and_then(serde_json::from_value).unwrap_or_default()
}

/// Counters that differ from recorded ones by more than they may: what there is more of, then what there is less of.
pub fn changes(was: &BTreeMap<String, u64>, now: &BTreeMap<String, u64>) -> [Vec<Counter>; 2] {
    let [mut more, mut less] = [Vec::new(), Vec::new()];
    for (name, &was) in was {
        let now = now.get(name).copied().unwrap_or(0);
        let allowed =
            if ITERATIONS.contains(&name.as_str()) { (was as f64 * ITERATIONS_SHARE) as u64 } else { 0 };
        let counter = || Counter { name: name.clone(), was, now };
        if now > was + allowed {
            more.push(counter());
        } else if now + allowed < was {
            less.push(counter());
        }
    }
    [more, less]
}

impl CaseJudgement {
    /// What the case did more often, and less often, than recorded for the same scene.
    pub fn work_changes(&self) -> [Vec<Counter>; 2] {
        if self.recorded_counters.is_empty() {
            // An older record: the sum alone.
            let total = |total| BTreeMap::from([("total".to_owned(), total)]);
            return self
                .recorded_work
                .map_or_else(Default::default, |was| changes(&total(was), &total(self.work.total())));
        }
        changes(&self.recorded_counters, &counters(&self.work))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(bond_updates: u64, solves: u64) -> BTreeMap<String, u64> {
        counters(&Work { bond_updates, solves, ..Work::default() })
    }

    #[test]
    fn every_counter_is_compared_by_its_name() {
        let names: Vec<String> = of(1, 1).into_keys().collect();
        assert!(names.len() >= 7 && names.contains(&"bond_updates".to_owned()), "{names:?}");
    }

    #[test]
    fn one_more_is_too_many_and_iterations_have_a_tenth() {
        let was = of(1000, 100);
        for (now, more, less) in [
            (of(1000, 110), vec![], vec![]),
            (of(1001, 111), vec!["bond_updates", "solves"], vec![]),
            (of(999, 89), vec![], vec!["bond_updates", "solves"]),
        ] {
            let names = |counters: Vec<Counter>| counters.into_iter().map(|c| c.name).collect::<Vec<_>>();
            assert_eq!(changes(&was, &now).map(names), [more, less]);
        }
    }
}
