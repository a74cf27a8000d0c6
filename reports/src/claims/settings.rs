//! Settings of a family, and the one-sided bounds of their errors.

use crate::statistics::{NORMAL_95, ensemble::Ensemble};
use seam_cases::result::{Family, Member};
use std::collections::BTreeMap;

/// Probability of the one-sided bounds.
const PROBABILITY: f64 = 0.95;

/// Members that share the value of every axis: one deterministic run, or the seeds of one packing.
#[derive(Debug, Clone)]
pub struct Setting<'a> {
    /// Value of each axis.
    pub values: &'a BTreeMap<String, String>,
    /// The runs, in the order of the family.
    pub members: Vec<&'a Member>,
}

/// Error of a setting under one reading, with one-sided 95 % bounds, all as fractions.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ErrorBounds {
    /// Mean over the seeds.
    pub mean: f64,
    /// The error is above this with 95 % probability; not negative.
    pub lower: f64,
    /// The error is below this with 95 % probability.
    pub upper: f64,
}

/// What the bounds of an error say about the bound of a claim.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// Upper bound ≤ bound.
    Meets,
    /// Lower bound > bound.
    Fails,
    /// The bound lies between them, or the setting could not be run.
    Unclear,
}

/// The settings of a family, ordered by the values of their axes.
pub fn settings(family: &Family) -> Vec<Setting<'_>> {
    let mut groups: BTreeMap<&BTreeMap<String, String>, Vec<&Member>> = BTreeMap::new();
    for member in &family.members {
        groups.entry(&member.settings).or_default().push(member);
    }
    groups.into_iter().map(|(values, members)| Setting { values, members }).collect()
}

impl Setting<'_> {
    /// Error under a reading; `None` if a member failed or was not measured under it.
    ///
    /// A deterministic run has the interval `e ± 1.645 u`. Members that differ in their seed have that
    /// of the next single packing, `ē ± t·s·√(1+1/N)`, joined with `1.645 u` as the root of the sum of squares.
    pub fn error(&self, reading: &str) -> Option<ErrorBounds> {
        let errors: Option<Vec<f64>> = self.members.iter().map(|m| m.errors.get(reading).copied()).collect();
        let e = Ensemble::of(&errors?)?;
        let random = self.members.iter().any(|m| m.seed.is_some());
        let scatter = if random { e.next_half_width(PROBABILITY) } else { 0.0 };
        let half = scatter.hypot(NORMAL_95 * self.uncertainty());
        e.mean.is_finite().then_some(ErrorBounds {
            mean: e.mean,
            lower: (e.mean - half).max(0.0),
            upper: e.mean + half,
        })
    }

    /// Whether the setting meets a bound under a reading. `most_particles` is a second condition:
    /// a setting with more particles fails, however accurate it is.
    pub fn outcome(&self, reading: &str, bound: f64, most_particles: Option<f64>) -> Outcome {
        if most_particles.is_some_and(|most| self.particles() > most) {
            return Outcome::Fails;
        }
        match self.error(reading) {
            Some(e) if e.upper <= bound => Outcome::Meets,
            Some(e) if e.lower > bound => Outcome::Fails,
            _ => Outcome::Unclear,
        }
    }

    /// Mean number of particles over the seeds.
    pub fn particles(&self) -> f64 {
        self.members.iter().map(|m| m.particles as f64).sum::<f64>() / self.members.len() as f64
    }

    /// Largest standard uncertainty from discretisation and reference, as a fraction.
    pub fn uncertainty(&self) -> f64 {
        self.members.iter().map(|m| m.u).fold(0.0, f64::max)
    }

    /// Whether some member could not be run.
    pub fn failed(&self) -> bool {
        self.members.iter().any(|m| m.failed.is_some())
    }

    /// Smallest number of seeds, same mean and scatter supposed, that would decide an unclear
    /// outcome; `None` if it is no matter of seeds.
    pub fn seeds_to_decide(&self, reading: &str, bound: f64) -> Option<usize> {
        let errors: Option<Vec<f64>> = self.members.iter().map(|m| m.errors.get(reading).copied()).collect();
        let now = Ensemble::of(&errors?)?;
        let random = self.members.iter().all(|m| m.seed.is_some());
        let gap = (now.mean - bound).abs();
        // A thousand packings is more than anyone would run: beyond it scatter, not their number, decides.
        let enough = |&n: &usize| {
            Ensemble { count: n, ..now }.next_half_width(PROBABILITY).hypot(NORMAL_95 * self.uncertainty())
                < gap
        };
        (random && now.count > 1).then(|| (now.count + 1..=1000).find(enough)).flatten()
    }
}

/// A run that claims to have worked, but gives no number under a reading of the family.
pub fn unmeasured(family: &Family) -> Option<(&Member, &String)> {
    let ran = family.members.iter().filter(|m| m.failed.is_none());
    ran.flat_map(|m| family.readings.keys().map(move |r| (m, r)))
        .find(|(m, r)| !m.u.is_finite() || !m.errors.get(*r).is_some_and(|e| e.is_finite()))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn family(errors: &[f64], seeded: bool, u: f64) -> Family {
        let member = |(i, &e): (usize, &f64)| Member {
            seed: seeded.then_some(i as u64),
            errors: [("r".to_owned(), e)].into(),
            u,
            particles: 100 + i,
            ..Member::default()
        };
        Family { members: errors.iter().enumerate().map(member).collect(), ..Family::default() }
    }

    fn outcome(errors: &[f64], seeded: bool, u: f64) -> Outcome {
        settings(&family(errors, seeded, u))[0].outcome("r", 0.07, None)
    }

    #[test]
    fn the_uncertainty_of_a_single_run_counts() {
        assert_eq!(outcome(&[0.069], false, 0.0), Outcome::Meets);
        assert_eq!(outcome(&[0.069], false, 0.001), Outcome::Unclear);
        assert_eq!(outcome(&[0.071], false, 0.001), Outcome::Unclear);
        assert_eq!(outcome(&[0.071], false, 0.0), Outcome::Fails);
        assert_eq!(outcome(&[f64::NAN], false, 0.0), Outcome::Unclear);
    }

    #[test]
    fn packings_are_judged_by_the_next_one() {
        // Mean 0.06, s = 0.01, N = 3: t(0.95, 2) √(4/3) s = 0.0337.
        let e = settings(&family(&[0.05, 0.06, 0.07], true, 0.0))[0].error("r").unwrap();
        assert!((e.upper - 0.0937).abs() < 1e-4 && (e.lower - 0.0263).abs() < 1e-4, "{e:?}");
        assert_eq!(outcome(&[0.05, 0.06, 0.07], true, 0.0), Outcome::Unclear);
        assert_eq!(outcome(&[0.029, 0.03, 0.031], true, 0.0), Outcome::Meets);
        assert_eq!(outcome(&[0.139, 0.14, 0.141], true, 0.0), Outcome::Fails);
        assert_eq!(outcome(&[0.01], true, 0.0), Outcome::Unclear, "one seed shows no scatter");
    }

    #[test]
    fn more_seeds_are_asked_for_only_where_they_would_decide() {
        let close = family(&[0.05, 0.055, 0.06], true, 0.0);
        // s = 0.005, gap 0.015: t(N−1) √(1+1/N) < 3 first holds at N = 4 (2.353 · 1.118 = 2.63).
        assert_eq!(settings(&close)[0].seeds_to_decide("r", 0.07), Some(4));
        let wide = family(&[0.03, 0.06, 0.10], true, 0.0);
        assert_eq!(settings(&wide)[0].seeds_to_decide("r", 0.07), None);
    }

    #[test]
    fn too_many_particles_are_a_failure() {
        let f = family(&[0.01], false, 0.0);
        assert_eq!(settings(&f)[0].outcome("r", 0.07, Some(99.0)), Outcome::Fails);
        assert_eq!(settings(&f)[0].outcome("r", 0.07, Some(100.0)), Outcome::Meets);
    }
}
