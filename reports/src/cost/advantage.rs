//! How much cheaper other settings reach the accuracy of the paper-like one.

use super::TARGETS;
use super::reach::{Cost, Reached, reached};
use crate::format::percent;
use schemars::JsonSchema;
use seam_cases::result::{CostDiagram, CostSetting, Observation, PAPER_LIKE, ReferenceKind};
use serde::{Deserialize, Serialize};

/// The paper-like setting against the cheapest other one with particles, in counted work and in wall time, at one accuracy: costs are
/// read off the line of each setting, interpolated in logarithms, never extrapolated.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Advantage {
    /// The accuracy, as a fraction.
    pub error: f64,
    /// Whether a claim of somebody else is about it.
    pub claimed: bool,
    /// The setting with the least counted work.
    pub setting: String,
    /// Counted work of the paper-like setting over that of this one.
    pub times_less_work: f64,
    /// Whether it is at least that: the paper-like setting does not get there, or this one starts better.
    pub work_at_least: bool,
    /// The same without packings and calibrations, which a later run of the same material need not repeat.
    #[serde(default)]
    pub times_less_run_work: f64,
    /// The setting with the least wall time. Not deterministic.
    #[serde(default)]
    pub setting_in_seconds: String,
    /// Wall time of the paper-like setting over that of this one. Not deterministic.
    pub times_less_seconds: f64,
    /// Whether it is at least that. Not deterministic.
    pub seconds_at_least: bool,
}

/// At each claimed accuracy and each of [`TARGETS`], large to small, that some setting reaches.
pub fn advantages(diagram: &CostDiagram) -> Vec<Advantage> {
    let Some(paper) = diagram.settings.iter().find(|s| Some(&s.name) == diagram.paper_like.as_ref()) else {
        return Vec::new();
    };
    let promise = diagram.cheaper.iter().map(|promise| promise.error);
    let mut errors: Vec<f64> = diagram.claimed.iter().copied().chain(TARGETS).chain(promise).collect();
    errors.sort_by(|a, b| b.total_cmp(a));
    errors.dedup();
    errors.into_iter().filter_map(|error| at(diagram, paper, error)).collect()
}

/// What a diagram promises against its paper-like setting, as a number beside the others; NaN where the two cannot be compared.
pub fn promised(diagram: &CostDiagram) -> Option<Observation> {
    let promise = diagram.cheaper.as_ref()?;
    let paper = diagram.settings.iter().find(|s| Some(&s.name) == diagram.paper_like.as_ref());
    let found = paper.and_then(|paper| at(diagram, paper, promise.error));
    let (value, how) = match &found {
        Some(a) => {
            (a.times_less_work, format!("{}{}", if a.work_at_least { "at least, " } else { "" }, a.setting))
        }
        None => (f64::NAN, "no setting with particles gets there".to_owned()),
    };
    Some(Observation {
        id: format!("cheaper-{}", diagram.id),
        label: format!(
            "{}: counted work of the paper-like setting over that of the cheapest other one with particles, at an error of {} ({how})",
            diagram.title,
            percent(promise.error)
        ),
        unit: "1".to_owned(),
        value,
        kind: ReferenceKind::OwnRun,
        source: format!("the setting '{PAPER_LIKE}' of the same diagram"),
        accepted: Some(promise.times),
        why: promise.why.clone(),
        ..Observation::default()
    })
}

fn at(diagram: &CostDiagram, paper: &CostSetting, error: f64) -> Option<Advantage> {
    // A setting without particles answers another question.
    let coupled = |s: &&CostSetting| s.points.iter().any(|p| p.particles > 0);
    let others = diagram.settings.iter().filter(|s| s.name != paper.name).filter(coupled);
    let least = |cost: Cost| {
        let costs = others.clone().filter_map(|s| Some((s, cost_of(s, error, cost)?.0)));
        costs.min_by(|(_, a), (_, b)| a.total_cmp(b)).map(|(setting, _)| setting)
    };
    let (setting, fastest) = (least(Cost::Work)?, least(Cost::Seconds)?);
    let (times_less_work, work_at_least) = ratio(paper, setting, error, Cost::Work)?;
    let (times_less_run_work, _) = ratio(paper, setting, error, Cost::Run)?;
    let (times_less_seconds, seconds_at_least) = ratio(paper, fastest, error, Cost::Seconds)?;
    Some(Advantage {
        error,
        claimed: diagram.claimed.contains(&error),
        setting: setting.name.clone(),
        times_less_work,
        work_at_least,
        times_less_run_work,
        setting_in_seconds: fastest.name.clone(),
        times_less_seconds,
        seconds_at_least,
    })
}

/// Cost of a setting that gets there, and whether it is at most that.
fn cost_of(setting: &CostSetting, error: f64, cost: Cost) -> Option<(f64, bool)> {
    match reached(setting, error, cost)? {
        Reached::At(c) => Some((c, false)),
        Reached::AtMost(c) => Some((c, true)),
        Reached::MoreThan(_) => None,
    }
}

/// Cost of the paper-like setting over that of another one, and whether it is at least that. Where the paper-like setting is
/// good enough at its coarsest level its cost is known from above only, and that level's cost is taken: a comparison of the two
/// as measured.
fn ratio(paper: &CostSetting, other: &CostSetting, error: f64, cost: Cost) -> Option<(f64, bool)> {
    let (own, at_most) = cost_of(other, error, cost)?;
    Some(match reached(paper, error, cost)? {
        Reached::At(theirs) => (theirs / own, at_most),
        Reached::AtMost(theirs) => (theirs / own, false),
        Reached::MoreThan(theirs) => (theirs / own, true),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::verdict::{Verdict, of_quantity};
    use seam_cases::result::{Cheaper, CostPoint};
    use seam_solver::work::Work;

    fn setting(name: &str, particles: usize, points: &[(f64, u64)]) -> CostSetting {
        // Work in which each unit takes a tenth of the time.
        let quick = if name == "quick" { 0.1 } else { 1.0 };
        let point = |&(error, work): &(f64, u64)| CostPoint {
            error: Some(error),
            particles,
            work: Work { bond_updates: work, ..Work::default() },
            run_work: work / 2,
            seconds: quick * work as f64,
            ..CostPoint::default()
        };
        CostSetting { name: name.to_owned(), points: points.iter().map(point).collect() }
    }

    #[test]
    fn costs_are_compared_at_the_same_accuracy() {
        let diagram = CostDiagram {
            claimed: vec![0.02],
            paper_like: Some("paper-like".to_owned()),
            settings: vec![
                setting("paper-like", 9, &[(0.1, 100), (0.01, 1000)]),
                setting("improved", 9, &[(0.03, 10), (0.003, 100)]),
                setting("quick", 9, &[(0.03, 50), (0.003, 500)]),
                setting("no particles", 0, &[(0.001, 1)]),
            ],
            ..CostDiagram::default()
        };
        let all = advantages(&diagram);
        let of = |error: f64| all.iter().find(|a| a.error == error).unwrap();
        let claimed = of(0.02);
        // 500 against 15: both errors fall as one over the cost.
        assert!((claimed.times_less_work - 500.0 / 15.0).abs() < 1e-9 && !claimed.work_at_least);
        assert!(claimed.claimed && claimed.setting == "improved");
        // 500 against 75 units of a tenth of the time each.
        assert!(
            claimed.setting_in_seconds == "quick" && (claimed.times_less_seconds - 500.0 / 7.5).abs() < 1e-9
        );
        // Half of the work is the run's in both.
        assert!((claimed.times_less_run_work - claimed.times_less_work).abs() < 1e-9);
        // 5 %: the improved setting starts better than that, so the ratio is a lower bound.
        assert!(of(0.05).work_at_least && (of(0.05).times_less_work - 20.0).abs() < 1e-9);
        assert_eq!(all.iter().filter(|a| a.error == 0.001).count(), 0, "nobody with particles gets there");
    }

    /// 500 against 15 at 2 %, as above.
    #[test]
    fn a_promise_is_judged_from_both_sides_and_measured_or_red() {
        let promise = |error: f64, times: [f64; 2], improved: u64| {
            let diagram = CostDiagram {
                id: "c".to_owned(),
                paper_like: Some("paper-like".to_owned()),
                cheaper: Some(Cheaper { error, times, why: "chosen".to_owned() }),
                settings: vec![
                    setting("paper-like", 9, &[(0.1, 100), (0.01, 1000)]),
                    setting("improved", 9, &[(0.03, improved), (0.003, 10 * improved)]),
                ],
                ..CostDiagram::default()
            };
            let found = promised(&diagram).unwrap();
            of_quantity(found.value, found.accepted).unwrap()
        };
        assert_eq!(promise(0.02, [10.0, 100.0], 10), Verdict::Pass);
        assert_eq!(promise(0.02, [10.0, 100.0], 100), Verdict::Fail, "an improvement that became dear");
        assert_eq!(promise(0.02, [10.0, 30.0], 10), Verdict::Fail, "too good to be true");
        assert_eq!(promise(0.0001, [10.0, 100.0], 10), Verdict::Undetermined, "nobody gets there");
        assert_eq!(promised(&CostDiagram::default()), None);
    }
}
