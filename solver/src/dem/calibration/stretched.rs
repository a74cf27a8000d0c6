//! Lattices whose cells are stretched to fit a box.
//!
//! Stretching the cells of a calibrated lattice along x by `s` changes its modulus along x by about `0.6 s` at
//! `ν = 0.3` (2.3 % for 4 % stretch, 0.6 % for 1 %), and the isotropic part hardly at all. `r̃` stays that of the regular lattice,
//! since `ν` matters little to a beam; `E_μ` is scaled so that the modulus along x is exact.

use super::homogenisation::homogenise;
use super::isotropy::{Moduli, anisotropy};
use super::specimen::Specimen;
use super::{Calibrated, lattice};
use crate::dem::arrangement::Matter;
use crate::dem::bond::BondMaterial;
use crate::dem::bonding::{BondRecipe, periodic_network};
use crate::dem::lattice::LatticeKind;
use crate::dem::section::Section;
use crate::dem::skin::Skin;
use crate::error::Result;
use crate::work::Work;

/// Bonds that give a lattice with cells stretched by `stretch` (as [`crate::dem::lattice::Lattice::stretch`]) the wanted modulus along x.
/// `spacing` (m) is the neighbour distance of the regular cell of the same volume: twice the particles' radius. `reached`
/// holds the moduli along x.
///
/// # Errors
/// As for [`lattice::calibrate`] and [`Specimen::lattice_cell`].
pub fn calibrate(
    kind: LatticeKind,
    spacing: f64,
    stretch: [f64; 3],
    matter: Matter,
    target: Moduli,
    bond_poisson: f64,
    work: &mut Work,
) -> Result<Calibrated> {
    let regular = lattice::calibrate(kind, spacing, matter.thickness_m, target, bond_poisson)?;
    let cell = Specimen::lattice_cell(kind, spacing, stretch, matter)?;
    let material = BondMaterial { young_pa: regular.bond_young_pa, poisson: bond_poisson };
    let section = Section::Uniform { ratio: regular.radius_ratio };
    let recipe = BondRecipe { material, section, skin: Skin::Full };
    let c = homogenise(&periodic_network(&cell.arrangement, &cell.pairs, &recipe)?, work)?.stiffness;
    let shown = Moduli::along_x(kind.space(), &c);
    Ok(Calibrated {
        method: "homogenised stretched cell".into(),
        key: format!("{} stretch={stretch:?}", regular.key),
        bond_young_pa: regular.bond_young_pa * target.young_pa / shown.young_pa,
        reached: Moduli { young_pa: target.young_pa, poisson: shown.poisson },
        anisotropy: anisotropy(kind.space(), &c),
        ..regular
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn found(stretch: f64) -> Calibrated {
        let target = Moduli { young_pa: 210e9, poisson: 0.3 };
        let matter = Matter { density: 1.0, thickness_m: 0.02 };
        let kind = LatticeKind::Triangular;
        calibrate(kind, 0.1, [stretch, 0.0, 0.0], matter, target, 0.3, &mut Work::default()).unwrap()
    }

    #[test]
    fn a_regular_cell_needs_no_correction_and_a_stretched_one_in_proportion() {
        let exact = lattice::calibrate(LatticeKind::Triangular, 0.1, 0.02, found(0.0).reached, 0.3).unwrap();
        assert!((found(0.0).bond_young_pa / exact.bond_young_pa - 1.0).abs() < 1e-12);
        let excess = |s: f64| (exact.bond_young_pa / found(s).bond_young_pa - 1.0) / s;
        // The law of this module, first order in the stretch.
        assert!((excess(0.01) - 0.58).abs() < 0.01, "{}", excess(0.01));
        assert!((excess(-0.01) - 0.58).abs() < 0.02, "{}", excess(-0.01));
    }
}
