//! The trace of a body on a flat face: points, and facets on which the motion is interpolated.
//!
//! Finite elements bring their facets. Particles have none, so their trace is made piecewise
//! linear: segments between neighbours along a line, bilinear cells where the particles form a
//! rectangular grid, Delaunay triangles otherwise.

use crate::error::{Error, Result};
use crate::fem::mesh::Mesh;
use crate::space::{Space, Vec3};
use nalgebra::Vector2;
use spade::{DelaunayTriangulation, Point2, Triangulation};

/// Coordinates in the plane of a face; in the plane only the first one counts.
pub type FacePoint = Vector2<f64>;

/// A flat face and the frame in which its points are measured.
#[derive(Debug, Clone, Copy)]
pub struct Frame {
    origin: Vec3,
    tangents: [Vec3; 2],
    normal: Vec3,
}

/// The trace of one body.
#[derive(Debug, Clone)]
pub struct Trace {
    /// Plane or solid.
    pub space: Space,
    /// Index of each point within its part.
    pub points: Vec<usize>,
    /// Positions, in m.
    pub positions: Vec<Vec3>,
    /// Segments, triangles or quadrilaterals, as indices into `points`.
    pub facets: Vec<Vec<usize>>,
}

impl Frame {
    /// The frame of the face that the points lie on.
    ///
    /// # Errors
    /// Fewer points than span a face, or points that are not flat within 1e-6 of its size.
    pub fn fit(space: Space, positions: &[Vec3], tie: &str) -> Result<Frame> {
        let empty =
            |message: &str| Error::EmptyInterface { tie: tie.to_owned(), message: message.to_owned() };
        let origin = *positions.first().ok_or_else(|| empty("a face has no points"))?;
        let farthest = |from: &dyn Fn(&Vec3) -> f64| {
            positions.iter().map(|p| (from(p), *p)).fold((0.0, origin), |a, b| if b.0 > a.0 { b } else { a })
        };
        let (size, far) = farthest(&|p| (p - origin).norm());
        if size == 0.0 {
            return Err(empty("a face is a single point; refine the body"));
        }
        let t1 = (far - origin) / size;
        let (t2, normal) = match space {
            Space::Plane => (Vec3::z(), t1.cross(&Vec3::z())),
            Space::Solid => {
                let off_line = |p: &Vec3| ((p - origin) - t1 * t1.dot(&(p - origin))).norm();
                let (width, far) = farthest(&off_line);
                if width < 1e-6 * size {
                    return Err(empty("a face is a line; refine the body"));
                }
                let d = far - origin;
                let t2 = (d - t1 * t1.dot(&d)).normalize();
                (t2, t1.cross(&t2))
            }
        };
        let frame = Frame { origin, tangents: [t1, t2], normal };
        let bump = positions.iter().map(|p| frame.height(p).abs()).fold(0.0, f64::max);
        if bump > 1e-6 * size {
            return Err(empty(&format!(
                "the points to be tied do not lie in one plane (off by {bump:.3e} m); tie flat faces that touch, pair by pair"
            )));
        }
        Ok(frame)
    }

    /// Coordinates in the face.
    pub fn flatten(&self, x: &Vec3) -> FacePoint {
        let d = x - self.origin;
        FacePoint::new(self.tangents[0].dot(&d), self.tangents[1].dot(&d))
    }

    /// The point of the face with these coordinates.
    pub fn lift(&self, s: &FacePoint) -> Vec3 {
        self.origin + self.tangents[0] * s.x + self.tangents[1] * s.y
    }

    /// Distance from the plane of the face, signed, in m.
    pub fn height(&self, x: &Vec3) -> f64 {
        self.normal.dot(&(x - self.origin))
    }
}

impl Trace {
    /// Trace of a mesh on a named boundary; `None` if there is no such boundary.
    pub fn of_mesh(mesh: &Mesh, boundary: &str) -> Option<Trace> {
        let points = mesh.boundary_nodes(boundary)?;
        let index = |node: &usize| points.binary_search(node).expect("facet nodes are boundary nodes");
        let facets = mesh.boundaries[boundary]
            .iter()
            .map(|facet| mesh.facet_nodes(facet).iter().map(index).collect())
            .collect();
        let positions = points.iter().map(|&node| mesh.nodes[node]).collect();
        Some(Trace { space: mesh.space, points, positions, facets })
    }

    /// Trace of particles on a flat face.
    ///
    /// # Errors
    /// Particles that do not span a face or are not flat.
    pub fn of_particles(space: Space, points: Vec<usize>, positions: Vec<Vec3>, tie: &str) -> Result<Trace> {
        let frame = Frame::fit(space, &positions, tie)?;
        let flat: Vec<FacePoint> = positions.iter().map(|x| frame.flatten(x)).collect();
        let facets = match space {
            Space::Plane => segments(&flat),
            Space::Solid => match grid_cells(&flat) {
                Some(cells) => cells,
                None => triangles(&flat, tie)?,
            },
        };
        Ok(Trace { space, points, positions, facets })
    }

    /// Interpolation weights `(index into points, N)` at a point of a facet given in face coordinates;
    /// `None` outside, beyond a tolerance of 1e-8 of the facet.
    pub fn weights_in(&self, frame: &Frame, facet: usize, s: &FacePoint) -> Option<Vec<(usize, f64)>> {
        let corners: Vec<FacePoint> =
            self.facets[facet].iter().map(|&p| frame.flatten(&self.positions[p])).collect();
        let n = shape(&corners, s)?;
        Some(self.facets[facet].iter().copied().zip(n).collect())
    }

    /// Interpolation weights at any point of the face; `None` where no facet holds it.
    pub fn weights(&self, frame: &Frame, s: &FacePoint) -> Option<Vec<(usize, f64)>> {
        (0..self.facets.len()).find_map(|facet| self.weights_in(frame, facet, s))
    }
}

/// Consecutive points along a line.
fn segments(flat: &[FacePoint]) -> Vec<Vec<usize>> {
    let mut order: Vec<usize> = (0..flat.len()).collect();
    order.sort_by(|&a, &b| flat[a].x.total_cmp(&flat[b].x));
    order.windows(2).map(|w| vec![w[0], w[1]]).collect()
}

/// Cells of a rectangular grid, if the points form one.
fn grid_cells(flat: &[FacePoint]) -> Option<Vec<Vec<usize>>> {
    // The grid may be turned in the frame: its axes are those of the nearest two neighbours.
    let corner = (0..flat.len()).min_by(|&a, &b| {
        let sum = |i: usize| flat.iter().map(|p| (p - flat[i]).norm_squared()).sum::<f64>();
        sum(b).total_cmp(&sum(a))
    })?;
    let nearest = (0..flat.len())
        .filter(|&i| i != corner)
        .min_by(|&a, &b| (flat[a] - flat[corner]).norm().total_cmp(&(flat[b] - flat[corner]).norm()))?;
    let axis = (flat[nearest] - flat[corner]).normalize();
    let other = FacePoint::new(-axis.y, axis.x);
    let coordinates: Vec<[f64; 2]> = flat.iter().map(|p| [axis.dot(p), other.dot(p)]).collect();
    let size = flat.iter().map(|p| (p - flat[corner]).norm()).fold(0.0, f64::max);
    let lines = |axis: usize| {
        let mut values: Vec<f64> = coordinates.iter().map(|c| c[axis]).collect();
        values.sort_by(f64::total_cmp);
        values.dedup_by(|b, a| (*b - *a).abs() < 1e-7 * size);
        values
    };
    let (xs, ys) = (lines(0), lines(1));
    if xs.len() < 2 || ys.len() < 2 || xs.len() * ys.len() != flat.len() {
        return None;
    }
    let place = |values: &[f64], v: f64| values.iter().position(|w| (w - v).abs() < 1e-7 * size);
    let mut at = vec![usize::MAX; flat.len()];
    for (point, c) in coordinates.iter().enumerate() {
        at[place(&ys, c[1])? * xs.len() + place(&xs, c[0])?] = point;
    }
    if at.contains(&usize::MAX) {
        return None;
    }
    let mut cells = Vec::with_capacity((xs.len() - 1) * (ys.len() - 1));
    for j in 0..ys.len() - 1 {
        for i in 0..xs.len() - 1 {
            let k = j * xs.len() + i;
            cells.push(vec![at[k], at[k + 1], at[k + xs.len() + 1], at[k + xs.len()]]);
        }
    }
    Some(cells)
}

fn triangles(flat: &[FacePoint], tie: &str) -> Result<Vec<Vec<usize>>> {
    let mut delaunay: DelaunayTriangulation<Point2<f64>> = DelaunayTriangulation::new();
    let mut vertex_point = Vec::with_capacity(flat.len());
    for (point, p) in flat.iter().enumerate() {
        let handle = delaunay.insert(Point2::new(p.x, p.y)).map_err(|e| Error::EmptyInterface {
            tie: tie.to_owned(),
            message: format!("particle {point} of the face cannot be triangulated ({e}); check its position"),
        })?;
        if handle.index() != vertex_point.len() {
            return Err(Error::EmptyInterface {
                tie: tie.to_owned(),
                message: "two particles of the face share one place; remove one".to_owned(),
            });
        }
        vertex_point.push(point);
    }
    let size = flat.iter().map(|p| (p - flat[0]).norm()).fold(0.0, f64::max);
    Ok(delaunay
        .inner_faces()
        .map(|face| face.vertices().map(|v| vertex_point[v.fix().index()]).to_vec())
        // Slivers along a straight edge of the face are rounding, not facets.
        .filter(|t| area(&[flat[t[0]], flat[t[1]], flat[t[2]]]) > 1e-10 * size * size)
        .collect())
}

/// Area of a polygon, positive counter-clockwise.
pub fn area(polygon: &[FacePoint]) -> f64 {
    let n = polygon.len();
    (0..n).map(|i| 0.5 * polygon[i].perp(&polygon[(i + 1) % n])).sum()
}

/// Shape functions of a segment, triangle or bilinear quadrilateral at `s`; `None` outside.
fn shape(corners: &[FacePoint], s: &FacePoint) -> Option<Vec<f64>> {
    const EDGE: f64 = 1e-8;
    let values = match corners {
        [a, b] => {
            let t = (s.x - a.x) / (b.x - a.x);
            vec![1.0 - t, t]
        }
        [a, b, c] => {
            let whole = area(&[*a, *b, *c]);
            vec![area(&[*s, *b, *c]) / whole, area(&[*a, *s, *c]) / whole, area(&[*a, *b, *s]) / whole]
        }
        _ => bilinear(corners, s)?,
    };
    values.iter().all(|n| *n >= -EDGE).then_some(values)
}

/// Bilinear shape functions: Newton for `Σ N_i(ξ, η) x_i = s`.
fn bilinear(corners: &[FacePoint], s: &FacePoint) -> Option<Vec<f64>> {
    const CORNER: [[f64; 2]; 4] = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let n = |xi: f64, eta: f64| CORNER.map(|[a, b]| 0.25 * (1.0 + a * xi) * (1.0 + b * eta));
    let (mut xi, mut eta) = (0.0, 0.0);
    for _ in 0..20 {
        let x: FacePoint = corners.iter().zip(n(xi, eta)).map(|(c, n)| c * n).sum();
        let along = |k: usize| -> FacePoint {
            let d = |[a, b]: [f64; 2]| {
                if k == 0 { 0.25 * a * (1.0 + b * eta) } else { 0.25 * b * (1.0 + a * xi) }
            };
            corners.iter().zip(CORNER).map(|(c, ab)| c * d(ab)).sum()
        };
        let (g1, g2, r) = (along(0), along(1), s - x);
        let det = g1.perp(&g2);
        let (dxi, deta) = (r.perp(&g2) / det, g1.perp(&r) / det);
        xi += dxi;
        eta += deta;
        if !(xi.abs() < 10.0 && eta.abs() < 10.0) {
            return None;
        }
        if dxi.abs() + deta.abs() < 1e-14 {
            break;
        }
    }
    Some(n(xi, eta).to_vec())
}
