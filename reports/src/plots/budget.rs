//! The signed parts of an error, as a waterfall.

use super::chart::{Axis, Chart, Layer, WIDTH};
use super::{Figure, Ink, LegendEntry, csv_line};
use crate::format::{signed_percent, typeset};
use plotters::style::text_anchor::HPos;
use seam_cases::result::Budget;

/// Height of one bar with its gap.
const ROW: u32 = 60;
/// Room for the names of the parts.
const LEFT: u32 = 380;

/// Waterfall of a budget: each bar starts where the one above it ends; `None` if it has no parts.
pub fn waterfall(budget: &Budget) -> Option<Figure> {
    if budget.parts.is_empty() {
        return None;
    }
    let mut bars: Vec<(String, f64, f64, Ink)> = Vec::new();
    let mut sum = 0.0;
    for part in &budget.parts {
        let ink = if part.value < 0.0 { Ink::Fall } else { Ink::Rise };
        bars.push((part.name.clone(), sum, sum + part.value, ink));
        sum += part.value;
    }
    bars.push(("total".to_owned(), 0.0, budget.total, Ink::Total));
    let ends = bars.iter().flat_map(|b| [100.0 * b.1, 100.0 * b.2]);
    let mut x = Axis::over("part of the error (%)", false, ends)?;
    // Room for the number that stands beside the outermost bar.
    let room = 0.45 * (x.range[1] - x.range[0]);
    x.range = [x.range[0] - room, x.range[1] + room];
    let count = bars.len() as f64;
    let y = Axis {
        label: String::new(),
        // From the first bar at the top down to the total.
        range: [count - 0.4, -0.6],
        log: false,
        names: bars.iter().map(|b| b.0.clone()).collect(),
    };
    let mut layers = vec![Layer::Line { ink: Ink::Axis, points: vec![[0.0, count - 0.4], [0.0, -0.6]] }];
    for (row, (_, from, to, ink)) in bars.iter().enumerate() {
        layers.extend(bar(row as f64, 100.0 * from, 100.0 * to, *ink, room));
    }
    let parts: Vec<String> = bars.iter().map(|b| format!("{} {}", b.0, signed_percent(b.2 - b.1))).collect();
    let chart = Chart {
        title: budget.title.clone(),
        description: parts.join(", "),
        x,
        y,
        layers,
        height: 132 + ROW * bars.len() as u32,
        left: LEFT.min(WIDTH / 3),
    };
    let legend = vec![
        LegendEntry::area(Ink::Rise, "raises the value"),
        LegendEntry::area(Ink::Fall, "lowers it"),
        LegendEntry::area(Ink::Total, "total"),
    ];
    let note = format!("{}. {}", budget.quantity, cancelling(budget));
    Some(chart.figure_of(legend, note, csv(budget)))
}

/// The parts and their total, as fractions.
fn csv(budget: &Budget) -> String {
    let mut text = csv_line(&["part", &budget.quantity, "scatter", "difference of"]);
    for p in &budget.parts {
        let scatter = p.scatter.map_or(String::new(), |s| format!("{s:?}"));
        text += &csv_line(&[&p.name, &format!("{:?}", p.value), &scatter, &p.how]);
    }
    text + &csv_line(&["total", &format!("{:?}", budget.total), "", ""])
}

fn bar(row: f64, from: f64, to: f64, ink: Ink, room: f64) -> [Layer; 2] {
    let (top, bottom) = (row - 0.32, row + 0.32);
    let (beside, anchor) =
        if to < from { (to - 0.04 * room, HPos::Right) } else { (to + 0.04 * room, HPos::Left) };
    [
        Layer::Area { ink, points: vec![[from, top], [to, top], [to, bottom], [from, bottom]] },
        Layer::Text { at: [beside, row], anchor, text: typeset(&signed_percent(0.01 * (to - from))) },
    ]
}

/// How much of the parts cancels: a small total proves nothing if they are large.
fn cancelling(budget: &Budget) -> String {
    let gross: f64 = budget.parts.iter().map(|p| p.value.abs()).sum();
    let hidden = gross - budget.parts.iter().map(|p| p.value).sum::<f64>().abs();
    if gross == 0.0 {
        return String::new();
    }
    format!(
        "Parts of {} in all, of which {} cancel, leave {}.",
        crate::format::percent(gross),
        crate::format::share(hidden / gross),
        signed_percent(budget.total)
    )
}
