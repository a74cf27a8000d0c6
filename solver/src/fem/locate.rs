//! Finding the cell that holds a point, and the shape functions there.

use super::mesh::Mesh;
use super::sample::Sample;
use crate::space::Vec3;

/// A point found in a mesh.
#[derive(Debug, Clone, PartialEq)]
pub struct Location {
    /// The cell.
    pub cell: usize,
    /// Natural coordinates in it.
    pub xi: [f64; 3],
    /// Node and shape function `N_a`: `x = Σ N_a x_a`.
    pub weights: Vec<(usize, f64)>,
    /// Node and gradient `∂N_a/∂x`, in 1/m.
    pub gradients: Vec<(usize, Vec3)>,
}

impl Location {
    /// The location of a sampled point.
    pub fn new(mesh: &Mesh, cell: usize, xi: [f64; 3], sample: &Sample) -> Location {
        let nodes = mesh.cell(cell);
        Location {
            cell,
            xi,
            weights: nodes.iter().copied().zip(sample.values).collect(),
            gradients: nodes.iter().copied().zip(sample.gradients).collect(),
        }
    }
}

/// How far outside a cell, in cell sizes, a point still counts as inside: well above the
/// rounding of coordinates, well below any distance that matters.
const TOLERANCE: f64 = 1e-9;
/// Quadratic convergence needs about five; strongly distorted cells a few more.
const NEWTON_STEPS: usize = 25;

/// A grid of buckets over the bounding boxes of the cells.
#[derive(Debug, Clone)]
pub struct Locator<'a> {
    mesh: &'a Mesh,
    boxes: Vec<[Vec3; 2]>,
    low: Vec3,
    bucket: Vec3,
    counts: [usize; 3],
    buckets: Vec<Vec<usize>>,
}

impl<'a> Locator<'a> {
    /// Sorts the cells into buckets, about one cell each. Cells with non-finite nodes are left out.
    pub fn new(mesh: &'a Mesh) -> Self {
        let boxes: Vec<[Vec3; 2]> = (0..mesh.cell_count()).map(|c| padded_box(mesh, c)).collect();
        let finite = |b: &&[Vec3; 2]| b.iter().all(|x| x.iter().all(|v| v.is_finite()));
        let (low, high) = boxes
            .iter()
            .filter(finite)
            .fold((Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)), |(low, high), b| {
                (low.inf(&b[0]), high.sup(&b[1]))
            });
        let extent = high - low;
        let axes = mesh.space.dim();
        let measure: f64 = extent.iter().take(axes).product();
        let size = (measure / boxes.len().max(1) as f64).powf(1.0 / axes as f64);
        // A bucket never gets more numerous than the cells along one axis can fill.
        let counts: [usize; 3] =
            std::array::from_fn(|i| ((extent[i] / size).floor() as usize).clamp(1, boxes.len().max(1)));
        let bucket = Vec3::from_fn(|i, _| (extent[i] / counts[i] as f64).max(f64::MIN_POSITIVE));
        let buckets = vec![Vec::new(); counts.iter().product()];
        let mut locator = Locator { mesh, boxes, low, bucket, counts, buckets };
        for cell in 0..locator.boxes.len() {
            let [low, high] = locator.boxes[cell];
            for index in locator.buckets_between(low, high) {
                locator.buckets[index].push(cell);
            }
        }
        locator
    }

    /// The first cell that holds `x`, to 1e-9 of its size; `None` outside the mesh.
    pub fn find(&self, x: Vec3) -> Option<Location> {
        self.candidates(x, 0.0).into_iter().find_map(|cell| {
            let xi = self.natural_coordinates(cell, x)?;
            // Natural coordinates span two units over the cell.
            let inside = xi.iter().all(|v| v.abs() <= 1.0 + 2.0 * TOLERANCE);
            inside.then(|| self.location(cell, xi))
        })
    }

    /// The location of `x`, or of the nearest point of the mesh when `x` lies outside by no more
    /// than `within` metres (nearest after clamping the natural coordinates to each cell).
    pub fn find_nearest(&self, x: Vec3, within: f64) -> Option<Location> {
        self.find(x).or_else(|| {
            let clamped = self.candidates(x, within).into_iter().map(|cell| self.clamp(cell, x));
            let (distance, cell, xi) = clamped.min_by(|a, b| a.0.total_cmp(&b.0))?;
            (distance <= within).then(|| self.location(cell, xi))
        })
    }

    fn location(&self, cell: usize, xi: [f64; 3]) -> Location {
        Location::new(self.mesh, cell, xi, &self.mesh.sample(cell, xi))
    }

    /// Cells whose padded box comes within `distance` of `x`, ascending.
    fn candidates(&self, x: Vec3, distance: f64) -> Vec<usize> {
        let wide = Vec3::repeat(distance);
        let mut cells: Vec<usize> = self
            .buckets_between(x - wide, x + wide)
            .flat_map(|index| self.buckets[index].iter().copied())
            .filter(|&cell| {
                let [low, high] = self.boxes[cell];
                (0..3).all(|i| x[i] >= low[i] - distance && x[i] <= high[i] + distance)
            })
            .collect();
        cells.sort_unstable();
        cells.dedup();
        cells
    }

    /// Indices of the buckets that a box touches; points beyond the grid fall into its rim.
    fn buckets_between(&self, low: Vec3, high: Vec3) -> impl Iterator<Item = usize> + use<> {
        let at = |x: Vec3, i: usize| {
            (((x[i] - self.low[i]) / self.bucket[i]).floor().max(0.0) as usize).min(self.counts[i] - 1)
        };
        let span: [_; 3] = std::array::from_fn(|i| at(low, i)..=at(high, i));
        let [nx, ny, _] = self.counts;
        let [xs, ys, zs] = span;
        zs.flat_map(move |k| {
            let xs = xs.clone();
            ys.clone().flat_map(move |j| xs.clone().map(move |i| (k * ny + j) * nx + i))
        })
    }

    /// Newton's method on `x(ξ) = x`; `None` if it does not arrive within the cell's surroundings.
    fn natural_coordinates(&self, cell: usize, x: Vec3) -> Option<[f64; 3]> {
        let [low, high] = self.boxes[cell];
        let size = (high - low).norm();
        let mut xi = Vec3::zeros();
        for _ in 0..NEWTON_STEPS {
            let (step, residual) = self.newton_step(cell, xi, x)?;
            if residual <= 1e-14 * size {
                return Some(xi.into());
            }
            // Twice the cell is far enough for any point of it; beyond, the map may fold over.
            xi = (xi + step).map(|v| v.clamp(-2.0, 2.0));
            if step.amax() <= 1e-15 {
                break;
            }
        }
        // Rounding of large coordinates may keep the residual above the strict bound.
        let (_, residual) = self.newton_step(cell, xi, x)?;
        (residual <= 0.1 * TOLERANCE * size).then(|| xi.into())
    }

    /// Distance to `x`, cell and natural coordinates of the clamped point of a cell.
    fn clamp(&self, cell: usize, x: Vec3) -> (f64, usize, [f64; 3]) {
        let mut xi = Vec3::zeros();
        for _ in 0..NEWTON_STEPS {
            let Some((step, _)) = self.newton_step(cell, xi, x) else { break };
            let next = (xi + step).map(|v| v.clamp(-1.0, 1.0));
            if (next - xi).amax() <= 1e-15 {
                break;
            }
            xi = next;
        }
        let xi = xi.into();
        ((self.mesh.sample(cell, xi).position - x).norm(), cell, xi)
    }

    /// `J⁻¹ (x − x(ξ))` and the distance `|x − x(ξ)|`.
    fn newton_step(&self, cell: usize, xi: Vec3, x: Vec3) -> Option<(Vec3, f64)> {
        let sample = self.mesh.sample(cell, xi.into());
        let gap = x - sample.position;
        let step = sample.jacobian.try_inverse()? * gap;
        // In the plane the third coordinate is no unknown, but a gap there is still a gap.
        let free = self.mesh.space.dim();
        Some((Vec3::from_fn(|i, _| if i < free { step[i] } else { 0.0 }), gap.norm()))
    }
}

/// The bounding box of a cell, wider by the tolerance on all sides.
fn padded_box(mesh: &Mesh, cell: usize) -> [Vec3; 2] {
    let nodes = mesh.cell(cell).iter().map(|&n| mesh.nodes[n]);
    let empty = [Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY)];
    let [low, high] = nodes.fold(empty, |[low, high], x| [low.inf(&x), high.sup(&x)]);
    let pad = Vec3::repeat(TOLERANCE * (high - low).norm());
    [low - pad, high + pad]
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::structured::{elliptic_sector, even, graded, grid, jiggle};
    use proptest::prelude::*;

    fn plane() -> Mesh {
        let mut mesh = grid(&[graded(0.0, 3.0, 7, 1.4).unwrap(), even(-1.0, 1.0, 5).unwrap()]).unwrap();
        jiggle(&mut mesh, 0.3, 1);
        mesh
    }

    fn solid() -> Mesh {
        let mut mesh =
            grid(&[even(0.0, 3.0, 4).unwrap(), even(-1.0, 1.0, 3).unwrap(), even(0.0, 1.0, 3).unwrap()])
                .unwrap();
        jiggle(&mut mesh, 0.25, 2);
        mesh
    }

    /// Linear completeness at the location: `Σ N_a x_a = x`, `Σ x_a ⊗ ∇N_a = 1`.
    fn check(mesh: &Mesh, at: &Location, x: Vec3) {
        let position: Vec3 = at.weights.iter().map(|&(n, w)| mesh.nodes[n] * w).sum();
        // Newton stops at 1e-14 cell sizes, or 1e-10 where coordinates are large.
        assert!((position - x).norm() < 1e-13, "{position} for {x}");
        let sum: f64 = at.weights.iter().map(|w| w.1).sum();
        assert!((sum - 1.0).abs() < 1e-13);
        let slope: nalgebra::Matrix3<f64> =
            at.gradients.iter().map(|&(n, g)| mesh.nodes[n] * g.transpose()).sum();
        for i in 0..mesh.space.dim() {
            for j in 0..mesh.space.dim() {
                assert!((slope[(i, j)] - f64::from(i == j)).abs() < 1e-12, "{slope}");
            }
        }
    }

    proptest! {
        #[test]
        fn every_plane_point_is_found(x in 0.0..=3.0f64, y in -1.0..=1.0f64) {
            let mesh = plane();
            let x = Vec3::new(x, y, 0.0);
            check(&mesh, &Locator::new(&mesh).find(x).unwrap(), x);
        }

        #[test]
        fn every_solid_point_is_found(x in 0.0..=3.0f64, y in -1.0..=1.0f64, z in 0.0..=1.0f64) {
            let mesh = solid();
            let x = Vec3::new(x, y, z);
            check(&mesh, &Locator::new(&mesh).find(x).unwrap(), x);
        }
    }

    #[test]
    fn nodes_and_a_hair_outside_are_found_and_the_rest_is_not() {
        let mesh = plane();
        let locator = Locator::new(&mesh);
        for &x in &mesh.nodes {
            check(&mesh, &locator.find(x).unwrap(), x);
        }
        assert!(locator.find(Vec3::new(3.0 + 1e-11, 0.3, 0.0)).is_some());
        assert!(locator.find(Vec3::new(3.0 + 1e-6, 0.3, 0.0)).is_none());
        assert!(locator.find(Vec3::new(1.0, 0.3, 0.1)).is_none());
        assert!(locator.find(Vec3::new(f64::NAN, 0.3, 0.1)).is_none());
    }

    #[test]
    fn nearest_point_is_clamped_to_the_boundary() {
        let mesh = plane();
        let locator = Locator::new(&mesh);
        let at = locator.find_nearest(Vec3::new(3.0 + 1e-3, 0.3, 0.0), 2e-3).unwrap();
        let position: Vec3 = at.weights.iter().map(|&(n, w)| mesh.nodes[n] * w).sum();
        assert!((position.x - 3.0).abs() < 1e-14);
        // Clamping along a skewed grid line moves the point sideways by less than the gap.
        assert!((position.y - 0.3).abs() < 1e-3, "{position}");
        assert!(locator.find_nearest(Vec3::new(3.0 + 3e-3, 0.3, 0.0), 2e-3).is_none());
    }

    /// The notch of a ring lies in the bounding box but in no cell.
    #[test]
    fn a_hole_is_outside() {
        let t = even(0.0, 1.5, 6).unwrap();
        let mesh = elliptic_sector([2.0, 1.0], [3.0, 2.0], &[0.0, 0.5, 1.0], &t).unwrap();
        assert!(Locator::new(&mesh).find(Vec3::new(0.8, 0.6, 0.0)).is_none());
    }
}
