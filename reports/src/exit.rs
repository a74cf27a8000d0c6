//! Exit codes: what went wrong, the most severe first.

use crate::record::RecordState;
use crate::results::{CaseJudgement, ClaimResult, QuantityResult, Results};
use crate::verdict::{ClaimVerdict, Verdict};

/// Exit code of the command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub enum Exit {
    /// Everything that was promised holds.
    Pass = 0,
    /// Accuracy, an own claim, a recorded verdict, stability or trust failed.
    Failed = 1,
    /// Wrong usage or bad input; the caller's to give, never that of results.
    Usage = 2,
    /// More work than recorded for the same scene.
    Cost = 3,
    /// Could not measure: no cases, NaN in a result, a missing or altered reference.
    Unmeasured = 4,
    /// An own claim is undetermined, under `--strict`.
    Undetermined = 5,
}

impl Exit {
    /// Place in the order of severity: 2, which is no verdict at all, before 4, 1, 3, 5 and 0.
    fn severity(self) -> u8 {
        match self {
            Exit::Pass => 0,
            Exit::Undetermined => 1,
            Exit::Cost => 2,
            Exit::Failed => 3,
            Exit::Unmeasured => 4,
            Exit::Usage => 5,
        }
    }

    /// The more severe of two.
    #[must_use]
    pub fn or(self, other: Exit) -> Exit {
        if other.severity() > self.severity() { other } else { self }
    }
}

impl Results {
    /// Exit code of these results: the most severe of what occurs, in the order 4, 1, 3, 5.
    /// `strict` also asks that no own claim be undetermined.
    pub fn exit(&self, strict: bool) -> Exit {
        let any = |is: fn(&CaseJudgement) -> bool| self.cases.iter().any(is);
        if self.cases.is_empty() || any(CaseJudgement::unmeasured) {
            Exit::Unmeasured
        } else if any(CaseJudgement::failed) {
            Exit::Failed
        } else if any(CaseJudgement::costs_more) {
            Exit::Cost
        } else if strict && any(CaseJudgement::own_undetermined) {
            Exit::Undetermined
        } else {
            Exit::Pass
        }
    }

    /// [`Results::exit`] as a number.
    pub fn exit_code(&self, strict: bool) -> u8 {
        self.exit(strict) as u8
    }
}

impl CaseJudgement {
    /// Whether something could not be measured, or nothing was compared at all.
    pub fn unmeasured(&self) -> bool {
        let nothing = self.quantities.is_empty()
            && self.claims.is_empty()
            && self.curves.is_empty()
            && self.margins.is_empty()
            && self.costs.is_empty()
            && self.ablations.is_empty();
        nothing
            || self.quantities.iter().any(|q| q.value.is_none() || q.verdict == Some(Verdict::Undetermined))
            || self.curves.iter().any(|c| c.verdict == Verdict::Undetermined)
            || self.margins.iter().any(|m| m.verdict == Verdict::Undetermined)
            || self.claims.iter().any(|c| c.unmeasured.is_some())
            || self.ablations.iter().any(|a| a.verdict == Some(Verdict::Undetermined))
            || self.timed.iter().any(|t| t.seconds_verdict == Verdict::Undetermined)
    }

    /// Whether a number, a curve, a margin, a claim or an ablation failed, one that should have failed did not, a tolerance
    /// is looser than recorded, or the result is not trusted.
    pub fn failed(&self) -> bool {
        !self.trusted
            || self.ablations.iter().any(|a| a.verdict == Some(Verdict::Fail))
            || self.timed.iter().any(|t| t.seconds_verdict == Verdict::Fail)
            || self.quantities.iter().any(|q| q.failed() || q.passes_again())
            || self.curves.iter().any(|c| c.verdict == Verdict::Fail)
            || self.margins.iter().any(|m| m.verdict == Verdict::Fail)
            || self.claims.iter().any(ClaimResult::failed)
            || !self.loosened.is_empty()
            || !self.expected_in_vain.is_empty()
    }

    /// Whether the case did more work than recorded for the same scene.
    pub fn costs_more(&self) -> bool {
        let [more, _] = self.work_changes();
        !more.is_empty()
    }

    /// Whether anything keeps the gate from being green.
    pub fn is_red(&self, strict: bool) -> bool {
        self.unmeasured() || self.failed() || self.costs_more() || (strict && self.own_undetermined())
    }

    fn own_undetermined(&self) -> bool {
        self.claims.iter().any(|c| c.own && c.verdict == ClaimVerdict::Undetermined)
    }
}

impl QuantityResult {
    /// Whether it is outside of its interval, and nobody knew.
    pub fn failed(&self) -> bool {
        self.verdict == Some(Verdict::Fail) && self.expected_failure.is_none()
    }

    /// Whether it was said to fail and passes.
    pub fn passes_again(&self) -> bool {
        self.verdict == Some(Verdict::Pass) && self.expected_failure.is_some()
    }
}

impl ClaimResult {
    /// An own claim fails unless it is supported or undetermined. A paper's claim fails only if its
    /// verdict or its family is not the recorded one.
    pub fn failed(&self) -> bool {
        if self.own {
            matches!(self.verdict, ClaimVerdict::Contradicted | ClaimVerdict::Conditional)
        } else {
            matches!(self.record, RecordState::Changed | RecordState::OtherFamily)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::Exit::{Cost, Failed, Pass, Undetermined, Unmeasured, Usage};

    #[test]
    fn the_most_severe_counts_in_either_order() {
        let order = [Usage, Unmeasured, Failed, Cost, Undetermined, Pass];
        for (k, worse) in order.iter().enumerate() {
            for milder in &order[k..] {
                assert_eq!((worse.or(*milder), milder.or(*worse)), (*worse, *worse));
            }
        }
        assert_eq!(order.map(|exit| exit as u8), [2, 4, 1, 3, 5, 0]);
    }
}
