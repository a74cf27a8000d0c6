//! What the part of a case shows.

use super::switches::{self, Switches};
use crate::activity::Activity;
use crate::format::{self, percent, share};
use crate::html::prose;
use crate::plots::{self, Figure};
use crate::results::{CaseJudgement, CurveResult};
use crate::verdict::Verdict;
use seam_cases::result::{CaseResult, Parameter};
use serde::Serialize;

/// A case in words and figures.
#[derive(Serialize)]
pub(crate) struct Case {
    pub(super) judged: CaseJudgement,
    purpose: String,
    page: String,
    citation: String,
    tags: Vec<String>,
    counts: [usize; 4],
    tightest: String,
    parameters: Vec<[String; 4]>,
    pub(super) figures: Vec<Figure>,
    pub(super) sketches: Vec<Figure>,
    pub(super) pictures: Vec<Figure>,
    curves: Vec<[String; 7]>,
    switches: Option<Switches>,
    work: Vec<(&'static str, String)>,
    notes: Vec<String>,
}

/// Puts a judged case, and what was measured in it, into words and figures.
pub(super) fn view(judged: &CaseJudgement, measured: Option<&CaseResult>) -> Case {
    let none = CaseResult::default();
    let m = measured.unwrap_or(&none);
    let curves = m.curves.iter().flat_map(|p| [plots::curves::curves(p), plots::curves::residuals(p)]);
    let orders = m.convergence.iter().map(plots::convergence::orders);
    let with = |v| judged.quantities.iter().filter(|q| q.verdict == v).count();
    let headrooms = judged.quantities.iter().filter_map(|q| Some((q.headroom?, &q.id)));
    let tightest = headrooms.min_by(|a, b| a.0.total_cmp(&b.0));
    Case {
        judged: judged.clone(),
        purpose: prose::html(&m.purpose),
        page: seam_cases::catalogue::page(&judged.id).map_or(String::new(), prose::page),
        citation: m.citation.clone(),
        tags: m.tags.clone(),
        counts: [
            with(Some(Verdict::Pass)),
            with(Some(Verdict::Fail)),
            with(Some(Verdict::Undetermined)),
            with(None),
        ],
        tightest: tightest.map_or(String::new(), |(h, id)| format!("{:.0} % left in {id}", 100.0 * h)),
        parameters: m.parameters.iter().map(parameter).collect(),
        figures: curves.chain(orders).flatten().collect(),
        sketches: m.pictures.iter().filter_map(plots::sketch::sketch).collect(),
        pictures: m.pictures.iter().filter_map(plots::picture::picture).collect(),
        curves: judged.curves.iter().map(curve).collect(),
        switches: switches::view(&m.switches),
        work: work(judged),
        notes: m.notes.clone(),
    }
}

fn parameter(p: &Parameter) -> [String; 4] {
    let unit = if p.unit == "1" { String::new() } else { p.unit.clone() };
    [p.name.clone(), format::typeset(&format::value(p.value)), unit, p.about.clone()]
}

fn curve(c: &CurveResult) -> [String; 7] {
    let of = |e: Option<f64>| e.map_or("–".to_owned(), percent);
    let state = match c.verdict {
        Verdict::Pass => "compared",
        Verdict::Fail => "covers too little",
        Verdict::Undetermined => "not comparable",
    };
    let activity = Activity::against(c.kind).name().to_owned();
    [c.plot.clone(), c.series.clone(), activity, share(c.coverage), of(c.e2), of(c.e_max), state.to_owned()]
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
        ("factor entries of all solves", w.solve_entries),
        ("contact checks", w.contact_checks),
        ("packing checks", w.packing_checks),
        ("steps", w.steps),
    ];
    all.into_iter().filter(|(_, n)| *n > 0).map(|(name, n)| (name, format::grouped(n))).collect()
}
