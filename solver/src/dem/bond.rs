//! The cylindrical Euler–Bernoulli bond.
//!
//! For small rotations, about the mid-point of the bond with unit direction `n` (1→2):
//!
//! `w = u₂ − u₁ − (L/2)(θ₁+θ₂) × n`, `φ = θ₂ − θ₁`
//!
//! `f = k_n (n·w) n + k_s (w − (n·w) n)`, `m = k_t (n·φ) n + k_b (φ − (n·φ) n)`
//!
//! Particle 1 gets `+f` and `+m + (L/2) n×f`, particle 2 gets `−f` and `−m + (L/2) n×f`.
//! This is the 12×12 Euler–Bernoulli beam element (Przemieniecki 1968, eq. 5.116, without shear
//! deformation) for a circular section.

use super::network::{BondStiffness, Network};
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use nalgebra::{Matrix3, SMatrix};
use std::f64::consts::PI;

/// Material of a bond: not the material of the body it builds.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BondMaterial {
    /// Young's modulus `E_μ`, in Pa.
    pub young_pa: f64,
    /// Poisson's ratio `ν_μ`; gives `G_μ = E_μ / 2(1+ν_μ)` for torsion.
    pub poisson: f64,
}

impl BondMaterial {
    /// Stiffnesses of a cylinder of radius `r` and length `l` (both m):
    /// `k_n = E_μA/L`, `k_s = 12E_μI/L³`, `k_b = E_μI/L`, `k_t = G_μJ/L`, with
    /// `A = πr²`, `I = πr⁴/4`, `J = 2I`.
    pub fn cylinder(&self, r: f64, l: f64) -> BondStiffness {
        let e = self.young_pa;
        let g = e / (2.0 * (1.0 + self.poisson));
        let a = PI * r * r;
        let i = 0.25 * PI * r.powi(4);
        BondStiffness { kn: e * a / l, ks: 12.0 * e * i / l.powi(3), kb: e * i / l, kt: 2.0 * g * i / l }
    }
}

/// Stiffness matrix of one bond from particle 1 at the origin to particle 2 at `d` (m):
/// 12×12 on `u₁, θ₁, u₂, θ₂`, in N/m, N and N m.
///
/// With the deformation `(w, φ) = T q`, `K = Tᵀ diag(k_w, k_φ) T`, where
/// `k_w = k_s 1 + (k_n − k_s) n⊗n` and `k_φ = k_b 1 + (k_t − k_b) n⊗n`.
pub fn stiffness_matrix(d: Vec3, k: BondStiffness) -> SMatrix<f64, 12, 12> {
    let l = d.norm();
    let n = d / l;
    let nn = n * n.transpose();
    let one = Matrix3::identity();
    let kw = one * k.ks + nn * (k.kn - k.ks);
    let kphi = one * k.kb + nn * (k.kt - k.kb);
    // θ × n = −[n]× θ, so w = u₂ − u₁ + (L/2) [n]× (θ₁ + θ₂).
    let arm = n.cross_matrix() * (0.5 * l);
    let mut t = SMatrix::<f64, 6, 12>::zeros();
    t.fixed_view_mut::<3, 3>(0, 0).copy_from(&-one);
    t.fixed_view_mut::<3, 3>(0, 3).copy_from(&arm);
    t.fixed_view_mut::<3, 3>(0, 6).copy_from(&one);
    t.fixed_view_mut::<3, 3>(0, 9).copy_from(&arm);
    t.fixed_view_mut::<3, 3>(3, 3).copy_from(&-one);
    t.fixed_view_mut::<3, 3>(3, 9).copy_from(&one);
    let mut c = SMatrix::<f64, 6, 6>::zeros();
    c.fixed_view_mut::<3, 3>(0, 0).copy_from(&kw);
    c.fixed_view_mut::<3, 3>(3, 3).copy_from(&kphi);
    t.transpose() * c * t
}

/// Which of the 12 degrees of freedom of a bond a space keeps.
const PLANE_DOFS: [usize; 6] = [0, 1, 5, 6, 7, 11];

/// Writes what a space keeps of a bond's stiffness matrix, row by row: 6×6 or 12×12 numbers.
pub(super) fn keep_rows(space: Space, full: &SMatrix<f64, 12, 12>, k: &mut [f64; 144]) {
    let n = 2 * space.dofs_per_particle();
    for r in 0..n {
        for c in 0..n {
            k[r * n + c] = match space {
                Space::Plane => full[(PLANE_DOFS[r], PLANE_DOFS[c])],
                Space::Solid => full[(r, c)],
            };
        }
    }
}

/// Calls `sink(dofs, k)` for every bond of positive weight: `dofs` are degrees of freedom
/// of the network (particle · 3 or 6 + component), `k` the stiffness matrix of the bond times its
/// weight, row by row.
///
/// # Errors
/// A bond whose ends coincide, whose particles do not exist or whose stiffness is not finite.
pub fn for_each_stiffness(
    network: &Network,
    body: &str,
    mut sink: impl FnMut(&[usize], &[f64]),
) -> Result<()> {
    let per = network.space.dofs_per_particle();
    let particles = &network.particles;
    let mut dofs = [0usize; 12];
    let mut k = [0.0; 144];
    for (b, &[i, j]) in network.bonds.ends.iter().enumerate() {
        check_bond(network, body, b)?;
        let weight = network.bonds.weight[b];
        if weight == 0.0 {
            continue;
        }
        let d = particles.position[j] - particles.position[i];
        let full = stiffness_matrix(d, network.bonds.stiffness[b]) * weight;
        for c in 0..per {
            dofs[c] = i * per + c;
            dofs[per + c] = j * per + c;
        }
        let n = 2 * per;
        keep_rows(network.space, &full, &mut k);
        sink(&dofs[..n], &k[..n * n]);
    }
    Ok(())
}

/// Refuses a bond that cannot carry load.
pub(super) fn check_bond(network: &Network, body: &str, bond: usize) -> Result<()> {
    let [i, j] = network.bonds.ends[bond];
    let fail =
        |message: &str| Err(Error::Bond { body: body.to_owned(), bond, i, j, message: message.to_owned() });
    let count = network.particles.len();
    if i >= count || j >= count {
        return fail("no such particle; check the ids of the bond");
    }
    if i == j || !network.bond_length(bond).is_normal() {
        return fail("its ends coincide or are not finite; remove the bond or one of the particles");
    }
    let BondStiffness { kn, ks, kb, kt } = network.bonds.stiffness[bond];
    let weight = network.bonds.weight[bond];
    if [kn, ks, kb, kt, weight].iter().any(|k| !k.is_finite() || *k < 0.0) {
        return fail("stiffnesses and weight must be finite and not negative; check modulus and radius");
    }
    Ok(())
}
