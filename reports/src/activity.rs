//! Verification, benchmarking or validation: what a number is evidence of.

use crate::results::QuantityResult;
use seam_cases::result::ReferenceKind;

/// What comparing a number with its reference is called.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Activity {
    /// Against an exact answer or property, or against Seam itself with other settings: are the equations
    /// solved right?
    Verification,
    /// Against other codes and converged finite elements: do independent solutions agree?
    Benchmarking,
    /// Against experiments: are they the right equations?
    Validation,
    /// Compared with nothing.
    None,
}

impl Activity {
    /// What a judged or compared number is evidence of; [`Activity::None`] for one that is only shown.
    pub fn of(q: &QuantityResult) -> Self {
        let compared = q.reference.is_some() || q.accepted.is_some() || !q.source.is_empty();
        if compared { Self::against(q.kind) } else { Activity::None }
    }

    /// What comparing with a reference of this kind is.
    pub fn against(kind: ReferenceKind) -> Self {
        use ReferenceKind as Kind;
        match kind {
            Kind::Exact | Kind::OwnRun | Kind::Regression => Activity::Verification,
            Kind::OwnFem | Kind::Calculix | Kind::Yade | Kind::Lammps | Kind::Prototype => {
                Activity::Benchmarking
            }
            Kind::Experiment => Activity::Validation,
        }
    }

    /// Its name; `–` where nothing was compared.
    pub fn name(self) -> &'static str {
        match self {
            Activity::Verification => "verification",
            Activity::Benchmarking => "benchmarking",
            Activity::Validation => "validation",
            Activity::None => "–",
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_number_that_is_only_shown_is_evidence_of_nothing() {
        let shown = QuantityResult { value: Some(3.0), ..QuantityResult::default() };
        assert_eq!(Activity::of(&shown), Activity::None);
        let property = QuantityResult { accepted: Some([Some(0.0), Some(1e-9)]), ..shown.clone() };
        assert_eq!(Activity::of(&property), Activity::Verification);
        let other_code = QuantityResult { kind: ReferenceKind::Yade, ..property };
        assert_eq!(Activity::of(&other_code), Activity::Benchmarking);
        let measured = QuantityResult { kind: ReferenceKind::Experiment, reference: Some(3.1), ..shown };
        assert_eq!(Activity::of(&measured), Activity::Validation);
    }
}
