//! The validation document: the figures of a run as Markdown that can be committed and compared.
//!
//! Nothing in it depends on the machine or the clock. Numbers that are rounding error have other digits on
//! another processor, so a pure number below 1e-9 is written as that bound.

use crate::ablation::AblationJudgement;
use crate::activity::Activity;
use crate::claims::meaning;
use crate::failure::interval;
use crate::format::{self, percent, share, signed_percent, significant};
use crate::markdown::escape;
use crate::plots::cost::{Cost, work_precision};
use crate::results::{CaseJudgement, QuantityResult, Results};
use crate::terminal::kind_name;
use crate::verdict::Verdict;
use seam_cases::result::{Budget, CaseResult};

/// Below this, a pure number is called rounding error.
const ROUNDING: f64 = 1e-9;

/// The document. Judged and measured cases are joined by their id.
pub fn document(results: &Results, cases: &[CaseResult]) -> String {
    let measured: Vec<&CaseResult> =
        results.cases.iter().filter_map(|c| cases.iter().find(|m| m.id == c.id)).collect();
    let parts = [
        head(results),
        claims(results),
        costs(&measured),
        budgets(&measured),
        margins(results),
        ablations(results),
        agreements(results),
        format!("## Numbers\n\n{}", results.cases.iter().map(numbers).collect::<String>()),
    ];
    parts.concat()
}

fn head(results: &Results) -> String {
    let tier = results.cases.first().map_or("quick", |c| c.tier.as_str());
    let of = |a| results.cases.iter().flat_map(|c| &c.quantities).filter(|q| Activity::of(q) == a).count();
    format!(
        "# Validation\n\n\
         Written by `seam report --markdown` from a run of the {tier} tier; nobody edits it by hand. {}, {} of \
         verification (exact answers), {} of benchmarking (other codes and converged finite elements), {} of validation \
         (experiments). Rounding error, below 1e-9, is written as that bound.\n\n",
        format::count(results.cases.len(), "case"),
        format::count(of(Activity::Verification), "number"),
        of(Activity::Benchmarking),
        of(Activity::Validation),
    )
}

fn claims(results: &Results) -> String {
    let mut claims: Vec<_> = results.cases.iter().flat_map(|c| &c.claims).collect();
    claims.sort_by_key(|c| c.own);
    let one = |c: &crate::results::ClaimResult| {
        let whose = if c.own { "own claim" } else { "the paper's claim" };
        format!(
            "### {}\n\n**{}**: {} ({whose}, bound {}).\n\n{}\n\n{}\n\n",
            escape(&c.statement),
            c.verdict,
            escape(&meaning::headline(c)),
            percent(c.bound),
            escape(&meaning::paragraph(c)),
            escape(&c.reason)
        )
    };
    section("Claims", claims.into_iter().map(one).collect())
}

/// What the work–precision diagrams end in.
fn costs(cases: &[&CaseResult]) -> String {
    let figures = cases.iter().flat_map(|c| &c.costs).flat_map(|d| work_precision(d, Cost::Work));
    let told = figures.filter(|f| !f.note.is_empty());
    let list: String = told.map(|f| format!("- {}: {}\n", escape(&f.title), escape(&f.note))).collect();
    section("What accuracy costs", if list.is_empty() { list } else { list + "\n" })
}

fn budgets(cases: &[&CaseResult]) -> String {
    let one = |b: &Budget| {
        let mut text = format!(
            "### {}\n\n| part | share | scatter | difference of |\n|---|---:|---:|---|\n",
            escape(&b.title)
        );
        for p in &b.parts {
            let scatter = p.scatter.map_or(String::new(), |s| format!("± {}", percent(s)));
            text += &format!(
                "| {} | {} | {scatter} | {} |\n",
                escape(&p.name),
                signed_percent(p.value),
                escape(&p.how)
            );
        }
        text + &format!("| **total** | {} | | |\n\n", signed_percent(b.total))
    };
    section("Error budgets", cases.iter().flat_map(|c| &c.budgets).map(one).collect())
}

fn margins(results: &Results) -> String {
    let rows = results.cases.iter().flat_map(|c| &c.margins).map(|m| {
        let value = m.value.map_or("not measured".to_owned(), |v| with_unit(v, &m.unit));
        format!(
            "| {} | {} | {} | {}{value} | {} | {} |\n",
            escape(&m.row),
            escape(&m.label),
            escape(&m.axis),
            if m.open { "≥ " } else { "" },
            with_unit(m.needed, &m.unit),
            m.verdict
        )
    });
    let head = [
        "| hard case | body and scheme | raised | margin | needed | verdict |",
        "|---|---|---|---:|---:|---|",
    ];
    table("Stability margins", head, rows.collect())
}

/// What leaving an effect out changes, and whether the run without it says so.
fn ablations(results: &Results) -> String {
    let row = |case: &str, a: &AblationJudgement| {
        format!(
            "| {case} | {} | {} | {} | {} | {} | {} |\n",
            escape(&a.label),
            a.effect,
            a.largest_change.map_or("not measured".to_owned(), percent),
            a.work_ratio.map_or(String::new(), |r| format!("{} ×", significant(r, 3))),
            if a.caught { "called for" } else { "silent" },
            shown(a.verdict),
        )
    };
    let rows = results.cases.iter().flat_map(|c| c.ablations.iter().map(|a| row(&c.id, a)));
    let head = [
        "| case | scene | effect left out | largest change | work | guard | verdict |",
        "|---|---|---|---:|---:|---|---|",
    ];
    table("Effects left out", head, rows.collect())
}

/// Numbers that stand beside those of another code.
fn agreements(results: &Results) -> String {
    let row = |case: &str, q: &QuantityResult| {
        let a = q.agreement.as_ref()?;
        Some(format!(
            "| {case} | {} | {} {} | {} | {} | {} | {} | {} |\n",
            escape(&q.label),
            a.code,
            a.version,
            a.date,
            if a.same_model { "the same" } else { "another" },
            difference(q),
            interval(q).unwrap_or_default(),
            shown(q.verdict),
        ))
    };
    let rows = results.cases.iter().flat_map(|c| c.quantities.iter().filter_map(|q| row(&c.id, q)));
    let head = [
        "| case | number | code | run on | model | difference | accepted | verdict |",
        "|---|---|---|---|---|---:|---|---|",
    ];
    table("Agreement with other codes", head, rows.collect())
}

fn shown(verdict: Option<Verdict>) -> String {
    verdict.map_or("shown".to_owned(), |v| v.to_string())
}

/// A difference as it is, a value beside that of the code as their relative difference.
fn difference(q: &QuantityResult) -> String {
    match q.value {
        _ if q.error.is_some() => error(q),
        Some(value) => with_unit(value, &q.unit),
        None => "not measured".to_owned(),
    }
}

/// A heading with what stands under it; nothing without that.
fn section(heading: &str, body: String) -> String {
    if body.is_empty() { body } else { format!("## {heading}\n\n{body}") }
}

/// A section with a table: its header, the alignment of its columns, its rows; nothing without rows.
fn table(heading: &str, [header, alignment]: [&str; 2], rows: String) -> String {
    let body = if rows.is_empty() { rows } else { format!("{header}\n{alignment}\n{rows}\n") };
    section(heading, body)
}

fn numbers(case: &CaseJudgement) -> String {
    if case.quantities.is_empty() {
        return String::new();
    }
    let mut text = format!(
        "### {}\n\n{}. Run it again: `{}`\n\n| number | value | reference | error | accepted | headroom | evidence | verdict |\n\
         |---|---:|---:|---:|---|---:|---|---|\n",
        case.id,
        escape(&case.title),
        case.command
    );
    for q in &case.quantities {
        text += &format!(
            "| {} | {} | {} | {} | {} | {} | {} | {} |\n",
            escape(&q.label),
            q.value.map_or("not measured".to_owned(), |v| with_unit(v, &q.unit)),
            q.reference.map_or(String::new(), |r| with_unit(r, &q.unit)),
            error(q),
            interval(q).unwrap_or_default(),
            q.headroom.map_or(String::new(), share_left),
            evidence(q),
            shown(q.verdict),
        );
    }
    text + "\n"
}

fn with_unit(v: f64, unit: &str) -> String {
    let pure = unit == "1" || unit.is_empty();
    let number = if pure && v != 0.0 && v.abs() < ROUNDING { "< 1e-9".to_owned() } else { significant(v, 4) };
    if pure { number } else { format!("{number} {unit}") }
}

fn error(q: &QuantityResult) -> String {
    match (q.error, q.reference) {
        (Some(e), _) if e != 0.0 && e.abs() < ROUNDING => "< 1e-9".to_owned(),
        (Some(e), Some(0.0)) => significant(e, 2),
        (Some(e), _) => signed_percent(e),
        (None, _) => String::new(),
    }
}

fn share_left(headroom: f64) -> String {
    if headroom >= 0.0 { share(headroom.min(1.0)) } else { "none".to_owned() }
}

fn evidence(q: &QuantityResult) -> String {
    match Activity::of(q) {
        Activity::None => String::new(),
        activity => format!("{}, {}", activity.name(), kind_name(q)),
    }
}
