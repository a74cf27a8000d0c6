//! A safe bound on the critical time step `2/ω_max` of central differences.
//!
//! `ω²_max(M⁻¹K) ≤ max_e ω²_max(M_e⁻¹K_e)` for any split of the masses among elements and bonds
//! with `Σ M_e = M` (Irons & Treharne 1971). Each element and bond gets a share of the mass
//! in proportion to its share of the stiffness there, which for `Z` equal bonds is `m/Z` and `J/Z`. Supports, ties
//! and multipliers take freedom away and cannot raise a frequency: the bound holds for the coupled model.

use super::forces::InternalForces;
use super::system::System;
use crate::dem::network::{BondStiffness, Network};
use crate::error::{Error, Result};
use crate::fem;
use crate::fem::continuum::Continuum;
use crate::fem::loads::lumped_mass;
use crate::model::{Model, Part};
use crate::space::Space;
use crate::work::Work;
use nalgebra::DMatrix;

/// A bound on the critical step, and what sets it.
#[derive(Debug, Clone, PartialEq)]
pub struct CriticalStep {
    /// In s; infinite if nothing can vibrate.
    pub step_s: f64,
    /// The element or bond that sets it.
    pub what: String,
}

impl CriticalStep {
    /// Refuses a step beyond the bound, or one that is no step at all.
    ///
    /// # Errors
    /// [`Error::UnstableStep`] with both numbers; [`Error::Solve`] for a step that is not positive.
    pub fn admit(&self, step_s: f64) -> Result<()> {
        if !(step_s.is_finite() && step_s > 0.0) {
            return Err(Error::Solve {
                message: format!(
                    "a time step of {step_s} s; give a positive one, at most {:.6e} s",
                    self.step_s
                ),
            });
        }
        // A step computed as a share of the bound may come back one rounding above it.
        if step_s > self.step_s * (1.0 + 4.0 * f64::EPSILON) {
            return Err(Error::UnstableStep { step_s, critical_s: self.step_s, what: self.what.clone() });
        }
        Ok(())
    }
}

/// The bound for a model: the smallest of its parts.
///
/// # Errors
/// Bad elements; masses and bonds are assumed to be checked ([`System::new`]).
pub fn bound(model: &Model) -> Result<CriticalStep> {
    bound_of(model.parts.iter())
}

/// The bound for some parts, as [`bound`].
///
/// # Errors
/// As [`bound`].
pub fn bound_of<'a>(parts: impl Iterator<Item = &'a Part>) -> Result<CriticalStep> {
    let mut highest = (0.0, "nothing".to_owned());
    for part in parts {
        let (omega2, at, noun) = match part {
            Part::Continuum(body) => {
                let (omega2, at) = highest_element(body)?;
                (omega2, at, "element")
            }
            Part::Discrete { network, .. } => {
                let (omega2, at) = highest_bond(network);
                (omega2, at, "bond")
            }
        };
        if omega2 > highest.0 {
            highest = (omega2, format!("{noun} {at} of body '{}'", part.name()));
        }
    }
    Ok(CriticalStep { step_s: 2.0 / f64::sqrt(highest.0), what: highest.1 })
}

/// `2/ω_max` by power iteration on `M⁻¹K` of the untied, unsupported parts: an estimate from above, to
/// check [`bound`] with.
pub fn iterate(system: &System, forces: &InternalForces, iterations: usize) -> f64 {
    let mass = &system.mass;
    // Any start with a share of every mode will do.
    let mut x: Vec<f64> =
        (0..mass.len()).map(|i| (1.0 + (i as f64 * 12.9898).sin()) / mass[i].sqrt()).collect();
    let mut omega2 = 0.0;
    for _ in 0..iterations {
        let mut f = vec![0.0; x.len()];
        forces.add(&x, &mut f, &mut Work::default());
        // Rayleigh quotient xᵀKx / xᵀMx.
        let modal_mass: f64 = x.iter().zip(mass).map(|(x, m)| m * x * x).sum();
        omega2 = x.iter().zip(&f).map(|(x, f)| x * f).sum::<f64>() / modal_mass;
        let length = f.iter().zip(mass).map(|(f, m)| f * f / m).sum::<f64>().sqrt();
        x = f.iter().zip(mass).map(|(f, m)| f / m / length).collect();
    }
    2.0 / omega2.sqrt()
}

/// Largest `ω²` of the bonds with their share of the masses, and the bond.
fn highest_bond(network: &Network) -> (f64, usize) {
    let bonds = &network.bonds;
    let count = network.particles.len();
    let demand = |b: usize| Demand::of(network, b);
    let mut sums = vec![Demand::default(); count];
    for (b, ends) in bonds.ends.iter().enumerate() {
        for &p in ends {
            sums[p].translation += demand(b).translation;
            sums[p].rotation += demand(b).rotation;
        }
    }
    let mut highest = (0.0, 0);
    for (b, ends) in bonds.ends.iter().enumerate() {
        if bonds.weight[b] == 0.0 {
            continue;
        }
        let own = demand(b);
        let inverse_mass = ends.map(|p| sums[p].translation / own.translation / network.particles.mass[p]);
        let inverse_inertia = ends.map(|p| sums[p].rotation / own.rotation / network.particles.inertia[p]);
        let k = weighted(network, b);
        let omega2 = pair_frequency(network.space, k, network.bond_length(b), inverse_mass, inverse_inertia);
        if omega2 > highest.0 {
            highest = (omega2, b);
        }
    }
    highest
}

/// What a bond asks of the masses (N/m) and inertias (N m) of its ends.
#[derive(Debug, Clone, Copy, Default)]
struct Demand {
    translation: f64,
    rotation: f64,
}

impl Demand {
    fn of(network: &Network, bond: usize) -> Self {
        let k = weighted(network, bond);
        let l = network.bond_length(bond);
        let torsion = if network.space == Space::Solid { k.kt } else { 0.0 };
        Demand { translation: k.kn.max(k.ks), rotation: 0.25 * k.ks * l * l + k.kb.max(torsion) }
    }
}

fn weighted(network: &Network, bond: usize) -> BondStiffness {
    let (k, w) = (network.bonds.stiffness[bond], network.bonds.weight[bond]);
    BondStiffness { kn: w * k.kn, ks: w * k.ks, kb: w * k.kb, kt: w * k.kt }
}

/// Largest `ω²` of a free pair with the given inverse masses and inertias.
///
/// Axial `k_n Σ1/m`, torsion `k_t Σ1/J`; shear, rotation and bending share the 2×2 problem
/// `[k_s (Σ1/m + (L²/4) Σ1/J), s; s, k_b Σ1/J]`, `s = √(k_s k_b) (L/2)(1/J₁ − 1/J₂)`.
pub fn pair_frequency(
    space: Space,
    k: BondStiffness,
    l: f64,
    inverse_mass: [f64; 2],
    inverse_inertia: [f64; 2],
) -> f64 {
    let per_mass: f64 = inverse_mass.iter().sum();
    let per_inertia: f64 = inverse_inertia.iter().sum();
    let shear = k.ks * (per_mass + 0.25 * l * l * per_inertia);
    let bending = k.kb * per_inertia;
    let mixed = (k.ks * k.kb).sqrt() * 0.5 * l * (inverse_inertia[0] - inverse_inertia[1]);
    let transverse = 0.5 * (shear + bending) + (0.25 * (shear - bending).powi(2) + mixed * mixed).sqrt();
    let torsion = if space == Space::Solid { k.kt * per_inertia } else { 0.0 };
    transverse.max(k.kn * per_mass).max(torsion)
}

/// Largest `ω²` of the elements with their share of the nodal masses, and the element.
fn highest_element(body: &Continuum) -> Result<(f64, usize)> {
    let dim = body.mesh.space.dim();
    let mass = lumped_mass(body)?;
    let mut diagonal = vec![0.0; body.dof_count()];
    fem::assembly::for_each_stiffness(body, |dofs, k| {
        dofs.iter().enumerate().for_each(|(r, &i)| diagonal[i] += k[r * dofs.len() + r]);
    })?;
    let mut highest = (0.0, 0);
    let mut element = 0;
    let mut known: Vec<(DMatrix<f64>, f64)> = Vec::new();
    fem::assembly::for_each_stiffness(body, |dofs, k| {
        let n = dofs.len();
        // M_e⁻½ K_e M_e⁻½ with m_e = m k_ii / Σ k_ii.
        let root: Vec<f64> =
            (0..n).map(|r| (diagonal[dofs[r]] / k[r * n + r] / mass[dofs[r] / dim]).sqrt()).collect();
        let scaled = DMatrix::from_fn(n, n, |r, c| k[r * n + c] * root[r] * root[c]);
        let omega2 = largest_eigenvalue(scaled, &mut known);
        if omega2 > highest.0 {
            highest = (omega2, element);
        }
        element += 1;
    })?;
    Ok(highest)
}

/// Elements of this many kinds are remembered.
const KINDS: usize = 8;
/// Elements of one kind differ by this share: rounding of their nodes.
const SAME: f64 = 1e-9;

/// Largest eigenvalue of a symmetric matrix, from above: `λ(A) ≤ λ(B) + ‖A − B‖` (Weyl) where `B` is known and all but the same,
/// which spares structured meshes all but a few eigenproblems.
fn largest_eigenvalue(matrix: DMatrix<f64>, known: &mut Vec<(DMatrix<f64>, f64)>) -> f64 {
    let near = known.iter().find_map(|(other, largest)| {
        let off = if other.len() == matrix.len() { (&matrix - other).norm() } else { f64::INFINITY };
        (off <= SAME * largest).then_some(largest + off)
    });
    near.unwrap_or_else(|| {
        let largest = matrix.symmetric_eigenvalues().max();
        if known.len() < KINDS {
            known.push((matrix, largest));
        }
        largest
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::bond::{BondMaterial, stiffness_matrix};
    use crate::space::Vec3;
    use nalgebra::SMatrix;

    /// The four pair modes against the eigenvalues of the 12×12 pair, slender to stout, equal and unequal ends.
    #[test]
    fn pair_modes_are_the_eigenvalues_of_the_pair() {
        let material = BondMaterial { young_pa: 3.0, poisson: 0.3 };
        for ratio in [0.01, 0.1, 0.3, 0.6, 0.62, 0.7, 1.0] {
            for partner in [1.0, 1.7, 40.0] {
                let d = Vec3::new(0.6, -1.2, 1.4);
                let l = d.norm();
                let big = 0.5 * l;
                let k = material.cylinder(ratio * big, l);
                let mass = [1.0, partner];
                let inertia = mass.map(|m| 0.4 * m * big * big);
                let root = |i: usize| (if i % 6 < 3 { mass[i / 6] } else { inertia[i / 6] }).sqrt();
                let full = stiffness_matrix(d, k);
                let scaled = SMatrix::<f64, 12, 12>::from_fn(|r, c| full[(r, c)] / root(r) / root(c));
                let exact = scaled.symmetric_eigenvalues().max();
                let found =
                    pair_frequency(Space::Solid, k, l, mass.map(|m| 1.0 / m), inertia.map(|j| 1.0 / j));
                // Eigenvalues of a 12×12 matrix to rounding of the largest.
                assert!((found / exact - 1.0).abs() < 1e-12, "r̃ = {ratio}, {partner}: {found} {exact}");
            }
        }
    }

    /// A known neighbour bounds from above by less than its share; a stranger is solved for itself.
    #[test]
    fn like_matrices_share_their_eigenvalue() {
        let mut known = Vec::new();
        let base = DMatrix::from_fn(4, 4, |r, c| if r == c { 2.0 + r as f64 } else { 0.5 });
        let of = |m: &DMatrix<f64>| m.clone().symmetric_eigenvalues().max();
        assert_eq!(largest_eigenvalue(base.clone(), &mut known), of(&base));
        let near = base.map(|x| x * (1.0 + 1e-11));
        let bound = largest_eigenvalue(near.clone(), &mut known);
        assert!(bound >= of(&near) && bound < of(&near) * (1.0 + 2.0 * SAME) && known.len() == 1);
        let far = base.map(|x| x * (1.0 + 1e-6));
        assert_eq!(largest_eigenvalue(far.clone(), &mut known), of(&far));
        assert_eq!(known.len(), 2);
    }

    /// Equal ends, L = 2R: shear–rotation over axial is 2.625 r̃² in ω².
    #[test]
    fn rotation_decides_for_stout_bonds() {
        let material = BondMaterial { young_pa: 1.0, poisson: 0.3 };
        for ratio in [0.61, 0.62] {
            let k = material.cylinder(ratio, 2.0);
            let omega2 = pair_frequency(Space::Plane, k, 2.0, [1.0; 2], [2.5; 2]);
            let expected = k.kn * 2.0 * f64::max(1.0, 2.625 * ratio * ratio);
            assert!((omega2 / expected - 1.0).abs() < 1e-14, "{ratio}");
            assert_eq!(omega2 > 2.0 * k.kn * (1.0 + 1e-14), ratio > 0.617);
        }
    }
}
