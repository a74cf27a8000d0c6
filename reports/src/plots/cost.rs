//! What accuracy costs: error against counted work, and against seconds.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::format::{grouped, percent, significant};
use seam_cases::result::{CostDiagram, CostPoint, CostSetting};

/// Error that the closing sentence asks for.
const TARGET: f64 = 0.01;

/// What the cost is counted in.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Cost {
    /// `Work::total`: the same in every run.
    Work,
    /// Wall seconds: not deterministic.
    Seconds,
}

impl Cost {
    fn of(self, p: &CostPoint) -> f64 {
        match self {
            Cost::Work => p.work.total() as f64,
            Cost::Seconds => p.seconds,
        }
    }

    fn label(self) -> &'static str {
        match self {
            Cost::Work => "counted work (updates and factor entries)",
            Cost::Seconds => "wall time (s)",
        }
    }

    fn words(self, p: &CostPoint) -> String {
        match self {
            Cost::Work => format!("{} units of work", grouped(p.work.total())),
            Cost::Seconds => format!("{} s", significant(p.seconds, 2)),
        }
    }
}

/// Error over cost, one line per setting, broken where a run failed; `None` if there is nothing to draw.
pub fn work_precision(diagram: &CostDiagram, cost: Cost) -> Option<Figure> {
    let runs = || diagram.settings.iter().flat_map(|s| &s.points).filter(|p| p.error.is_some());
    let x = Axis::over(cost.label(), true, runs().map(|p| cost.of(p)))?;
    let errors = runs().filter_map(|p| p.error).map(|e| 100.0 * e);
    let y = Axis::over("error (%)", true, errors.chain([100.0 * TARGET]))?;
    let target = x.range.map(|x| [x, 100.0 * TARGET]).to_vec();
    let mut layers = vec![Layer::Line { ink: Ink::Bound, points: target }];
    let mut legend = vec![LegendEntry::line(Ink::Bound, percent(TARGET))];
    for (i, setting) in diagram.settings.iter().enumerate() {
        let ink = Ink::series(i);
        legend.push(LegendEntry::line(ink, &setting.name));
        for points in unbroken(setting, cost) {
            layers.push(Layer::Line { ink, points: points.clone() });
            layers.push(Layer::Dots { ink, points, radius: 8 });
        }
    }
    let title = match cost {
        Cost::Work => diagram.title.clone(),
        Cost::Seconds => format!("{}, in seconds", diagram.title),
    };
    let description = format!("{} over {}", diagram.error_label, cost.label());
    let note = format!("{} Error: {}.", cheapest(diagram, cost), diagram.error_label);
    let chart = Chart { title, description, x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, note))
}

/// The runs of a setting, as pieces without a failed run between them.
fn unbroken(setting: &CostSetting, cost: Cost) -> Vec<Vec<[f64; 2]>> {
    let point = |p: &CostPoint| p.error.map(|e| [cost.of(p), 100.0 * e]);
    let pieces = setting.points.split(|p| p.error.is_none());
    pieces.filter(|piece| !piece.is_empty()).map(|piece| piece.iter().filter_map(point).collect()).collect()
}

/// `Cheapest setting with error ≤ 1 %: weighted skin, 8 rows, 202 particles, 0.4 s.`
fn cheapest(diagram: &CostDiagram, cost: Cost) -> String {
    let runs = diagram.settings.iter().flat_map(|s| s.points.iter().map(move |p| (s, p)));
    let good = runs.filter(|(_, p)| p.error.is_some_and(|e| e <= TARGET));
    let best = good.min_by(|(_, a), (_, b)| cost.of(a).total_cmp(&cost.of(b)));
    let failed = diagram.settings.iter().flat_map(|s| &s.points).filter(|p| p.error.is_none()).count();
    let gaps = if failed > 0 {
        format!(" {} failed and left a gap.", crate::format::count(failed, "run"))
    } else {
        String::new()
    };
    match best {
        Some((s, p)) => format!(
            "Cheapest setting with error ≤ {}: {}, {}, {} particles, {}.{gaps}",
            percent(TARGET),
            s.name,
            p.level,
            p.particles,
            cost.words(p)
        ),
        None => format!("No setting reaches an error of {}.{gaps}", percent(TARGET)),
    }
}
