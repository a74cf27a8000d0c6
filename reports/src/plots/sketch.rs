//! The scene as it is set up: bodies with their names, coupled faces, supports, loads and dimensions.

use super::shapes::{View, WIDTH, arrow, bonds, circles, line, path, polygons, supports, thinned};
use super::{Figure, LegendEntry, escape, open_svg, picture};
use crate::format::significant;
use seam_cases::result::{BodyOutline, Picture};

/// Room at the sides, for the height and its number.
const SIDES: f64 = 120.0;
/// Room above and below, for names and lengths.
const ABOVE: f64 = 104.0;
/// Width of a letter at the size that narrow windows use.
const LETTER: f64 = 20.0;

/// The undeformed model with names and dimensions; `None` where the result names no bodies.
pub fn sketch(p: &Picture) -> Option<Figure> {
    let ends = p.bodies.iter().flat_map(|b| &b.extent);
    let view = View::over(ends, SIDES, ABOVE)?;
    let title = "The scene".to_owned();
    let note = words(p);
    let mut svg =
        open_svg(WIDTH, view.height(), &title, &note).replacen("<svg ", "<svg class=\"sketch\" ", 1);
    svg.push_str(&path("shape-element", &polygons(&view, &p.elements)));
    svg.push_str(&circles(&view, "shape-particle", &p.particles, &p.radii, &p.bonds));
    svg.push_str(&path("shape-bond", &bonds(&view, &p.particles, &p.bonds)));
    let ties = p.ties.iter().filter(|t| t.line.len() > 1).map(|t| line(&view, &t.line));
    svg.push_str(&path("shape-tie", &ties.collect::<String>()));
    svg.push_str(&path("shape-support", &supports(&view, p)));
    let loads = thinned(&p.loads).map(|load| arrow(&view, *load));
    svg.push_str(&path("shape-load", &loads.collect::<String>()));
    p.bodies.iter().for_each(|b| svg.push_str(&name(&view, b)));
    svg.push_str(&dimensions(&view, &p.bodies));
    svg.push_str("</svg>");
    let mut legend = picture::legend(p);
    if !p.ties.is_empty() {
        legend.push(LegendEntry { ink: "shape-tie", mark: "line", text: "tied faces".to_owned() });
    }
    Some(Figure { title, svg, legend, note, csv: picture::csv(p) })
}

/// What stands where, in words: also for readers who cannot see it.
fn words(p: &Picture) -> String {
    let body = |b: &BodyOutline| {
        let [[x0, y0], [x1, y1]] = b.extent;
        format!("{} ({}, {} × {} m)", b.name, b.method, significant(x1 - x0, 3), significant(y1 - y0, 3))
    };
    let bodies: Vec<String> = p.bodies.iter().map(body).collect();
    let ties: Vec<String> = p.ties.iter().map(|t| format!("{} ({})", t.name, t.method)).collect();
    let tied = if ties.is_empty() { String::new() } else { format!(" Ties: {}.", ties.join(", ")) };
    format!("Bodies: {}.{tied}", bodies.join(", "))
}

/// The name of a body above it, where there is room for it.
fn name(view: &View, b: &BodyOutline) -> String {
    let [[x0, _], [x1, y1]] = b.extent;
    let [middle, top] = view.at([0.5 * (x0 + x1), y1]);
    let text = format!("{} · {}", b.name, b.method);
    if fits(&text, view.scale * (x1 - x0)) {
        label(middle, top - 58.0, "middle", &text)
    } else {
        String::new()
    }
}

fn fits(text: &str, width: f64) -> bool {
    text.chars().count() as f64 * LETTER < width
}

fn label(x: f64, y: f64, anchor: &str, text: &str) -> String {
    format!(
        "<text class=\"fill ink-text\" x=\"{x:.1}\" y=\"{y:.1}\" text-anchor=\"{anchor}\">{}</text>\n",
        escape(text)
    )
}

/// Lengths of the bodies in a row, the whole length below them, and the whole height at the right.
fn dimensions(view: &View, bodies: &[BodyOutline]) -> String {
    let ends = |axis: usize| {
        let all = bodies.iter().flat_map(|b| b.extent).map(|p| p[axis]);
        all.fold([f64::MAX, f64::MIN], |[lo, hi], v| [v.min(lo), v.max(hi)])
    };
    let ([x0, x1], [y0, y1]) = (ends(0), ends(1));
    let [right, bottom] = view.at([x1, y0]);
    let mut svg = String::new();
    let row = side_by_side(bodies);
    for [a, b] in &row {
        svg += &length(view, [*a, *b], bottom + 26.0);
    }
    svg += &length(view, [x0, x1], bottom + if row.is_empty() { 26.0 } else { 62.0 });
    if y1 > y0 {
        let [_, top] = view.at([x1, y1]);
        let x = right + 18.0;
        svg += &path(
            "dimension",
            &format!("M{x:.1} {top:.1}V{bottom:.1}M{:.1} {top:.1}h12M{:.1} {bottom:.1}h12", x - 6.0, x - 6.0),
        );
        svg += &label(x + 8.0, 0.5 * (top + bottom) + 9.0, "start", &metres(y1 - y0));
    }
    svg
}

/// Extents in x of two or more bodies that stand beside each other without overlap; else nothing.
fn side_by_side(bodies: &[BodyOutline]) -> Vec<[f64; 2]> {
    let mut row: Vec<[f64; 2]> = bodies.iter().map(|b| [b.extent[0][0], b.extent[1][0]]).collect();
    row.sort_by(|a, b| a[0].total_cmp(&b[0]));
    let whole = row.iter().map(|r| r[1]).fold(0.0f64, |m, v| m.max(v.abs()));
    let apart = row.windows(2).all(|w| w[1][0] >= w[0][1] - 1e-9 * whole);
    if row.len() > 1 && apart { row } else { Vec::new() }
}

fn length(view: &View, [a, b]: [f64; 2], y: f64) -> String {
    let [x0, x1] = [a, b].map(|x| view.at([x, 0.0])[0]);
    let text = metres(b - a);
    let line = path(
        "dimension",
        &format!("M{x0:.1} {y:.1}H{x1:.1}M{x0:.1} {:.1}v12M{x1:.1} {:.1}v12", y - 6.0, y - 6.0),
    );
    if fits(&text, x1 - x0) { line + &label(0.5 * (x0 + x1), y + 29.0, "middle", &text) } else { line }
}

fn metres(v: f64) -> String {
    format!("{} m", significant(v, 3))
}
