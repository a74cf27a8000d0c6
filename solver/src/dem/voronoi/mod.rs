//! Voronoi and power (Laguerre) cells of particles in a box.
//!
//! The cell of particle `i` is `{x : |x−x_i|² − R_i² ≤ |x−x_j|² − R_j² for all j}`: the convex
//! body that the radical planes of its neighbours cut out of the box (Aurenhammer 1987). With equal
//! radii it is the Voronoi cell. Neighbours that share a facet are joined by an edge of the
//! (regular) Delaunay triangulation.

mod convex;
mod polygon;
mod polyhedron;

use super::block::Block;
use super::grid::{Boundary, Grid, Near};
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use convex::Convex;
use polygon::Polygon;
use polyhedron::Polyhedron;

/// A common facet of two cells.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Facet {
    /// The particle on the other side.
    pub neighbour: usize,
    /// Period the neighbour lies in; zero unless the box repeats.
    pub shift: [i8; 3],
    /// Length (m) in the plane, area (m²) in the solid.
    pub measure: f64,
}

/// Cell of one particle.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Cell {
    /// Area (m²) in the plane, volume (m³) in the solid.
    pub measure: f64,
    /// Its facets with other cells, by neighbour and shift; not those with the box.
    pub facets: Vec<Facet>,
}

/// What lies behind a face of a polyhedron.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Behind {
    Box,
    Particle(usize, [i8; 3]),
}

/// Cells of particles at `position` with `radius` (m); radii all zero or equal give Voronoi cells.
/// In a closed box the particles may lie on its faces.
///
/// # Errors
/// A particle without a cell: coincident with another one or buried in it; a coordinate that is not finite.
pub fn cells(
    space: Space,
    block: Block,
    boundary: Boundary,
    position: &[Vec3],
    radius: &[f64],
) -> Result<Vec<Cell>> {
    if let Some(bad) = (0..position.len()).find(|&i| !(position[i].sum() + radius[i]).is_finite()) {
        return Err(no_cell(bad, "its position or radius is not a finite number"));
    }
    let spacing = (block.measure(space) / position.len().max(1) as f64).powf(1.0 / space.dim() as f64);
    let grid = Grid::new(space, block, boundary, position, spacing);
    let largest = radius.iter().copied().fold(0.0, f64::max);
    let search = Search { block, boundary, grid, position, radius, spacing, largest };
    match space {
        Space::Plane => (0..position.len()).map(|i| search.cell::<Polygon<_>>(i)).collect(),
        Space::Solid => (0..position.len()).map(|i| search.cell::<Polyhedron<_>>(i)).collect(),
    }
}

fn no_cell(particle: usize, message: &str) -> Error {
    Error::Geometry { what: format!("Voronoi cell of particle {particle}"), message: message.to_owned() }
}

struct Search<'a> {
    block: Block,
    boundary: Boundary,
    grid: Grid,
    position: &'a [Vec3],
    radius: &'a [f64],
    spacing: f64,
    largest: f64,
}

impl Search<'_> {
    fn cell<C: Convex<Behind>>(&self, i: usize) -> Result<Cell> {
        let mut reach = 2.5 * self.spacing;
        let mut near = Vec::new();
        loop {
            near.clear();
            self.grid.for_each_within(self.position[i], reach, |n| {
                if n.point != i || n.shift != [0; 3] {
                    near.push(n);
                }
            });
            near.sort_by(|a, b| a.offset.norm_squared().total_cmp(&b.offset.norm_squared()));
            if let Some(cell) = self.cut::<C>(i, &near, reach) {
                return if cell.measure > 0.0 {
                    Ok(cell)
                } else {
                    Err(no_cell(i, "it is empty; two particles coincide or one is buried in the other"))
                };
            }
            reach *= 1.5;
        }
    }

    /// Cuts the box by the radical planes of the particles near `i`, nearest first; `None` if one
    /// farther than `reach` could still cut.
    fn cut<C: Convex<Behind>>(&self, i: usize, near: &[Near], reach: f64) -> Option<Cell> {
        let mut cell: C = self.start(i);
        let weight = self.radius[i] * self.radius[i];
        // The radical plane of a particle at distance D lies at least (D² + R_i² − R_max²)/2D away.
        let excess = self.largest * self.largest - weight;
        let nearest_plane = |d: f64| (d * d - excess) / (2.0 * d);
        let mut far = cell.reach();
        for n in near {
            let d = n.offset.norm();
            if nearest_plane(d) > far {
                return Some(measure(&cell));
            }
            let other = self.radius[n.point] * self.radius[n.point];
            let normal = n.offset / d;
            if !normal.x.is_finite()
                || !cell.cut(normal, (d * d + weight - other) / (2.0 * d), Behind::Particle(n.point, n.shift))
            {
                return Some(Cell::default());
            }
            far = cell.reach();
        }
        (nearest_plane(reach) > far || self.has_all(near)).then(|| measure(&cell))
    }

    /// In a closed box there is nothing beyond all its particles.
    fn has_all(&self, near: &[Near]) -> bool {
        self.boundary == Boundary::Closed && near.len() + 1 == self.position.len()
    }

    /// The box seen from particle `i`; if it repeats, what its own images leave of it.
    fn start<C: Convex<Behind>>(&self, i: usize) -> C {
        let x = self.position[i];
        match self.boundary {
            Boundary::Closed => C::cuboid(self.block.min - x, self.block.max - x, |_, _| Behind::Box),
            Boundary::Periodic => {
                let half = 0.5 * self.block.sides();
                C::cuboid(-half, half, |axis, end| {
                    let mut shift = [0; 3];
                    shift[axis] = if end == 0 { -1 } else { 1 };
                    Behind::Particle(i, shift)
                })
            }
        }
    }
}

fn measure(cell: &impl Convex<Behind>) -> Cell {
    let facet = |(behind, measure)| match behind {
        Behind::Box => None,
        Behind::Particle(neighbour, shift) => Some(Facet { neighbour, shift, measure }),
    };
    let mut facets: Vec<Facet> = cell.facets().filter_map(facet).collect();
    facets.sort_by_key(|f| (f.neighbour, f.shift));
    Cell { measure: cell.measure(), facets }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    fn scattered(space: Space, block: Block, n: usize) -> (Vec<Vec3>, Vec<f64>) {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let mut place = |axis: usize| block.min[axis] + block.sides()[axis] * rng.random::<f64>();
        let points = (0..n).map(|_| Vec3::new(place(0), place(1), place(2))).collect();
        let mut rng = ChaCha8Rng::seed_from_u64(8);
        let spacing = (block.measure(space) / n as f64).powf(1.0 / space.dim() as f64);
        (points, (0..n).map(|_| 0.2 * spacing * (0.8 + 0.4 * rng.random::<f64>())).collect())
    }

    #[test]
    fn cells_fill_the_box_and_facets_agree() {
        for space in [Space::Plane, Space::Solid] {
            let block = Block::new(space, Vec3::new(-1.0, 2.0, 0.5), Vec3::new(1.0, 3.0, 1.7)).unwrap();
            let (points, _) = scattered(space, block, 300);
            for radius in [vec![0.0; 300], vec![0.01; 300]] {
                for boundary in [Boundary::Closed, Boundary::Periodic] {
                    let cells = cells(space, block, boundary, &points, &radius).unwrap();
                    let sum: f64 = cells.iter().map(|c| c.measure).sum();
                    // 300 cells, each cut some 20 times to 1e-16 of the box.
                    assert!((sum / block.measure(space) - 1.0).abs() < 1e-10, "{space:?} {boundary:?} {sum}");
                    check_pairs(&cells);
                }
            }
        }
    }

    /// Every facet is seen alike from both sides.
    fn check_pairs(cells: &[Cell]) {
        for (i, cell) in cells.iter().enumerate() {
            for f in cell.facets.iter().filter(|f| f.measure > 1e-9) {
                let back = f.shift.map(|s| -s);
                let twin = cells[f.neighbour].facets.iter().find(|g| g.neighbour == i && g.shift == back);
                let twin = twin.unwrap_or_else(|| panic!("{i} → {f:?} has no twin"));
                assert!((twin.measure - f.measure).abs() < 1e-10);
            }
        }
    }

    #[test]
    fn power_cells_fill_the_box_with_unequal_radii() {
        for space in [Space::Plane, Space::Solid] {
            let block = Block::at_origin(space, Vec3::new(1.0, 1.0, 1.0)).unwrap();
            // A jittered grid: random points would bury some particles in others.
            let side = if space == Space::Plane { 12 } else { 6usize };
            let n = side.pow(space.dim() as u32);
            let (jitter, radius) = scattered(space, block, n);
            let points: Vec<Vec3> = (0..n)
                .map(|k| {
                    let at = |k: usize, j: f64| (k as f64 + 0.25 + 0.5 * j) / side as f64;
                    let z = if space == Space::Plane { 0.0 } else { at(k / side / side, jitter[k].z) };
                    Vec3::new(at(k % side, jitter[k].x), at(k / side % side, jitter[k].y), z)
                })
                .collect();
            let cells = cells(space, block, Boundary::Periodic, &points, &radius).unwrap();
            let sum: f64 = cells.iter().map(|c| c.measure).sum();
            assert!((sum - 1.0).abs() < 1e-10, "{space:?} {sum}");
            check_pairs(&cells);
        }
    }

    /// Polygons against polyhedra: cells of the plane are those of a slab, by its thickness.
    #[test]
    fn plane_cells_are_those_of_a_slab() {
        let slab = Block::at_origin(Space::Solid, Vec3::new(3.0, 2.0, 0.5)).unwrap();
        let plane = Block::at_origin(Space::Plane, Vec3::new(3.0, 2.0, 0.0)).unwrap();
        let (mut points, radius) = scattered(Space::Plane, plane, 200);
        // On corners and sides too, and on a square lattice, where four lines meet in a corner.
        points.extend([[0.0, 0.0], [3.0, 1.0], [1.5, 2.0]].map(|[x, y]| Vec3::new(x, y, 0.0)));
        let lattice =
            (0..42).map(|k| Vec3::new(f64::from(k % 7) / 2.0, f64::from(k / 7) / 2.5, 0.0)).collect();
        for (points, radius) in
            [(points, radius.iter().map(|r| 0.3 * r).chain([0.0; 3]).collect()), (lattice, vec![0.1; 42])]
        {
            let middle: Vec<Vec3> = points.iter().map(|x| x + Vec3::new(0.0, 0.0, 0.25)).collect();
            let flat = cells(Space::Plane, plane, Boundary::Closed, &points, &radius).unwrap();
            let thick = cells(Space::Solid, slab, Boundary::Closed, &middle, &radius).unwrap();
            for (flat, thick) in flat.iter().zip(&thick) {
                assert!((flat.measure - thick.measure / 0.5).abs() < 1e-12);
                let of = |cell: &Cell, by: f64| -> Vec<(usize, f64)> {
                    let wide = cell.facets.iter().filter(|f| f.measure > 1e-9);
                    wide.map(|f| (f.neighbour, f.measure / by)).collect()
                };
                let (flat, thick) = (of(flat, 1.0), of(thick, 0.5));
                assert_eq!(flat.len(), thick.len());
                for (a, b) in flat.iter().zip(&thick) {
                    assert!(a.0 == b.0 && (a.1 - b.1).abs() < 1e-12, "{a:?} {b:?}");
                }
            }
        }
    }

    #[test]
    fn one_particle_is_its_own_neighbour() {
        let block = Block::at_origin(Space::Solid, Vec3::new(1.0, 2.0, 3.0)).unwrap();
        let cells =
            cells(Space::Solid, block, Boundary::Periodic, &[Vec3::new(0.3, 0.4, 0.5)], &[0.1]).unwrap();
        assert!((cells[0].measure - 6.0).abs() < 1e-12);
        let areas: Vec<f64> =
            cells[0].facets.iter().filter(|f| f.measure > 1e-9).map(|f| f.measure).collect();
        assert_eq!(areas.len(), 6);
        assert!((areas.iter().sum::<f64>() - 22.0).abs() < 1e-12);
    }

    #[test]
    fn two_particles_split_the_box_at_the_radical_plane() {
        let block = Block::at_origin(Space::Plane, Vec3::new(4.0, 1.0, 0.0)).unwrap();
        let points = [Vec3::new(1.0, 0.5, 0.0), Vec3::new(3.0, 0.5, 0.0)];
        let cells = cells(Space::Plane, block, Boundary::Closed, &points, &[0.9, 0.5]).unwrap();
        // (D² + R₁² − R₂²)/2D = (4 + 0.81 − 0.25)/4 from the first particle.
        assert!((cells[0].measure - (1.0 + 4.56 / 4.0)).abs() < 1e-12);
        assert!((cells[0].facets[0].measure - 1.0).abs() < 1e-12);
    }

    #[test]
    fn coincident_particles_are_refused() {
        let block = Block::at_origin(Space::Plane, Vec3::new(1.0, 1.0, 0.0)).unwrap();
        let points = [Vec3::new(0.5, 0.5, 0.0); 2];
        assert!(cells(Space::Plane, block, Boundary::Closed, &points, &[0.1, 0.1]).is_err());
        let points = [Vec3::new(f64::NAN, 0.5, 0.0)];
        assert!(cells(Space::Plane, block, Boundary::Closed, &points, &[0.1]).is_err());
    }
}
