//! Error against cell size, with the fitted order.

use super::chart::{Axis, Chart, HEIGHT, LEFT, Layer};
use super::{Figure, Ink, LegendEntry};
use crate::format::significant;
use crate::statistics::convergence::fitted_order;
use plotters::style::text_anchor::HPos;
use seam_cases::result::Convergence;

/// How far below the levels the triangle stands, as a factor on the error.
const UNDER: f64 = 0.7;

/// Errors of a refinement study with the fitted line and a triangle of the formal order; `None` if there is
/// nothing to draw.
pub fn orders(study: &Convergence) -> Option<Figure> {
    let points: Vec<[f64; 2]> = study.h.iter().zip(&study.error).map(|(h, e)| [*h, *e]).collect();
    let x = Axis::over("cell size h (m)", true, points.iter().map(|p| p[0]))?;
    let y = Axis::over("relative error (1)", true, points.iter().flat_map(|p| [p[1], UNDER * p[1]]))?;
    let formal = significant(study.formal_order, 3);
    let mut layers = triangle(study, &formal);
    let mut legend = Vec::new();
    let mut note = format!("Theory gives order {formal}; the levels do not give one.");
    if let Some(fit) = fitted_order(&study.h, &study.error) {
        let ends = [study.h[0], study.h[study.h.len() - 1]];
        let line = ends.map(|h| [h, fit.constant * h.powf(fit.order)]).to_vec();
        layers.push(Layer::Line { ink: Ink::Series(0), points: line });
        let order = significant(fit.order, 3);
        legend.push(LegendEntry::line(Ink::Series(0), format!("fitted order {order}")));
        note = format!("Observed order {order}, theory {formal}.");
    }
    legend.push(LegendEntry::dot(Ink::Data, "levels"));
    layers.push(Layer::Dots { ink: Ink::Data, points, radius: 8 });
    let title = format!("Convergence: {}", study.label);
    let chart = Chart { title, description: note.clone(), x, y, layers, height: HEIGHT, left: LEFT };
    Some(chart.figure(legend, note))
}

/// A triangle of the formal order under the finest two levels.
fn triangle(study: &Convergence, formal: &str) -> Vec<Layer> {
    let n = study.h.len().min(study.error.len());
    if n < 2 {
        return Vec::new();
    }
    let (fine, coarse, e) = (study.h[n - 1], study.h[n - 2], UNDER * study.error[n - 1]);
    let top = e * (coarse / fine).powf(study.formal_order);
    let corners = vec![[fine, e], [coarse, e], [coarse, top], [fine, e]];
    vec![
        Layer::Line { ink: Ink::Axis, points: corners },
        Layer::Text { at: [coarse * 1.05, (e * top).sqrt()], anchor: HPos::Left, text: formal.to_owned() },
    ]
}
