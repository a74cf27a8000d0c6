//! Margins of the hard cases: against what is needed, and against what was there before.
//!
//! A margin fails below the value that is needed. It also fails when it differs from the recorded one by more than the width
//! of its search: a smaller one was eaten by a change, a larger one means that the case no longer asks the same.

use crate::verdict::Verdict;
use schemars::JsonSchema;
use seam_cases::margin::Margin;
use serde::{Deserialize, Serialize};
use std::cmp::Ordering;

/// A judged margin.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct MarginResult {
    /// Unique within the case.
    pub id: String,
    /// The hard case.
    pub row: String,
    /// Which body and scheme.
    pub label: String,
    /// What is raised.
    pub axis: String,
    /// Unit of the axis, `1` for a pure number.
    pub unit: String,
    /// The largest value that passed; `null` if it is not finite.
    pub value: Option<f64>,
    /// Whether the end of the search still passed.
    pub open: bool,
    /// The value that has to pass.
    pub needed: f64,
    /// The recorded value of this tier.
    pub recorded: Option<f64>,
    /// Relative width of the search, which a recorded value may differ by.
    pub tolerance: f64,
    /// When the case passes.
    pub criterion: String,
    /// How the value was found.
    pub how: String,
    /// The verdict.
    pub verdict: Verdict,
}

/// Judges a margin beside its record.
pub(crate) fn judge(m: &Margin, recorded: Option<f64>) -> MarginResult {
    let value = Some(m.value).filter(|v| v.is_finite());
    let verdict = match value {
        None => Verdict::Undetermined,
        Some(v) if v < m.needed || recorded.is_some_and(|r| moved(v, r, m.tolerance).is_ne()) => {
            Verdict::Fail
        }
        Some(_) => Verdict::Pass,
    };
    MarginResult {
        id: m.id.clone(),
        row: m.row.clone(),
        label: m.label.clone(),
        axis: m.axis.clone(),
        unit: m.unit.clone(),
        value,
        open: m.open,
        needed: m.needed,
        recorded,
        tolerance: m.tolerance,
        criterion: m.criterion.clone(),
        how: m.how.clone(),
        verdict,
    }
}

/// Where a margin lies beside an earlier one. A search ends between `value` and `value · (1 + tolerance)`, so the two are equal within that
/// factor on either side: whole numbers, whose tolerance is zero, exactly, and searches by doublings within two.
pub(crate) fn moved(value: f64, before: f64, tolerance: f64) -> Ordering {
    let factor = 1.0 + tolerance;
    if value > before * factor {
        Ordering::Greater
    } else if value * factor < before {
        Ordering::Less
    } else {
        Ordering::Equal
    }
}

impl MarginResult {
    /// Whether less than needed passed; otherwise a failure is a change.
    pub fn too_small(&self) -> bool {
        self.value.is_some_and(|v| v < self.needed)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn margin(value: f64) -> Margin {
        Margin { id: "step".into(), value, needed: 1.0, tolerance: 0.01, ..Margin::default() }
    }

    #[test]
    fn less_than_needed_and_any_change_fail() {
        for (value, recorded, verdict) in [
            (1.2, None, Verdict::Pass),
            (0.99, None, Verdict::Fail),
            (1.2, Some(1.205), Verdict::Pass),
            (1.2, Some(1.22), Verdict::Fail),
            (1.2, Some(1.18), Verdict::Fail),
            (f64::NAN, None, Verdict::Undetermined),
        ] {
            assert_eq!(judge(&margin(value), recorded).verdict, verdict, "{value} {recorded:?}");
        }
        assert!(judge(&margin(0.5), None).too_small() && !judge(&margin(1.2), Some(9.0)).too_small());
    }

    /// A search by doublings: a loss beyond a factor of two is seen as a gain is, though it is less than all of the record.
    #[test]
    fn a_wide_search_has_two_sides() {
        let doubled = |value| Margin { tolerance: 1.0, ..margin(value) };
        for (value, verdict) in [(8.0, Verdict::Pass), (4.0, Verdict::Pass), (16.0, Verdict::Pass)]
            .into_iter()
            .chain([(2.0, Verdict::Fail), (3.9, Verdict::Fail), (16.1, Verdict::Fail)])
        {
            assert_eq!(judge(&doubled(value), Some(8.0)).verdict, verdict, "{value}");
        }
    }

    #[test]
    fn whole_numbers_are_exact() {
        let count = Margin { tolerance: 0.0, ..margin(8.0) };
        assert_eq!(judge(&count, Some(8.0)).verdict, Verdict::Pass);
        assert_eq!(judge(&count, Some(9.0)).verdict, Verdict::Fail);
    }
}
