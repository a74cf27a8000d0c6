//! A beam with a notch at mid-span: a grid refined towards the tip whose slit is opened into a V.

use super::mesh::{Facet, Mesh};
use super::refined::{Refinement, refined};
use super::structured::{BOX_SIDES, mapped};
use crate::error::{Error, Result};
use crate::space::Space;
use std::collections::{BTreeMap, BTreeSet};
use std::f64::consts::PI;

/// Name of the boundary of both flanks.
pub const FLANKS: &str = "notch";

/// The beam `|x| ≤ length/2`, `0 ≤ y ≤ depth`, notched from below at x = 0; lengths in m.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NotchedBeam {
    /// Along x.
    pub length: f64,
    /// Along y: W.
    pub depth: f64,
    /// Of the notch: a.
    pub notch_depth: f64,
    /// Between the flanks: ω, in rad; zero is a crack.
    pub angle: f64,
    /// Distance c from mid-span beyond which the grid stays rectangular. Above `a tan(ω/2)`.
    pub reach: f64,
}

/// Coordinates that must be grid lines, in m, beside the ends and the tip; supports and loads stand on them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Through {
    /// Lines x = const. Where `|x| ≥ c` they stay straight.
    pub x: Vec<f64>,
    /// Lines y = const.
    pub y: Vec<f64>,
    /// Layers of a solid, ascending; empty in the plane.
    pub z: Vec<f64>,
}

/// The mesh, and where its tip is.
#[derive(Debug, Clone, PartialEq)]
pub struct NotchedMesh {
    /// Q4 or H8; sides named by [`BOX_SIDES`], the flanks by [`FLANKS`].
    pub mesh: Mesh,
    /// Nodes of the tip, one in the plane, one per layer in the solid.
    pub tip: Vec<usize>,
}

impl NotchedBeam {
    /// Checks the proportions.
    ///
    /// # Errors
    /// A notch outside the beam, an angle not in [0, π), a reach that the mouth does not fit in or beyond the ends.
    pub fn check(&self) -> Result<()> {
        let Self { length, depth, notch_depth, angle, reach } = *self;
        if ![length, depth].iter().all(|x| x.is_finite() && *x > 0.0) {
            return Err(bad(format!("length {length} m, depth {depth} m; give positive lengths")));
        }
        if !(notch_depth > 0.0 && notch_depth < depth) {
            return Err(bad(format!(
                "the notch, {notch_depth} m deep, does not end inside the beam of depth {depth} m; \
                 give a depth between zero and that"
            )));
        }
        if !(0.0..PI).contains(&angle) {
            return Err(bad(format!(
                "the flanks open by {:.6}°; give an angle from 0° (a crack) to below 180°",
                angle.to_degrees()
            )));
        }
        let mouth = self.half_opening(0.0);
        if !(reach > mouth && reach <= 0.5 * length) {
            return Err(bad(format!(
                "a grid opened within {reach} m of mid-span inverts its cells or leaves the beam; the reach must lie above \
                 half the mouth, {mouth} m, and not beyond the ends, {} m",
                0.5 * length
            )));
        }
        Ok(())
    }

    /// Half the width of the notch at height y, in m.
    pub fn half_opening(&self, y: f64) -> f64 {
        (self.notch_depth - y).max(0.0) * (0.5 * self.angle).tan()
    }

    /// Meshes it: nodes on the slit `x = 0`, `y < a` are doubled, then the slit opens by
    ///
    /// `x' = x ± (a − y) tan(ω/2) (1 − |x|/c)` for `|x| < c`, `y < a`.
    ///
    /// Grid lines x = const stay in order, since `∂x'/∂x = 1 − (a − y) tan(ω/2)/c > 0`: no cell inverts.
    ///
    /// # Errors
    /// As [`NotchedBeam::check`]; lines to pass through that lie outside; more lines than can be meant.
    pub fn mesh(&self, refinement: Refinement, through: &Through) -> Result<NotchedMesh> {
        self.check()?;
        let half = 0.5 * self.length;
        let xs = refined([-half, half], 0.0, &through.x, refinement)?;
        let ys = refined([0.0, self.depth], self.notch_depth, &through.y, refinement)?;
        let (middle, tip) = (line(&xs, 0.0)?, line(&ys, self.notch_depth)?);
        let axes = match through.z.is_empty() {
            true => vec![xs, ys],
            false => vec![xs, ys, through.z.clone()],
        };
        let counts = [axes[0].len(), axes[1].len(), through.z.len().max(1)];
        let mut mesh = mapped(&axes, BOX_SIDES, |x| x)?;
        let right = split(&mut mesh, counts, [middle, tip]);
        for (n, x) in mesh.nodes.iter_mut().enumerate() {
            let side = if x.x > 0.0 || right.contains(&n) { 1.0 } else { -1.0 };
            x.x += side * self.half_opening(x.y) * (1.0 - x.x.abs() / self.reach).max(0.0);
        }
        let tip = (0..counts[2]).map(|k| (k * counts[1] + tip) * counts[0] + middle).collect();
        Ok(NotchedMesh { mesh, tip })
    }
}

/// Doubles the nodes of the slit, gives the new ones to the cells on its right, and names the flanks. Returns the new nodes.
fn split(mesh: &mut Mesh, [nx, ny, nz]: [usize; 3], [middle, tip]: [usize; 2]) -> BTreeSet<usize> {
    let mut copy = BTreeMap::new();
    for k in 0..nz {
        for j in 0..tip {
            let old = (k * ny + j) * nx + middle;
            copy.insert(old, mesh.nodes.len());
            mesh.nodes.push(mesh.nodes[old]);
        }
    }
    let per = mesh.nodes_per_cell();
    let on_right = |cell: usize| cell % (nx - 1) >= middle;
    for (at, node) in mesh.cells.iter_mut().enumerate() {
        if let Some(&new) = copy.get(node).filter(|_| on_right(at / per)) {
            *node = new;
        }
    }
    for facet in mesh.boundaries.values_mut().flatten().filter(|f| on_right(f.cell)) {
        facet.nodes.iter_mut().for_each(|n| *n = copy.get(n).copied().unwrap_or(*n));
    }
    // Facets at low and high x in the order of Q4 and H8.
    let [low, high] = if mesh.space == Space::Plane { [3, 1] } else { [5, 3] };
    let mut flanks: Vec<Facet> = Vec::new();
    for cell in 0..mesh.cell_count() {
        let (i, j) = (cell % (nx - 1), cell / (nx - 1) % (ny - 1));
        if j < tip && (i + 1 == middle || i == middle) {
            flanks.extend(mesh.cell_facets(cell).nth(if i == middle { low } else { high }));
        }
    }
    mesh.boundaries.insert(FLANKS.to_owned(), flanks);
    copy.into_values().collect()
}

/// Index of a grid line; `refined` has put one there, to the bit.
fn line(lines: &[f64], at: f64) -> Result<usize> {
    lines.iter().position(|x| *x == at).ok_or_else(|| bad(format!("no grid line at {at} m")))
}

fn bad(message: String) -> Error {
    Error::Geometry { what: "notched beam".to_owned(), message }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::quadrature::tensor_gauss;
    use crate::space::Vec3;
    use proptest::prelude::*;

    const BEAM: NotchedBeam =
        NotchedBeam { length: 4.4, depth: 1.0, notch_depth: 0.4, angle: 0.0, reach: 1.5 };
    const COARSE: Refinement = Refinement { finest: 0.02, growth: 1.5, coarsest: 0.2 };

    fn measure(mesh: &Mesh) -> (f64, f64) {
        let rule = tensor_gauss(mesh.space.dim(), 2);
        let points = || (0..mesh.cell_count()).flat_map(|c| rule.iter().map(move |&(xi, w)| (c, xi, w)));
        let sum = points().map(|(c, xi, w)| mesh.sample(c, xi).determinant * w).sum();
        (sum, points().map(|(c, xi, _)| mesh.sample(c, xi).determinant).fold(f64::INFINITY, f64::min))
    }

    fn area(mesh: &Mesh, name: &str) -> f64 {
        let rule = tensor_gauss(mesh.space.dim() - 1, 2);
        let facets = mesh.boundaries[name].iter();
        facets
            .flat_map(|f| rule.iter().map(|(eta, w)| mesh.facet_point(f, [eta[0], eta[1]]).measure * w))
            .sum()
    }

    proptest! {
        /// `A = L W − a² tan(ω/2)`, and no cell is inverted, at corners neither.
        #[test]
        fn area_is_exact_and_cells_are_sound(
            notch_depth in 0.05..0.95f64,
            degrees in 0.0..150.0f64,
            room in 1.01..2.0f64,
            growth in 1.0..2.0f64,
        ) {
            let angle = degrees.to_radians();
            let mouth = notch_depth * (0.5 * angle).tan();
            let reach = (room * mouth).max(0.1);
            let beam = NotchedBeam { length: 2.0 * reach + 1.0, notch_depth, angle, reach, ..BEAM };
            let refinement = Refinement { finest: 0.05, growth, coarsest: 0.3 };
            let mesh = beam.mesh(refinement, &Through::default()).unwrap().mesh;
            let (sum, _) = measure(&mesh);
            let exact = beam.length * beam.depth - notch_depth * mouth;
            prop_assert!((sum / exact - 1.0).abs() < 1e-12, "{sum} {exact}");
            let corners = (0..mesh.cell_count()).flat_map(|c| (0..4).map(move |a| (c, a)));
            for (c, a) in corners {
                prop_assert!(mesh.sample(c, mesh.corner(a)).determinant > 0.0, "cell {c}");
            }
            // Both flanks, each a/cos(ω/2) long; the mouth is missing from below.
            prop_assert!((area(&mesh, FLANKS) * (0.5 * angle).cos() / (2.0 * notch_depth) - 1.0).abs() < 1e-12);
            prop_assert!((area(&mesh, "bottom") - (beam.length - 2.0 * mouth)).abs() < 1e-12);
            prop_assert!((area(&mesh, "top") - beam.length).abs() < 1e-12);
        }
    }

    #[test]
    fn the_boundary_is_whole_and_the_flanks_look_outwards() {
        for z in [vec![], vec![0.0, 0.3, 0.6]] {
            let beam = NotchedBeam { angle: 1.0, ..BEAM };
            let NotchedMesh { mesh, tip } =
                beam.mesh(COARSE, &Through { z: z.clone(), ..Through::default() }).unwrap();
            let named: usize = mesh.boundaries.values().map(Vec::len).sum();
            assert_eq!(mesh.free_facets().len(), named);
            assert_eq!(tip.len(), z.len().max(1));
            for &node in &tip {
                assert!((mesh.nodes[node] - Vec3::new(0.0, 0.4, mesh.nodes[node].z)).norm() == 0.0);
            }
            // n = ∓(cos ω/2, ± sin ω/2): out of the material, into the notch, downwards.
            for facet in &mesh.boundaries[FLANKS] {
                let at = mesh.facet_point(facet, [0.0, 0.0]);
                let normal = Vec3::new(-at.position.x.signum() * 0.5f64.cos(), -(0.5f64.sin()), 0.0);
                assert!((at.normal - normal).norm() < 1e-12, "{} at {}", at.normal, at.position);
            }
            let depth = if z.is_empty() { 1.0 } else { 0.6 };
            let exact = depth * (4.4 - 0.16 * 0.5f64.tan());
            assert!((measure(&mesh).0 - exact).abs() < 1e-12);
        }
    }

    #[test]
    fn asked_lines_are_there_and_straight_beyond_the_reach() {
        let beam = NotchedBeam { angle: 1.5, ..BEAM };
        let through = Through { x: vec![-2.0, -1.6, 1.6, 2.0], y: vec![0.7], z: vec![] };
        let mesh = beam.mesh(COARSE, &through).unwrap().mesh;
        for &x in &through.x {
            let on = mesh.nodes.iter().filter(|p| p.x == x);
            assert_eq!(on.clone().count(), mesh.nodes.iter().filter(|p| p.x == -2.2).count(), "{x}");
            assert!(on.clone().any(|p| p.y == 0.0) && on.clone().any(|p| p.y == 1.0));
        }
        assert!(mesh.nodes.iter().any(|p| p.y == 0.7 && p.x == 0.0));
        // Finest at the tip, mirrored about mid-span.
        assert!(mesh.nodes.iter().any(|p| p.x == 0.0 && p.y > 0.4 && p.y - 0.4 <= 0.02 * 1.000_001));
        assert!(mesh.nodes.iter().all(|p| mesh.nodes.iter().any(|q| q.x == -p.x && q.y == p.y)));
    }

    #[test]
    fn impossible_notches_are_refused() {
        let refused = |beam: NotchedBeam, words: &str| {
            let error = beam.mesh(COARSE, &Through::default()).unwrap_err().to_string();
            assert!(error.contains(words), "'{words}' is missing in: {error}");
        };
        for notch_depth in [0.0, -0.1, 1.0, 1.2, f64::NAN] {
            refused(NotchedBeam { notch_depth, ..BEAM }, "does not end inside");
        }
        for angle in [-0.1, PI, f64::NAN] {
            refused(NotchedBeam { angle, ..BEAM }, "below 180°");
        }
        refused(NotchedBeam { angle: 2.0 * f64::atan(4.0), ..BEAM }, "half the mouth, 1.6");
        refused(NotchedBeam { reach: 3.0, ..BEAM }, "not beyond the ends, 2.2");
        refused(NotchedBeam { length: 0.0, ..BEAM }, "positive lengths");
        let through = |x: f64| Through { x: vec![x], ..Through::default() };
        assert!(BEAM.mesh(COARSE, &through(3.0)).is_err() && BEAM.mesh(COARSE, &through(f64::NAN)).is_err());
    }
}
