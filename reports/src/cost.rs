//! What a cost diagram says in numbers: the cheapest settings, the front, how cost grows, and what the paper-like setting
//! would have cost.

mod advantage;
mod others;
mod reach;

pub use advantage::{Advantage, advantages, promised};
pub use others::{Other, others};
pub use reach::{Cost, Reached, reached};

use schemars::JsonSchema;
use seam_cases::result::{CostDiagram, CostPoint, CostSetting};
use serde::{Deserialize, Serialize};

/// Accuracies that a user is told the cheapest setting for.
pub const TARGETS: [f64; 3] = [0.05, 0.01, 0.001];

/// Fewest points that an exponent is fitted to.
const LEAST_POINTS: usize = 3;

/// A cost diagram in numbers. Fields whose name contains `seconds` are not deterministic, the others are.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct CostJudgement {
    /// Unique within the case.
    pub id: String,
    /// Caption.
    pub title: String,
    /// What the error is of.
    pub error_label: String,
    /// What the error is measured against.
    pub reference: String,
    /// For each of some accuracies the setting that does the least counted work.
    pub cheapest: Vec<Cheapest>,
    /// Points that no other beats in both error and counted work, cheapest first.
    pub front: Vec<FrontPoint>,
    /// How the cost of each setting grows with its unknowns.
    pub growth: Vec<Growth>,
    /// The paper-like setting against the rest, at the same accuracy.
    pub advantages: Vec<Advantage>,
    /// Points that could not be measured.
    pub gaps: Vec<Gap>,
}

/// The setting that reaches an accuracy with the least counted work, and keeps it at all finer levels.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Cheapest {
    /// The accuracy, as a fraction.
    pub target: f64,
    /// The setting; `null` if none reaches it, and then the rest is empty.
    pub setting: Option<String>,
    /// Its level.
    pub level: String,
    /// Its error, as a fraction.
    pub error: f64,
    /// Its particles.
    pub particles: usize,
    /// `Work::total`.
    pub work: u64,
    /// Median wall time, in s. Not deterministic.
    pub seconds: f64,
}

/// A point of the front.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct FrontPoint {
    /// The setting.
    pub setting: String,
    /// Its level.
    pub level: String,
    /// Its error, as a fraction.
    pub error: f64,
    /// `Work::total`.
    pub work: u64,
}

/// Exponents p of `cost ∝ Nᵖ`, N unknowns, fitted by least squares in logarithms over the levels of a setting.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Growth {
    /// The setting.
    pub setting: String,
    /// Number of levels.
    pub levels: usize,
    /// Of counted work.
    pub work_exponent: f64,
    /// Of wall time. Not deterministic.
    pub seconds_exponent: f64,
}

/// A point that could not be measured.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Gap {
    /// The setting.
    pub setting: String,
    /// Its level.
    pub level: String,
    /// Why.
    pub why: String,
}

/// What a diagram says.
pub fn judge(diagram: &CostDiagram) -> CostJudgement {
    CostJudgement {
        id: diagram.id.clone(),
        title: diagram.title.clone(),
        error_label: diagram.error_label.clone(),
        reference: diagram.reference.clone(),
        cheapest: TARGETS.iter().map(|&target| cheapest(diagram, target, Cost::Work)).collect(),
        front: front(diagram),
        growth: diagram.settings.iter().filter_map(growth).collect(),
        advantages: advantages(diagram),
        gaps: gaps(diagram),
    }
}

/// The cheapest point of all settings from which on a setting keeps an accuracy: one lucky level does not count.
pub fn cheapest(diagram: &CostDiagram, target: f64, cost: Cost) -> Cheapest {
    let first = |setting: &'_ CostSetting| {
        let level = reach::first_level(setting, target)?;
        Some(setting.points[level].clone())
    };
    let all = diagram.settings.iter().filter_map(|setting| Some((setting, first(setting)?)));
    let best = all.min_by(|(_, a), (_, b)| cost.of(a).total_cmp(&cost.of(b)));
    best.map_or(Cheapest { target, ..Cheapest::default() }, |(setting, p)| Cheapest {
        target,
        setting: Some(setting.name.clone()),
        error: p.error.unwrap_or(f64::MAX),
        particles: p.particles,
        work: p.work.total(),
        seconds: p.seconds,
        level: p.level,
    })
}

fn front(diagram: &CostDiagram) -> Vec<FrontPoint> {
    let all = diagram.settings.iter().flat_map(|s| s.points.iter().map(move |p| (s, p)));
    let measured = all.filter_map(|(s, p)| Some((s, p, p.error?)));
    let mut points: Vec<FrontPoint> = measured
        .map(|(s, p, error)| FrontPoint {
            setting: s.name.clone(),
            level: p.level.clone(),
            error,
            work: p.work.total(),
        })
        .collect();
    points.sort_by(|a, b| a.work.cmp(&b.work).then(a.error.total_cmp(&b.error)));
    let mut least = f64::INFINITY;
    points.retain(|p| {
        let better = p.error < least;
        least = least.min(p.error);
        better
    });
    points
}

fn growth(setting: &CostSetting) -> Option<Growth> {
    let points: Vec<&CostPoint> =
        setting.points.iter().filter(|p| p.error.is_some() && p.unknowns > 0).collect();
    let of = |cost: &dyn Fn(&CostPoint) -> f64| exponent(points.iter().map(|p| (p.unknowns as f64, cost(p))));
    Some(Growth {
        setting: setting.name.clone(),
        levels: points.len(),
        work_exponent: of(&|p| p.work.total() as f64)?,
        seconds_exponent: of(&|p| p.seconds)?,
    })
}

/// Slope of `ln y` over `ln x` by least squares; `None` for fewer than three points or a spread of nothing.
pub fn exponent(points: impl Iterator<Item = (f64, f64)>) -> Option<f64> {
    let logs: Vec<[f64; 2]> = points.map(|(x, y)| [x.ln(), y.ln()]).collect();
    if logs.len() < LEAST_POINTS || logs.iter().flatten().any(|v| !v.is_finite()) {
        return None;
    }
    let n = logs.len() as f64;
    let mean = |i: usize| logs.iter().map(|p| p[i]).sum::<f64>() / n;
    let (mx, my) = (mean(0), mean(1));
    let sxx: f64 = logs.iter().map(|p| (p[0] - mx).powi(2)).sum();
    let sxy: f64 = logs.iter().map(|p| (p[0] - mx) * (p[1] - my)).sum();
    (sxx > 0.0).then_some(sxy / sxx)
}

fn gaps(diagram: &CostDiagram) -> Vec<Gap> {
    let all = diagram.settings.iter().flat_map(|s| s.points.iter().map(move |p| (s, p)));
    let missing = all.filter(|(_, p)| p.error.is_none());
    missing
        .map(|(s, p)| Gap {
            setting: s.name.clone(),
            level: p.level.clone(),
            why: p.failed.clone().unwrap_or_else(|| "it failed".to_owned()),
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use seam_solver::work::Work;

    fn setting(name: &str, points: &[(f64, u64)]) -> CostSetting {
        let point = |&(error, work): &(f64, u64)| CostPoint {
            error: error.is_finite().then_some(error),
            unknowns: work as usize,
            particles: 1,
            work: Work { bond_updates: work, ..Work::default() },
            seconds: work as f64 * 1e-6,
            ..CostPoint::default()
        };
        CostSetting { name: name.to_owned(), points: points.iter().map(point).collect() }
    }

    #[test]
    fn a_lucky_level_is_not_the_cheapest() {
        let lucky = setting("lucky", &[(0.2, 10), (0.005, 20), (0.1, 40)]);
        let steady = setting("steady", &[(0.1, 100), (0.008, 200), (0.002, 400)]);
        let diagram = CostDiagram { settings: vec![lucky, steady], ..CostDiagram::default() };
        let found = cheapest(&diagram, 0.01, Cost::Work);
        assert_eq!((found.setting.as_deref(), found.work), (Some("steady"), 200));
        assert_eq!(cheapest(&diagram, 0.001, Cost::Work).setting, None);
    }

    #[test]
    fn the_front_holds_what_nobody_beats_and_gaps_say_why() {
        let a = setting("a", &[(0.2, 10), (0.1, 40), (f64::NAN, 80)]);
        let b = setting("b", &[(0.3, 20), (0.05, 30)]);
        let judged = judge(&CostDiagram { settings: vec![a, b], ..CostDiagram::default() });
        let front: Vec<_> = judged.front.iter().map(|p| (p.setting.as_str(), p.work)).collect();
        assert_eq!(front, [("a", 10), ("b", 30)]);
        assert_eq!(judged.gaps.len(), 1);
    }

    #[test]
    fn a_power_law_gives_its_exponent() {
        let found = exponent([1.0, 2.0, 4.0, 8.0].into_iter().map(|x: f64| (x, 3.0 * x.powf(1.25))));
        assert!((found.unwrap() - 1.25).abs() < 1e-12);
        assert_eq!(exponent([(1.0, 1.0), (2.0, 2.0)].into_iter()), None, "two points always lie on a line");
    }
}
