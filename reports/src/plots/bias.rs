//! Value over reference of all quantities at once, with bias and scatter.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::format::{signed_percent, significant};
use crate::results::{QuantityResult, Results};
use crate::statistics::bias::{Pair, bias};
use crate::terminal::kind_name;
use std::collections::BTreeMap;

/// Ratio of value and reference over the size of the reference, by kind of reference, with the bias δ and
/// the band δ(1 ± 2σ); `None` with fewer than two quantities that have a ratio.
pub fn scatter(results: &Results) -> Option<Figure> {
    let mut kinds: BTreeMap<&str, Vec<[f64; 2]>> = BTreeMap::new();
    let mut pairs = Vec::new();
    for q in results.cases.iter().flat_map(|c| &c.quantities) {
        if let Some(pair) = pair(q) {
            pairs.push(pair);
            kinds.entry(kind_name(q)).or_default().push([pair.reference.abs(), pair.model / pair.reference]);
        }
    }
    let b = bias(&pairs)?;
    let edges = [b.delta * (1.0 - 2.0 * b.sigma), b.delta * (1.0 + 2.0 * b.sigma)];
    let all = || kinds.values().flatten();
    let x = Axis::over("size of the reference (in its own unit)", true, all().map(|p| p[0]))?;
    let y = Axis::over("value / reference (1)", false, all().map(|p| p[1]).chain(edges).chain([1.0]))?;
    let [left, right] = x.range;
    let band = vec![[left, edges[0]], [right, edges[0]], [right, edges[1]], [left, edges[1]]];
    let mut layers = vec![
        Layer::Area { ink: Ink::Band, points: band },
        Layer::Line { ink: Ink::Reference, points: vec![[left, 1.0], [right, 1.0]] },
        Layer::Line { ink: Ink::Total, points: vec![[left, b.delta], [right, b.delta]] },
    ];
    let mut legend = vec![
        LegendEntry::line(Ink::Reference, "value = reference"),
        LegendEntry::line(Ink::Total, format!("bias δ = {}", significant(b.delta, 4))),
        LegendEntry::area(Ink::Band, "δ (1 ± 2σ)"),
    ];
    for (i, (kind, points)) in kinds.into_iter().enumerate() {
        legend.push(LegendEntry::dot(Ink::series(i), kind));
        layers.push(Layer::Dots { ink: Ink::series(i), points, radius: 8 });
    }
    let title = "Values over their references".to_owned();
    let note = format!(
        "Over {} quantities the values are {} off on average and scatter by {}.",
        b.count,
        signed_percent(b.delta - 1.0),
        crate::format::percent(b.sigma)
    );
    let chart = Chart { title, description: note.clone(), x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, note))
}

/// A quantity whose value and reference have a ratio.
fn pair(q: &QuantityResult) -> Option<Pair> {
    let pair = Pair { model: q.value?, reference: q.reference?, uncertainty: q.u_ref.unwrap_or(0.0) };
    // What is only shown, such as a count of particles, was not meant to agree.
    (q.verdict.is_some() && pair.model / pair.reference > 0.0).then_some(pair)
}
