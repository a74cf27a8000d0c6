//! Elements, particles, bonds, supports and arrows as SVG paths, from model coordinates.

use seam_cases::result::Picture;

/// Width of a drawing.
pub(super) const WIDTH: f64 = 1000.0;
/// Most height that bodies may take.
const MOST_HEIGHT: f64 = 460.0;

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
    let one = |corners: &Vec<[f64; 2]>| format!("{}Z", line(view, corners));
    elements.iter().filter(|e| !e.is_empty()).map(one).collect()
}

pub(super) fn line(view: &View, points: &[[f64; 2]]) -> String {
    let points: Vec<String> = points.iter().map(|p| view.text(*p)).collect();
    format!("M{}", points.join("L"))
}

pub(super) fn circles(view: &View, class: &str, centres: &[[f64; 2]], radii: &[f64]) -> String {
    let circle = |(c, r): (&[f64; 2], &f64)| {
        let [x, y] = view.at(*c);
        format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{:.1}\"/>", view.scale * r)
    };
    let body: String = centres.iter().zip(radii).map(circle).collect();
    if body.is_empty() { body } else { format!("<g class=\"{class}\">{body}</g>\n") }
}

pub(super) fn bonds(view: &View, centres: &[[f64; 2]], bonds: &[[usize; 2]]) -> String {
    let one = |[i, j]: &[usize; 2]| {
        Some(format!("M{}L{}", view.text(*centres.get(*i)?), view.text(*centres.get(*j)?)))
    };
    bonds.iter().filter_map(one).collect()
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
