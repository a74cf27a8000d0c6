//! Regular lattices that fill a box exactly, with flat faces.
//!
//! A lattice has a whole number of cells along each side of the box. The number across the
//! height is given; along the other sides it is the nearest to the regular cell, which is then
//! stretched to fit: by at most one part in `2n` for `n` cells (5 % for 10, 0.6 % for 80).
//! [`Lattice::stretch`] says by how much. A stretched cell is slightly anisotropic;
//! homogenising it ([`super::calibration`]) tells what that changes.

use super::arrangement::{Arrangement, Matter};
use super::block::Block;
use super::bonding::Pair;
use super::grid::Boundary;
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Kind of lattice.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum LatticeKind {
    /// Plane; rows parallel to x, each shifted by half a spacing against the next. Its ends at x min
    /// and max are flat faces: the regular lattice is cut at a mirror line through particles, and
    /// where the line halves a bond of a shifted row, a particle ends the half. With its mirror
    /// image it *is* the regular lattice, so no bond runs along these faces.
    Triangular,
    /// Plane; like [`LatticeKind::Triangular`], but shifted rows end half a spacing before the
    /// faces: the exact bulk lattice up to its zigzag ends.
    TriangularZigzag,
    /// Plane, four neighbours.
    Square,
    /// Simple cubic, six neighbours.
    SimpleCubic,
    /// Body-centred cubic, eight neighbours.
    BodyCentredCubic,
    /// Face-centred cubic, twelve neighbours.
    FaceCentredCubic,
}

/// A lattice and its pairs of neighbours.
#[derive(Debug, Clone, PartialEq)]
pub struct Lattice {
    /// The particles.
    pub arrangement: Arrangement,
    /// Neighbours, each once, ascending.
    pub pairs: Vec<Pair>,
    /// Cell length over its regular length, less one, along each side.
    pub stretch: [f64; 3],
    /// Sides of a cell as it fills the box, in m.
    pub cell: Vec3,
}

/// Lattice sites are counted on a grid of half (or whole) cells; neighbours differ by these steps.
struct Pattern {
    space: Space,
    /// Grid intervals per cell along each axis.
    per_cell: [usize; 3],
    /// Regular length of a cell along x, y, z over the one along y.
    proportion: [f64; 3],
    /// Neighbour distance of the regular lattice over the cell's length along y.
    neighbour: f64,
    /// Steps from a site to the neighbours that come after it.
    steps: &'static [[i64; 3]],
}

impl LatticeKind {
    fn pattern(self) -> Pattern {
        let (space, per_cell, neighbour, steps): (_, _, _, &'static [[i64; 3]]) = match self {
            LatticeKind::Triangular | LatticeKind::TriangularZigzag => {
                // (1,0,0) only occurs at flat ends: half a bond.
                let steps = &[[2, 0, 0], [1, 0, 0], [1, 1, 0], [-1, 1, 0]];
                (Space::Plane, [2, 1, 1], 2.0 / 3f64.sqrt(), steps)
            }
            LatticeKind::Square => (Space::Plane, [1, 1, 1], 1.0, &[[1, 0, 0], [0, 1, 0]]),
            LatticeKind::SimpleCubic => (Space::Solid, [1, 1, 1], 1.0, &[[1, 0, 0], [0, 1, 0], [0, 0, 1]]),
            LatticeKind::BodyCentredCubic => {
                let steps = &[[1, 1, 1], [-1, 1, 1], [1, -1, 1], [-1, -1, 1]];
                (Space::Solid, [2, 2, 2], 0.75f64.sqrt(), steps)
            }
            LatticeKind::FaceCentredCubic => {
                let steps = &[[1, 1, 0], [-1, 1, 0], [1, 0, 1], [-1, 0, 1], [0, 1, 1], [0, -1, 1]];
                (Space::Solid, [2, 2, 2], 0.5f64.sqrt(), steps)
            }
        };
        let along_x = if space == Space::Plane { neighbour } else { 1.0 };
        Pattern { space, per_cell, proportion: [along_x, 1.0, 1.0], neighbour, steps }
    }

    /// Plane or solid.
    pub fn space(self) -> Space {
        self.pattern().space
    }

    /// Whether a point of the counting grid of `n` intervals is a site.
    fn is_site(self, p: [usize; 3], n: [usize; 3]) -> bool {
        let end = p[0] == 0 || p[0] == n[0];
        match self {
            LatticeKind::Triangular => (p[0] + p[1]).is_multiple_of(2) || end,
            LatticeKind::TriangularZigzag => (p[0] + p[1]).is_multiple_of(2),
            LatticeKind::Square | LatticeKind::SimpleCubic => true,
            LatticeKind::BodyCentredCubic => p[0] % 2 == p[1] % 2 && p[1] % 2 == p[2] % 2,
            LatticeKind::FaceCentredCubic => (p[0] + p[1] + p[2]).is_multiple_of(2),
        }
    }
}

/// How the cells of a lattice fit a box.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fit {
    /// Number of cells along each side; zero along an axis the lattice does not have.
    pub cells: [usize; 3],
    /// As [`Lattice::stretch`].
    pub stretch: [f64; 3],
    /// As [`Lattice::cell`].
    pub cell: Vec3,
    /// Neighbour distance of the regular cell of the same volume, in m: twice the radius of the particles.
    pub spacing: f64,
}

/// Fits `rows` cells (triangular: row intervals) into the height of a box, and the nearest number into its other sides.
///
/// # Errors
/// As [`lattice()`].
pub fn fit(kind: LatticeKind, block: Block, rows: usize) -> Result<Fit> {
    let pattern = kind.pattern();
    let dim = pattern.space.dim();
    let sides = block.sides();
    if rows == 0 {
        return Err(refusal(kind, "it needs at least one row across the height"));
    }
    let height = sides.y / rows as f64;
    let mut cells = [0usize; 3];
    let mut stretch = [0.0; 3];
    let mut cell = Vec3::zeros();
    let mut volume_ratio = 1.0;
    for axis in 0..dim {
        let regular = pattern.proportion[axis] * height;
        let least = if axis == 0 && pattern.per_cell == [2, 1, 1] { 2.0 } else { 1.0 };
        let count = (sides[axis] / regular).round();
        if count < least {
            let message = format!(
                "{:.3} cells of height {height:.3e} m fit along {}, at least {least} are needed; use more rows",
                sides[axis] / regular,
                ["x", "y", "z"][axis],
            );
            return Err(refusal(kind, &message));
        }
        cells[axis] = count as usize;
        cell[axis] = sides[axis] / count;
        stretch[axis] = sides[axis] / (count * regular) - 1.0;
        volume_ratio *= 1.0 + stretch[axis];
    }
    let spacing = pattern.neighbour * height * volume_ratio.powf(1.0 / dim as f64);
    Ok(Fit { cells, stretch, cell, spacing })
}

/// Fills a box with a lattice of `rows` cells across its height (triangular: row intervals).
/// All radii are half the neighbour distance of a regular cell of the same volume.
///
/// # Errors
/// `rows` of zero, or fewer than two cells along the x of a triangular lattice.
pub fn lattice(kind: LatticeKind, block: Block, rows: usize, matter: Matter) -> Result<Lattice> {
    let Fit { cells, stretch, cell, spacing } = fit(kind, block, rows)?;
    let pattern = kind.pattern();
    let n = [0, 1, 2].map(|axis| cells[axis] * pattern.per_cell[axis]);
    let (position, index) = sites(kind, block, n);
    let pairs = pairs(&index, pattern.steps);
    let radius = vec![0.5 * spacing; position.len()];
    let arrangement = Arrangement::new(pattern.space, block, Boundary::Closed, matter, position, radius)?;
    Ok(Lattice { arrangement, pairs, stretch, cell })
}

fn refusal(kind: LatticeKind, message: &str) -> Error {
    Error::Geometry { what: format!("{kind:?} lattice"), message: message.to_owned() }
}

/// Positions of the sites, z slowest and x fastest, and their numbers by grid point.
fn sites(kind: LatticeKind, block: Block, n: [usize; 3]) -> (Vec<Vec3>, BTreeMap<[i64; 3], usize>) {
    let along = |axis: usize, p: usize| {
        // The last one is the face itself, not a rounded sum.
        if p == n[axis] && p > 0 {
            return block.max[axis];
        }
        block.min[axis] + block.sides()[axis] * p as f64 / n[axis].max(1) as f64
    };
    let mut position = Vec::new();
    let mut index = BTreeMap::new();
    for pz in 0..=n[2] {
        for py in 0..=n[1] {
            for px in 0..=n[0] {
                if kind.is_site([px, py, pz], n) {
                    index.insert([px as i64, py as i64, pz as i64], position.len());
                    position.push(Vec3::new(along(0, px), along(1, py), along(2, pz)));
                }
            }
        }
    }
    (position, index)
}

fn pairs(index: &BTreeMap<[i64; 3], usize>, steps: &[[i64; 3]]) -> Vec<Pair> {
    let mut pairs = Vec::new();
    for (p, &i) in index {
        for s in steps {
            if let Some(&j) = index.get(&[p[0] + s[0], p[1] + s[1], p[2] + s[2]]) {
                pairs.push(Pair::inside(i.min(j), i.max(j)));
            }
        }
    }
    pairs.sort_unstable();
    pairs
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::bonding;

    fn plane(length: f64, height: f64) -> Block {
        Block::at_origin(Space::Plane, Vec3::new(length, height, 0.0)).unwrap()
    }

    #[test]
    fn triangular_beam_has_the_reference_counts() {
        for (rows, particles) in [(4, 57), (8, 202), (16, 739), (32, 2788)] {
            let l = lattice(LatticeKind::Triangular, plane(3.0, 1.0), rows, Matter::default()).unwrap();
            assert_eq!(l.arrangement.particles.len(), particles, "{rows} rows");
            assert_eq!(l.arrangement.faces["left"].len(), rows + 1);
            assert!(l.stretch[0].abs() < 0.5 / (3.0 * rows as f64 * 0.75f64.sqrt() - 0.5));
        }
    }

    #[test]
    fn triangular_pairs_are_the_delaunay_triangulation_but_for_the_mirror_lines() {
        let l = lattice(LatticeKind::Triangular, plane(3.0, 1.0), 8, Matter::default()).unwrap();
        let mut delaunay = bonding::delaunay(&l.arrangement, 1e-6);
        delaunay.retain(|&p| bonding::pair_vector(&l.arrangement, p).x != 0.0);
        assert_eq!(delaunay, l.pairs);
    }

    #[test]
    fn zigzag_ends_lack_the_end_particles() {
        let l = lattice(LatticeKind::TriangularZigzag, plane(3.0, 1.0), 4, Matter::default()).unwrap();
        assert_eq!(l.arrangement.particles.len(), 57 - 4);
        let regular = l.pairs.iter().all(|&p| bonding::pair_vector(&l.arrangement, p).norm() > 0.28);
        assert!(regular, "no half spacings");
    }

    #[test]
    fn mass_is_the_bodys() {
        let solid = Block::at_origin(Space::Solid, Vec3::new(3.0, 1.0, 1.0)).unwrap();
        let matter = Matter { density: 2500.0, thickness_m: 0.2 };
        use LatticeKind::*;
        for kind in [Triangular, TriangularZigzag, Square, SimpleCubic, BodyCentredCubic, FaceCentredCubic] {
            let (block, volume) =
                if kind.space() == Space::Plane { (plane(3.0, 1.0), 0.6) } else { (solid, 3.0) };
            let l = lattice(kind, block, 3, matter).unwrap();
            let mass: f64 = l.arrangement.particles.mass.iter().sum();
            // Sum of some hundred cells, each to rounding.
            assert!((mass / (2500.0 * volume) - 1.0).abs() < 1e-11, "{kind:?}: {mass}");
        }
    }

    #[test]
    fn interior_particles_have_the_coordination_of_the_lattice() {
        let solid = Block::at_origin(Space::Solid, Vec3::new(4.0, 4.0, 4.0)).unwrap();
        use LatticeKind::*;
        for (kind, z) in
            [(Triangular, 6), (Square, 4), (SimpleCubic, 6), (BodyCentredCubic, 8), (FaceCentredCubic, 12)]
        {
            let block = match kind {
                // Four regular cells of length 2/√3.
                Triangular => plane(8.0 / 3f64.sqrt(), 4.0),
                Square => plane(4.0, 4.0),
                _ => solid,
            };
            let l = lattice(kind, block, 4, Matter::default()).unwrap();
            let x = &l.arrangement.particles.position;
            let centre = |p: &usize| {
                let inside = |c: f64| c > 0.9 && c < 3.1;
                inside(x[*p].x) && inside(x[*p].y) && (kind.space() == Space::Plane || inside(x[*p].z))
            };
            let inner: Vec<usize> = (0..x.len()).filter(centre).collect();
            assert!(!inner.is_empty());
            for p in inner {
                assert_eq!(l.pairs.iter().filter(|b| b.ends.contains(&p)).count(), z, "{kind:?}");
            }
            let spacing = 2.0 * l.arrangement.particles.radius[0];
            let regular =
                |p: &Pair| (bonding::pair_vector(&l.arrangement, *p).norm() / spacing - 1.0).abs() < 1e-12;
            let odd = l.pairs.iter().filter(|p| !regular(p)).count();
            // A flat end has one half bond per shifted row.
            assert_eq!(odd, if kind == Triangular { 2 * 2 } else { 0 }, "{kind:?}");
        }
    }

    #[test]
    fn refuses_what_does_not_fit() {
        assert!(lattice(LatticeKind::Square, plane(1.0, 1.0), 0, Matter::default()).is_err());
        assert!(lattice(LatticeKind::Square, plane(0.1, 1.0), 3, Matter::default()).is_err());
        assert!(lattice(LatticeKind::Triangular, plane(1.0, 1.0), 1, Matter::default()).is_err());
    }
}
