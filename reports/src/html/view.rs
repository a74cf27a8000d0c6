//! What the templates show: everything already in words.

use super::claim::{Claim, claim};
use super::prose;
use super::stability::{self, Stability};
use crate::exit::Exit;
use crate::failure::{Failure, failures, interval};
use crate::format::{self, percent, share};
use crate::plots::{self, Figure};
use crate::results::{CaseJudgement, CurveResult, Provenance, QuantityResult, Results};
use crate::terminal::{error, kind_name};
use seam_cases::result::CaseResult;
use serde::Serialize;

/// The whole page.
#[derive(Serialize)]
pub(super) struct Page {
    outcome: &'static str,
    good: bool,
    counts: [usize; 3],
    claims: Vec<Claim>,
    failures: Vec<FailureView>,
    rows: Vec<Row>,
    bias: Option<Figure>,
    budgets: Vec<BudgetView>,
    costs: Vec<Figure>,
    stability: Option<Stability>,
    cases: Vec<Case>,
    provenance: Provenance,
    timings: Vec<(String, String)>,
    seconds: String,
    second_costs: Vec<Figure>,
}

#[derive(Serialize)]
struct FailureView {
    class: &'static str,
    place: String,
    measured: String,
    bound: String,
    meaning: String,
    rerun: String,
}

#[derive(Serialize)]
struct Row {
    case: String,
    id: String,
    label: String,
    value: String,
    number: f64,
    reference: String,
    kind: &'static str,
    source: String,
    error: String,
    error_number: f64,
    interval: String,
    why: String,
    headroom: Option<f64>,
    headroom_text: String,
    regression: String,
    verdict: String,
}

#[derive(Serialize)]
struct BudgetView {
    figure: Figure,
    parts: Vec<[String; 4]>,
}

#[derive(Serialize)]
struct Case {
    judged: CaseJudgement,
    purpose: String,
    citation: String,
    tags: Vec<String>,
    parameters: Vec<[String; 4]>,
    figures: Vec<Figure>,
    pictures: Vec<Figure>,
    curves: Vec<[String; 6]>,
    work: Vec<(&'static str, String)>,
    notes: Vec<String>,
}

impl Page {
    /// Every figure of the page with a name for its file, in the order of the page.
    pub(super) fn figures(&self) -> impl Iterator<Item = (String, &Figure)> {
        let claims = self.claims.iter().filter_map(Claim::figure);
        let totals = self
            .bias
            .iter()
            .chain(self.budgets.iter().map(|b| &b.figure))
            .chain(&self.costs)
            .chain(&self.second_costs)
            .chain(self.stability.iter().flat_map(Stability::maps));
        let cases = self.cases.iter().flat_map(|c| {
            c.pictures
                .iter()
                .chain(&c.figures)
                .map(|figure| (format!("{}-{}", c.judged.id, slug(&figure.title)), figure))
        });
        claims.chain(totals.map(|figure| (slug(&figure.title), figure))).chain(cases)
    }
}

/// A caption as the name of a file.
fn slug(title: &str) -> String {
    let plain: String =
        title.chars().map(|c| if c.is_ascii_alphanumeric() { c.to_ascii_lowercase() } else { '-' }).collect();
    plain.split('-').filter(|word| !word.is_empty()).collect::<Vec<_>>().join("-")
}

/// Puts results and the measurements they came from into words and figures.
pub(super) fn page(results: &Results, cases: &[CaseResult]) -> Page {
    let measured = |id: &str| cases.iter().find(|c| c.id == id);
    let quantities = || results.cases.iter().flat_map(|c| c.quantities.iter().map(move |q| (c, q)));
    let with = |v| quantities().filter(|(_, q)| q.verdict == Some(v)).count();
    let shown = || results.cases.iter().filter_map(|c| measured(&c.id));
    let costs =
        |cost| shown().flat_map(|c| &c.costs).filter_map(|d| plots::cost::work_precision(d, cost)).collect();
    use crate::verdict::Verdict::{Fail, Pass, Undetermined};
    let outcome = results.exit(true);
    Page {
        outcome: outcome_words(outcome),
        good: outcome == Exit::Pass,
        counts: [with(Pass), with(Fail), with(Undetermined)],
        claims: results
            .cases
            .iter()
            .flat_map(|c| c.claims.iter().map(|j| claim(c, j, measured(&c.id))))
            .collect(),
        failures: failures(results).into_iter().map(failure).collect(),
        rows: quantities().map(|(c, q)| row(c, q)).collect(),
        bias: plots::bias::scatter(results),
        budgets: shown().flat_map(|c| &c.budgets).filter_map(budget).collect(),
        costs: costs(plots::cost::Cost::Work),
        stability: stability::section(results, cases),
        cases: results.cases.iter().map(|c| case(c, measured(&c.id))).collect(),
        provenance: results.provenance.clone(),
        timings: results.cases.iter().map(|c| (c.id.clone(), seconds(c.seconds))).collect(),
        seconds: seconds(results.cases.iter().map(|c| c.seconds).sum()),
        second_costs: costs(plots::cost::Cost::Seconds),
    }
}

fn outcome_words(exit: Exit) -> &'static str {
    match exit {
        Exit::Pass => "everything that was promised holds",
        Exit::Failed => "something that was promised does not hold",
        Exit::Usage => "the input could not be used",
        Exit::Cost => "the answers hold, at more work than recorded",
        Exit::Unmeasured => "something could not be measured",
        Exit::Undetermined => "an own claim is not decided",
    }
}

fn seconds(s: f64) -> String {
    format!("{} s", format::significant(s, 3))
}

fn failure(f: Failure) -> FailureView {
    let Failure { class, place, measured, bound, meaning, rerun } = f;
    FailureView { class, place, measured, bound, meaning, rerun }
}

fn row(case: &CaseJudgement, q: &QuantityResult) -> Row {
    let value = q.value.map_or("not measured".to_owned(), |v| format::with_unit(v, &q.unit));
    Row {
        case: case.id.clone(),
        id: q.id.clone(),
        label: q.label.clone(),
        value,
        number: q.value.unwrap_or(f64::MAX),
        reference: q.reference.map_or("–".to_owned(), |r| format::with_unit(r, &q.unit)),
        kind: q.reference.map_or("–", |_| kind_name(q)),
        source: q.source.clone(),
        error: error(q),
        error_number: q.error.map_or(-1.0, f64::abs),
        interval: interval(q).unwrap_or("–".to_owned()),
        why: q.why.clone(),
        headroom: q.headroom,
        headroom_text: q.headroom.map_or("–".to_owned(), |h| format!("{:.0} %", 100.0 * h)),
        regression: q
            .regression
            .map_or(String::new(), |r| format!("{} since last accepted", format::signed_percent(r))),
        verdict: q.verdict.map_or("shown".to_owned(), |v| v.to_string()),
    }
}

fn budget(b: &seam_cases::result::Budget) -> Option<BudgetView> {
    let part = |p: &seam_cases::result::BudgetPart| {
        let scatter = p.scatter.map_or(String::new(), |s| format!("± {}", percent(s)));
        [p.name.clone(), format::signed_percent(p.value), scatter, p.how.clone()]
    };
    Some(BudgetView { figure: plots::budget::waterfall(b)?, parts: b.parts.iter().map(part).collect() })
}

fn case(judged: &CaseJudgement, measured: Option<&CaseResult>) -> Case {
    let none = CaseResult::default();
    let m = measured.unwrap_or(&none);
    let curves = m.curves.iter().flat_map(|p| [plots::curves::curves(p), plots::curves::residuals(p)]);
    let orders = m.convergence.iter().map(plots::convergence::orders);
    let parameter = |p: &seam_cases::result::Parameter| {
        let unit = if p.unit == "1" { String::new() } else { p.unit.clone() };
        [p.name.clone(), format::value(p.value), unit, p.about.clone()]
    };
    Case {
        judged: judged.clone(),
        purpose: prose::html(&m.purpose),
        citation: m.citation.clone(),
        tags: m.tags.clone(),
        parameters: m.parameters.iter().map(parameter).collect(),
        figures: curves.chain(orders).flatten().collect(),
        pictures: m.pictures.iter().filter_map(plots::picture::picture).collect(),
        curves: judged.curves.iter().map(curve).collect(),
        work: work(judged),
        notes: m.notes.clone(),
    }
}

fn curve(c: &CurveResult) -> [String; 6] {
    let of = |e: Option<f64>| e.map_or("–".to_owned(), percent);
    let state = match c.verdict {
        crate::verdict::Verdict::Pass => "compared",
        crate::verdict::Verdict::Fail => "covers too little",
        crate::verdict::Verdict::Undetermined => "not comparable",
    };
    [c.plot.clone(), c.series.clone(), share(c.coverage), of(c.e2), of(c.e_max), state.to_owned()]
}

/// The counters that are not zero.
fn work(c: &CaseJudgement) -> Vec<(&'static str, String)> {
    let w = &c.work;
    let all = [
        ("bond updates", w.bond_updates),
        ("element updates", w.element_updates),
        ("factorisations", w.factorisations),
        ("factor entries", w.factor_nonzeros),
        ("solves", w.solves),
        ("contact checks", w.contact_checks),
        ("steps", w.steps),
    ];
    all.into_iter().filter(|(_, n)| *n > 0).map(|(name, n)| (name, format::grouped(n))).collect()
}
