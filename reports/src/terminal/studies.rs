//! What the studies found: the cheapest settings, and effects on and off.

use super::style::{Paint, wrap};
use super::{Style, WIDTH, cut, heading, short};
use crate::ablation::AblationJudgement;
use crate::cost::{Advantage, Cheapest, CostJudgement};
use crate::format::{grouped, percent, significant};
use crate::growth::TimedGrowth;
use crate::results::{CaseJudgement, Results};

/// The sections of cost and effects, or nothing.
pub(super) fn sections(results: &Results, style: Style) -> String {
    let mut out = String::new();
    let cases = || results.cases.iter();
    if cases().any(|c| !c.costs.is_empty()) {
        out.push_str(&heading("What accuracy costs", style));
        cases().for_each(|c| c.costs.iter().for_each(|d| out.push_str(&cost(c, d, style))));
    }
    if cases().any(|c| !c.timed.is_empty()) {
        out.push_str(&heading("How wall time grows", style));
        cases().for_each(|c| c.timed.iter().for_each(|t| out.push_str(&timed(t, style))));
    }
    if cases().any(|c| !c.ablations.is_empty()) {
        out.push_str(&heading("Effects on and off", style));
        cases().for_each(|c| c.ablations.iter().for_each(|a| out.push_str(&ablation(c, a, style))));
    }
    out
}

fn cost(case: &CaseJudgement, d: &CostJudgement, style: Style) -> String {
    let mut text =
        format!("  {}\n", style.paint(Paint::Bold, &cut(&format!("{} / {}", case.id, d.id), WIDTH - 2)));
    d.cheapest.iter().for_each(|c| text.push_str(&wrap(&cheapest(c), WIDTH, 4)));
    d.advantages.iter().filter(|a| a.claimed).for_each(|a| text.push_str(&wrap(&advantage(a), WIDTH, 4)));
    if !d.gaps.is_empty() {
        let gaps = crate::format::count(d.gaps.len(), "point");
        text.push_str(&wrap(&format!("{gaps} could not be measured; the report says why."), WIDTH, 4));
    }
    text
}

/// `error ≤ 1 %: lattice, 8 rows, 0.7 %, 202 particles, 1 234 units of work, 0.4 s`
pub(crate) fn cheapest(c: &Cheapest) -> String {
    let Some(setting) = &c.setting else {
        return format!("error ≤ {}: no setting that was tried reaches it and keeps it", percent(c.target));
    };
    let particles =
        if c.particles > 0 { format!(", {} particles", grouped(c.particles as u64)) } else { String::new() };
    format!(
        "error ≤ {}: {setting}, {}{particles}, {} units of work, {} s",
        percent(c.target),
        c.level,
        grouped(c.work),
        significant(c.seconds, 2)
    )
}

/// `at 7 %, the claimed accuracy, "lattice" takes 43 times less work (8 times less without packing and calibration) and "quick" 30 times less
/// time than the paper-like setting`
pub(crate) fn advantage(a: &Advantage) -> String {
    let times = |ratio: f64, at_least: bool| {
        let least = if at_least { "at least " } else { "" };
        match ratio {
            r if r >= 1.0 => format!("{least}{} times less", significant(r, 2)),
            r => format!("{} times more", significant(1.0 / r, 2)),
        }
    };
    let claimed = if a.claimed { ", the claimed accuracy," } else { "" };
    let fastest = if a.setting_in_seconds == a.setting {
        String::new()
    } else {
        format!("\"{}\" ", a.setting_in_seconds)
    };
    format!(
        "at {}{claimed} \"{}\" takes {} work ({} without packing and calibration) and {fastest}{} time than the paper-like setting",
        percent(a.error),
        a.setting,
        times(a.times_less_work, a.work_at_least),
        times(a.times_less_run_work, false),
        times(a.times_less_seconds, a.seconds_at_least)
    )
}

fn timed(t: &TimedGrowth, style: Style) -> String {
    let found = t.seconds_exponent.map_or("not fitted".to_owned(), |p| significant(p, 3));
    let [low, high] = t.accepted;
    let verdict = style.paint(Paint::verdict(t.seconds_verdict), short(t.seconds_verdict));
    format!("  {:<44} {found:>10}  in {low} … {high} {verdict}\n", cut(&t.label, 44))
}

fn ablation(case: &CaseJudgement, a: &AblationJudgement, style: Style) -> String {
    let name = cut(&format!("{} / {}", case.id, a.id), WIDTH - 2 - 18 - 1 - 6);
    let width = WIDTH - 2 - 18 - 1 - 6;
    let verdict = match a.verdict {
        Some(v) => style.paint(Paint::verdict(v), short(v)),
        None => style.paint(Paint::Dim, "shown"),
    };
    let text = format!("  {:<18} {name:<width$} {verdict}\n", a.effect);
    text + &wrap(&a.why, WIDTH, 6)
}
