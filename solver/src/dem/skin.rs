//! Skin weights: how much of a bond lies inside the body.
//!
//! Think of the body as completed by its mirror images in its flat faces. A bond whose two ends lie
//! in a face is then shared by the body and its image: half of it belongs to the body, a quarter
//! in the edge between two faces of a solid. Every other bond, and its whole Voronoi facet, lies on
//! one side: a facet cannot cross a mirror, since a point beyond it is nearer to the image. So
//! the weight `2^−k` for `k` faces that hold both ends *is* the share of the completed facet inside the body,
//! in a random packing as in a lattice. The same holds for particles: `2^−k` of each is inside.

use super::arrangement::Arrangement;
use super::bonding::Pair;
use crate::error::{Error, Result};
use serde::{Deserialize, Serialize};
use std::collections::BTreeMap;

/// Whether bonds in the faces of a body carry their full stiffness.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Skin {
    /// All weights 1: the skin is too stiff.
    Full,
    /// The share of each bond that lies inside the body.
    Weighted,
    /// As [`Skin::Weighted`], corrected so that rows of bonds along a beam have the beam's second moment of
    /// area; for lattices. See [`second_moment_shares`].
    SecondMoment,
}

/// For every particle the faces that hold it, as bits in the order of the map.
fn faces_of(faces: &BTreeMap<String, Vec<usize>>, particles: usize) -> Vec<u64> {
    let mut bits = vec![0u64; particles];
    for (bit, members) in faces.values().enumerate() {
        for &p in members {
            bits[p] |= 1 << bit;
        }
    }
    bits
}

/// Share `2^−k` of each bond inside the body, for `k` of the given faces that hold both its ends.
/// Free and tied faces count alike; leave out of `faces` those beyond which the same material goes on.
pub fn bond_shares(faces: &BTreeMap<String, Vec<usize>>, particles: usize, pairs: &[Pair]) -> Vec<f64> {
    let bits = faces_of(faces, particles);
    pairs.iter().map(|p| share(bits[p.ends[0]] & bits[p.ends[1]])).collect()
}

/// Weights of the bonds of a lattice whose rows carry a beam along x.
///
/// Rows at `y_i`, `n` spacings `a = h/n` apart, that carry axial stress are a quadrature rule for
/// `∫σ y dy`. Half weights at the faces are the trapezoidal rule: exact for tension, too stiff
/// in bending, since `Σ w_i y_i² a = (h³/12)(1 + 2/n²)`. Moving the weight
/// `ε = 1/(12(1 − 1/n))` from each face row to the row next to it keeps `Σ w_i = n` and makes the second
/// moment exact (for large n: Gregory's rule with weights 5/12, 13/12, 1, …).
///
/// The weight of a bond is the product over y and z of its row's weight (1 if it crosses rows), times its
/// share inside the faces at x min and max. Particle rows must be equally spaced.
///
/// # Errors
/// Fewer than two row spacings, or rows that are not equally spaced: use [`Skin::Weighted`] there.
pub fn second_moment_shares(arrangement: &Arrangement, pairs: &[Pair]) -> Result<Vec<f64>> {
    let ends: BTreeMap<String, Vec<usize>> = ["left", "right"]
        .iter()
        .filter_map(|f| Some(((*f).to_owned(), arrangement.faces.get(*f)?.clone())))
        .collect();
    let mut weights = bond_shares(&ends, arrangement.particles.len(), pairs);
    for axis in 1..arrangement.space.dim() {
        let (rows, of) = rows_along(arrangement, axis)?;
        let epsilon = 1.0 / (12.0 * (1.0 - 1.0 / rows as f64));
        for (weight, pair) in weights.iter_mut().zip(pairs) {
            let [i, j] = pair.ends.map(|p| of[p]);
            if i == j {
                // With two spacings the middle row is next to both faces.
                let next = f64::from(u8::from(i == 1)) + f64::from(u8::from(i + 1 == rows));
                *weight *= if i == 0 || i == rows { 0.5 - epsilon } else { 1.0 + next * epsilon };
            }
        }
    }
    Ok(weights)
}

/// Number of row spacings along an axis, and the row of each particle.
fn rows_along(arrangement: &Arrangement, axis: usize) -> Result<(usize, Vec<usize>)> {
    let position = &arrangement.particles.position;
    let mut levels: Vec<f64> = position.iter().map(|x| x[axis]).collect();
    let (low, side) = (arrangement.block.min[axis], arrangement.block.sides()[axis]);
    levels.sort_by(f64::total_cmp);
    levels.dedup_by(|b, a| (*b - *a).abs() < 1e-9 * side);
    let rows = levels.len() - 1;
    let even =
        levels.iter().enumerate().all(|(k, y)| (y - low - side * k as f64 / rows as f64).abs() < 1e-6 * side);
    if rows < 2 || !even {
        return Err(Error::Geometry {
            what: "second-moment skin".to_owned(),
            message: format!(
                "it needs at least two equal row spacings along {}, found {rows}; use a finer lattice, or weighted skin",
                ["x", "y", "z"][axis]
            ),
        });
    }
    let of = position.iter().map(|x| ((x[axis] - low) / side * rows as f64).round() as usize).collect();
    Ok((rows, of))
}

/// Share `2^−k` of each particle inside the body, for `k` faces through its centre.
pub fn particle_shares(faces: &BTreeMap<String, Vec<usize>>, particles: usize) -> Vec<f64> {
    faces_of(faces, particles).into_iter().map(share).collect()
}

fn share(faces: u64) -> f64 {
    0.5f64.powi(faces.count_ones() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::block::Block;
    use crate::dem::bond::{BondMaterial, for_each_stiffness};
    use crate::dem::bonding::{BondRecipe, bond_network};
    use crate::dem::lattice::{LatticeKind, lattice};
    use crate::dem::network::Network;
    use crate::dem::section::Section;
    use crate::space::{Space, Vec3};

    fn body(kind: LatticeKind, skin: Skin) -> Network {
        let block = Block::at_origin(kind.space(), Vec3::new(4.0, 3.0, 3.0)).unwrap();
        let l = lattice(kind, block, 3, Default::default()).unwrap();
        let material = BondMaterial { young_pa: 1.0, poisson: 0.3 };
        let recipe = BondRecipe { material, section: Section::Uniform { ratio: 0.7 }, skin };
        bond_network(&l.arrangement, &l.pairs, &recipe).unwrap()
    }

    /// Largest moment, and largest force on an interior particle, over the largest force at all, in simple
    /// shear with the rotation of the material.
    fn unbalanced(network: &Network) -> f64 {
        let per = network.space.dofs_per_particle();
        let dim = network.space.dim();
        let n = network.particles.len();
        let mut q = vec![0.0; per * n];
        for (p, x) in network.particles.position.iter().enumerate() {
            q[p * per] = 1e-3 * x.y;
            // θ_z = ½(∂u_y/∂x − ∂u_x/∂y)
            q[p * per + per - 1] = -0.5e-3;
        }
        let mut f = vec![0.0; per * n];
        for_each_stiffness(network, "test", |dofs, k| {
            for (r, &row) in dofs.iter().enumerate() {
                for (c, &column) in dofs.iter().enumerate() {
                    f[row] += k[r * dofs.len() + c] * q[column];
                }
            }
        })
        .unwrap();
        let on_face: Vec<usize> = network.faces.values().flatten().copied().collect();
        let scale = f.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        let mut worst = 0.0f64;
        for p in 0..n {
            let first = if on_face.contains(&p) { dim } else { 0 };
            for c in first..per {
                worst = worst.max(f[p * per + c].abs());
            }
        }
        worst / scale
    }

    #[test]
    fn uniform_shear_balances_on_square_lattices_with_weighted_skin_only() {
        for kind in [LatticeKind::Square, LatticeKind::SimpleCubic] {
            // A few additions of numbers of order one.
            assert!(unbalanced(&body(kind, Skin::Weighted)) < 1e-14, "{kind:?}");
            assert!(unbalanced(&body(kind, Skin::Full)) > 1e-2, "{kind:?}");
        }
    }

    #[test]
    fn weights_are_halves_and_quarters() {
        let solid = body(LatticeKind::SimpleCubic, Skin::Weighted);
        let count = |w: f64| solid.bonds.weight.iter().filter(|&&b| b == w).count();
        // 4×3×3 cells: all bonds along the edges; then those in a face but not on its edges.
        assert_eq!(count(0.25), 4 * (4 + 3 + 3));
        let inside = |a: usize, b: usize| a * (b - 1) + b * (a - 1);
        assert_eq!(count(0.5), 2 * (2 * inside(4, 3) + inside(3, 3)));
        assert_eq!(count(1.0) + count(0.5) + count(0.25), solid.bonds.len());
        let square = body(LatticeKind::Square, Skin::Weighted);
        assert_eq!(square.bonds.weight.iter().filter(|&&w| w == 0.5).count(), 2 * (4 + 3));
        assert_eq!(Space::Plane, square.space);
    }

    /// Bonds along a beam have its area and second moment of area: to rounding for the corrected skin; half
    /// weights are off by `2/n²`.
    #[test]
    fn second_moment_skin_has_the_area_and_second_moment_of_the_beam() {
        for (kind, rows) in [(LatticeKind::Square, 2), (LatticeKind::Triangular, 3), (LatticeKind::Square, 8)]
        {
            let block =
                Block::new(Space::Plane, Vec3::new(0.0, -1.0, 0.0), Vec3::new(6.0, 1.0, 0.0)).unwrap();
            let l = lattice(kind, block, rows, Default::default()).unwrap();
            let moments = |weights: &[f64]| {
                let mut sums = [0.0; 2];
                for (pair, w) in l.pairs.iter().zip(weights) {
                    let [a, b] = pair.ends.map(|p| l.arrangement.particles.position[p]);
                    if a.y == b.y {
                        let area = w * (b.x - a.x).abs() / 6.0 * 2.0 / rows as f64;
                        sums[0] += area;
                        sums[1] += area * a.y * a.y;
                    }
                }
                sums
            };
            let [area, second] = moments(&second_moment_shares(&l.arrangement, &l.pairs).unwrap());
            assert!((area - 2.0).abs() < 1e-14 && (second - 8.0 / 12.0).abs() < 1e-14, "{area} {second}");
            let [_, half] =
                moments(&bond_shares(&l.arrangement.faces, l.arrangement.particles.len(), &l.pairs));
            let n = rows as f64;
            assert!((half / (8.0 / 12.0) - 1.0 - 2.0 / (n * n)).abs() < 1e-13, "{half}");
        }
    }
}
