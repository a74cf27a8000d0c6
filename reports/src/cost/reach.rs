//! What it costs to reach an accuracy and keep it.

use seam_cases::result::{CostPoint, CostSetting};

/// What cost is counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cost {
    /// `Work::total`: the same in every run.
    Work,
    /// `Work::total` of the run alone, packings and calibrations left out.
    Run,
    /// Wall seconds: not deterministic.
    Seconds,
}

impl Cost {
    /// Of one point.
    pub fn of(self, p: &CostPoint) -> f64 {
        match self {
            Cost::Work => p.work.total() as f64,
            Cost::Run => p.run_work as f64,
            Cost::Seconds => p.seconds,
        }
    }
}

/// Cost of reaching an accuracy.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Reached {
    /// Between two levels, interpolated in logarithms.
    At(f64),
    /// The coarsest level is good enough already: at most this.
    AtMost(f64),
    /// No level is: more than the finest one.
    MoreThan(f64),
}

/// The first level from which on all that were measured keep an error of at most `target`.
pub fn first_level(setting: &CostSetting, target: f64) -> Option<usize> {
    let mut first = None;
    for (level, point) in setting.points.iter().enumerate().rev() {
        match point.error {
            Some(error) if error <= target => first = Some(level),
            Some(_) => break,
            // A gap neither keeps the accuracy nor loses it.
            None => {}
        }
    }
    first
}

/// What it costs a setting to reach an accuracy and keep it; `None` if nothing was measured.
pub fn reached(setting: &CostSetting, target: f64, cost: Cost) -> Option<Reached> {
    let measured: Vec<(f64, f64)> =
        setting.points.iter().filter_map(|p| Some((p.error?.max(f64::MIN_POSITIVE), cost.of(p)))).collect();
    let last = measured.last()?.1;
    let bad = measured.iter().rposition(|(error, _)| *error > target);
    Some(match bad {
        None => Reached::AtMost(measured[0].1),
        Some(bad) if bad + 1 == measured.len() => Reached::MoreThan(last),
        Some(bad) => {
            let [(e0, c0), (e1, c1)] = [measured[bad], measured[bad + 1]];
            let share = (e0 / target).ln() / (e0 / e1).ln();
            Reached::At((c0.ln() + share * (c1 / c0).ln()).exp())
        }
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use seam_solver::work::Work;

    fn setting(points: &[(f64, u64)]) -> CostSetting {
        let point = |&(error, work): &(f64, u64)| CostPoint {
            error: Some(error),
            work: Work { bond_updates: work, ..Work::default() },
            ..CostPoint::default()
        };
        CostSetting { name: String::new(), points: points.iter().map(point).collect() }
    }

    /// Error c⁻¹: at an error of 1/50 the cost is 50.
    #[test]
    fn cost_is_interpolated_where_the_error_passes_the_accuracy() {
        let s = setting(&[(0.1, 10), (0.01, 100)]);
        let Some(Reached::At(cost)) = reached(&s, 0.02, Cost::Work) else { panic!("between two levels") };
        assert!((cost - 50.0).abs() < 1e-9, "{cost}");
        assert_eq!(reached(&s, 0.5, Cost::Work), Some(Reached::AtMost(10.0)));
        assert_eq!(reached(&s, 0.001, Cost::Work), Some(Reached::MoreThan(100.0)));
    }

    #[test]
    fn an_accuracy_that_is_lost_again_is_not_reached() {
        let s = setting(&[(0.1, 10), (0.001, 20), (0.05, 40)]);
        assert_eq!(first_level(&s, 0.01), None);
        assert_eq!(reached(&s, 0.01, Cost::Work), Some(Reached::MoreThan(40.0)));
    }
}
