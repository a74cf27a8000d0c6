//! Exact constants of the regular lattices, and their inverse: which bond gives a material.
//!
//! With the neighbour distance `l` and, in the plane, per thickness `t`:
//!
//! | lattice | C11 | C12 | C44 |
//! |---|---|---|---|
//! | triangular | `E/(1−ν²)`, `E t = 2√3 k_n(k_n+k_s)/(3k_n+k_s)`, `ν = (k_n−k_s)/(3k_n+k_s)` | | |
//! | square | `k_n/t` | 0 | `k_s/2t` |
//! | simple cubic | `k_n/l` | 0 | `k_s/2l` |
//! | body-centred | `s(k_n+2k_s)/9` | `s(k_n−k_s)/9` | `s(k_n/9+k_s/18)`, `s = 3√3/l` |
//! | face-centred | `√2(k_n+k_s)/l` | `√2(k_n−k_s)/2l` | `√2(k_n+k_s)/2l` |
//!
//! (Born & Huang 1954 for the method; particle rotations are free). With `α = k_s/k_n = 3r̃²/4`, Poisson's ratio along the
//! axes is `(1−α)/(3+α)` (triangular, face-centred), `(1−α)/(2+α)` (body-centred) or 0 (square, simple cubic). Only the
//! triangular lattice is isotropic at every `α`; the others are at `α = 1` alone, where `ν = 0`. Elsewhere they are calibrated along
//! their axes and the anisotropy is reported.

use super::isotropy::{Moduli, anisotropy};
use super::{Calibrated, LARGEST_RATIO};
use crate::dem::bond::BondMaterial;
use crate::dem::lattice::LatticeKind;
use crate::dem::network::BondStiffness;
use crate::error::{Error, Result};
use crate::fem::elasticity::Stiffness;
use crate::space::Space;

/// Voigt stiffness (Pa) of an infinite lattice of neighbour distance `spacing` (m) with bonds of stiffness `k`; `thickness` (m) counts
/// in the plane only.
pub fn stiffness(kind: LatticeKind, spacing: f64, thickness: f64, k: BondStiffness) -> Stiffness {
    let (kn, ks, l, t) = (k.kn, k.ks, spacing, thickness);
    let root2 = 2f64.sqrt();
    match kind {
        LatticeKind::Triangular | LatticeKind::TriangularZigzag => {
            let young_pa = 2.0 * 3f64.sqrt() * kn * (kn + ks) / ((3.0 * kn + ks) * t);
            Moduli { young_pa, poisson: (kn - ks) / (3.0 * kn + ks) }.stiffness(Space::Plane)
        }
        LatticeKind::Square => {
            let mut c = Stiffness::zeros();
            (c[(0, 0)], c[(1, 1)], c[(3, 3)]) = (kn / t, kn / t, 0.5 * ks / t);
            c
        }
        LatticeKind::SimpleCubic => cubic(kn / l, 0.0, 0.5 * ks / l),
        LatticeKind::BodyCentredCubic => {
            let s = 27f64.sqrt() / l;
            cubic(s * (kn + 2.0 * ks) / 9.0, s * (kn - ks) / 9.0, s * (kn / 9.0 + ks / 18.0))
        }
        LatticeKind::FaceCentredCubic => {
            cubic(root2 * (kn + ks) / l, 0.5 * root2 * (kn - ks) / l, 0.5 * root2 * (kn + ks) / l)
        }
    }
}

fn cubic(c11: f64, c12: f64, c44: f64) -> Stiffness {
    Stiffness::from_fn(|i, j| match (i == j, i < 3 && j < 3) {
        (true, true) => c11,
        (false, true) => c12,
        (true, false) => c44,
        (false, false) => 0.0,
    })
}

/// `α = k_s/k_n` that gives Poisson's ratio `ν` along the axes.
fn shear_ratio(kind: LatticeKind, poisson: f64) -> f64 {
    let nu = poisson;
    match kind {
        LatticeKind::Triangular | LatticeKind::TriangularZigzag | LatticeKind::FaceCentredCubic => {
            (1.0 - 3.0 * nu) / (1.0 + nu)
        }
        LatticeKind::BodyCentredCubic => (1.0 - 2.0 * nu) / (1.0 + nu),
        // ν is 0 at every α; this is the isotropic one.
        LatticeKind::Square | LatticeKind::SimpleCubic => 1.0,
    }
}

/// Poisson's ratios a lattice reaches for `0 < r̃ ≤ 2/√3`: the lowest, and the one it stays below.
fn reach(kind: LatticeKind) -> [f64; 2] {
    match kind {
        LatticeKind::Triangular | LatticeKind::TriangularZigzag | LatticeKind::FaceCentredCubic => {
            [0.0, 1.0 / 3.0]
        }
        LatticeKind::BodyCentredCubic => [0.0, 0.5],
        LatticeKind::Square | LatticeKind::SimpleCubic => [0.0, 0.0],
    }
}

/// Bond modulus and radius ratio that give a lattice of neighbour distance `spacing` (m) and `thickness` (m, plane only) the
/// wanted moduli along its axes (see [`Moduli::of`] for plane strain).
///
/// # Errors
/// A modulus that is not positive, or a Poisson's ratio the lattice cannot have: the message names the range.
pub fn calibrate(
    kind: LatticeKind,
    spacing: f64,
    thickness: f64,
    target: Moduli,
    bond_poisson: f64,
) -> Result<Calibrated> {
    target.check()?;
    let [low, high] = reach(kind);
    let nu = target.poisson;
    if !(nu == low || (nu > low && nu < high)) {
        return Err(Error::Geometry {
            what: format!("{kind:?} lattice"),
            message: if high == 0.0 {
                format!(
                    "Poisson's ratio {nu} (in its own plane or solid) is out of reach: it has 0 at every bond radius; use another lattice"
                )
            } else {
                format!(
                    "Poisson's ratio {nu} (in its own plane or solid) is out of reach: it has {low} to below {high:.4}; use a packing or another lattice"
                )
            },
        });
    }
    let radius_ratio = (4.0 * shear_ratio(kind, nu) / 3.0).sqrt().min(LARGEST_RATIO);
    let unit = BondMaterial { young_pa: 1.0, poisson: bond_poisson };
    let c = stiffness(kind, spacing, thickness, unit.cylinder(0.5 * radius_ratio * spacing, spacing));
    let per_unit = Moduli::along_x(kind.space(), &c);
    Ok(Calibrated {
        method: "exact lattice constants".into(),
        key: format!("lattice/1 {kind:?} l={spacing:?} t={thickness:?} {target:?} nu_b={bond_poisson:?}"),
        radius_ratio,
        bond_young_pa: target.young_pa / per_unit.young_pa,
        bond_poisson,
        reached: Moduli { young_pa: target.young_pa, poisson: per_unit.poisson },
        scatter: [0.0; 2],
        anisotropy: anisotropy(kind.space(), &c),
        evaluations: 1,
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dem::arrangement::Matter;
    use crate::dem::bonding::{BondRecipe, periodic_network};
    use crate::dem::calibration::homogenisation::homogenise;
    use crate::dem::calibration::specimen::Specimen;
    use crate::dem::section::Section;
    use crate::dem::skin::Skin;
    use crate::work::Work;
    use LatticeKind::*;

    const SPACING: f64 = 0.02;
    const MATTER: Matter = Matter { density: 1.0, thickness_m: 0.3 };
    const BOND: BondMaterial = BondMaterial { young_pa: 3e9, poisson: 0.25 };

    fn homogenised(kind: LatticeKind, material: BondMaterial, ratio: f64, stretch: [f64; 3]) -> Stiffness {
        let cell = Specimen::lattice_cell(kind, SPACING, stretch, MATTER).unwrap();
        let recipe = BondRecipe { material, section: Section::Uniform { ratio }, skin: Skin::Full };
        let network = periodic_network(&cell.arrangement, &cell.pairs, &recipe).unwrap();
        homogenise(&network, &mut Work::default()).unwrap().stiffness
    }

    #[test]
    fn homogenised_cells_have_the_exact_constants() {
        for kind in [Triangular, Square, SimpleCubic, BodyCentredCubic, FaceCentredCubic] {
            for ratio in [0.1, 0.5, 1.0] {
                let exact = stiffness(
                    kind,
                    SPACING,
                    MATTER.thickness_m,
                    BOND.cylinder(0.5 * ratio * SPACING, SPACING),
                );
                let found = homogenised(kind, BOND, ratio, [0.0; 3]);
                let error = (found - exact).amax() / exact.amax();
                assert!(error < 1e-12, "{kind:?} r̃ = {ratio}: {error:e}");
            }
        }
    }

    #[test]
    fn calibrated_lattices_show_the_wanted_moduli() {
        for (kind, poisson) in [
            (Triangular, 0.3),
            (Triangular, 0.0),
            (Square, 0.0),
            (SimpleCubic, 0.0),
            (BodyCentredCubic, 0.3),
            (FaceCentredCubic, 0.25),
        ] {
            let target = Moduli { young_pa: 210e9, poisson };
            let found = calibrate(kind, SPACING, MATTER.thickness_m, target, 0.25).unwrap();
            let material = BondMaterial { young_pa: found.bond_young_pa, poisson: 0.25 };
            let c = homogenised(kind, material, found.radius_ratio, [0.0; 3]);
            let shown = Moduli::along_x(kind.space(), &c);
            assert!((shown.young_pa / target.young_pa - 1.0).abs() < 1e-12, "{kind:?} {shown:?}");
            assert!((shown.poisson - poisson).abs() < 1e-12, "{kind:?} {shown:?}");
            let is_isotropic = kind.space() == Space::Plane || poisson == 0.0;
            assert_eq!(found.anisotropy < 1e-12, is_isotropic, "{kind:?} {}", found.anisotropy);
        }
    }

    #[test]
    fn out_of_reach_names_the_range() {
        let target = |poisson| Moduli { young_pa: 1e9, poisson };
        for (kind, poisson, range) in [
            (Triangular, 0.34, "0.3333"),
            (BodyCentredCubic, 0.5, "0.5"),
            (Square, 0.2, "0 at every"),
            (Triangular, -0.1, "0 to"),
        ] {
            let refusal = calibrate(kind, 1.0, 1.0, target(poisson), 0.3).unwrap_err().to_string();
            assert!(refusal.contains(range), "{refusal}");
        }
        assert!(calibrate(Triangular, 1.0, 1.0, Moduli { young_pa: -1.0, poisson: 0.2 }, 0.3).is_err());
        assert!(calibrate(Triangular, 1.0, 1.0, target(f64::NAN), 0.3).is_err());
    }

    #[test]
    fn a_stretched_cell_is_slightly_anisotropic() {
        let found =
            |stretch| anisotropy(Space::Plane, &homogenised(Triangular, BOND, 0.5, [stretch, 0.0, 0.0]));
        assert!(found(0.0) < 1e-12);
        // First order in the stretch.
        let ratio = found(0.02) / found(0.01);
        assert!((ratio - 2.0).abs() < 0.05, "{ratio}");
    }
}
