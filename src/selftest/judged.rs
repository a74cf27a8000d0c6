//! Defects of results and of what is promised about them: a gate must not be talked into being green.

use super::{Part, Seeded, Spoil, Trial};
use seam_cases::result::{CaseResult, Family, Role};
use seam_reports::exit::Exit;

const PATCH: Trial = Trial::of("patch-fe");
const CANTILEVER: Trial = Trial::of("timoshenko-goodier");
/// The curves of a beam, beside a beam that is all elements.
const CURVES: Trial =
    Trial { case: "clamped-beam-rotation", sets: &[], part: Part::Quantities(&["tip-deflection"]) };
/// Two claims, over a family of few settings and over the whole one of our own.
const CLAIMS: Trial = Trial {
    case: "clamped-beam-rotation",
    sets: &["families.settings.quick=[{ rows = [4, 8, 16] }, { rows = [8], skin = [\"weighted\"] }]"],
    part: Part::Claims,
};

pub const DEFECTS: &[Seeded] = &[
    seeded("empty-case-list", "no case was run", PATCH, Vec::clear, Exit::Unmeasured, "no cases"),
    seeded(
        "empty-case",
        "a case compares nothing",
        PATCH,
        |r| r[0].quantities.clear(),
        Exit::Unmeasured,
        "patch-fe",
    ),
    seeded(
        "nan",
        "a value is not a number",
        PATCH,
        |r| r[0].quantities[0].value = f64::NAN,
        Exit::Unmeasured,
        "displacement-error",
    ),
    seeded(
        "nan-in-a-bound",
        "a bound is not a number",
        PATCH,
        nan_bound,
        Exit::Unmeasured,
        "displacement-error",
    ),
    seeded(
        "one-sided-tolerance",
        "a value may be as small as it likes",
        CANTILEVER,
        one_sided,
        Exit::Unmeasured,
        "tip-deflection",
    ),
    seeded(
        "loosen-a-tolerance",
        "a tolerance is ten times wider than recorded",
        CANTILEVER,
        loosen,
        Exit::Failed,
        "tip-deflection",
    ),
    seeded(
        "drop-a-check",
        "a number is shown and no longer judged",
        CANTILEVER,
        |r| r[0].quantities[0].accepted = None,
        Exit::Failed,
        "timoshenko",
    ),
    seeded(
        "drop-a-quantity",
        "a number is not measured any more",
        CANTILEVER,
        |r| drop(r[0].quantities.pop()),
        Exit::Failed,
        "timoshenko",
    ),
    seeded(
        "forgotten-xfail",
        "an expected failure passes",
        PATCH,
        |r| expect(r, "displacement-error"),
        Exit::Failed,
        "displacement-error",
    ),
    seeded(
        "misspelt-xfail",
        "an expected failure names what is not there",
        PATCH,
        |r| expect(r, "displacment"),
        Exit::Failed,
        "displacment",
    ),
    seeded(
        "two-levels",
        "an order is fitted through two points",
        CANTILEVER,
        two_levels,
        Exit::Unmeasured,
        "order-",
    ),
    seeded(
        "lose-an-order",
        "the error of the finest mesh does not fall",
        CANTILEVER,
        lose_order,
        Exit::Failed,
        "order-",
    ),
    seeded("truncate-a-curve", "a curve ends half-way", CURVES, truncate, Exit::Failed, "secant"),
    seeded("fold-a-curve", "a curve turns back", CURVES, fold, Exit::Unmeasured, "secant"),
    seeded(
        "more-work",
        "one bond more is computed",
        PATCH,
        |r| r[0].work.element_updates += 1,
        Exit::Cost,
        "work",
    ),
    seeded(
        "paper-verdict-changes",
        "all settings meet the paper's bound",
        CLAIMS,
        |r| errors(r, false, 1e-4),
        Exit::Failed,
        "rotation-7-percent",
    ),
    seeded(
        "trim-a-family",
        "the setting that fails is left out",
        CLAIMS,
        trim,
        Exit::Failed,
        "rotation-7-percent",
    ),
    seeded(
        "own-claim-fails",
        "our own settings miss our bound",
        CLAIMS,
        |r| errors(r, true, 0.05),
        Exit::Failed,
        "rotation-07-percent",
    ),
    seeded(
        "own-claim-open",
        "nobody knows how accurate our own settings are",
        CLAIMS,
        open,
        Exit::Undetermined,
        "rotation-07-percent",
    ),
];

const fn seeded(
    name: &'static str,
    about: &'static str,
    trial: Trial,
    spoil: fn(&mut Vec<CaseResult>),
    exit: Exit,
    by: &'static str,
) -> Seeded {
    Seeded { name, about, trial, spoil: Spoil::Results(spoil), exit, by }
}

fn nan_bound(results: &mut Vec<CaseResult>) {
    results[0].quantities[0].accepted = Some([0.0, f64::NAN]);
}

fn accepted(results: &mut [CaseResult], id: &str, change: impl Fn([f64; 2]) -> [f64; 2]) {
    for q in results[0].quantities.iter_mut().filter(|q| q.id == id) {
        q.accepted = q.accepted.map(&change);
    }
}

fn one_sided(results: &mut Vec<CaseResult>) {
    accepted(results, "tip-deflection", |[_, high]| [f64::NEG_INFINITY, high]);
}

fn loosen(results: &mut Vec<CaseResult>) {
    accepted(results, "tip-deflection", |[low, high]| [low - 4.5 * (high - low), high + 4.5 * (high - low)]);
}

fn expect(results: &mut [CaseResult], id: &str) {
    results[0].expected_failures.insert(id.to_owned(), "once it did".to_owned());
}

fn two_levels(results: &mut Vec<CaseResult>) {
    for study in &mut results[0].convergence {
        study.h.truncate(2);
        study.error.truncate(2);
    }
}

fn lose_order(results: &mut Vec<CaseResult>) {
    for study in &mut results[0].convergence {
        if let [.., before, last] = study.error.as_mut_slice() {
            *last = *before;
        }
    }
}

fn models(results: &mut [CaseResult], change: impl Fn(&mut Vec<f64>)) {
    let series =
        results[0].curves.iter_mut().filter(|plot| plot.band.is_some()).flat_map(|plot| &mut plot.series);
    for line in series.filter(|line| line.role == Role::Model) {
        change(&mut line.x);
        line.y.truncate(line.x.len());
    }
}

fn truncate(results: &mut Vec<CaseResult>) {
    models(results, |x| x.truncate(x.len() / 2));
}

fn fold(results: &mut Vec<CaseResult>) {
    models(results, |x| x.swap(1, 2));
}

fn families(results: &mut [CaseResult], own: bool) -> impl Iterator<Item = &mut Family> {
    results[0].families.iter_mut().filter(move |family| family.own == own)
}

fn errors(results: &mut [CaseResult], own: bool, error: f64) {
    let members = families(results, own).flat_map(|family| &mut family.members);
    members.flat_map(|member| member.errors.values_mut()).for_each(|e| *e = error);
}

fn trim(results: &mut Vec<CaseResult>) {
    families(results, false).for_each(|family| drop(family.members.remove(0)));
}

fn open(results: &mut Vec<CaseResult>) {
    families(results, true).flat_map(|family| &mut family.members).for_each(|member| member.u = 0.05);
}
