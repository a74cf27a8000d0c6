//! A convex polyhedron around the origin, cut by half-spaces.

use crate::space::{Space, Vec3};
use std::collections::BTreeMap;

/// A face: its corners in order, and what lies behind it.
#[derive(Debug, Clone)]
pub struct Face<T> {
    pub corners: Vec<usize>,
    pub behind: T,
}

/// A convex polyhedron that contains the origin, or has it on its surface.
#[derive(Debug, Clone)]
pub struct Polyhedron<T> {
    corners: Vec<Vec3>,
    pub faces: Vec<Face<T>>,
    /// Corners closer than this to a cutting plane count as lying on it.
    on_plane: f64,
}

impl<T: Copy> Polyhedron<T> {
    /// The cuboid between two corners; its faces in the order x min, x max, y min, …
    pub fn cuboid(low: Vec3, high: Vec3, behind: T) -> Self {
        let pick = |bit: usize, axis: usize| if bit == 0 { low[axis] } else { high[axis] };
        let corners = (0..8).map(|c| Vec3::new(pick(c & 1, 0), pick(c & 2, 1), pick(c & 4, 2))).collect();
        let faces = [[0, 2, 6, 4], [1, 3, 7, 5], [0, 1, 5, 4], [2, 3, 7, 6], [0, 1, 3, 2], [4, 5, 7, 6]]
            .map(|corners| Face { corners: corners.to_vec(), behind })
            .to_vec();
        // Rounding of a cut is some 1e-16 of the size; lattices have many planes through one corner.
        Self { corners, faces, on_plane: 1e-12 * (high - low).norm() }
    }

    /// Keeps `n·x ≤ d` for a unit vector `n`; `false` if nothing is left.
    pub fn cut(&mut self, n: Vec3, d: f64, behind: T) -> bool {
        let side: Vec<f64> = self.corners.iter().map(|x| n.dot(x) - d).collect();
        let outside = |c: usize| side[c] > self.on_plane;
        if !self.faces.iter().any(|f| f.corners.iter().any(|&c| outside(c))) {
            return true;
        }
        let mut crossing: BTreeMap<(usize, usize), usize> = BTreeMap::new();
        let mut rim: Vec<usize> = Vec::new();
        for face in &mut self.faces {
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
                    let corner = *crossing.entry((inner, outer)).or_insert_with(|| {
                        let t = side[inner] / (side[inner] - side[outer]);
                        let x = self.corners[inner] + t * (self.corners[outer] - self.corners[inner]);
                        self.corners.push(x);
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

    /// Sorts corners of a plane convex polygon with normal `n` around their middle.
    fn around(&self, mut rim: Vec<usize>, n: Vec3) -> Vec<usize> {
        let middle = rim.iter().map(|&c| self.corners[c]).sum::<Vec3>() / rim.len() as f64;
        let s = (self.corners[rim[0]] - middle).normalize();
        let t = n.cross(&s);
        let angle = |c: usize| {
            let x = self.corners[c] - middle;
            t.dot(&x).atan2(s.dot(&x))
        };
        rim.sort_by(|&a, &b| angle(a).total_cmp(&angle(b)));
        rim
    }

    /// Largest distance of a corner from the origin, in the plane of a slab or in space.
    pub fn reach(&self, space: Space) -> f64 {
        let square = |c: &usize| self.corners[*c].iter().take(space.dim()).map(|x| x * x).sum::<f64>();
        self.faces.iter().flat_map(|f| &f.corners).map(square).fold(0.0, f64::max).sqrt()
    }

    fn area_vector(&self, face: &Face<T>) -> Vec3 {
        let x = |k: usize| self.corners[face.corners[k]] - self.corners[face.corners[0]];
        (1..face.corners.len() - 1).map(|k| 0.5 * x(k).cross(&x(k + 1))).sum()
    }

    /// Area of a face.
    pub fn area(&self, face: &Face<T>) -> f64 {
        self.area_vector(face).norm()
    }

    /// Volume, as the sum of the cones from the origin over the faces.
    pub fn volume(&self) -> f64 {
        let cone = |f: &Face<T>| self.area_vector(f).dot(&self.corners[f.corners[0]]).abs() / 3.0;
        self.faces.iter().map(cone).sum()
    }
}
