//! What the studies found, in words: costs, where time goes, effects on and off.

use crate::ablation::AblationJudgement;
use crate::cost::{Advantage, Cheapest, CostJudgement, Growth};
use crate::format::{grouped, percent, signed_percent, significant, value, with_unit};
use crate::results::Results;
use seam_cases::result::{AblationChange, CostDiagram, CostPoint};
use serde::Serialize;
use std::collections::BTreeSet;

/// A cost diagram in tables; nothing in it depends on the clock.
#[derive(Serialize)]
pub(crate) struct CostView {
    case: String,
    title: String,
    error: String,
    reference: String,
    cheapest: Vec<[String; 6]>,
    front: Vec<[String; 4]>,
    advantages: Vec<[String; 4]>,
    growth: Vec<[String; 3]>,
    gaps: Vec<[String; 3]>,
}

/// Where the time of the finest level of each setting goes.
#[derive(Serialize)]
pub(crate) struct StageView {
    title: String,
    names: Vec<String>,
    rows: Vec<StageRow>,
}

#[derive(Serialize)]
struct StageRow {
    setting: String,
    seconds: String,
    shares: Vec<String>,
    memory: String,
}

/// An ablation.
#[derive(Serialize)]
pub(crate) struct AblationView {
    case: String,
    label: String,
    effect: String,
    change: String,
    work: String,
    counters: String,
    guard: String,
    verdict: String,
    why: String,
    changes: Vec<[String; 4]>,
}

/// The diagrams of all cases.
pub(super) fn costs(results: &Results) -> Vec<CostView> {
    results.cases.iter().flat_map(|c| c.costs.iter().map(|d| cost(&c.id, d))).collect()
}

fn cost(case: &str, d: &CostJudgement) -> CostView {
    CostView {
        case: case.to_owned(),
        title: d.title.clone(),
        error: d.error_label.clone(),
        reference: d.reference.clone(),
        cheapest: d.cheapest.iter().map(cheapest).collect(),
        front: d
            .front
            .iter()
            .map(|p| [p.setting.clone(), p.level.clone(), percent(p.error), grouped(p.work)])
            .collect(),
        advantages: d.advantages.iter().map(advantage).collect(),
        growth: d.growth.iter().map(growth).collect(),
        gaps: d.gaps.iter().map(|g| [g.setting.clone(), g.level.clone(), g.why.clone()]).collect(),
    }
}

fn cheapest(c: &Cheapest) -> [String; 6] {
    let Some(setting) = &c.setting else {
        let none = || "–".to_owned();
        return [
            percent(c.target),
            "no setting reaches it and keeps it".to_owned(),
            none(),
            none(),
            none(),
            none(),
        ];
    };
    [
        percent(c.target),
        setting.clone(),
        c.level.clone(),
        percent(c.error),
        grouped(c.particles as u64),
        grouped(c.work),
    ]
}

fn advantage(a: &Advantage) -> [String; 4] {
    let least = if a.work_at_least { "at least " } else { "" };
    let claimed = if a.claimed { " (claimed)" } else { "" };
    let times = format!("{least}{}", significant(a.times_less_work, 3));
    [percent(a.error) + claimed, a.setting.clone(), times, significant(a.times_less_run_work, 3)]
}

fn growth(g: &Growth) -> [String; 3] {
    [g.setting.clone(), g.levels.to_string(), significant(g.work_exponent, 3)]
}

/// Stages of a diagram, at the finest level of each setting that was measured.
pub(super) fn stages(case: &str, d: &CostDiagram) -> StageView {
    let finest =
        d.settings.iter().filter_map(|s| Some((s, s.points.iter().rev().find(|p| p.error.is_some())?)));
    let finest: Vec<_> = finest.collect();
    let names: BTreeSet<&String> = finest.iter().flat_map(|(_, p)| p.seconds_of_stages.keys()).collect();
    let row = |(s, p): &(&seam_cases::result::CostSetting, &CostPoint)| StageRow {
        setting: format!("{}, {}", s.name, p.level),
        seconds: significant(p.seconds, 3),
        shares: names
            .iter()
            .map(|name| p.seconds_of_stages.get(*name).map_or("–".to_owned(), |s| percent(s / p.seconds)))
            .collect(),
        memory: p.memory_mb.map_or("–".to_owned(), |mb| significant(mb, 3)),
    };
    StageView {
        title: format!("{case}: {}", d.title),
        rows: finest.iter().map(row).collect(),
        names: names.into_iter().cloned().collect(),
    }
}

/// The paper-like setting against the rest in wall time.
pub(super) fn in_seconds(results: &Results) -> Vec<[String; 4]> {
    let all = results
        .cases
        .iter()
        .flat_map(|c| c.costs.iter().flat_map(move |d| d.advantages.iter().map(move |a| (c, a))));
    all.map(|(case, a)| {
        let [accuracy, ..] = advantage(a);
        let least = if a.seconds_at_least { "at least " } else { "" };
        [
            case.id.clone(),
            accuracy,
            a.setting_in_seconds.clone(),
            format!("{least}{}", significant(a.times_less_seconds, 3)),
        ]
    })
    .collect()
}

/// Exponents of wall time.
pub(super) fn timed(results: &Results) -> Vec<[String; 4]> {
    let all = results.cases.iter().flat_map(|c| &c.timed);
    all.map(|t| {
        let [low, high] = t.accepted;
        let found = t.seconds_exponent.map_or("not fitted".to_owned(), |p| significant(p, 3));
        [t.label.clone(), found, format!("{low} … {high}"), t.seconds_verdict.to_string()]
    })
    .collect()
}

/// The ablations of all cases.
pub(super) fn ablations(results: &Results) -> Vec<AblationView> {
    results.cases.iter().flat_map(|c| c.ablations.iter().map(|a| ablation(&c.id, a))).collect()
}

fn ablation(case: &str, a: &AblationJudgement) -> AblationView {
    let guard = match &a.indicator {
        Some(i) => format!("{} of {}", significant(i.value, 2), value(i.limit)),
        None => "–".to_owned(),
    };
    AblationView {
        case: case.to_owned(),
        label: a.label.clone(),
        effect: a.effect.clone(),
        change: a.largest_change.map_or("–".to_owned(), percent),
        work: a.work_ratio.map_or("–".to_owned(), |r| significant(r, 3)),
        counters: format!("{} / {}", grouped(a.counters[0]), grouped(a.counters[1])),
        guard,
        verdict: a.verdict.map_or("shown".to_owned(), |v| v.to_string()),
        why: a.why.clone(),
        changes: a.changes.iter().map(change).collect(),
    }
}

fn change(c: &AblationChange) -> [String; 4] {
    let of = |v: Option<f64>| v.map_or("curve".to_owned(), |v| with_unit(v, &c.unit));
    [c.label.clone(), of(c.with), of(c.without), c.change.map_or("–".to_owned(), signed_percent)]
}
