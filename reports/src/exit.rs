//! Exit codes: what went wrong, the most severe first.

use crate::record::RecordState;
use crate::results::{CaseJudgement, ClaimResult, Results};
use crate::verdict::{ClaimVerdict, Verdict};

/// Exit code of the command.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
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

    /// Whether a number, a curve, a margin, a claim or an ablation failed, or the result is not trusted.
    pub fn failed(&self) -> bool {
        !self.trusted
            || self.ablations.iter().any(|a| a.verdict == Some(Verdict::Fail))
            || self.timed.iter().any(|t| t.seconds_verdict == Verdict::Fail)
            || self.quantities.iter().any(|q| q.verdict == Some(Verdict::Fail))
            || self.curves.iter().any(|c| c.verdict == Verdict::Fail)
            || self.margins.iter().any(|m| m.verdict == Verdict::Fail)
            || self.claims.iter().any(ClaimResult::failed)
    }

    /// Whether the case did more work than recorded for the same scene.
    pub fn costs_more(&self) -> bool {
        self.recorded_work.is_some_and(|recorded| self.work.total() > recorded)
    }

    fn own_undetermined(&self) -> bool {
        self.claims.iter().any(|c| c.own && c.verdict == ClaimVerdict::Undetermined)
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
