//! Bonds under finite rotations: a symmetric corotational beam.
//!
//! `e` is the current chord, `L` its length, `t_i = Q_i n₀` the bond's direction carried by particle `i`, `β_i` the
//! rotation vector that takes `e` to `t_i`, and `τ` the twist of `Q₁ᵀQ₂` about `n₀`. With
//! `S = k_s L₀²/4`, which is `3EI/L₀` for a cylinder,
//!
//! `U = ½ k_n (L − L₀)² + ½ k_t τ² + ½ S |β₁ + β₂|² + ½ k_b |β₂ − β₁|²`;
//!
//! for `k_s = 12 k_b/L₀²` the last two are `(2EI/L₀)(β₁² + β₁·β₂ + β₂²)` (Crisfield 1990 for the corotational frame).
//! `β_i` is perpendicular to the chord, so that no frame about the chord has to be chosen: `U` does not change
//! under rigid motion or when the two particles change places. Forces are its exact gradient; the shear is
//! `e × (m₁ + m₂)/L`, so that forces and moments balance to rounding.

mod bond;
pub mod equilibrium;
mod swing;

use super::bond::check_bond;
use super::network::Network;
use crate::error::Result;
use crate::space::{Space, Vec3};
use bond::FiniteBond;
use nalgebra::{Matrix3, Quaternion, UnitQuaternion};

/// A network whose particles may turn by any angle. It carries their orientations.
#[derive(Debug, Clone)]
pub struct Corotational {
    space: Space,
    /// `(lower particle, higher particle)` of each bond of positive weight, ascending.
    ends: Vec<[u32; 2]>,
    bonds: Vec<FiniteBond>,
    orientation: Vec<UnitQuaternion<f64>>,
    /// The same as matrices.
    frame: Vec<Matrix3<f64>>,
}

impl Corotational {
    /// Prepares the bonds of positive weight; all particles unturned.
    ///
    /// # Errors
    /// As [`super::bond::for_each_stiffness`].
    pub fn new(network: &Network, body: &str) -> Result<Self> {
        let mut order = Vec::with_capacity(network.bonds.len());
        for (b, &[i, j]) in network.bonds.ends.iter().enumerate() {
            check_bond(network, body, b)?;
            if network.bonds.weight[b] > 0.0 {
                order.push((i.min(j), i.max(j), b));
            }
        }
        order.sort_unstable();
        let x = &network.particles.position;
        let bond = |&(i, j, b): &_| {
            FiniteBond::new(x[j] - x[i], network.bonds.stiffness[b], network.bonds.weight[b])
        };
        Ok(Corotational {
            space: network.space,
            ends: order.iter().map(|&(i, j, _)| [i as u32, j as u32]).collect(),
            bonds: order.iter().map(bond).collect(),
            orientation: vec![UnitQuaternion::identity(); x.len()],
            frame: vec![Matrix3::identity(); x.len()],
        })
    }

    /// Number of bonds evaluated by each call.
    pub fn bond_count(&self) -> usize {
        self.bonds.len()
    }

    /// Orientation of each particle.
    pub fn orientations(&self) -> &[UnitQuaternion<f64>] {
        &self.orientation
    }

    /// Puts orientations back, as read from [`Corotational::orientations`]: bit by bit.
    ///
    /// # Panics
    /// If there is not one for each particle.
    pub fn set_orientations(&mut self, orientation: Vec<UnitQuaternion<f64>>) {
        assert_eq!(orientation.len(), self.orientation.len(), "one orientation per particle");
        self.frame = orientation.iter().map(|q| q.to_rotation_matrix().into_inner()).collect();
        self.orientation = orientation;
    }

    /// `Q ← exp(scale · θ) Q` with the rotation components of `q`, a vector over all degrees of freedom.
    pub fn turn(&mut self, q: &[f64], scale: f64) {
        let (dim, per) = (self.space.dim(), self.space.dofs_per_particle());
        for ((orientation, frame), q) in
            self.orientation.iter_mut().zip(&mut self.frame).zip(q.chunks_exact(per))
        {
            let theta = spread(self.space.rotation_axes(), &q[dim..]) * scale;
            *orientation = rotation_by(theta) * *orientation;
            // Rounding would let the length drift over millions of steps.
            orientation.renormalize_fast();
            *frame = orientation.to_rotation_matrix().into_inner();
        }
    }

    /// Adds internal forces and moments (N, N m; in fixed axes) at the displacements of `u` and the present
    /// orientations; the rotation components of `u` are not used.
    pub fn add_internal(&self, u: &[f64], f: &mut [f64]) {
        match self.space {
            Space::Plane => self.add::<3>(u, f),
            Space::Solid => self.add::<6>(u, f),
        }
    }

    fn add<const D: usize>(&self, u: &[f64], f: &mut [f64]) {
        let (u, f) = (u.as_chunks::<D>().0, f.as_chunks_mut::<D>().0);
        for (&[i, j], bond) in self.ends.iter().zip(&self.bonds) {
            let (i, j) = (i as usize, j as usize);
            let turned = [(&self.orientation[i], &self.frame[i]), (&self.orientation[j], &self.frame[j])];
            let loads = bond.loads(stretch(&u[i], &u[j]), turned);
            accumulate(&mut f[i], -loads.force, loads.moments[0]);
            accumulate(&mut f[j], loads.force, loads.moments[1]);
        }
    }

    /// Strain energy, in J.
    pub fn energy(&self, u: &[f64]) -> f64 {
        let per = self.space.dofs_per_particle();
        let dim = self.space.dim();
        let shift = |p: u32| spread(&[0, 1, 2][..dim], &u[p as usize * per..p as usize * per + dim]);
        let of_bond = |(ends, bond): (&[u32; 2], &FiniteBond)| {
            let turned = ends.map(|p| (&self.orientation[p as usize], &self.frame[p as usize]));
            bond.energy(shift(ends[1]) - shift(ends[0]), turned)
        };
        self.ends.iter().zip(&self.bonds).map(of_bond).sum()
    }
}

/// Quaternion of a rotation vector; a series for the small turns of a time step.
fn rotation_by(theta: Vec3) -> UnitQuaternion<f64> {
    // cos(θ/2) and sin(θ/2)/θ in h = θ²/4; the next terms are below rounding for θ < 0.1.
    let h = 0.25 * theta.norm_squared();
    if h > 2.5e-3 {
        return UnitQuaternion::from_scaled_axis(theta);
    }
    let cosine = 1.0 - h / 2.0 * (1.0 - h / 12.0 * (1.0 - h / 30.0 * (1.0 - h / 56.0)));
    let sine = 0.5 * (1.0 - h / 6.0 * (1.0 - h / 20.0 * (1.0 - h / 42.0 * (1.0 - h / 72.0))));
    UnitQuaternion::new_unchecked(Quaternion::from_parts(cosine, theta * sine))
}

/// Components on their axes.
fn spread(axes: &[usize], values: &[f64]) -> Vec3 {
    let mut v = Vec3::zeros();
    axes.iter().zip(values).for_each(|(&axis, value)| v[axis] = *value);
    v
}

/// `u₂ − u₁`; `D` is 3 (`u_x, u_y, θ_z`) or 6.
#[inline(always)]
fn stretch<const D: usize>(u1: &[f64; D], u2: &[f64; D]) -> Vec3 {
    Vec3::new(u2[0] - u1[0], u2[1] - u1[1], if D == 6 { u2[2] - u1[2] } else { 0.0 })
}

#[inline(always)]
fn accumulate<const D: usize>(f: &mut [f64; D], force: Vec3, moment: Vec3) {
    f[0] += force.x;
    f[1] += force.y;
    if D == 6 {
        f[2] += force.z;
        (0..3).for_each(|c| f[3 + c] += moment[c]);
    } else {
        f[2] += moment.z;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_turns_are_the_closed_form() {
        for size in [0.0, 1e-8, 1e-3, 0.099, 0.101, 2.0] {
            let theta = Vec3::new(0.6, -0.48, 0.64) * size;
            let off = rotation_by(theta).coords - UnitQuaternion::from_scaled_axis(theta).coords;
            assert!(off.amax() < 2.0 * f64::EPSILON, "{size}: {off}");
        }
    }
}
