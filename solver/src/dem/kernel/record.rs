//! What one bond needs: half-bond vector and stiffnesses, weight included.

use crate::dem::network::BondStiffness;
use crate::space::Vec3;

/// A bond over `D` degrees of freedom per particle.
pub(super) trait Record<const D: usize>: Copy + Send + Sync {
    /// Displacement components, before the rotations.
    const DIM: usize;

    /// From the half-bond vector `h` (m), lower to higher particle.
    fn new(h: Vec3, k: BondStiffness, weight: f64) -> Self;

    /// Adds the internal forces on the lower particle (at `q1`) to `f1`, those on the higher one to `f2`.
    fn add_internal(&self, q1: &[f64; D], q2: &[f64; D], f1: &mut [f64; D], f2: &mut [f64; D]);
}

/// Degrees of freedom `u_x, u_y, θ_z`; 40 bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct PlaneBond {
    h: [f64; 2],
    ks: f64,
    kappa_f: f64,
    kb: f64,
}

impl Record<3> for PlaneBond {
    const DIM: usize = 2;

    fn new(h: Vec3, k: BondStiffness, weight: f64) -> Self {
        let h2 = h.norm_squared();
        PlaneBond {
            h: [h.x, h.y],
            ks: k.ks * weight,
            kappa_f: (k.kn - k.ks) * weight / h2,
            kb: k.kb * weight,
        }
    }

    #[inline(always)]
    fn add_internal(&self, q1: &[f64; 3], q2: &[f64; 3], f1: &mut [f64; 3], f2: &mut [f64; 3]) {
        let [hx, hy] = self.h;
        let sum = q1[2] + q2[2];
        // w = u₂ − u₁ − θ e_z × h
        let wx = q2[0] - q1[0] + sum * hy;
        let wy = q2[1] - q1[1] - sum * hx;
        let axial = self.kappa_f * (hx * wx + hy * wy);
        let fx = self.ks * wx + axial * hx;
        let fy = self.ks * wy + axial * hy;
        let m = self.kb * (q2[2] - q1[2]);
        let arm = hx * fy - hy * fx;
        f1[0] -= fx;
        f1[1] -= fy;
        f1[2] -= m + arm;
        f2[0] += fx;
        f2[1] += fy;
        f2[2] += m - arm;
    }
}

/// Degrees of freedom `u, θ`; 56 bytes.
#[derive(Debug, Clone, Copy)]
pub(super) struct SolidBond {
    h: [f64; 3],
    ks: f64,
    kappa_f: f64,
    kb: f64,
    kappa_m: f64,
}

impl Record<6> for SolidBond {
    const DIM: usize = 3;

    fn new(h: Vec3, k: BondStiffness, weight: f64) -> Self {
        let h2 = h.norm_squared();
        SolidBond {
            h: h.into(),
            ks: k.ks * weight,
            kappa_f: (k.kn - k.ks) * weight / h2,
            kb: k.kb * weight,
            kappa_m: (k.kt - k.kb) * weight / h2,
        }
    }

    #[inline(always)]
    fn add_internal(&self, q1: &[f64; 6], q2: &[f64; 6], f1: &mut [f64; 6], f2: &mut [f64; 6]) {
        let [hx, hy, hz] = self.h;
        let [sx, sy, sz] = [q1[3] + q2[3], q1[4] + q2[4], q1[5] + q2[5]];
        // w = u₂ − u₁ − (θ₁+θ₂) × h
        let wx = q2[0] - q1[0] - (sy * hz - sz * hy);
        let wy = q2[1] - q1[1] - (sz * hx - sx * hz);
        let wz = q2[2] - q1[2] - (sx * hy - sy * hx);
        let axial = self.kappa_f * (hx * wx + hy * wy + hz * wz);
        let [fx, fy, fz] = [self.ks * wx + axial * hx, self.ks * wy + axial * hy, self.ks * wz + axial * hz];
        let [px, py, pz] = [q2[3] - q1[3], q2[4] - q1[4], q2[5] - q1[5]];
        let twist = self.kappa_m * (hx * px + hy * py + hz * pz);
        let [mx, my, mz] = [self.kb * px + twist * hx, self.kb * py + twist * hy, self.kb * pz + twist * hz];
        // h × f
        let [ax, ay, az] = [hy * fz - hz * fy, hz * fx - hx * fz, hx * fy - hy * fx];
        f1[0] -= fx;
        f1[1] -= fy;
        f1[2] -= fz;
        f1[3] -= mx + ax;
        f1[4] -= my + ay;
        f1[5] -= mz + az;
        f2[0] += fx;
        f2[1] += fy;
        f2[2] += fz;
        f2[3] += mx - ax;
        f2[4] += my - ay;
        f2[5] += mz - az;
    }
}
