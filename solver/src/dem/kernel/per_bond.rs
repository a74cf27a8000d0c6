//! What a step of a solid network costs per bond, counted in the loop of [`super::vibration`]: memory and arithmetic.

use super::record::SolidBond;
use crate::dem::network::Network;

/// Products and sums of a solid bond, and of the integration of a particle.
const BOND_OPERATIONS: f64 = 78.0;
const PARTICLE_OPERATIONS: f64 = 24.0;

/// Cost of one bond and its share of the particles, in one step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PerBond {
    /// Bytes read and written, if each number passes once.
    pub bytes: f64,
    /// Products and sums.
    pub operations: f64,
}

impl PerBond {
    /// For a network in space.
    pub fn solid(network: &Network) -> Self {
        let share = network.particles.len() as f64 / network.bonds.len() as f64;
        // A bond: its record and the number of the partner. A particle: u, v, f, read and written; 1/m and 1/J, read.
        let bond = (size_of::<SolidBond>() + size_of::<u32>()) as f64;
        let particle = (2 * size_of::<[[f64; 6]; 3]>() + size_of::<[f64; 2]>()) as f64;
        PerBond { bytes: bond + share * particle, operations: BOND_OPERATIONS + share * PARTICLE_OPERATIONS }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::network::{Bonds, Particles};
    use crate::space::Space;
    use std::collections::BTreeMap;

    /// Two particles and a bond: 56 + 4 bytes of the bond; of each particle 18 numbers twice, and two.
    #[test]
    fn a_bond_and_two_particles_are_counted() {
        let particles = Particles { position: vec![crate::space::Vec3::zeros(); 2], ..Particles::default() };
        let bonds = Bonds { ends: vec![[0, 1]], ..Bonds::default() };
        let network = Network { space: Space::Solid, particles, bonds, faces: BTreeMap::new() };
        let expected = PerBond { bytes: 60.0 + 2.0 * 8.0 * (36.0 + 2.0), operations: 78.0 + 48.0 };
        assert_eq!(PerBond::solid(&network), expected);
    }
}
