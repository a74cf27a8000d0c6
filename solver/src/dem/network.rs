//! A network of particles and bonds: the discrete-element body.

use crate::space::{Space, Vec3};
use std::collections::BTreeMap;

/// Particles, one array per field.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Particles {
    /// Centres, in metres.
    pub position: Vec<Vec3>,
    /// Radii, in metres.
    pub radius: Vec<f64>,
    /// Masses, in kg.
    pub mass: Vec<f64>,
    /// Moments of inertia about any axis, in kg m² (0.4 mR² for a sphere).
    pub inertia: Vec<f64>,
}

impl Particles {
    /// Number of particles.
    pub fn len(&self) -> usize {
        self.position.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.position.is_empty()
    }
}

/// Stiffnesses of one bond, as in `f = k_n (n·w) n + k_s w_⊥`, `m = k_t (n·φ) n + k_b φ_⊥`.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct BondStiffness {
    /// Axial, in N/m: `E_μ A / L`.
    pub kn: f64,
    /// Shear, in N/m: `12 E_μ I / L³`.
    pub ks: f64,
    /// Bending, in N m: `E_μ I / L`.
    pub kb: f64,
    /// Torsion, in N m: `G_μ J / L`.
    pub kt: f64,
}

/// Bonds, one array per field.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Bonds {
    /// The two particles of each bond.
    pub ends: Vec<[usize; 2]>,
    /// Bond radius r, in metres.
    pub radius: Vec<f64>,
    /// Stiffnesses of the whole cylinder, before the weight.
    pub stiffness: Vec<BondStiffness>,
    /// Share of the bond that lies inside the body: 1 inside, ½ in a flat face, ¼ on an edge of a solid.
    /// It multiplies all four stiffnesses.
    pub weight: Vec<f64>,
}

impl Bonds {
    /// Number of bonds.
    pub fn len(&self) -> usize {
        self.ends.len()
    }

    /// Whether there are none.
    pub fn is_empty(&self) -> bool {
        self.ends.is_empty()
    }
}

/// A bonded network.
#[derive(Debug, Clone, PartialEq)]
pub struct Network {
    /// Plane or solid.
    pub space: Space,
    /// The particles.
    pub particles: Particles,
    /// The bonds.
    pub bonds: Bonds,
    /// Particles on named flat faces (`left`, `right`, `bottom`, `top`, and in the solid `back`
    /// (z min), `front` (z max)), ascending. A particle on an edge is in both its faces.
    pub faces: BTreeMap<String, Vec<usize>>,
}

impl Network {
    /// Distance between the centres of a bond's particles, in metres.
    pub fn bond_length(&self, bond: usize) -> f64 {
        let [i, j] = self.bonds.ends[bond];
        (self.particles.position[j] - self.particles.position[i]).norm()
    }
}
