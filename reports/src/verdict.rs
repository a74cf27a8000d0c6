//! The verdicts, and the rule for a single quantity.

use crate::compare::within;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};
use std::fmt;

/// Verdict on a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum Verdict {
    /// Inside the accepted interval.
    Pass,
    /// Outside the accepted interval.
    Fail,
    /// Could not be measured.
    Undetermined,
}

/// Verdict on a claim over a family of settings.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "lowercase")]
pub enum ClaimVerdict {
    /// Every setting meets the bound, under every reading.
    Supported,
    /// No setting meets the bound, under any reading.
    Contradicted,
    /// Settings or readings differ.
    Conditional,
    /// The evidence does not decide.
    #[default]
    Undetermined,
}

/// Verdict on a measured value: NaN, or an accepted interval that is not closed on both sides, is never
/// a pass and never a mere failure, it is a failure to measure. `None` where nothing was promised.
pub fn of_quantity(value: f64, accepted: Option<[f64; 2]>) -> Option<Verdict> {
    let interval = accepted?;
    Some(if !value.is_finite() || interval.iter().any(|end| !end.is_finite()) {
        Verdict::Undetermined
    } else if within(value, interval) {
        Verdict::Pass
    } else {
        Verdict::Fail
    })
}

impl fmt::Display for Verdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Verdict::Pass => "pass",
            Verdict::Fail => "fail",
            Verdict::Undetermined => "undetermined",
        })
    }
}

impl fmt::Display for ClaimVerdict {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            ClaimVerdict::Supported => "supported",
            ClaimVerdict::Contradicted => "contradicted",
            ClaimVerdict::Conditional => "conditional",
            ClaimVerdict::Undetermined => "undetermined",
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_value_is_judged_on_both_sides_and_nan_is_not_measured() {
        let interval = Some([1.0, 2.0]);
        assert_eq!(of_quantity(1.5, interval), Some(Verdict::Pass));
        assert_eq!(of_quantity(0.9, interval), Some(Verdict::Fail));
        assert_eq!(of_quantity(2.1, interval), Some(Verdict::Fail));
        assert_eq!(of_quantity(f64::NAN, interval), Some(Verdict::Undetermined));
        for open in [f64::NAN, f64::NEG_INFINITY] {
            assert_eq!(of_quantity(1.5, Some([open, 2.0])), Some(Verdict::Undetermined), "one-sided");
        }
        assert_eq!(of_quantity(f64::NAN, None), None);
    }
}
