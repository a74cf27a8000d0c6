//! The small-rotation bond force, fast: the bond of [`super::bond`] without forming matrices.
//!
//! With the half-bond vector `h = (L/2) n`, `w = u₂ − u₁ − (θ₁+θ₂) × h`, `φ = θ₂ − θ₁`:
//!
//! `f = k_s w + κ_f (h·w) h`, `κ_f = (k_n − k_s)/h²`; `m = k_b φ + κ_m (h·φ) h`, `κ_m = (k_t − k_b)/h²`
//!
//! Bonds are sorted by their lower particle, which stays in registers while its bonds pass by; all that a
//! bond needs, and nothing else, lies in one record. [`locality`] numbers particles so that
//! neighbours in space are neighbours in memory; [`vibration`] integrates a network on several threads.

pub mod locality;
pub mod per_bond;
mod record;
pub mod vibration;

use super::network::Network;
use crate::error::Result;
use crate::space::Space;
use record::{PlaneBond, Record, SolidBond};

/// Bonds of a network, ready to be evaluated.
#[derive(Debug, Clone)]
pub struct Kernel(Records);

#[derive(Debug, Clone)]
enum Records {
    Plane(Rows<PlaneBond, 3>),
    Solid(Rows<SolidBond, 6>),
}

impl Kernel {
    /// Prepares the bonds of positive weight.
    ///
    /// # Errors
    /// As [`super::bond::for_each_stiffness`].
    pub fn new(network: &Network, body: &str) -> Result<Self> {
        Ok(Kernel(match network.space {
            Space::Plane => Records::Plane(Rows::new(network, body)?),
            Space::Solid => Records::Solid(Rows::new(network, body)?),
        }))
    }

    /// Number of bonds evaluated by each call.
    pub fn bond_count(&self) -> usize {
        match &self.0 {
            Records::Plane(rows) => rows.bonds.len(),
            Records::Solid(rows) => rows.bonds.len(),
        }
    }

    /// Gives a bond the weight that it has in `network`; its particles have the numbers `ends` in here.
    pub fn set_weight(&mut self, network: &Network, bond: usize, ends: [usize; 2]) {
        match &mut self.0 {
            Records::Plane(rows) => rows.set_weight(network, bond, ends),
            Records::Solid(rows) => rows.set_weight(network, bond, ends),
        }
    }

    /// `f += K u`: internal forces (N, N m) from displacements and rotations, particle by particle.
    pub fn add_internal(&self, u: &[f64], f: &mut [f64]) {
        match &self.0 {
            Records::Plane(rows) => rows.add_internal(u.as_chunks().0, f.as_chunks_mut().0),
            Records::Solid(rows) => rows.add_internal(u.as_chunks().0, f.as_chunks_mut().0),
        }
    }
}

/// Bonds of positive weight as `(lower particle, higher particle, bond)`, ascending.
fn sorted_pairs(network: &Network, body: &str) -> Result<Vec<(u32, u32, usize)>> {
    let mut pairs = Vec::with_capacity(network.bonds.len());
    for (b, &[i, j]) in network.bonds.ends.iter().enumerate() {
        super::bond::check_bond(network, body, b)?;
        if network.bonds.weight[b] > 0.0 {
            pairs.push((i.min(j) as u32, i.max(j) as u32, b));
        }
    }
    pairs.sort_unstable();
    Ok(pairs)
}

/// Bonds by their lower particle: those of particle `i` are `start[i]..start[i + 1]`.
#[derive(Debug, Clone)]
struct Rows<R, const D: usize> {
    start: Vec<u32>,
    /// The higher particle of each bond.
    other: Vec<u32>,
    bonds: Vec<R>,
}

impl<R: Record<D>, const D: usize> Rows<R, D> {
    fn new(network: &Network, body: &str) -> Result<Self> {
        Ok(Self::from_pairs(network, network.particles.len(), &sorted_pairs(network, body)?))
    }

    /// Rows over `count` particles from sorted `(lower, higher, bond of the network)`. The particles may be
    /// renumbered, but must keep their order.
    fn from_pairs(network: &Network, count: usize, pairs: &[(u32, u32, usize)]) -> Self {
        let mut start = vec![0u32; count + 1];
        pairs.iter().for_each(|p| start[p.0 as usize + 1] += 1);
        for i in 0..count {
            start[i + 1] += start[i];
        }
        let record = |&(_, _, b): &(u32, u32, usize)| {
            let [i, j] = network.bonds.ends[b];
            let (i, j) = (i.min(j), i.max(j));
            let h = 0.5 * (network.particles.position[j] - network.particles.position[i]);
            R::new(h, network.bonds.stiffness[b], network.bonds.weight[b])
        };
        Rows { start, other: pairs.iter().map(|p| p.1).collect(), bonds: pairs.iter().map(record).collect() }
    }

    fn set_weight(&mut self, network: &Network, bond: usize, [i, j]: [usize; 2]) {
        let (low, high) = (i.min(j), i.max(j));
        let range = self.start[low] as usize..self.start[low + 1] as usize;
        let Some(k) = self.other[range.clone()].iter().position(|&o| o as usize == high) else { return };
        let [a, b] = network.bonds.ends[bond];
        let x = &network.particles.position;
        // From the lower particle to the higher one, in the numbers used here.
        let h = if i < j { 0.5 * (x[b] - x[a]) } else { 0.5 * (x[a] - x[b]) };
        self.bonds[range.start + k] = R::new(h, network.bonds.stiffness[bond], network.bonds.weight[bond]);
    }

    fn add_internal(&self, u: &[[f64; D]], f: &mut [[f64; D]]) {
        for i in 0..u.len() {
            f[i] = self.row(i, u, f);
        }
    }

    /// Adds the bonds of particle `i` to the forces on their higher particles; returns the force on `i` itself,
    /// complete if the particles before it are done.
    #[inline(always)]
    fn row(&self, i: usize, u: &[[f64; D]], f: &mut [[f64; D]]) -> [f64; D] {
        let range = self.start[i] as usize..self.start[i + 1] as usize;
        let q = u[i];
        let mut own = f[i];
        for (&j, bond) in self.other[range.clone()].iter().zip(&self.bonds[range]) {
            bond.add_internal(&q, &u[j as usize], &mut own, &mut f[j as usize]);
        }
        own
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::bond::{BondMaterial, for_each_stiffness};
    use crate::dem::network::{Bonds, Particles};
    use crate::space::Vec3;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    /// Particles anywhere, bonded to the next ones in any order, each bond of its own radius and weight.
    fn tangle(space: Space, count: usize) -> Network {
        let mut rng = ChaCha8Rng::seed_from_u64(7);
        let mut draw = || rng.random_range(0.0..1.0);
        let mut network = Network {
            space,
            particles: Particles::default(),
            bonds: Bonds::default(),
            faces: Default::default(),
        };
        for _ in 0..count {
            let z = if space == Space::Solid { draw() } else { 0.0 };
            network.particles.position.push(Vec3::new(draw(), draw(), z));
            network.particles.radius.push(0.1);
            network.particles.mass.push(0.5 + draw());
            network.particles.inertia.push(0.01 + 0.01 * draw());
        }
        let material = BondMaterial { young_pa: 1e3, poisson: 0.3 };
        for i in 0..count {
            for j in i + 1..count.min(i + 5) {
                let b = network.bonds.len();
                let radius = 0.05 + 0.1 * draw();
                network.bonds.ends.push(if b.is_multiple_of(2) { [i, j] } else { [j, i] });
                network.bonds.radius.push(radius);
                network.bonds.stiffness.push(material.cylinder(radius, network.bond_length(b)));
                network.bonds.weight.push([1.0, 0.5, 0.25, 0.0][b % 4]);
            }
        }
        network
    }

    #[test]
    fn forces_are_the_stiffness_matrix_times_displacements() {
        for space in [Space::Plane, Space::Solid] {
            let network = tangle(space, 20);
            let n = 20 * space.dofs_per_particle();
            let u: Vec<f64> = (0..n).map(|i| (1.7 * i as f64).sin()).collect();
            let mut expected = vec![0.0; n];
            for_each_stiffness(&network, "b", |dofs, k| {
                for (r, &row) in dofs.iter().enumerate() {
                    for (c, &column) in dofs.iter().enumerate() {
                        expected[row] += k[r * dofs.len() + c] * u[column];
                    }
                }
            })
            .unwrap();
            let mut f = vec![0.0; n];
            let kernel = Kernel::new(&network, "b").unwrap();
            kernel.add_internal(&u, &mut f);
            assert_eq!(kernel.bond_count(), network.bonds.weight.iter().filter(|w| **w > 0.0).count());
            let scale = expected.iter().fold(0.0f64, |m, v| m.max(v.abs()));
            let error = f.iter().zip(&expected).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            // Both are sums of a few dozen products: rounding of the largest.
            assert!(error < 1e-13 * scale, "{space:?}: {error:e} of {scale:e}");
        }
    }

    /// Weights set one by one make the kernel of a network that had them from the start.
    #[test]
    fn a_weight_can_be_set() {
        for space in [Space::Plane, Space::Solid] {
            let mut network = tangle(space, 12);
            network.bonds.weight.iter_mut().for_each(|w| *w = w.max(0.1));
            let mut kernel = Kernel::new(&network, "b").unwrap();
            for bond in 0..network.bonds.len() {
                network.bonds.weight[bond] = 0.3 * (bond % 4) as f64;
                kernel.set_weight(&network, bond, network.bonds.ends[bond]);
            }
            let n = 12 * space.dofs_per_particle();
            let u: Vec<f64> = (0..n).map(|i| (1.7 * i as f64).sin()).collect();
            let forces = |kernel: &Kernel| {
                let mut f = vec![0.0; n];
                kernel.add_internal(&u, &mut f);
                f
            };
            let (set, made) = (forces(&kernel), forces(&Kernel::new(&network, "b").unwrap()));
            let scale = made.iter().fold(0.0f64, |m, v| m.max(v.abs()));
            // The same sums, with zeros in between.
            assert!(set.iter().zip(&made).all(|(a, b)| (a - b).abs() <= 1e-14 * scale), "{space:?}");
        }
    }

    #[test]
    fn a_bond_without_length_is_refused() {
        let mut network = tangle(Space::Plane, 4);
        network.particles.position[1] = network.particles.position[0];
        assert!(Kernel::new(&network, "b").unwrap_err().to_string().contains("ends coincide"));
    }
}
