//! The isotropic material nearest to a stiffness tensor, and plane moduli.

use crate::error::{Error, Result};
use crate::fem::elasticity::{Elasticity, Hypothesis, Stiffness};
use crate::space::Space;
use serde::{Deserialize, Serialize};

/// Young's modulus and Poisson's ratio of a network as measured in its own space: in the plane they relate the in-plane
/// stresses (force per height and thickness) to in-plane strains, which is plane stress.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Moduli {
    /// `E`, in Pa.
    pub young_pa: f64,
    /// `ν`, dimensionless.
    pub poisson: f64,
}

impl Moduli {
    /// What a network must show in its own space to stand for a material: the same in the solid and in plane stress,
    /// `E/(1−ν²)` and `ν/(1−ν)` in plane strain.
    pub fn of(material: &Elasticity, hypothesis: Hypothesis) -> Self {
        let Elasticity { young_pa: e, poisson: nu, .. } = *material;
        match hypothesis {
            Hypothesis::PlaneStrain { .. } => {
                Self { young_pa: e / (1.0 - nu * nu), poisson: nu / (1.0 - nu) }
            }
            _ => Self { young_pa: e, poisson: nu },
        }
    }

    /// The projection of a Voigt stiffness onto isotropic ones: it keeps the two linear invariants `C_iijj` and `C_ijij`
    /// (the Voigt average over all orientations).
    pub fn project(space: Space, c: &Stiffness) -> Self {
        match space {
            Space::Plane => {
                let bulk = (c[(0, 0)] + c[(1, 1)] + 2.0 * c[(0, 1)]) / 4.0;
                let shear = (c[(0, 0)] + c[(1, 1)] - 2.0 * c[(0, 1)] + 4.0 * c[(3, 3)]) / 8.0;
                Self {
                    young_pa: 4.0 * bulk * shear / (bulk + shear),
                    poisson: (bulk - shear) / (bulk + shear),
                }
            }
            Space::Solid => {
                let normal = c[(0, 0)] + c[(1, 1)] + c[(2, 2)];
                let cross = c[(0, 1)] + c[(1, 2)] + c[(2, 0)];
                let bulk = (normal + 2.0 * cross) / 9.0;
                let shear = (normal - cross + 3.0 * (c[(3, 3)] + c[(4, 4)] + c[(5, 5)])) / 15.0;
                Self {
                    young_pa: 9.0 * bulk * shear / (3.0 * bulk + shear),
                    poisson: (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear)),
                }
            }
        }
    }

    /// What a bar cut along x shows: `E = 1/S11`, `ν = −S12/S11` with the compliance `S = C⁻¹`. Equal to the projection for an isotropic
    /// material; what a beam along x needs of another one. NaN for a stiffness that cannot be inverted.
    pub fn along_x(space: Space, c: &Stiffness) -> Self {
        let used: &[usize] = match space {
            Space::Plane => &[0, 1, 3],
            Space::Solid => &[0, 1, 2, 3, 4, 5],
        };
        // Unused components get a unit stiffness and do not couple.
        let full = Stiffness::from_fn(|i, j| {
            if used.contains(&i) && used.contains(&j) { c[(i, j)] } else { f64::from(i == j) * c[(0, 0)] }
        });
        full.try_inverse().map_or(Self { young_pa: f64::NAN, poisson: f64::NAN }, |s| Self {
            young_pa: 1.0 / s[(0, 0)],
            poisson: -s[(1, 0)] / s[(0, 0)],
        })
    }

    /// Mean and standard deviation (NaN for one sample) of each of the two.
    pub fn statistics(samples: impl Iterator<Item = Moduli> + Clone) -> (Moduli, Moduli) {
        let n = samples.clone().count() as f64;
        let of = |pick: fn(&Moduli) -> f64| {
            let mean = samples.clone().map(|m| pick(&m)).sum::<f64>() / n;
            let square: f64 = samples.clone().map(|m| (pick(&m) - mean).powi(2)).sum();
            (mean, (square / (n - 1.0)).sqrt())
        };
        let ((e, de), (nu, dnu)) = (of(|m| m.young_pa), of(|m| m.poisson));
        (Moduli { young_pa: e, poisson: nu }, Moduli { young_pa: de, poisson: dnu })
    }

    /// Refuses moduli that no network is calibrated to.
    pub(super) fn check(&self) -> Result<()> {
        for (name, value, good) in [
            ("young_Pa", self.young_pa, self.young_pa > 0.0 && self.young_pa.is_finite()),
            ("poisson", self.poisson, self.poisson > -1.0 && self.poisson < 1.0),
        ] {
            if !good {
                let mend = "give a positive modulus and a Poisson's ratio between -1 and 1 (in the plane; 0.5 in the solid)";
                return Err(Error::Material { what: "calibration target".into(), name, value, mend });
            }
        }
        Ok(())
    }

    /// The isotropic Voigt stiffness of these moduli in a space.
    pub fn stiffness(&self, space: Space) -> Stiffness {
        let material = Elasticity { young_pa: self.young_pa, poisson: self.poisson, density: 0.0 };
        let hypothesis = match space {
            Space::Plane => Hypothesis::PlaneStress { thickness_m: 1.0 },
            Space::Solid => Hypothesis::Solid,
        };
        material.stiffness(hypothesis)
    }
}

/// How far a stiffness is from isotropic: `‖C − C_iso‖ / ‖C‖` in the Frobenius norm of its Voigt matrix.
pub fn anisotropy(space: Space, c: &Stiffness) -> f64 {
    (c - Moduli::project(space, c).stiffness(space)).norm() / c.norm()
}
