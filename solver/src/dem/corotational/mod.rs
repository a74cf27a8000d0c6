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
//! `e × (m₁ + m₂)/L`, so that forces and moments balance to rounding. Bonds are evaluated in batches (`batch`).

mod batch;
mod bond;
pub mod equilibrium;
mod swing;

use super::bond::check_bond;
use super::network::Network;
use crate::error::Result;
use crate::space::{Space, Vec3};
use batch::{Batch, BatchLoads, LANES, Pose};
use bond::FiniteBond;
use nalgebra::{Quaternion, UnitQuaternion};
use pulp::Arch;

/// A network whose particles may turn by any angle. It carries their orientations.
#[derive(Debug, Clone)]
pub struct Corotational {
    space: Space,
    /// `(lower particle, higher particle)` of each bond of positive weight, ascending.
    ends: Vec<[u32; 2]>,
    batches: Vec<Batch>,
    orientation: Vec<UnitQuaternion<f64>>,
    /// The vector instructions of this machine.
    arch: Arch,
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
        let bonds: Vec<FiniteBond> = order.iter().map(bond).collect();
        Ok(Corotational {
            space: network.space,
            ends: order.iter().map(|&(i, j, _)| [i as u32, j as u32]).collect(),
            batches: bonds.chunks(LANES).map(Batch::new).collect(),
            orientation: vec![UnitQuaternion::identity(); x.len()],
            arch: Arch::new(),
        })
    }

    /// Number of bonds evaluated by each call.
    pub fn bond_count(&self) -> usize {
        self.ends.len()
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
        self.orientation = orientation;
    }

    /// `Q ← exp(scale · θ) Q` with the rotation components of `q`, a vector over all degrees of freedom.
    pub fn turn(&mut self, q: &[f64], scale: f64) {
        let (dim, per) = (self.space.dim(), self.space.dofs_per_particle());
        for (orientation, q) in self.orientation.iter_mut().zip(q.chunks_exact(per)) {
            let theta = spread(self.space.rotation_axes(), &q[dim..]) * scale;
            *orientation = rotation_by(theta) * *orientation;
            // Rounding would let the length drift over millions of steps.
            orientation.renormalize_fast();
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
        let (mut pose, mut loads) = (Pose::new(), BatchLoads::new());
        for (ends, batch) in self.ends.chunks(LANES).zip(&self.batches) {
            for (l, &[i, j]) in ends.iter().enumerate() {
                let (i, j) = (i as usize, j as usize);
                pose.set(l, stretch(&u[i], &u[j]), [self.quaternion(i), self.quaternion(j)]);
            }
            loads.evaluate(self.arch, batch, &pose);
            for (l, &[i, j]) in ends.iter().enumerate() {
                let [force, moment1, moment2] = loads.get(l);
                accumulate(&mut f[i as usize], force.map(|f| -f), moment1);
                accumulate(&mut f[j as usize], force, moment2);
            }
        }
    }

    /// `i, j, k, w` of a particle.
    #[inline(always)]
    fn quaternion(&self, particle: usize) -> [f64; 4] {
        self.orientation[particle].coords.into()
    }

    /// Bonds with their particles.
    fn bonds(&self) -> impl Iterator<Item = ([usize; 2], FiniteBond)> {
        let bond = |(b, ends): (usize, &[u32; 2])| {
            (ends.map(|p| p as usize), self.batches[b / LANES].bond(b % LANES))
        };
        self.ends.iter().enumerate().map(bond)
    }

    /// Strain energy, in J.
    pub fn energy(&self, u: &[f64]) -> f64 {
        let per = self.space.dofs_per_particle();
        let dim = self.space.dim();
        let shift = |p: usize| spread(&[0, 1, 2][..dim], &u[p * per..p * per + dim]);
        let of_bond = |([i, j], bond): ([usize; 2], FiniteBond)| {
            bond.energy(shift(j) - shift(i), [self.quaternion(i), self.quaternion(j)])
        };
        self.bonds().map(of_bond).sum()
    }
}

/// Quaternion of a rotation vector; a series for the small turns of a time step.
fn rotation_by(theta: Vec3) -> UnitQuaternion<f64> {
    // cos(θ/2) and sin(θ/2)/θ in h = θ²/4; the next terms are below rounding for θ < 0.1.
    let h = 0.25 * theta.norm_squared();
    if h > 2.5e-3 {
        return UnitQuaternion::from_scaled_axis(theta);
    }
    // Products, since quotients are slow.
    let nest = |[a, b, c, d]: [f64; 4]| 1.0 - h * a * (1.0 - h * b * (1.0 - h * c * (1.0 - h * d)));
    let cosine = nest([1.0 / 2.0, 1.0 / 12.0, 1.0 / 30.0, 1.0 / 56.0]);
    let sine = 0.5 * nest([1.0 / 6.0, 1.0 / 20.0, 1.0 / 42.0, 1.0 / 72.0]);
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
fn stretch<const D: usize>(u1: &[f64; D], u2: &[f64; D]) -> [f64; 3] {
    [u2[0] - u1[0], u2[1] - u1[1], if D == 6 { u2[2] - u1[2] } else { 0.0 }]
}

#[inline(always)]
fn accumulate<const D: usize>(f: &mut [f64; D], force: [f64; 3], moment: [f64; 3]) {
    f[0] += force[0];
    f[1] += force[1];
    if D == 6 {
        f[2] += force[2];
        (0..3).for_each(|c| f[3 + c] += moment[c]);
    } else {
        f[2] += moment[2];
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::network::{BondStiffness, Bonds, Particles};

    #[test]
    fn small_turns_are_the_closed_form() {
        for size in [0.0, 1e-8, 1e-3, 0.099, 0.101, 2.0] {
            let theta = Vec3::new(0.6, -0.48, 0.64) * size;
            let off = rotation_by(theta).coords - UnitQuaternion::from_scaled_axis(theta).coords;
            assert!(off.amax() < 2.0 * f64::EPSILON, "{size}: {off}");
        }
    }

    /// Particles in a chain, turned by up to `angle` against each other.
    fn chain(angle: f64) -> (Corotational, Vec<f64>) {
        let count = 30;
        let k = BondStiffness { kn: 5.0, ks: 2.0, kb: 0.7, kt: 0.4 };
        let network = Network {
            space: Space::Solid,
            particles: Particles {
                position: (0..count).map(|i| Vec3::new(i as f64, (i as f64).sin(), 0.3)).collect(),
                radius: vec![0.5; count],
                mass: vec![1.0; count],
                inertia: vec![1.0; count],
            },
            bonds: Bonds {
                ends: (1..count).map(|i| [i - 1, i]).collect(),
                radius: vec![0.5; count - 1],
                stiffness: vec![k; count - 1],
                weight: vec![1.0; count - 1],
            },
            faces: Default::default(),
        };
        let mut bonds = Corotational::new(&network, "b").unwrap();
        let u: Vec<f64> = (0..6 * count).map(|i| angle * (2.3 * i as f64).sin()).collect();
        bonds.turn(&u, 1.0);
        (bonds, u)
    }

    #[test]
    fn vector_instructions_do_not_change_a_bit() {
        for angle in [1e-3, 0.04, 0.8] {
            let (mut bonds, u) = chain(angle);
            let forces = |bonds: &Corotational| {
                let mut f = vec![0.0; u.len()];
                bonds.add_internal(&u, &mut f);
                f
            };
            let with = forces(&bonds);
            bonds.arch = Arch::Scalar;
            assert_eq!(with, forces(&bonds));
        }
    }

    /// A batch is no more than its bonds, whichever series each of them takes.
    #[test]
    fn a_bond_does_not_feel_its_batch() {
        for angle in [1e-3, 0.04, 0.8] {
            let (bonds, u) = chain(angle);
            let (mut f, mut alone) = (vec![0.0; u.len()], vec![0.0; u.len()]);
            bonds.add_internal(&u, &mut f);
            for (ends, bond) in bonds.bonds() {
                let one = Corotational {
                    ends: vec![ends.map(|p| p as u32)],
                    batches: vec![Batch::new(&[bond])],
                    ..bonds.clone()
                };
                one.add_internal(&u, &mut alone);
            }
            assert_eq!(f, alone);
        }
    }
}
