//! The stiffness of a bond as a sum of squares: `q·K q = Σ (v·q)²`.

use crate::dem::network::Network;
use crate::space::{Space, Vec3};

/// One deformation of a bond as a functional of the unknowns of its network, times the root of its stiffness.
pub(crate) type Mode = Vec<(usize, f64)>;

/// Modes of a bond of weight `weight`: three in the plane, six in the solid; those without stiffness are left out.
///
/// With `a ∈ {n, s₁, s₂}`: `√k_a a·w = √k_a (a·(u₂ − u₁) − (L/2)(θ₁ + θ₂)·(n×a))` and `√k_a a·φ`, with the stiffnesses
/// `k_n, k_s, k_s` and `k_t, k_b, k_b` times the weight.
pub(crate) fn modes(network: &Network, bond: usize, weight: f64) -> Vec<Mode> {
    let space = network.space;
    let (dim, per) = (space.dim(), space.dofs_per_particle());
    let [i, j] = network.bonds.ends[bond];
    let d = network.particles.position[j] - network.particles.position[i];
    let length = d.norm();
    let n = d / length;
    let axes = match space {
        Space::Plane => [n, Vec3::new(-n.y, n.x, 0.0), Vec3::z()],
        Space::Solid => {
            let s = n.cross(&Vec3::ith(n.iamin(), 1.0)).normalize();
            [n, s, n.cross(&s)]
        }
    };
    let k = network.bonds.stiffness[bond];
    let mut modes = Vec::with_capacity(2 * dim);
    let mut push = |stiffness: f64, displacement: Vec3, turn: [Vec3; 2]| {
        let root = (stiffness * weight).sqrt();
        let ends = [(i, -displacement, turn[0]), (j, displacement, turn[1])];
        let terms = ends.iter().flat_map(|&(p, u, theta)| {
            let translations = (0..dim).map(move |c| (p * per + c, root * u[c]));
            let rotations = space.rotation_axes().iter().enumerate();
            translations.chain(rotations.map(move |(k, &axis)| (p * per + dim + k, root * theta[axis])))
        });
        let terms: Mode = terms.filter(|t| t.1 != 0.0).collect();
        if !terms.is_empty() {
            modes.push(terms);
        }
    };
    for (c, a) in axes.iter().enumerate().take(dim) {
        let arm = -0.5 * length * n.cross(a);
        push(if c == 0 { k.kn } else { k.ks }, *a, [arm, arm]);
    }
    match space {
        Space::Plane => push(k.kb, Vec3::zeros(), [-axes[2], axes[2]]),
        Space::Solid => {
            for (c, a) in axes.iter().enumerate() {
                push(if c == 0 { k.kt } else { k.kb }, Vec3::zeros(), [-*a, *a]);
            }
        }
    }
    modes
}

/// `v·u`.
pub(crate) fn product(mode: &[(usize, f64)], u: &[f64]) -> f64 {
    mode.iter().map(|&(i, v)| v * u[i]).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::bond::for_each_stiffness;
    use crate::dem::network::{BondStiffness, Bonds, Particles};

    #[test]
    fn modes_add_up_to_the_stiffness_matrix() {
        for space in [Space::Plane, Space::Solid] {
            let depth = if space == Space::Plane { 0.0 } else { 0.7 };
            let particles = Particles {
                position: vec![Vec3::zeros(), Vec3::new(0.9, -0.4, depth)],
                ..Particles::default()
            };
            let bonds = Bonds {
                ends: vec![[1, 0]],
                radius: vec![0.1],
                stiffness: vec![BondStiffness { kn: 5.0, ks: 2.0, kb: 0.7, kt: 0.4 }],
                weight: vec![0.5],
            };
            let network = Network { space, particles, bonds, faces: Default::default() };
            let found = modes(&network, 0, 0.5);
            assert_eq!(found.len(), space.dofs_per_particle());
            for_each_stiffness(&network, "test", |dofs, k| {
                for (r, &row) in dofs.iter().enumerate() {
                    for (c, &column) in dofs.iter().enumerate() {
                        let of = |m: &Mode, i| m.iter().find(|t| t.0 == i).map_or(0.0, |t| t.1);
                        let sum: f64 = found.iter().map(|m| of(m, row) * of(m, column)).sum();
                        assert!((sum - k[r * dofs.len() + c]).abs() < 1e-14, "{space:?} {row} {column}");
                    }
                }
            })
            .unwrap();
        }
    }
}
