//! Force and moment in a bond, and the stress they make in its section.

use super::Section;
use crate::dem::network::Network;
use crate::space::Vec3;
use std::f64::consts::PI;

/// Load in one bond, weight and damage included; in the notation of [`crate::dem::bond`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BondForce {
    /// Unit direction n from particle 1 to 2.
    pub axis: Vec3,
    /// Length L, in m.
    pub length: f64,
    /// f, the force on particle 1, in N: along n in tension.
    pub force: Vec3,
    /// m, the moment at the mid-point, in N m.
    pub moment: Vec3,
}

/// Stresses in the section of a bond, in Pa.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SectionStress {
    /// `σ = N/A + r√(M_y²+M_z²)/I` at the end that bends more: tension positive.
    pub normal: f64,
    /// `τ = |V| 4/(3A) + r|M_x|/J`.
    pub shear: f64,
}

impl BondForce {
    /// Load in a bond whose network moves by `u` (all its unknowns), times the share `integrity` of its stiffness.
    pub fn of(network: &Network, bond: usize, u: &[f64], integrity: f64) -> Self {
        let (space, bonds) = (network.space, &network.bonds);
        let (dim, per) = (space.dim(), space.dofs_per_particle());
        let [i, j] = bonds.ends[bond];
        let translation = |p: usize| Vec3::from_fn(|c, _| if c < dim { u[p * per + c] } else { 0.0 });
        let rotation = |p: usize| {
            let mut theta = Vec3::zeros();
            space.rotation_axes().iter().enumerate().for_each(|(k, &a)| theta[a] = u[p * per + dim + k]);
            theta
        };
        let d = network.particles.position[j] - network.particles.position[i];
        let length = d.norm();
        let n = d / length;
        let (ti, tj) = (rotation(i), rotation(j));
        let w = translation(j) - translation(i) - 0.5 * length * (ti + tj).cross(&n);
        let phi = tj - ti;
        let k = bonds.stiffness[bond];
        let share = integrity * bonds.weight[bond];
        let law = |along: f64, across: f64, v: Vec3| share * (across * v + (along - across) * n.dot(&v) * n);
        BondForce { axis: n, length, force: law(k.kn, k.ks, w), moment: law(k.kt, k.kb, phi) }
    }

    /// Loads of all bonds of a network.
    pub fn all(network: &Network, u: &[f64], integrity: &[f64]) -> Vec<Self> {
        (0..network.bonds.len()).map(|b| Self::of(network, b, u, integrity[b])).collect()
    }

    /// Axial force `N = n·f`, in N: tension positive.
    pub fn axial(&self) -> f64 {
        self.axis.dot(&self.force)
    }

    /// Stress in the whole section, of which the share `weight` lies inside the body. Areas other than `πr²` scale the
    /// stresses of the cylinder by `πr²/A`.
    pub(crate) fn stress(&self, section: &Section) -> SectionStress {
        if section.weight == 0.0 {
            return SectionStress { normal: 0.0, shear: 0.0 };
        }
        let (n, r) = (self.axis, section.radius);
        let a = PI * r * r;
        let i = 0.25 * a * r * r;
        let axial = self.axial();
        let shear = (self.force - axial * n).norm();
        let torsion = n.dot(&self.moment);
        let bending = self.moment - torsion * n;
        // At the ends the shear force adds ±(L/2) n×f to the bending moment of the middle.
        let arm = 0.5 * self.length * n.cross(&self.force);
        let largest = (bending + arm).norm().max((bending - arm).norm());
        let scale = a / section.area / section.weight;
        SectionStress {
            normal: scale * (axial / a + r * largest / i),
            shear: scale * (shear * 4.0 / (3.0 * a) + r * torsion.abs() / (2.0 * i)),
        }
    }
}
