//! Periodic homogenisation: the exact stiffness of an infinite body made of one period of a network.
//!
//! For each unit macro strain `ε` the particles move by `εx + ũ` with a periodic fluctuation `ũ` and turn by `θ`; both
//! follow from equilibrium, `K ũ = −f(ε)`, where `f(ε)` are the forces of the affine motion. Then
//! `C_ab V = Σ_bonds q_aᵀ K q_b + f_a·ũ_b` (energy of the whole motion; e.g. Michel, Moulinec & Suquet 1999).

use super::equilibrium::Equilibrium;
use super::isotropy::Moduli;
use crate::dem::bond::{keep_rows, stiffness_matrix};
use crate::dem::bonding::PeriodicNetwork;
use crate::dem::clusters::Clusters;
use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::fem::elasticity::Stiffness;
use crate::solve::sparse::Triplets;
use crate::space::{Space, Vec3};
use crate::work::Work;
use nalgebra::Matrix3;

/// Effective stiffness of a periodic network.
#[derive(Debug, Clone, PartialEq)]
pub struct Homogenised {
    /// Voigt stiffness in Pa (order `xx, yy, zz, xy, yz, zx`; a plane network fills `xx, yy, xy`).
    pub stiffness: Stiffness,
    /// Its isotropic projection.
    pub moduli: Moduli,
    /// Particles that carry no load: without bonds, or in clusters apart from the largest.
    pub idle: usize,
}

/// Voigt components a space has.
const fn components(space: Space) -> &'static [usize] {
    match space {
        Space::Plane => &[0, 1, 3],
        Space::Solid => &[0, 1, 2, 3, 4, 5],
    }
}

/// Unit strain tensor of a Voigt component: shear components are engineering strains.
fn unit_strain(component: usize) -> Matrix3<f64> {
    let (i, j) = [(0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0)][component];
    let mut strain = Matrix3::zeros();
    strain[(i, j)] += 0.5;
    strain[(j, i)] += 0.5;
    strain
}

/// Homogenises a periodic network.
///
/// # Errors
/// A network without bonds; a linear solve that fails.
pub fn homogenise(periodic: &PeriodicNetwork, work: &mut Work) -> Result<Homogenised> {
    let space = periodic.network.space;
    let numbering = Numbering::new(periodic)?;
    let system = System::assemble(periodic, &numbering);
    work.bond_updates += periodic.network.bonds.len() as u64;
    let equilibrium = Equilibrium::new(numbering.count, &system.triplets, work)?;

    let components = components(space);
    let mut stiffness = system.affine;
    for (b, force) in system.force.iter().enumerate() {
        let fluctuation = equilibrium.solve(force, work)?;
        for (a, other) in system.force.iter().enumerate() {
            // The forces push the particles away from the affine motion: K ũ = −f.
            let relaxed: f64 = other.iter().zip(&fluctuation).map(|(f, u)| f * u).sum();
            stiffness[(components[a], components[b])] -= relaxed;
        }
    }
    stiffness /= periodic.volume();
    Ok(Homogenised { stiffness, moduli: Moduli::project(space, &stiffness), idle: numbering.idle })
}

/// Unknowns of the particles that carry load.
struct Numbering {
    /// Unknown of each degree of freedom; `None` where it is held.
    unknown: Vec<Option<usize>>,
    count: usize,
    idle: usize,
}

impl Numbering {
    /// Held are the particles outside the largest cluster, and the translations of one particle of it (a periodic
    /// fluctuation cannot turn as a whole).
    fn new(periodic: &PeriodicNetwork) -> Result<Self> {
        let space = periodic.network.space;
        let particles = periodic.network.particles.len();
        let cluster = carriers(periodic);
        let Some(&anchor) = cluster.first() else {
            return Err(Error::Geometry {
                what: "homogenisation".into(),
                message: "the network has no bonds; bond it first".into(),
            });
        };
        let mut carries = vec![false; particles];
        cluster.iter().for_each(|&p| carries[p] = true);
        let mut numbering = Self { unknown: Vec::new(), count: 0, idle: particles - cluster.len() };
        for (particle, &carries) in carries.iter().enumerate() {
            for c in 0..space.dofs_per_particle() {
                let held = !carries || (particle == anchor && c < space.dim());
                numbering.unknown.push((!held).then_some(numbering.count));
                numbering.count += usize::from(!held);
            }
        }
        Ok(numbering)
    }
}

/// Particles of the largest cluster, ascending. A period of one particle is bonded to its own images.
fn carriers(periodic: &PeriodicNetwork) -> Vec<usize> {
    let Network { particles, bonds, .. } = &periodic.network;
    let own_image = bonds.ends.iter().find(|[i, j]| i == j).map(|[i, _]| vec![*i]);
    let largest = Clusters::of(particles.len(), bonds.ends.iter().copied()).largest();
    if largest.is_empty() { own_image.unwrap_or_default() } else { largest }
}

/// Stiffness of the fluctuation, forces of each unit strain, and `Σ q_aᵀ K q_b` of the affine motions.
struct System {
    triplets: Triplets,
    force: Vec<Vec<f64>>,
    affine: Stiffness,
}

impl System {
    fn assemble(periodic: &PeriodicNetwork, numbering: &Numbering) -> Self {
        let Network { space, bonds, .. } = &periodic.network;
        let per = space.dofs_per_particle();
        let n = 2 * per;
        let components = components(*space);
        let strains: Vec<_> = components.iter().map(|&c| unit_strain(c)).collect();
        let mut system = Self {
            triplets: Triplets::with_capacity(bonds.len() * n * (n + 1)),
            force: vec![vec![0.0; numbering.count]; components.len()],
            affine: Stiffness::zeros(),
        };
        let mut k = [0.0; 144];
        for b in 0..bonds.len() {
            let [i, j] = bonds.ends[b];
            let d = periodic.bond_vector(b);
            keep_rows(*space, &(stiffness_matrix(d, bonds.stiffness[b]) * bonds.weight[b]), &mut k);
            let unknown = |r: usize| numbering.unknown[if r < per { i * per + r } else { j * per + r - per }];
            for r in 0..n {
                for c in 0..n {
                    if let (Some(row), Some(column)) = (unknown(r), unknown(c)) {
                        system.triplets.push(row, column, k[r * n + c]);
                    }
                }
            }
            // The affine motion moves the second end by εd against the first.
            let moved: Vec<Vec3> = strains.iter().map(|strain| strain * d).collect();
            for (a, moved_a) in moved.iter().enumerate() {
                let force =
                    |r: usize| -> f64 { (0..space.dim()).map(|c| k[r * n + per + c] * moved_a[c]).sum() };
                for r in 0..n {
                    if let Some(row) = unknown(r) {
                        system.force[a][row] += force(r);
                    }
                }
                for (b, moved_b) in moved.iter().enumerate() {
                    let energy: f64 = (0..space.dim()).map(|c| moved_b[c] * force(per + c)).sum();
                    system.affine[(components[b], components[a])] += energy;
                }
            }
        }
        system
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Arrangement;
    use crate::dem::block::Block;
    use crate::dem::bond::BondMaterial;
    use crate::dem::bonding::{BondRecipe, Pair, periodic_network};
    use crate::dem::grid::Boundary;
    use crate::dem::section::Section;
    use crate::dem::skin::Skin;

    /// Two particles per period along x, each bonded to its own image along y.
    fn chain(kn: [f64; 2]) -> PeriodicNetwork {
        let block = Block::at_origin(Space::Plane, Vec3::new(1.0, 1.0, 0.0)).unwrap();
        let position = vec![Vec3::new(0.2, 0.5, 0.0), Vec3::new(0.7, 0.5, 0.0)];
        let arrangement = Arrangement::new(
            Space::Plane,
            block,
            Boundary::Periodic,
            Default::default(),
            position,
            vec![0.25; 2],
        )
        .unwrap();
        let pairs = [([0, 0], [0, 1, 0]), ([1, 1], [0, 1, 0]), ([0, 1], [0, 0, 0]), ([0, 1], [-1, 0, 0])]
            .map(|(ends, shift)| Pair { ends, shift });
        let material = BondMaterial { young_pa: 1.0, poisson: 0.3 };
        let recipe = BondRecipe { material, section: Section::Uniform { ratio: 1.0 }, skin: Skin::Full };
        let mut network = periodic_network(&arrangement, &pairs, &recipe).unwrap();
        for (k, kn) in network.network.bonds.stiffness[2..].iter_mut().zip(kn) {
            k.kn = kn;
        }
        network
    }

    #[test]
    fn unequal_bonds_in_a_row_act_in_series() {
        // Two springs k₁, k₂ in a period of unit length, height and thickness: C11 = k₁k₂/(k₁+k₂), where
        // the affine motion would give (k₁+k₂)/4.
        let found = homogenise(&chain([1.0, 3.0]), &mut Work::default()).unwrap();
        assert!((found.stiffness[(0, 0)] - 0.75).abs() < 1e-13, "{}", found.stiffness);
        assert!(found.stiffness[(0, 1)].abs() < 1e-13);
        assert_eq!(found.idle, 0);
    }

    #[test]
    fn a_network_without_bonds_is_refused() {
        let mut network = chain([1.0, 1.0]);
        network.network.bonds = Default::default();
        network.shift.clear();
        assert!(homogenise(&network, &mut Work::default()).is_err());
    }
}
