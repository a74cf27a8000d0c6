//! A convex polyhedron around the origin, cut by half-spaces.

use super::convex::Convex;
use crate::space::Vec3;

/// A face: its corners in order, and what lies behind it.
#[derive(Debug, Clone)]
struct Face<T> {
    corners: Vec<usize>,
    behind: T,
}

/// A convex polyhedron; a cut is a half-space seen from the origin.
#[derive(Debug, Clone)]
pub struct Polyhedron<T> {
    corners: Vec<Vec3>,
    faces: Vec<Face<T>>,
    /// Corners closer than this to a cutting plane count as lying on it.
    on_plane: f64,
}

impl<T: Copy> Convex<T> for Polyhedron<T> {
    fn cuboid(low: Vec3, high: Vec3, behind: impl Fn(usize, usize) -> T) -> Self {
        let pick = |bit: usize, axis: usize| if bit == 0 { low[axis] } else { high[axis] };
        let corners = (0..8).map(|c| Vec3::new(pick(c & 1, 0), pick(c & 2, 1), pick(c & 4, 2))).collect();
        let faces = [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]]
            .into_iter()
            .enumerate()
            .map(|(k, corners)| Face { corners: corners.to_vec(), behind: behind(k / 2, k % 2) })
            .collect();
        // Rounding of a cut is some 1e-16 of the size; lattices have many planes through one corner.
        Self { corners, faces, on_plane: 1e-12 * (high - low).norm() }
    }

    fn cut(&mut self, n: Vec3, d: f64, behind: T) -> bool {
        let side: Vec<f64> = self.corners.iter().map(|x| n.dot(x) - d).collect();
        let outside = |c: usize| side[c] > self.on_plane;
        if !self.faces.iter().any(|f| f.corners.iter().any(|&c| outside(c))) {
            return true;
        }
        // Few enough for a list: (inner, outer, the corner between them).
        let mut crossing: Vec<(usize, usize, usize)> = Vec::new();
        let mut rim: Vec<usize> = Vec::new();
        for face in &mut self.faces {
            if !face.corners.iter().any(|&c| outside(c)) {
                continue;
            }
            let mut kept = Vec::with_capacity(face.corners.len() + 1);
            for k in 0..face.corners.len() {
                let (a, b) = (face.corners[k], face.corners[(k + 1) % face.corners.len()]);
                if !outside(a) {
                    kept.push(a);
                }
                if outside(a) != outside(b) {
                    let (inner, outer) = if outside(a) { (b, a) } else { (a, b) };
                    if side[inner] >= -self.on_plane {
                        rim.push(inner);
                        continue;
                    }
                    // Always from the inner to the outer corner, so that both faces of the edge get the same point.
                    let known = crossing.iter().find(|c| (c.0, c.1) == (inner, outer)).map(|c| c.2);
                    let corner = known.unwrap_or_else(|| {
                        let t = side[inner] / (side[inner] - side[outer]);
                        let x = self.corners[inner] + t * (self.corners[outer] - self.corners[inner]);
                        self.corners.push(x);
                        crossing.push((inner, outer, self.corners.len() - 1));
                        self.corners.len() - 1
                    });
                    kept.push(corner);
                    rim.push(corner);
                }
            }
            face.corners = kept;
        }
        self.faces.retain(|f| f.corners.len() >= 3);
        rim.sort_unstable();
        rim.dedup();
        if rim.len() >= 3 {
            self.faces.push(Face { corners: self.around(rim, n), behind });
        }
        !self.faces.is_empty()
    }

    fn reach(&self) -> f64 {
        let square = |c: &usize| self.corners[*c].norm_squared();
        self.faces.iter().flat_map(|f| &f.corners).map(square).fold(0.0, f64::max).sqrt()
    }

    /// Volume, as the sum of the cones over the faces from a point inside: the origin may be outside, where a particle is outside its
    /// own cell.
    fn measure(&self) -> f64 {
        let corners = || self.faces.iter().flat_map(|f| &f.corners).map(|&c| self.corners[c]);
        let inside = corners().sum::<Vec3>() / corners().count().max(1) as f64;
        let cone = |f: &Face<T>| self.area_vector(f).dot(&(self.corners[f.corners[0]] - inside)).abs() / 3.0;
        self.faces.iter().map(cone).sum()
    }

    fn facets(&self) -> impl Iterator<Item = (T, f64)> {
        self.faces.iter().map(|face| (face.behind, self.area_vector(face).norm()))
    }
}

impl<T> Polyhedron<T> {
    /// Sorts corners of a plane convex polygon with normal `n` around their middle.
    fn around(&self, rim: Vec<usize>, n: Vec3) -> Vec<usize> {
        let middle = rim.iter().map(|&c| self.corners[c]).sum::<Vec3>() / rim.len() as f64;
        let s = (self.corners[rim[0]] - middle).normalize();
        let t = n.cross(&s);
        let angle = |c: usize| {
            let x = self.corners[c] - middle;
            (t.dot(&x).atan2(s.dot(&x)), c)
        };
        let mut rim: Vec<(f64, usize)> = rim.into_iter().map(angle).collect();
        rim.sort_by(|a, b| a.0.total_cmp(&b.0));
        rim.into_iter().map(|(_, c)| c).collect()
    }

    fn area_vector(&self, face: &Face<T>) -> Vec3 {
        let x = |k: usize| self.corners[face.corners[k]] - self.corners[face.corners[0]];
        (1..face.corners.len() - 1).map(|k| 0.5 * x(k).cross(&x(k + 1))).sum()
    }
}
