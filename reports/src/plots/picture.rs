//! Bodies drawn from the model: elements, bonds, particles, supports and loads.

use super::{Figure, LegendEntry, open_svg};
use crate::format::significant;
use seam_cases::result::Picture;

/// Width of the drawing, and room around the bodies for supports and arrows.
const WIDTH: f64 = 1000.0;
const MARGIN: f64 = 56.0;

/// From model coordinates, in metres, y upwards, to the drawing.
struct View {
    scale: f64,
    left: f64,
    top: f64,
}

impl View {
    fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [MARGIN + self.scale * (x - self.left), MARGIN + self.scale * (self.top - y)]
    }

    /// Coordinates of a path, to a tenth of a unit.
    fn text(&self, p: [f64; 2]) -> String {
        let [x, y] = self.at(p);
        format!("{x:.1} {y:.1}")
    }
}

/// Undeformed outline, deformed elements, bonds and particles, supports and loads; `None` for an empty picture.
pub fn picture(p: &Picture) -> Option<Figure> {
    let elements = if p.deformed_elements.is_empty() { &p.elements } else { &p.deformed_elements };
    let particles = if p.deformed_particles.is_empty() { &p.particles } else { &p.deformed_particles };
    let drawn = [&p.elements, elements].into_iter().flatten().flatten().chain(&p.particles).chain(particles);
    let finite = drawn.filter(|p| p[0].is_finite() && p[1].is_finite());
    let bounds = finite.fold(None, |b: Option<[f64; 4]>, [x, y]| {
        let [x0, y0, x1, y1] = b.unwrap_or([*x, *y, *x, *y]);
        Some([x0.min(*x), y0.min(*y), x1.max(*x), y1.max(*y)])
    });
    let [x0, y0, x1, y1] = bounds?;
    let scale = (WIDTH - 2.0 * MARGIN) / (x1 - x0).max(y1 - y0).max(f64::MIN_POSITIVE);
    let view = View { scale, left: x0, top: y1 };
    let height = scale * (y1 - y0) + 2.0 * MARGIN;
    let broken =
        if p.broken.is_empty() { String::new() } else { format!(", {} of them broken", p.broken.len()) };
    let description = format!(
        "{} elements, {} particles and {} bonds{broken}; displacements enlarged {} times",
        p.elements.len(),
        p.particles.len(),
        p.bonds.len() + p.broken.len(),
        significant(p.scale, 3)
    );
    let mut svg = open_svg(WIDTH, height.ceil(), &p.title, &description);
    svg.push_str(&path("shape-ghost", &polygons(&view, &p.elements)));
    svg.push_str(&circles(&view, "shape-ghost", &p.particles, &p.radii));
    svg.push_str(&path("shape-element", &polygons(&view, elements)));
    svg.push_str(&circles(&view, "shape-particle", particles, &p.radii));
    svg.push_str(&path("shape-bond", &bonds(&view, particles, &p.bonds)));
    svg.push_str(&path("shape-bond", &bonds(&view, particles, &p.bonds)));
    svg.push_str(&path("shape-broken", &bonds(&view, particles, &p.broken)));
    svg.push_str(&path(
        "shape-support",
        &thinned(&p.supports).map(|at| support(&view, *at)).collect::<String>(),
    ));
    let loads = thinned(&p.loads).map(|[at, direction]| arrow(&view, [displaced(p, *at), *direction]));
    svg.push_str(&path("shape-load", &loads.collect::<String>()));
    svg.push_str("</svg>");
    Some(Figure { title: p.title.clone(), svg, legend: legend(p), note: format!("{description}.") })
}

fn path(class: &str, d: &str) -> String {
    if d.is_empty() { String::new() } else { format!("<path class=\"{class}\" d=\"{d}\"/>\n") }
}

fn polygons(view: &View, elements: &[Vec<[f64; 2]>]) -> String {
    let one = |corners: &Vec<[f64; 2]>| {
        let points: Vec<String> = corners.iter().map(|c| view.text(*c)).collect();
        format!("M{}Z", points.join("L"))
    };
    elements.iter().filter(|e| !e.is_empty()).map(one).collect()
}

fn circles(view: &View, class: &str, centres: &[[f64; 2]], radii: &[f64]) -> String {
    let circle = |(c, r): (&[f64; 2], &f64)| {
        let [x, y] = view.at(*c);
        format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\"/>", view.scale * r)
    };
    let body: String = centres.iter().zip(radii).map(circle).collect();
    if body.is_empty() { body } else { format!("<g class=\"{class}\">{body}</g>\n") }
}

fn bonds(view: &View, centres: &[[f64; 2]], bonds: &[[usize; 2]]) -> String {
    let one = |[i, j]: &[usize; 2]| {
        Some(format!("M{}L{}", view.text(*centres.get(*i)?), view.text(*centres.get(*j)?)))
    };
    bonds.iter().filter_map(one).collect()
}

/// At most nine of some symbols, evenly chosen, the last one among them: more would hide each other.
fn thinned<T>(all: &[T]) -> impl Iterator<Item = &T> {
    let step = all.len().div_ceil(9).max(1);
    all.iter().rev().step_by(step)
}

/// Where a point of the undeformed bodies has moved to: with the corner or particle nearest to it.
fn displaced(p: &Picture, at: [f64; 2]) -> [f64; 2] {
    let corners = p.elements.iter().flatten().zip(p.deformed_elements.iter().flatten());
    let particles = p.particles.iter().zip(&p.deformed_particles);
    let distance = |q: &[f64; 2]| (q[0] - at[0]).hypot(q[1] - at[1]);
    let nearest = corners.chain(particles).min_by(|(a, _), (b, _)| distance(a).total_cmp(&distance(b)));
    nearest.map_or(at, |(from, to)| [at[0] + to[0] - from[0], at[1] + to[1] - from[1]])
}

/// A small triangle whose tip is the held point, standing to its left.
fn support(view: &View, at: [f64; 2]) -> String {
    let [x, y] = view.at(at);
    format!("M{x:.1} {y:.1}l-14 -8v16Z")
}

/// An arrow that starts at the loaded point.
fn arrow(view: &View, [at, [dx, dy]]: [[f64; 2]; 2]) -> String {
    let [x, y] = view.at(at);
    // The drawing's y axis points downwards. Shaft 38, head 10 long and 8 wide.
    let (dx, dy) = (dx, -dy);
    let (tx, ty) = (x + 38.0 * dx, y + 38.0 * dy);
    let (bx, by) = (tx - 10.0 * dx, ty - 10.0 * dy);
    format!(
        "M{x:.1} {y:.1}L{tx:.1} {ty:.1}M{:.1} {:.1}L{tx:.1} {ty:.1}L{:.1} {:.1}",
        bx - 4.0 * dy,
        by + 4.0 * dx,
        bx + 4.0 * dy,
        by - 4.0 * dx
    )
}

fn legend(p: &Picture) -> Vec<LegendEntry> {
    let entry = |ink, mark, text: &str| LegendEntry { ink, mark, text: text.to_owned() };
    let mut legend = Vec::new();
    if !p.elements.is_empty() {
        legend.push(entry("shape-element", "area", "finite elements"));
    }
    if !p.particles.is_empty() {
        legend.push(entry("shape-particle", "dot", "particles"));
    }
    if !p.bonds.is_empty() {
        legend.push(entry("shape-bond", "line", "bonds"));
    }
    if !p.broken.is_empty() {
        legend.push(entry("shape-broken", "line", "broken bonds"));
    }
    if !p.supports.is_empty() {
        legend.push(entry("shape-support", "area", "held"));
    }
    if !p.loads.is_empty() {
        legend.push(entry("shape-load", "line", "load"));
    }
    legend
}
