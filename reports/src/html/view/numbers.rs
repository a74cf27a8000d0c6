//! The table of all numbers.

use crate::activity::Activity;
use crate::failure::interval;
use crate::format::{self, typeset};
use crate::results::{CaseJudgement, QuantityResult, Results};
use crate::terminal::{error, kind_name};
use serde::Serialize;

/// One row: text to read, and numbers to sort by.
#[derive(Serialize)]
pub(crate) struct Row {
    case: String,
    id: String,
    label: String,
    value: String,
    number: f64,
    reference: String,
    reference_number: f64,
    activity: &'static str,
    kind: &'static str,
    source: String,
    error: String,
    error_number: f64,
    interval: String,
    width: f64,
    why: String,
    headroom: Option<f64>,
    headroom_text: String,
    regression: String,
    verdict: String,
}

/// All numbers, in the order of the cases.
pub(super) fn rows(results: &Results) -> Vec<Row> {
    results.cases.iter().flat_map(|c| c.quantities.iter().map(move |q| row(c, q))).collect()
}

fn row(case: &CaseJudgement, q: &QuantityResult) -> Row {
    let value = q.value.map_or("not measured".to_owned(), |v| printed(v, &q.unit));
    let activity = Activity::of(q);
    Row {
        case: case.id.clone(),
        id: q.id.clone(),
        label: q.label.clone(),
        value,
        number: q.value.unwrap_or(f64::MAX),
        reference: q.reference.map_or(String::new(), |r| printed(r, &q.unit)),
        reference_number: q.reference.unwrap_or(f64::MAX),
        activity: activity.name(),
        kind: if activity == Activity::None { "" } else { kind_name(q) },
        source: q.source.clone(),
        error: typeset(&error(q)),
        error_number: q.error.map_or(-1.0, f64::abs),
        interval: interval(q).map_or(String::new(), |i| typeset(&i)),
        width: half_width(q).unwrap_or(f64::MAX),
        why: q.why.clone(),
        headroom: q.headroom,
        headroom_text: q.headroom.map_or(String::new(), |h| format!("{:.0} %", 100.0 * h)),
        regression: q.regression.filter(|r| *r != 0.0).map_or(String::new(), |r| {
            typeset(&format!("{} since last accepted", format::signed_percent(r)))
        }),
        verdict: q.verdict.map_or("shown".to_owned(), |v| v.to_string()),
    }
}

fn printed(v: f64, unit: &str) -> String {
    typeset(&format::with_unit(v, unit))
}

/// Half width of the accepted interval, over the reference where there is one.
fn half_width(q: &QuantityResult) -> Option<f64> {
    let [lo, hi] = q.accepted?;
    let width = 0.5 * (hi? - lo?);
    Some(q.reference.filter(|r| *r != 0.0).map_or(width, |r| width / r.abs()))
}
