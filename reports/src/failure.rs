//! Failures in words, the same for every view.

use crate::ablation::AblationJudgement;
use crate::counted::Counter;
use crate::format::{self, percent, share, significant, with_unit};
use crate::growth::TimedGrowth;
use crate::loosened::Loosened;
use crate::margins::MarginResult;
use crate::record::RecordState;
use crate::results::{CaseJudgement, ClaimResult, CurveResult, QuantityResult, Results};
use crate::verdict::{ClaimVerdict, Verdict};
use seam_cases::result::{EffectUse, Expected};

/// One thing that keeps the gate from being green.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Failure {
    /// [`FAILED`], [`NOT_MEASURED`], [`COSTS_MORE`], [`LOOSENED`] or [`PASSES_AGAIN`].
    pub class: &'static str,
    /// Case, and the quantity, curve or claim within it.
    pub place: String,
    /// What was measured.
    pub measured: String,
    /// What was allowed, and why.
    pub bound: String,
    /// What it means.
    pub meaning: String,
    /// The command that runs just this case again.
    pub rerun: String,
}

/// Outside of what was promised.
pub const FAILED: &str = "FAILED";
/// An effect that the scene calls for was left out.
pub const NOT_TRUSTED: &str = "NOT TRUSTED";
/// Nothing that could be judged.
pub const NOT_MEASURED: &str = "NOT MEASURED";
/// More counted work than recorded.
pub const COSTS_MORE: &str = "COSTS MORE";
/// A tolerance wider than recorded.
pub const LOOSENED: &str = "LOOSENED";
/// An expected failure that is none.
pub const PASSES_AGAIN: &str = "PASSES AGAIN";

/// Every failure: loosened tolerances first, since they change what all else means; then in the order of the cases.
pub fn failures(results: &Results) -> Vec<Failure> {
    let loosened = results.cases.iter().flat_map(|case| case.loosened.iter().map(|l| of_loosened(case, l)));
    loosened.chain(results.cases.iter().flat_map(of_case)).collect()
}

/// The failures of one case, apart from loosened tolerances.
pub fn of_case(case: &CaseJudgement) -> Vec<Failure> {
    let quantities = case.quantities.iter().filter_map(|q| of_quantity(case, q));
    let curves = case.curves.iter().filter_map(|c| of_curve(case, c));
    let claims = case.claims.iter().filter_map(|c| of_claim(case, c));
    let margins = case.margins.iter().filter_map(|m| of_margin(case, m));
    let effects = case.effects.iter().filter_map(|e| of_effect(case, e));
    let ablations = case.ablations.iter().filter_map(|a| of_ablation(case, a));
    let timed = case.timed.iter().filter_map(|t| of_timed(case, t));
    let in_vain = case.expected_in_vain.iter().map(|id| of_expected(case, id));
    let judged = quantities.chain(curves).chain(margins).chain(claims);
    let studies = effects.chain(ablations).chain(timed);
    let all: Vec<Failure> = judged.chain(studies).chain(in_vain).chain(of_cost(case)).collect();
    if all.is_empty() && case.unmeasured() {
        return vec![of_empty(case)];
    }
    all
}

fn failure(case: &CaseJudgement, class: &'static str, item: &str) -> Failure {
    let place = if item.is_empty() { case.id.clone() } else { format!("{} / {item}", case.id) };
    let empty = String::new;
    Failure { class, place, measured: empty(), bound: empty(), meaning: empty(), rerun: case.command.clone() }
}

fn of_quantity(case: &CaseJudgement, q: &QuantityResult) -> Option<Failure> {
    let bound = interval(q).map_or("a finite number".to_owned(), |i| format!("{i}: {}", q.why));
    match (q.verdict, q.value) {
        (Some(Verdict::Pass), Some(value)) if q.passes_again() => Some(Failure {
            measured: format!("{} ({})", with_unit(value, &q.unit), q.label),
            bound: format!("a failure was expected: {}", q.expected_failure.as_deref().unwrap_or_default()),
            meaning:
                "good news: take it out of `expected_failures` of the scene, so that it is guarded again"
                    .to_owned(),
            ..failure(case, PASSES_AGAIN, &q.id)
        }),
        (Some(Verdict::Fail), Some(value)) if q.failed() => Some(Failure {
            measured: format!("{} ({})", with_unit(value, &q.unit), q.label),
            bound,
            meaning: outside(q),
            ..failure(case, FAILED, &q.id)
        }),
        (Some(Verdict::Undetermined), _) | (_, None) => Some(Failure {
            measured: q.value.map_or("no finite number".to_owned(), |v| with_unit(v, &q.unit)),
            bound,
            meaning: "value, reference or bound is not a finite number, so nothing was compared".to_owned(),
            ..failure(case, NOT_MEASURED, &q.id)
        }),
        _ => None,
    }
}

/// The accepted interval with its unit, e.g. `-0.009078 … -0.008722 m`.
pub fn interval(q: &QuantityResult) -> Option<String> {
    let [lo, hi] = q.accepted?;
    let lo = lo.map_or("−∞".to_owned(), format::value);
    let hi = hi.map_or("∞".to_owned(), |hi| with_unit(hi, &q.unit));
    Some(format!("{lo} … {hi}"))
}

fn outside(q: &QuantityResult) -> String {
    let by = q.headroom.map_or(String::new(), |h| {
        format!("{} times the allowed deviation", format::significant(1.0 - h, 3))
    });
    let error = match (q.error, q.reference) {
        (Some(e), Some(r)) if r != 0.0 => {
            format!(", {} from the {} reference", format::signed_percent(e), crate::terminal::kind_name(q))
        }
        _ => String::new(),
    };
    if by.is_empty() { "outside the accepted interval".to_owned() + &error } else { by + &error }
}

fn of_curve(case: &CaseJudgement, c: &CurveResult) -> Option<Failure> {
    let class = match c.verdict {
        Verdict::Pass => return None,
        Verdict::Fail => FAILED,
        Verdict::Undetermined => NOT_MEASURED,
    };
    Some(Failure {
        measured: format!("curve '{}' covers {}", c.series, share(c.coverage)),
        bound: format!("{} of the reference's stations", percent(crate::compare::LEAST_COVERAGE)),
        meaning: c.why.clone(),
        ..failure(case, class, &c.plot)
    })
}

fn of_margin(case: &CaseJudgement, m: &MarginResult) -> Option<Failure> {
    let class = match m.verdict {
        Verdict::Pass => return None,
        Verdict::Fail => FAILED,
        Verdict::Undetermined => NOT_MEASURED,
    };
    let (bound, meaning) = match m.recorded {
        _ if m.value.is_none() => ("a finite margin".to_owned(), "nothing was compared".to_owned()),
        Some(recorded) if !m.too_small() => (
            format!(
                "{}, recorded, within a factor of {}",
                with_unit(recorded, &m.unit),
                significant(1.0 + m.tolerance, 4)
            ),
            "the margin has changed: find out why before it is accepted".to_owned(),
        ),
        _ => (
            format!("{} has to pass: {}", with_unit(m.needed, &m.unit), m.criterion),
            "the hard case does not pass where it has to".to_owned(),
        ),
    };
    let value = m.value.map_or("no finite number".to_owned(), |v| with_unit(v, &m.unit));
    Some(Failure {
        measured: format!("{value} ({}, {})", m.axis, m.label),
        bound,
        meaning,
        ..failure(case, class, &m.id)
    })
}

fn of_claim(case: &CaseJudgement, c: &ClaimResult) -> Option<Failure> {
    let class = match (&c.unmeasured, c.failed()) {
        (Some(_), _) => NOT_MEASURED,
        (None, true) => FAILED,
        (None, false) => return None,
    };
    let bound = if c.own {
        format!("{}, since it is an own claim", ClaimVerdict::Supported)
    } else {
        c.recorded
            .as_ref()
            .map_or("a verdict".to_owned(), |r| format!("recorded: {}, {}", r.verdict, share(r.share)))
    };
    let meaning = match c.record {
        RecordState::OtherFamily if !c.own => {
            "the family is not the one the record answers; accept the new verdict only if it was meant to change".to_owned()
        }
        _ => c.reason.clone(),
    };
    let measured = format!("{}, {} of the settings meet {}", c.verdict, share(c.share), percent(c.bound));
    Some(Failure { measured, bound, meaning, ..failure(case, class, &c.id) })
}

/// An effect that was left out although the scene calls for it, or that was simulated in vain.
fn of_effect(case: &CaseJudgement, effect: &EffectUse) -> Option<Failure> {
    let indicator = effect.indicator.as_ref().filter(|_| effect.called_for)?;
    if effect.on {
        return Some(Failure {
            measured: format!("{} is {}", indicator.about, format::significant(indicator.value, 3)),
            bound: format!("at most {}", format::significant(indicator.limit, 3)),
            meaning: effect.why.clone(),
            ..failure(case, NOT_TRUSTED, &effect.place())
        });
    }
    Some(Failure {
        measured: format!("{} is {}", indicator.about, format::significant(indicator.value, 3)),
        bound: format!("{} without {}", format::significant(indicator.limit, 3), effect.name),
        meaning: format!(
            "the scene calls for {}, which was left out: no number of this case is trusted; simulate it, or change the scene",
            effect.name
        ),
        ..failure(case, NOT_TRUSTED, &effect.place())
    })
}

fn of_ablation(case: &CaseJudgement, a: &AblationJudgement) -> Option<Failure> {
    let class = match a.verdict? {
        Verdict::Pass => return None,
        Verdict::Fail => FAILED,
        Verdict::Undetermined => NOT_MEASURED,
    };
    let bound = match a.expected {
        Some(Expected::IsCalledFor) => "is called for, and caught when it is left out",
        _ => "may be left out, costs nothing then, and the guard is silent",
    };
    Some(Failure {
        measured: format!("{}: {}", a.effect, a.why),
        bound: bound.to_owned(),
        meaning: "the effect or its guard does not do what this scene was made to show".to_owned(),
        ..failure(case, class, &a.id)
    })
}

fn of_timed(case: &CaseJudgement, t: &TimedGrowth) -> Option<Failure> {
    let class = match t.seconds_verdict {
        Verdict::Pass => return None,
        Verdict::Fail => FAILED,
        Verdict::Undetermined => NOT_MEASURED,
    };
    let [low, high] = t.accepted;
    Some(Failure {
        measured: t.seconds_exponent.map_or("no exponent".to_owned(), |p| format::significant(p, 3)),
        bound: format!("{low} … {high}: {}", t.why),
        meaning: "wall time grows otherwise than it should; run it again on a quiet machine first".to_owned(),
        ..failure(case, class, &t.id)
    })
}

fn of_cost(case: &CaseJudgement) -> Option<Failure> {
    let [more, _] = case.work_changes();
    let first = more.first()?;
    let each = |say: fn(&Counter) -> String| more.iter().map(say).collect::<Vec<_>>().join(", ");
    let meaning = match first.was {
        0 => "work that was not done before".to_owned(),
        was => format!(
            "{} more {} for the same answer",
            percent(first.now as f64 / was as f64 - 1.0),
            first.words()
        ),
    };
    Some(Failure {
        measured: each(|c| format!("{} {}", c.now, c.words())),
        bound: format!("{}, recorded for the same scene", each(|c| format!("{} {}", c.was, c.words()))),
        meaning,
        ..failure(case, COSTS_MORE, "work")
    })
}

fn of_loosened(case: &CaseJudgement, l: &Loosened) -> Failure {
    Failure {
        measured: format!("accepted now: {}", l.say_now()),
        bound: format!("recorded: {}", l.say(l.was)),
        meaning: "a wider tolerance hides what it was to find; accept it only with a reason, by seam bless"
            .to_owned(),
        ..failure(case, LOOSENED, &l.quantity)
    }
}

fn of_expected(case: &CaseJudgement, id: &str) -> Failure {
    Failure {
        measured: "nothing that is judged".to_owned(),
        bound: "a failure was expected".to_owned(),
        meaning: "`expected_failures` of the scene names what is not there; correct or remove it".to_owned(),
        ..failure(case, FAILED, id)
    }
}

fn of_empty(case: &CaseJudgement) -> Failure {
    Failure {
        measured: "nothing".to_owned(),
        bound: "at least one number, curve or claim".to_owned(),
        meaning: "a case that compares nothing proves nothing".to_owned(),
        ..failure(case, NOT_MEASURED, "")
    }
}
