//! Free vibration of one network by central differences, on several threads.
//!
//! `v ← v − Δt M⁻¹ K u`, `u ← u + Δt v`. Each thread owns a contiguous range of the particles and
//! mirrors those beyond it that its bonds reach; bonds across are evaluated on both sides. Particles
//! keep their order everywhere, so that every sum has the same terms in the same order: the result is the same
//! bits for any number of threads.

mod barrier;
mod domain;

use super::record::{PlaneBond, SolidBond};
use crate::dem::network::Network;
use crate::error::{Error, Result};
use crate::space::Space;
use domain::Team;

/// A vibrating network.
pub struct Vibration(Teams);

enum Teams {
    Plane(Team<PlaneBond, 3>),
    Solid(Team<SolidBond, 6>),
}

impl Vibration {
    /// Divides a network among `threads`. For speed its particles should be in the order of [`super::locality`].
    ///
    /// # Errors
    /// Bonds as in [`crate::dem::bond::for_each_stiffness`]; no thread or more threads than particles; masses or inertias that are not
    /// positive.
    pub fn new(network: &Network, body: &str, threads: usize) -> Result<Self> {
        if threads == 0 || threads > network.particles.len() {
            return Err(Error::Geometry {
                what: format!("body '{body}'"),
                message: format!(
                    "{threads} threads for {} particles; take at least one thread and no more than particles",
                    network.particles.len()
                ),
            });
        }
        let heavy = |m: &f64| m.is_finite() && *m > 0.0;
        let masses = network.particles.mass.iter().zip(&network.particles.inertia);
        if let Some((point, (m, j))) = masses.enumerate().find(|(_, (m, j))| !(heavy(m) && heavy(j))) {
            return Err(Error::Geometry {
                what: format!("body '{body}'"),
                message: format!(
                    "particle {point} has mass {m} and inertia {j}; both must be positive: give a positive density"
                ),
            });
        }
        Ok(Vibration(match network.space {
            Space::Plane => Teams::Plane(Team::new(network, body, threads)?),
            Space::Solid => Teams::Solid(Team::new(network, body, threads)?),
        }))
    }

    /// Sets displacements and rotations, and the velocities half a step earlier, particle by particle.
    ///
    /// # Panics
    /// If either does not have one number per degree of freedom.
    pub fn set(&mut self, u: &[f64], v: &[f64]) {
        match &mut self.0 {
            Teams::Plane(team) => team.set(u, v),
            Teams::Solid(team) => team.set(u, v),
        }
    }

    /// Displacements and rotations, and the velocities half a step earlier, particle by particle.
    pub fn get(&self) -> (Vec<f64>, Vec<f64>) {
        match &self.0 {
            Teams::Plane(team) => team.get(),
            Teams::Solid(team) => team.get(),
        }
    }

    /// Takes `steps` steps of `dt` seconds. The step must not exceed the critical one
    /// ([`crate::dynamics::critical`]).
    pub fn advance(&mut self, dt: f64, steps: usize) {
        match &mut self.0 {
            Teams::Plane(team) => team.advance(dt, steps),
            Teams::Solid(team) => team.advance(dt, steps),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Matter;
    use crate::dem::block::Block;
    use crate::dem::bond::BondMaterial;
    use crate::dem::bonding::{BondRecipe, bond_network};
    use crate::dem::kernel::Kernel;
    use crate::dem::kernel::locality::{order, renumber};
    use crate::dem::lattice::{LatticeKind, lattice};
    use crate::dem::section::Section;
    use crate::dem::skin::Skin;
    use crate::space::Vec3;

    fn network(kind: LatticeKind) -> Network {
        let block = Block::at_origin(kind.space(), Vec3::new(2.0, 1.0, 1.0)).unwrap();
        let l = lattice(kind, block, 4, Matter::default()).unwrap();
        let recipe = BondRecipe {
            material: BondMaterial { young_pa: 1.0, poisson: 0.3 },
            section: Section::Uniform { ratio: 0.6 },
            skin: Skin::Weighted,
        };
        let network = bond_network(&l.arrangement, &l.pairs, &recipe).unwrap();
        renumber(&network, &order(&network))
    }

    fn start(network: &Network) -> (Vec<f64>, Vec<f64>) {
        let n = network.particles.len() * network.space.dofs_per_particle();
        ((0..n).map(|i| (0.3 * i as f64).sin()).collect(), (0..n).map(|i| (0.7 * i as f64).cos()).collect())
    }

    /// The plain loop over the same forces, written once more.
    #[test]
    fn one_thread_is_the_plain_loop() {
        for kind in [LatticeKind::Triangular, LatticeKind::FaceCentredCubic] {
            let network = network(kind);
            let (mut u, mut v) = start(&network);
            let mut vibration = Vibration::new(&network, "b", 1).unwrap();
            vibration.set(&u, &v);
            vibration.advance(1e-3, 50);
            let kernel = Kernel::new(&network, "b").unwrap();
            let (dim, per) = (network.space.dim(), network.space.dofs_per_particle());
            for _ in 0..50 {
                let mut f = vec![0.0; u.len()];
                kernel.add_internal(&u, &mut f);
                for i in 0..u.len() {
                    let p = &network.particles;
                    let m = if i % per < dim { p.mass[i / per] } else { p.inertia[i / per] };
                    v[i] -= 1e-3 / m * f[i];
                    u[i] += 1e-3 * v[i];
                }
            }
            let (u2, v2) = vibration.get();
            let error = u.iter().chain(&v).zip(u2.iter().chain(&v2));
            let error = error.fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
            // Unit amplitudes; Δt/m is rounded in another order, fifty times.
            assert!(error < 1e-11, "{error:e}");
        }
    }

    #[test]
    fn any_number_of_threads_gives_the_same_bits() {
        for kind in [LatticeKind::Triangular, LatticeKind::FaceCentredCubic] {
            let network = network(kind);
            let (u, v) = start(&network);
            let run = |threads| {
                let mut vibration = Vibration::new(&network, "b", threads).unwrap();
                vibration.set(&u, &v);
                vibration.advance(1e-3, 20);
                // A second call has to find the mirrored particles up to date.
                vibration.advance(1e-3, 21);
                vibration.get()
            };
            let one = run(1);
            assert_ne!(one.0, u);
            for threads in [2, 3, 5] {
                assert_eq!(run(threads), one, "{threads} threads");
            }
        }
    }

    #[test]
    fn threads_without_particles_and_particles_without_mass_are_refused() {
        let mut network = network(LatticeKind::Triangular);
        let refusal =
            |n: &Network, t| Vibration::new(n, "b", t).err().map(|e| e.to_string()).unwrap_or_default();
        assert!(refusal(&network, 0).contains("at least one thread"));
        assert!(refusal(&network, 100_000).contains("no more than particles"));
        network.particles.inertia[3] = 0.0;
        assert!(refusal(&network, 1).contains("particle 3 has mass"));
    }
}
