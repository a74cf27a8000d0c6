//! Elements, particles, bonds, supports and arrows as SVG paths, from model coordinates.

use seam_cases::result::Picture;
use std::collections::BTreeSet;

/// Width of a drawing.
pub(super) const WIDTH: f64 = 1000.0;
/// Most height that bodies may take.
const MOST_HEIGHT: f64 = 460.0;

/// Least radius of a circle. A bonded particle that would be smaller is where its bonds meet.
const SMALLEST_CIRCLE: f64 = 2.5;

/// From model coordinates, in metres, y upwards, to the drawing.
pub(super) struct View {
    pub scale: f64,
    left: f64,
    top: f64,
    margin: [f64; 2],
    height: f64,
}

impl View {
    /// A view that shows all points with some room at the sides and above and below; `None` without points.
    pub(super) fn over<'a>(
        points: impl Iterator<Item = &'a [f64; 2]>,
        sides: f64,
        above: f64,
    ) -> Option<Self> {
        let finite = points.filter(|p| p[0].is_finite() && p[1].is_finite());
        let [x0, y0, x1, y1] = finite.fold(None, |b: Option<[f64; 4]>, [x, y]| {
            let [x0, y0, x1, y1] = b.unwrap_or([*x, *y, *x, *y]);
            Some([x0.min(*x), y0.min(*y), x1.max(*x), y1.max(*y)])
        })?;
        let (w, h) = (x1 - x0, y1 - y0);
        let room = WIDTH - 2.0 * sides;
        // A point has no size; it is drawn in the middle.
        let scale = (room / w.max(f64::MIN_POSITIVE)).min(MOST_HEIGHT / h.max(f64::MIN_POSITIVE));
        let scale = if scale.is_finite() { scale } else { 1.0 };
        let side = 0.5 * (WIDTH - scale * w);
        Some(View { scale, left: x0, top: y1, margin: [side, above], height: scale * h })
    }

    /// Height of the drawing, with as much room below as above.
    pub(super) fn height(&self) -> f64 {
        (self.height + 2.0 * self.margin[1]).ceil()
    }

    pub(super) fn at(&self, [x, y]: [f64; 2]) -> [f64; 2] {
        [self.margin[0] + self.scale * (x - self.left), self.margin[1] + self.scale * (self.top - y)]
    }

    /// Coordinates in tenths of a unit of the drawing: sums of steps between them are exact.
    fn tenths(&self, p: [f64; 2]) -> [i64; 2] {
        self.at(p).map(|v| (10.0 * v).round() as i64)
    }

    /// Coordinates of a path, to a tenth of a unit.
    pub(super) fn text(&self, p: [f64; 2]) -> String {
        let [x, y] = self.at(p);
        format!("{x:.1} {y:.1}")
    }
}

pub(super) fn path(class: &str, d: &str) -> String {
    if d.is_empty() { String::new() } else { format!("<path class=\"{class}\" d=\"{d}\"/>\n") }
}

pub(super) fn polygons(view: &View, elements: &[Vec<[f64; 2]>]) -> String {
    let mut d = String::new();
    for corners in elements {
        let at: Vec<[i64; 2]> = corners.iter().map(|c| view.tenths(*c)).collect();
        let Some(first) = at.first() else { continue };
        start(&mut d, *first);
        at.windows(2).for_each(|side| step(&mut d, side[0], side[1]));
        d.push('Z');
    }
    d
}

pub(super) fn line(view: &View, points: &[[f64; 2]]) -> String {
    let points: Vec<String> = points.iter().map(|p| view.text(*p)).collect();
    format!("M{}", points.join("L"))
}

/// Particles; of those too small to be seen as circles, only the ones without a bond.
pub(super) fn circles(
    view: &View,
    class: &str,
    centres: &[[f64; 2]],
    radii: &[f64],
    bonds: &[[usize; 2]],
) -> String {
    let bonded: BTreeSet<usize> = bonds.iter().flatten().copied().collect();
    let seen =
        |(i, (_, r)): &(usize, (&[f64; 2], &f64))| view.scale * **r >= SMALLEST_CIRCLE || !bonded.contains(i);
    let circle = |(_, (c, r)): (usize, (&[f64; 2], &f64))| {
        let [x, y] = view.at(*c);
        format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\"/>", view.scale * r)
    };
    let body: String = centres.iter().zip(radii).enumerate().filter(seen).map(circle).collect();
    if body.is_empty() { body } else { format!("<g class=\"{class}\">{body}</g>\n") }
}

/// Bonds as trails that go on from bond to bond while they can, in relative tenths of a unit: a third of the text of one
/// line per bond.
pub(super) fn bonds(view: &View, centres: &[[f64; 2]], bonds: &[[usize; 2]]) -> String {
    let at: Vec<[i64; 2]> = centres.iter().map(|c| view.tenths(*c)).collect();
    let mut at_point = vec![Vec::new(); at.len()];
    let there = |[i, j]: &[usize; 2]| *i < at.len() && *j < at.len();
    for (k, bond) in bonds.iter().enumerate().filter(|(_, bond)| there(bond)) {
        bond.iter().for_each(|&i| at_point[i].push(k));
    }
    let mut drawn: Vec<bool> = bonds.iter().map(|bond| !there(bond)).collect();
    let mut d = String::new();
    for first in 0..bonds.len() {
        if drawn[first] {
            continue;
        }
        let mut from = bonds[first][0];
        start(&mut d, at[from]);
        let mut next = Some(first);
        while let Some(k) = next {
            drawn[k] = true;
            let [i, j] = bonds[k];
            let to = if i == from { j } else { i };
            step(&mut d, at[from], at[to]);
            from = to;
            next = at_point[from].iter().copied().find(|&k| !drawn[k]);
        }
    }
    d
}

/// Begins a path of relative steps.
fn start(d: &mut String, [x, y]: [i64; 2]) {
    d.push('M');
    number(d, x, true);
    number(d, y, false);
    d.push('l');
}

fn step(d: &mut String, from: [i64; 2], to: [i64; 2]) {
    let first = d.ends_with('l');
    number(d, to[0] - from[0], first);
    number(d, to[1] - from[1], false);
}

/// Tenths as short as a path allows: `-.5` needs neither a zero nor a space before it.
fn number(d: &mut String, tenths: i64, first: bool) {
    let (whole, rest) = (tenths.abs() / 10, tenths.abs() % 10);
    if tenths < 0 {
        d.push('-');
    } else if !first {
        d.push(' ');
    }
    if whole > 0 || rest == 0 {
        d.push_str(&whole.to_string());
    }
    if rest > 0 {
        d.push('.');
        d.push_str(&rest.to_string());
    }
}

/// Where the bodies are held: at most nine triangles, evenly chosen, each pointing at its point from outside.
pub(super) fn supports(view: &View, p: &Picture) -> String {
    let all = || p.elements.iter().flatten().chain(&p.particles);
    let middle = |axis: usize| {
        let ends = all().map(|q| q[axis]).fold([f64::MAX, f64::MIN], |[lo, hi], v| [v.min(lo), v.max(hi)]);
        [0.5 * (ends[0] + ends[1]), 0.5 * (ends[1] - ends[0])]
    };
    let [x, y] = [middle(0), middle(1)];
    let one = |at: &[f64; 2]| {
        let off =
            [(at[0] - x[0]) / x[1].max(f64::MIN_POSITIVE), (at[1] - y[0]) / y[1].max(f64::MIN_POSITIVE)];
        let [px, py] = view.at(*at);
        match off {
            [a, b] if b.abs() > a.abs() && b < 0.0 => format!("M{px:.1} {py:.1}l-8 14h16Z"),
            [a, b] if b.abs() > a.abs() => format!("M{px:.1} {py:.1}l-8 -14h16Z"),
            [a, _] if a > 0.0 => format!("M{px:.1} {py:.1}l14 -8v16Z"),
            _ => format!("M{px:.1} {py:.1}l-14 -8v16Z"),
        }
    };
    thinned(&p.supports).map(one).collect()
}

/// At most nine of some symbols, evenly chosen, the last one among them: more would hide each other.
pub(super) fn thinned<T>(all: &[T]) -> impl Iterator<Item = &T> {
    let step = all.len().div_ceil(9).max(1);
    all.iter().rev().step_by(step)
}

/// An arrow that starts at the loaded point.
pub(super) fn arrow(view: &View, [at, [dx, dy]]: [[f64; 2]; 2]) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    /// Every bond once, whatever trails they make: the path is read back.
    #[test]
    fn every_bond_is_drawn_once() {
        let centres = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0]];
        let square = [[0, 1], [2, 0], [1, 3], [3, 2], [0, 3], [9, 0]];
        let view = View::over(centres.iter(), 0.0, 0.0).unwrap();
        let path = bonds(&view, &centres, &square);
        assert_eq!(path.matches('M').count(), 1, "{path}: one trail is enough");
        assert_eq!(path, "M270 460l460 0 0-460-460 0 0 460 460-460");
    }

    #[test]
    fn a_polygon_ends_where_it_began() {
        let corners = vec![[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        let view = View::over(corners.iter(), 0.0, 0.0).unwrap();
        assert_eq!(polygons(&view, &[corners, Vec::new()]), "M270 460l460 0 0-460-460 0Z");
    }

    #[test]
    fn numbers_are_short_and_apart() {
        let mut d = String::new();
        for (k, tenths) in [5, -5, 12, 0, -130, 7].into_iter().enumerate() {
            number(&mut d, tenths, k == 0);
        }
        assert_eq!(d, ".5-.5 1.2 0-13 .7");
    }

    #[test]
    fn small_particles_are_drawn_where_no_bond_shows_them() {
        let centres = [[0.0, 0.0], [1.0, 0.0], [0.5, 0.0]];
        let view = View::over(centres.iter(), 0.0, 0.0).unwrap();
        let count =
            |radius: f64| circles(&view, "", &centres, &[radius; 3], &[[0, 1]]).matches("<circle").count();
        assert_eq!((count(0.01), count(0.001)), (3, 1));
    }
}
