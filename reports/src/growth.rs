//! How cost grows with size, fitted and judged: counted work beside the other numbers, wall time by itself, since it is not
//! deterministic.

use crate::cost::exponent;
use crate::verdict::{Verdict, of_quantity};
use schemars::JsonSchema;
use seam_cases::result::{Growth, Observation, ReferenceKind};
use serde::{Deserialize, Serialize};

/// A fitted exponent of wall time. Fields whose name contains `seconds` are not deterministic.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TimedGrowth {
    /// Unique within the case.
    pub id: String,
    /// What is timed, in words.
    pub label: String,
    /// Fitted exponent of wall time.
    pub seconds_exponent: Option<f64>,
    /// Interval it must lie in.
    pub accepted: [f64; 2],
    /// The verdict.
    pub seconds_verdict: Verdict,
    /// Why the interval is as wide as it is.
    pub why: String,
}

/// The exponent of counted work, as a number beside the others. Where none can be fitted it is not measured.
pub fn of_work(growth: &Growth) -> Observation {
    let points = growth.size.iter().copied().zip(growth.work.iter().copied());
    Observation {
        id: format!("growth-{}", growth.id),
        label: format!("{}: exponent of counted work over {}", growth.label, growth.size_label),
        unit: "1".to_owned(),
        value: exponent(points).unwrap_or(f64::NAN),
        kind: ReferenceKind::Exact,
        source: "theory of the method".to_owned(),
        accepted: growth.accepted_work,
        why: growth.why.clone(),
        ..Observation::default()
    }
}

/// The exponent of wall time, where it was measured and something is promised of it.
pub fn of_seconds(growth: &Growth) -> Option<TimedGrowth> {
    let accepted = growth.accepted_seconds?;
    if growth.seconds.is_empty() {
        return None;
    }
    let fitted = exponent(growth.size.iter().copied().zip(growth.seconds.iter().copied()));
    Some(TimedGrowth {
        id: growth.id.clone(),
        label: format!("{}: exponent of wall time over {}", growth.label, growth.size_label),
        seconds_exponent: fitted,
        accepted,
        seconds_verdict: of_quantity(fitted.unwrap_or(f64::NAN), Some(accepted))
            .unwrap_or(Verdict::Undetermined),
        why: growth.why.clone(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn growth(power: f64) -> Growth {
        let size = vec![10.0, 20.0, 40.0];
        let cost: Vec<f64> = size.iter().map(|n: &f64| n.powf(power)).collect();
        Growth {
            work: cost.clone(),
            seconds: cost,
            size,
            accepted_work: Some([1.0 - 1e-12, 1.0 + 1e-12]),
            accepted_seconds: Some([0.95, 1.15]),
            ..Growth::default()
        }
    }

    #[test]
    fn exponents_are_judged_from_both_sides() {
        let verdict = |g: &Growth| of_seconds(g).unwrap().seconds_verdict;
        assert_eq!(
            [0.9, 1.0, 1.2].map(|p| verdict(&growth(p))),
            [Verdict::Fail, Verdict::Pass, Verdict::Fail]
        );
        let work = of_work(&growth(1.0));
        assert!(of_quantity(work.value, work.accepted) == Some(Verdict::Pass), "{}", work.value);
        let untimed = Growth { seconds: Vec::new(), ..growth(1.0) };
        assert_eq!(of_seconds(&untimed), None);
    }
}
