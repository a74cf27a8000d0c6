//! The error table for a terminal of 80 columns: claims, numbers, margins, failures, one closing line.

mod changes;
mod differences;
mod failures;
mod margins;
mod race;
pub(crate) mod studies;
mod style;

pub use changes::changes;
pub use differences::differences;
pub use race::race;
pub use style::Style;

use crate::format::{self, percent, share, signed_percent};
use crate::record::RecordState;
use crate::results::{CaseJudgement, ClaimResult, QuantityResult, Results};
use crate::verdict::Verdict;
use style::{Paint, wrap};

/// Columns the table fits into.
const WIDTH: usize = 80;

/// The whole table, ending in a newline.
pub fn table(results: &Results, style: Style) -> String {
    let mut out = failures::loosened(results, style);
    let claims: Vec<&ClaimResult> = results.cases.iter().flat_map(|c| &c.claims).collect();
    if !claims.is_empty() {
        out.push_str(&heading("Claims", style));
        claims.iter().for_each(|c| out.push_str(&claim(c, style)));
    }
    if results.cases.iter().any(|c| !c.quantities.is_empty()) {
        out.push_str(&heading("Numbers", style));
        out.push_str(&style.paint(Paint::Dim, &columns()));
        results.cases.iter().for_each(|c| out.push_str(&case(c, style)));
    }
    out.push_str(&margins::table(results, style));
    out.push_str(&studies::sections(results, style));
    out.push_str(&failures::blocks(results, style));
    out.push_str(&failures::less_work(results));
    out.push_str(&closing(results));
    out
}

fn heading(text: &str, style: Style) -> String {
    format!("{}\n", style.paint(Paint::Bold, text))
}

fn claim(c: &ClaimResult, style: Style) -> String {
    let verdict = style.paint(Paint::claim(c), &format!("{:<13}", c.verdict.to_string()));
    let whose = if c.own { "own" } else { "paper" };
    let bound = format!("≤ {}", percent(c.bound));
    let name_width = WIDTH - 2 - 13 - 1 - 5 - 1 - bound.chars().count() - 1;
    let name = cut(&c.id, name_width);
    let mut text = format!("  {verdict} {name:<name_width$} {whose:<5} {bound}\n");
    text.push_str(&wrap(&c.reason, WIDTH, 6));
    text.push_str(&wrap(&context(c), WIDTH, 6));
    text
}

/// How many settings were run, and what is recorded.
fn context(c: &ClaimResult) -> String {
    let part = if c.complete { "the whole family" } else { "a stated subset of the family" };
    let mut text = format!("{}, {part}.", format::count(c.settings, "setting"));
    if let Some(full) = &c.recorded_full {
        text.push_str(&format!(" Whole family, as recorded: {}, {}.", full.verdict, share(full.share)));
    }
    if !c.own && c.record == RecordState::Unrecorded {
        text.push_str(" No verdict is recorded yet.");
    }
    text
}

fn columns() -> String {
    format!(
        "  {:<23} {:>16}  {:<10} {:>8} {:>8} {}\n",
        "quantity", "value", "reference", "error", "headroom", "verdict"
    )
}

fn case(c: &CaseJudgement, style: Style) -> String {
    if c.quantities.is_empty() {
        return String::new();
    }
    let mut text = format!("{}\n", style.paint(Paint::Bold, &c.id));
    c.quantities.iter().for_each(|q| text.push_str(&row(q, style)));
    text
}

fn row(q: &QuantityResult, style: Style) -> String {
    let value = q.value.map_or_else(|| "not measured".to_owned(), |v| format::with_unit(v, &q.unit));
    let kind = q.reference.map_or("–", |_| kind_name(q));
    let headroom =
        q.headroom.map_or_else(|| "–".to_owned(), |h| format!("{:.0} %", (100.0 * h).clamp(-999.0, 100.0)));
    let verdict = match q.verdict {
        Some(Verdict::Fail) if !q.failed() => style.paint(Paint::Mixed, "xfail"),
        Some(v) => style.paint(Paint::verdict(v), short(v)),
        None => style.paint(Paint::Dim, "shown"),
    };
    let (id, value) = (cut(&q.id, 23), cut(&value, 16));
    format!("  {id:<23} {value:>16}  {kind:<10} {:>8} {headroom:>8} {verdict}\n", error(q))
}

/// Signed relative error in percent, or the absolute one where the reference is zero.
pub(crate) fn error(q: &QuantityResult) -> String {
    match (q.error, q.reference) {
        (Some(e), Some(0.0)) => format::significant(e, 2),
        (Some(e), _) => signed_percent(e),
        (None, _) => "–".to_owned(),
    }
}

/// Name of the kind of the reference, as in `results.json`.
pub(crate) fn kind_name(q: &QuantityResult) -> &'static str {
    use seam_cases::result::ReferenceKind as Kind;
    match q.kind {
        Kind::Exact => "exact",
        Kind::OwnFem => "own-fem",
        Kind::Calculix => "calculix",
        Kind::Yade => "yade",
        Kind::Lammps => "lammps",
        Kind::Experiment => "experiment",
        Kind::Prototype => "prototype",
        Kind::OwnRun => "own-run",
        Kind::Regression => "regression",
    }
}

fn short(v: Verdict) -> &'static str {
    match v {
        Verdict::Pass => "pass",
        Verdict::Fail => "FAIL",
        Verdict::Undetermined => "UNDET",
    }
}

/// Text of at most `width` characters, with an ellipsis where something is cut off.
fn cut(text: &str, width: usize) -> String {
    if text.chars().count() <= width {
        return text.to_owned();
    }
    text.chars().take(width - 1).chain(['…']).collect()
}

fn closing(results: &Results) -> String {
    let quantities = || results.cases.iter().flat_map(|c| &c.quantities);
    let with = |v| quantities().filter(|q| q.verdict == Some(v)).count();
    let seconds: f64 = results.cases.iter().map(|c| c.seconds).sum();
    let expected = quantities().filter(|q| q.verdict == Some(Verdict::Fail) && !q.failed()).count();
    let known = if expected > 0 { format!(", {expected} failed as expected") } else { String::new() };
    format!(
        "\n{}, {} passed, {} failed{known}, {} undetermined, in {seconds:.1} s\n",
        format::count(results.cases.len(), "case"),
        with(Verdict::Pass),
        with(Verdict::Fail) - expected,
        with(Verdict::Undetermined),
    )
}
