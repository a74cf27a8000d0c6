//! A facet seen from its cell: positions, normals, shape functions and their gradients on it.

use super::locate::Location;
use super::mesh::{Facet, Mesh};
use super::sample::Sample;
use crate::space::{Space, Vec3};

/// A point of a facet.
#[derive(Debug, Clone, PartialEq)]
pub struct FacetPoint {
    /// Position, in metres.
    pub position: Vec3,
    /// Tangents `∂x/∂η`, in metres; in the plane the second one is the unit vector out of it.
    pub tangents: [Vec3; 2],
    /// Outward unit normal; zero on a flat facet.
    pub normal: Vec3,
    /// Length (plane, m) or area (solid, m²) per unit of the facet's own coordinates.
    pub measure: f64,
    /// Natural coordinates in the cell.
    pub xi: [f64; 3],
    /// The cell's shape functions and gradients there.
    pub sample: Sample,
}

/// Corners of an edge and of a face in the facet's own coordinates `η`.
const EDGE: [[f64; 2]; 2] = [[-1.0, 0.0], [1.0, 0.0]];
const FACE: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];

impl Mesh {
    /// The point of a facet at its own coordinates `eta` in `[−1, 1]` (first one only in the
    /// plane), running from its first node to its second, in the solid also from the first to the fourth.
    ///
    /// A facet is the image of a flat facet of the reference cell, so `ξ(η)` interpolates the
    /// natural coordinates of its corners, and tangents are `J ∂ξ/∂η`.
    pub fn facet_point(&self, facet: &Facet, eta: [f64; 2]) -> FacetPoint {
        let corners = self.facet_corners(facet);
        let mut xi = Vec3::zeros();
        let mut slopes = [Vec3::zeros(); 2];
        for (corner, e) in corners.iter().zip(self.facet_coordinates()) {
            let (first, second) = match self.space {
                Space::Plane => (0.5 * (1.0 + e[0] * eta[0]), 1.0),
                Space::Solid => (0.5 * (1.0 + e[0] * eta[0]), 0.5 * (1.0 + e[1] * eta[1])),
            };
            xi += corner * (first * second);
            slopes[0] += corner * (0.5 * e[0] * second);
            slopes[1] += corner * (0.5 * e[1] * first);
        }
        // The coordinate that is constant on the facet exactly, so that nodes off it weigh nothing.
        for i in 0..3 {
            if corners.iter().all(|c| c[i] == corners[0][i]) {
                xi[i] = corners[0][i];
            }
        }
        let sample = self.sample(facet.cell, xi.into());
        let along = sample.jacobian * slopes[0];
        let across = match self.space {
            Space::Plane => Vec3::z(),
            Space::Solid => sample.jacobian * slopes[1],
        };
        let normal = along.cross(&across);
        let measure = normal.norm();
        let normal = normal.try_normalize(0.0).unwrap_or_default();
        FacetPoint {
            position: sample.position,
            tangents: [along, across],
            normal,
            measure,
            xi: xi.into(),
            sample,
        }
    }

    /// Coordinates `η` of the point of a facet nearest to `x`, by Gauss–Newton, clamped to the facet.
    pub fn project_on_facet(&self, facet: &Facet, x: Vec3) -> [f64; 2] {
        let mut eta = [0.0; 2];
        for _ in 0..25 {
            let point = self.facet_point(facet, eta);
            let step = least_squares(point.tangents, x - point.position);
            let next: [f64; 2] = std::array::from_fn(|i| (eta[i] + step[i]).clamp(-1.0, 1.0));
            let moved = (next[0] - eta[0]).abs().max((next[1] - eta[1]).abs());
            eta = next;
            if moved <= 1e-15 {
                break;
            }
        }
        eta
    }

    /// Values and gradients of the shape functions of the facet's cell at the point of the facet
    /// nearest to `x`.
    pub fn trace(&self, facet: &Facet, x: Vec3) -> Location {
        let point = self.facet_point(facet, self.project_on_facet(facet, x));
        Location::new(self, facet.cell, point.xi, &point.sample)
    }

    fn facet_coordinates(&self) -> &'static [[f64; 2]] {
        match self.space {
            Space::Plane => &EDGE,
            Space::Solid => &FACE,
        }
    }

    /// Natural coordinates of the corners of a facet in its cell.
    fn facet_corners(&self, facet: &Facet) -> Vec<Vec3> {
        let cell = self.cell(facet.cell);
        let local = |node: &usize| cell.iter().position(|n| n == node);
        self.facet_nodes(facet).iter().filter_map(local).map(|a| self.corner(a).into()).collect()
    }
}

/// `min |s·a + t·b − gap|` over `s, t`; zero where `a` and `b` are parallel.
fn least_squares([a, b]: [Vec3; 2], gap: Vec3) -> [f64; 2] {
    let (aa, ab, bb) = (a.norm_squared(), a.dot(&b), b.norm_squared());
    let (f, g) = (a.dot(&gap), b.dot(&gap));
    let determinant = aa * bb - ab * ab;
    if determinant > 0.0 {
        [(bb * f - ab * g) / determinant, (aa * g - ab * f) / determinant]
    } else {
        [0.0; 2]
    }
}

#[cfg(test)]
mod tests {
    use crate::fem::structured::{even, grid, jiggle, quadrilateral};
    use crate::space::Vec3;
    use nalgebra::Matrix3;

    /// On a facet only its own nodes have weight, positions are reproduced, and the gradient of a
    /// linear field comes out, also normal to the facet.
    #[test]
    fn trace_is_linearly_complete_on_every_facet() {
        let corners =
            [[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
        let lines = even(0.0, 1.0, 3).unwrap();
        let plane = quadrilateral(corners, &lines, &lines).unwrap();
        let lines = [even(0.0, 2.0, 3).unwrap(), even(0.0, 1.0, 3).unwrap(), even(0.0, 1.0, 3).unwrap()];
        let mut solid = grid(&lines).unwrap();
        jiggle(&mut solid, 0.2, 3);
        for mesh in [plane, solid] {
            for facet in (0..mesh.cell_count()).flat_map(|c| mesh.cell_facets(c).collect::<Vec<_>>()) {
                let x = mesh.facet_point(&facet, [0.37, -0.61]).position;
                let trace = mesh.trace(&facet, x);
                let size = x.norm().max(1.0);
                let mut position = Vec3::zeros();
                let mut slope = Matrix3::zeros();
                for (&(node, weight), &(_, gradient)) in trace.weights.iter().zip(&trace.gradients) {
                    position += mesh.nodes[node] * weight;
                    slope += mesh.nodes[node] * gradient.transpose();
                    assert!(mesh.facet_nodes(&facet).contains(&node) || weight.abs() < 1e-14);
                }
                assert!((position - x).norm() < 1e-13 * size);
                let dim = mesh.space.dim();
                let identity = Matrix3::from_fn(|i, j| f64::from(i == j && i < dim));
                assert!((slope - identity).norm() < 1e-12, "{slope}");
            }
        }
    }

    #[test]
    fn projection_stops_at_the_ends_of_a_facet() {
        let mesh = grid(&[even(0.0, 2.0, 2).unwrap(), even(0.0, 1.0, 1).unwrap()]).unwrap();
        let facet = mesh.boundaries["bottom"][0];
        assert_eq!(mesh.project_on_facet(&facet, Vec3::new(5.0, -1.0, 0.0))[0], 1.0);
        assert!((mesh.project_on_facet(&facet, Vec3::new(0.25, -1.0, 0.0))[0] + 0.5).abs() < 1e-15);
    }
}
