//! What the templates show: everything already in words. One file per section that needs words of its own.

mod agreement;
mod answer;
mod budget;
mod case;
mod claim;
mod failures;
mod numbers;
mod race;
mod stability;
mod studies;
mod switches;

use crate::activity::Activity;
use crate::exit::Exit;
use crate::format;
use crate::plots::cost::Cost;
use crate::plots::{self, Figure};
use crate::results::{Provenance, Results};
use crate::verdict::Verdict;
use seam_cases::result::CaseResult;
use serde::Serialize;

/// The whole page: a field for each section.
#[derive(Serialize)]
pub(super) struct Page {
    pub(super) outcome: &'static str,
    good: bool,
    counts: [usize; 3],
    known_failures: usize,
    activities: Vec<(&'static str, usize)>,
    answers: Vec<answer::Answer>,
    failures: Vec<failures::FailureView>,
    claims: Vec<claim::Claim>,
    rows: Vec<numbers::Row>,
    bias: Vec<Figure>,
    budgets: Vec<budget::BudgetView>,
    costs: Vec<Figure>,
    agreements: agreement::Agreements,
    race: Option<race::RaceView>,
    stability: Option<stability::Stability>,
    cost_tables: Vec<studies::CostView>,
    ablations: Vec<studies::AblationView>,
    cases: Vec<case::Case>,
    provenance: Provenance,
    timings: Vec<(String, String)>,
    seconds: String,
    second_costs: Vec<Figure>,
    second_advantages: Vec<[String; 4]>,
    stages: Vec<studies::StageView>,
    timed: Vec<[String; 4]>,
}

impl Page {
    /// Every figure of the page with a name for its file, in the order of the page.
    pub(super) fn figures(&self) -> impl Iterator<Item = (String, &Figure)> {
        let claims = self.claims.iter().filter_map(claim::Claim::figure);
        let budgets = self.budgets.iter().map(|b| &b.figure);
        let maps = self.stability.iter().flat_map(stability::Stability::maps);
        let race = self.race.iter().flat_map(|race| &race.figures);
        let totals = self.bias.iter().chain(budgets).chain(&self.costs).chain(&self.second_costs);
        let totals = totals.chain(maps).chain(race);
        let cases = self.cases.iter().flat_map(|c| {
            let figures = c.sketches.iter().chain(&c.pictures).chain(&c.figures);
            figures.map(|figure| (format!("{}-{}", c.judged.id, slug(&figure.title)), figure))
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
    let quantities = || results.cases.iter().flat_map(|c| &c.quantities);
    let with = |v| quantities().filter(|q| q.verdict == Some(v)).count();
    let known_failures = quantities().filter(|q| q.verdict == Some(Verdict::Fail) && !q.failed()).count();
    let shown = || results.cases.iter().filter_map(|c| measured(&c.id));
    let costs =
        |cost| shown().flat_map(|c| &c.costs).flat_map(|d| plots::cost::work_precision(d, cost)).collect();
    let beside = results.race.as_ref().map(|race| {
        shown().flat_map(|c| &c.costs).filter_map(|d| plots::cost::beside(d, race)).collect::<Vec<_>>()
    });
    let claims = results.cases.iter().flat_map(|c| c.claims.iter().map(move |j| (c, j)));
    let budgets = shown().flat_map(|c| c.budgets.iter().filter_map(|b| budget::view(&c.id, b)));
    let outcome = results.exit(true);
    let work_costs: Vec<Figure> = costs(Cost::Work);
    let stability = stability::section(results, cases);
    Page {
        outcome: outcome_words(outcome),
        good: outcome == Exit::Pass,
        counts: [with(Verdict::Pass), with(Verdict::Fail) - known_failures, with(Verdict::Undetermined)],
        known_failures,
        activities: activities(results),
        answers: answer::answers(
            results,
            &work_costs,
            stability.as_ref().and_then(stability::Stability::sentence),
        ),
        failures: failures::views(results),
        claims: claims.map(|(c, j)| claim::claim(c, j, measured(&c.id))).collect(),
        rows: numbers::rows(results),
        bias: plots::bias::scatter(results).into_iter().collect(),
        budgets: budgets.collect(),
        costs: work_costs,
        agreements: agreement::view(results),
        race: results.race.as_ref().map(race::view),
        cost_tables: studies::costs(results),
        ablations: studies::ablations(results),
        stability,
        cases: results.cases.iter().map(|c| case::view(c, measured(&c.id))).collect(),
        provenance: results.provenance.clone(),
        timings: results.cases.iter().map(|c| (c.id.clone(), seconds(c.seconds))).collect(),
        seconds: seconds(results.cases.iter().map(|c| c.seconds).sum()),
        second_costs: costs(Cost::Seconds).into_iter().chain(beside.into_iter().flatten()).collect(),
        second_advantages: studies::in_seconds(results),
        stages: shown().flat_map(|c| c.costs.iter().map(|d| studies::stages(&c.id, d))).collect(),
        timed: studies::timed(results),
    }
}

/// How many compared numbers are evidence of which kind.
fn activities(results: &Results) -> Vec<(&'static str, usize)> {
    let of = |a| results.cases.iter().flat_map(|c| &c.quantities).filter(|q| Activity::of(q) == a).count();
    [Activity::Verification, Activity::Benchmarking, Activity::Validation].map(|a| (a.name(), of(a))).to_vec()
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
