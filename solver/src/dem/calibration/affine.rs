//! The affine (Voigt) law: what a network would be if every particle followed the mean strain and none turned.
//!
//! With directions spread evenly, `α = Σl²k_s / Σl²k_n` and `S = Σl²k_n / V` (V: volume, or area × thickness):
//!
//! solid: `ν = (1−α)/(4+α)`, `E = (S/3)(2+3α)/(4+α)`; plane: `ν = (1−α)/(3+α)`, `E = S(1+α)/(3+α)`
//!
//! (Chang & Gao 1995). An upper bound of the stiffness, not a calibration; exact for the triangular lattice.

use super::isotropy::Moduli;
use crate::dem::bonding::PeriodicNetwork;
use crate::space::Space;

/// Moduli of a periodic network by the affine law.
pub fn affine(periodic: &PeriodicNetwork) -> Moduli {
    let bonds = &periodic.network.bonds;
    let (mut normal, mut shear) = (0.0, 0.0);
    for b in 0..bonds.len() {
        let square = periodic.bond_vector(b).norm_squared() * bonds.weight[b];
        normal += square * bonds.stiffness[b].kn;
        shear += square * bonds.stiffness[b].ks;
    }
    let alpha = shear / normal;
    let s = normal / periodic.volume();
    match periodic.network.space {
        Space::Solid => Moduli {
            young_pa: s / 3.0 * (2.0 + 3.0 * alpha) / (4.0 + alpha),
            poisson: (1.0 - alpha) / (4.0 + alpha),
        },
        Space::Plane => {
            Moduli { young_pa: s * (1.0 + alpha) / (3.0 + alpha), poisson: (1.0 - alpha) / (3.0 + alpha) }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Matter;
    use crate::dem::bond::BondMaterial;
    use crate::dem::bonding::{BondRecipe, periodic_network};
    use crate::dem::calibration::homogenisation::homogenise;
    use crate::dem::calibration::specimen::Specimen;
    use crate::dem::lattice::LatticeKind;
    use crate::dem::section::Section;
    use crate::dem::skin::Skin;
    use crate::work::Work;

    #[test]
    fn exact_for_the_triangular_lattice() {
        let matter = Matter { density: 1.0, thickness_m: 0.1 };
        let cell = Specimen::lattice_cell(LatticeKind::Triangular, 0.5, [0.0; 3], matter).unwrap();
        let material = BondMaterial { young_pa: 7.0, poisson: 0.3 };
        let recipe = BondRecipe { material, section: Section::Uniform { ratio: 0.6 }, skin: Skin::Full };
        let network = periodic_network(&cell.arrangement, &cell.pairs, &recipe).unwrap();
        let (law, exact) = (affine(&network), homogenise(&network, &mut Work::default()).unwrap().moduli);
        assert!((law.young_pa / exact.young_pa - 1.0).abs() < 1e-12);
        assert!((law.poisson - exact.poisson).abs() < 1e-12);
    }
}
