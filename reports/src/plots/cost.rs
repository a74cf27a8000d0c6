//! What accuracy costs: error against counted work, and against seconds.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::cost::{self, Other, TARGETS};
use crate::format::{grouped, percent, significant};
use crate::race::{Race, unit};
use seam_cases::result::{CostDiagram, CostPoint, CostSetting};

pub use crate::cost::Cost;

/// Error that a line is drawn at.
const TARGET: f64 = 0.01;
/// Most settings in one figure: there are no more colours that stay apart.
const MOST: usize = 6;

impl Cost {
    fn label(self) -> &'static str {
        match self {
            Cost::Work => "counted work (updates and factor entries)",
            Cost::Run => "counted work of the run alone",
            Cost::Seconds => "wall time (s)",
        }
    }
}

/// Error over cost, one line per setting, broken where a run failed; several figures where there are many settings, each with
/// the best of all of them.
pub fn work_precision(diagram: &CostDiagram, cost: Cost) -> Vec<Figure> {
    let groups: Vec<&[CostSetting]> = diagram.settings.chunks(MOST).collect();
    let figure = |(k, group): (usize, &&[CostSetting])| {
        let title = match groups.len() {
            1 => diagram.title.clone(),
            several => format!("{} ({} of {several})", diagram.title, k + 1),
        };
        figure(diagram, (k * MOST, group), title, cost)
    };
    groups.iter().enumerate().filter_map(figure).collect()
}

fn figure(
    diagram: &CostDiagram,
    (first, group): (usize, &[CostSetting]),
    title: String,
    cost: Cost,
) -> Option<Figure> {
    let runs = || diagram.settings.iter().flat_map(|s| &s.points).filter(|p| p.error.is_some());
    let x = Axis::over(cost.label(), true, runs().map(|p| cost.of(p)))?;
    let errors = runs().filter_map(|p| p.error).map(|e| 100.0 * e);
    let y = Axis::over("error (%)", true, errors.chain([100.0 * TARGET]))?;
    let target = x.range.map(|x| [x, 100.0 * TARGET]).to_vec();
    let mut layers = vec![Layer::Line { ink: Ink::Bound, points: target }];
    let mut legend = vec![LegendEntry::line(Ink::Bound, percent(TARGET))];
    if diagram.settings.len() > group.len() {
        layers.push(Layer::Line { ink: Ink::Theory, points: front(diagram, cost) });
        legend.push(LegendEntry::line(Ink::Theory, "best of all settings"));
    }
    for (i, setting) in group.iter().enumerate() {
        let ink = Ink::series(i);
        let missing = if setting.points.iter().all(|p| p.error.is_none()) { " (none measured)" } else { "" };
        legend.push(LegendEntry::line(ink, format!("{}{missing}", setting.name)));
        for points in unbroken(setting, cost) {
            layers.push(Layer::Line { ink, points: points.clone() });
            layers.push(Layer::Dots { ink, points, radius: 8 });
        }
    }
    let title = match cost {
        Cost::Work | Cost::Run => title,
        Cost::Seconds => format!("{title}, in seconds"),
    };
    let description = format!("{} over {}", diagram.error_label, cost.label());
    // Said once, under the first figure.
    let note = match first {
        0 => format!("{} Error: {}.", cheapest(diagram, cost), diagram.error_label),
        _ => String::new(),
    };
    let chart = Chart { title, description, x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, note))
}

/// Error over seconds of the settings that other codes could have run, with those codes beside them; `None` where there are none.
pub fn beside(diagram: &CostDiagram, race: &Race) -> Option<Figure> {
    let others = cost::others(diagram, race);
    let shared = |s: &&CostSetting| others.iter().any(|other| other.setting == s.name);
    let own: Vec<&CostSetting> = diagram.settings.iter().filter(shared).collect();
    if others.is_empty() {
        return None;
    }
    let best = front(diagram, Cost::Seconds);
    let lines = own.iter().flat_map(|s| unbroken(s, Cost::Seconds)).flatten();
    let theirs =
        |other: &Other| -> Vec<[f64; 2]> { other.points.iter().map(|[t, e]| [*t, 100.0 * e]).collect() };
    let points: Vec<[f64; 2]> =
        best.iter().copied().chain(lines).chain(others.iter().flat_map(theirs)).collect();
    let x = Axis::over(Cost::Seconds.label(), true, points.iter().map(|p| p[0]))?;
    let y = Axis::over("error (%)", true, points.iter().map(|p| p[1]).chain([100.0 * TARGET]))?;
    let target = x.range.map(|x| [x, 100.0 * TARGET]).to_vec();
    let mut layers =
        vec![Layer::Line { ink: Ink::Bound, points: target }, Layer::Line { ink: Ink::Theory, points: best }];
    let mut legend = vec![
        LegendEntry::line(Ink::Bound, percent(TARGET)),
        LegendEntry::line(Ink::Theory, "Seam, best of all settings"),
    ];
    let mut draw = |i: usize, text: String, pieces: Vec<Vec<[f64; 2]>>| {
        let ink = Ink::series(i);
        legend.push(LegendEntry::line(ink, text));
        for points in pieces {
            layers.push(Layer::Line { ink, points: points.clone() });
            layers.push(Layer::Dots { ink, points, radius: 8 });
        }
    };
    for (i, setting) in own.iter().enumerate() {
        draw(i, format!("Seam, {}", setting.name), unbroken(setting, Cost::Seconds));
    }
    for (i, other) in others.iter().enumerate() {
        draw(own.len() + i, words(other), vec![theirs(other)]);
    }
    let title = format!("{}: other codes beside, in seconds", diagram.title);
    let description = format!("{} over {}", diagram.error_label, Cost::Seconds.label());
    let from = if race.recorded { format!("recorded on {}", race.date) } else { "of this run".to_owned() };
    let waits = match others.iter().any(|other| other.unit == unit("network")) {
        true => {
            " Where the scene stands still, a code with explicit steps has to wait for rest: it is given the least it can \
                 take, a lowest mode damped critically, to 0.1 %."
        }
        false => "",
    };
    let note = format!(
        "Other codes get the same networks and meshes, so the error is Seam's; time is what they have to do over their speed in \
         the race {from}, on one thread, without reading and preparing.{waits}"
    );
    let chart = Chart { title, description, x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, note))
}

/// `YADE, all particles, at 2.8 million bond updates/s`
fn words(other: &Other) -> String {
    let [low, high] = other.rate.map(|rate| significant(rate, 2));
    let rate = if low == high { low } else { format!("{low} to {high}") };
    format!("{}, {}, at {rate} {}", other.code, other.setting, other.unit)
}

/// Points that no other beats in both, as a line.
fn front(diagram: &CostDiagram, cost: Cost) -> Vec<[f64; 2]> {
    let all = diagram.settings.iter().flat_map(|s| &s.points);
    let mut points: Vec<[f64; 2]> = all.filter_map(|p| Some([cost.of(p), 100.0 * p.error?])).collect();
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let mut least = f64::INFINITY;
    points.retain(|p| {
        let better = p[1] < least;
        least = least.min(p[1]);
        better
    });
    points
}

/// The runs of a setting, as pieces without a failed run between them.
fn unbroken(setting: &CostSetting, cost: Cost) -> Vec<Vec<[f64; 2]>> {
    let point = |p: &CostPoint| p.error.map(|e| [cost.of(p), 100.0 * e]);
    let pieces = setting.points.split(|p| p.error.is_none());
    pieces.filter(|piece| !piece.is_empty()).map(|piece| piece.iter().filter_map(point).collect()).collect()
}

/// `Cheapest setting with error ≤ 5 %: half skin, 4 rows, 61 particles, 0.1 s; ≤ 1 %: …; ≤ 0.1 %: none.`
fn cheapest(diagram: &CostDiagram, cost: Cost) -> String {
    let failed = diagram.settings.iter().flat_map(|s| &s.points).filter(|p| p.error.is_none()).count();
    let gaps = if failed > 0 {
        format!(" {} left a gap: failed, or too long to try.", crate::format::count(failed, "run"))
    } else {
        String::new()
    };
    let parts: Vec<String> = TARGETS
        .iter()
        .map(|&target| {
            let found = cost::cheapest(diagram, target, cost);
            let Some(setting) = &found.setting else { return format!("≤ {}: none", percent(target)) };
            let particles =
                if found.particles > 0 { format!(", {} particles", found.particles) } else { String::new() };
            let price = match cost {
                Cost::Work | Cost::Run => format!("{} units of work", grouped(found.work)),
                Cost::Seconds => format!("{} s", significant(found.seconds, 2)),
            };
            format!("≤ {}: {setting}, {}{particles}, {price}", percent(target), found.level)
        })
        .collect();
    format!("Cheapest setting with error {}.{gaps}", parts.join("; "))
}
