//! The deformed bodies over their undeformed outline.

use super::shapes::{View, arrow, bonds, circles, path, polygons, supports, thinned};
use super::{Figure, LegendEntry, csv_line, open_svg};
use crate::format::{count, significant};
use seam_cases::result::Picture;

/// Room around the bodies for supports and arrows.
const MARGIN: f64 = 56.0;

/// Undeformed outline, deformed elements, bonds and particles, supports and loads; `None` for an empty picture.
pub fn picture(p: &Picture) -> Option<Figure> {
    let elements = if p.deformed_elements.is_empty() { &p.elements } else { &p.deformed_elements };
    let particles = if p.deformed_particles.is_empty() { &p.particles } else { &p.deformed_particles };
    let drawn = [&p.elements, elements].into_iter().flatten().flatten().chain(&p.particles).chain(particles);
    let view = View::over(drawn, MARGIN, MARGIN)?;
    let bonds_there = p.bonds.len() + p.broken.len();
    let counts = [(p.elements.len(), "element"), (p.particles.len(), "particle"), (bonds_there, "bond")];
    let there = counts.into_iter().filter(|(n, _)| *n > 0).map(|(n, noun)| count(n, noun));
    let broken =
        if p.broken.is_empty() { String::new() } else { format!(", {} of them broken", p.broken.len()) };
    let description = format!(
        "{}{broken}; displacements enlarged {} times",
        there.collect::<Vec<_>>().join(", "),
        significant(p.scale, 3)
    );
    // Of several, all but the last say where on the way they are.
    let title = if p.id == "deformed" { "Deformed shape".to_owned() } else { p.title.clone() };
    let mut svg = open_svg(super::shapes::WIDTH, view.height(), &title, &description);
    svg.push_str(&path("shape-ghost", &polygons(&view, &p.elements)));
    svg.push_str(&circles(&view, "shape-ghost", &p.particles, &p.radii, &p.bonds));
    svg.push_str(&path("shape-element", &polygons(&view, elements)));
    svg.push_str(&circles(&view, "shape-particle", particles, &p.radii, &p.bonds));
    svg.push_str(&path("shape-bond", &bonds(&view, particles, &p.bonds)));
    svg.push_str(&path("shape-broken", &bonds(&view, particles, &p.broken)));
    svg.push_str(&path("shape-support", &supports(&view, p)));
    let loads = thinned(&p.loads).map(|[at, direction]| arrow(&view, [displaced(p, *at), *direction]));
    svg.push_str(&path("shape-load", &loads.collect::<String>()));
    svg.push_str("</svg>");
    let note = format!("{description}.");
    Some(Figure { title, svg, legend: legend(p), note, csv: csv(p) })
}

/// Corners of the elements and centres of the particles, where they are and where they are drawn, in metres.
pub(super) fn csv(p: &Picture) -> String {
    let mut text = csv_line(&["shape", "index", "x (m)", "y (m)", "drawn x (m)", "drawn y (m)"]);
    let mut add = |shape: &str, index: usize, at: &[f64; 2], drawn: &[f64; 2]| {
        let numbers = [at[0], at[1], drawn[0], drawn[1]].map(|v| format!("{v:?}"));
        let [x, y, dx, dy] = &numbers;
        text += &csv_line(&[shape, &index.to_string(), x, y, dx, dy]);
    };
    for (index, corners) in p.elements.iter().enumerate() {
        let drawn = p.deformed_elements.get(index).unwrap_or(corners);
        corners.iter().zip(drawn).for_each(|(at, drawn)| add("element", index, at, drawn));
    }
    for (index, at) in p.particles.iter().enumerate() {
        add("particle", index, at, p.deformed_particles.get(index).unwrap_or(at));
    }
    text
}

/// Where a point of the undeformed bodies has moved to: with the corner or particle nearest to it.
fn displaced(p: &Picture, at: [f64; 2]) -> [f64; 2] {
    let corners = p.elements.iter().flatten().zip(p.deformed_elements.iter().flatten());
    let particles = p.particles.iter().zip(&p.deformed_particles);
    let distance = |q: &[f64; 2]| (q[0] - at[0]).hypot(q[1] - at[1]);
    let nearest = corners.chain(particles).min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
    nearest.map_or(at, |(from, to)| [at[0] + to[0] - from[0], at[1] + to[1] - from[1]])
}

/// What is drawn how, for everything that is there.
pub(super) fn legend(p: &Picture) -> Vec<LegendEntry> {
    let entry = |ink, mark, text: &str| LegendEntry { ink, mark, text: text.to_owned() };
    let all = [
        (p.elements.is_empty(), entry("shape-element", "area", "finite elements")),
        (p.particles.is_empty(), entry("shape-particle", "dot", "particles")),
        (p.bonds.is_empty(), entry("shape-bond", "line", "bonds")),
        (p.broken.is_empty(), entry("shape-broken", "line", "broken bonds")),
        (p.supports.is_empty(), entry("shape-support", "area", "held")),
        (p.loads.is_empty(), entry("shape-load", "line", "load")),
    ];
    all.into_iter().filter(|(missing, _)| !missing).map(|(_, entry)| entry).collect()
}
