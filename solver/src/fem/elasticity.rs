//! Isotropic linear elasticity: plane stress, plane strain and solid.
//!
//! Strains and stresses are Voigt vectors in the order `xx, yy, zz, xy, yz, zx` with engineering
//! shear strains. The plane uses the first four components, so `σ_zz` of plane strain is kept.

use crate::error::{Error, Result};
use crate::space::Space;
use nalgebra::SMatrix;

/// Voigt stiffness matrix, 6×6, in Pa.
pub type Stiffness = SMatrix<f64, 6, 6>;

/// An isotropic elastic material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Elasticity {
    /// Young's modulus `E`, in Pa.
    pub young_pa: f64,
    /// Poisson's ratio `ν`, dimensionless.
    pub poisson: f64,
    /// Density, in kg/m³.
    pub density: f64,
}

/// What happens out of the plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Hypothesis {
    /// `σ_zz = 0`: a thin plate.
    PlaneStress {
        /// Thickness, in metres.
        thickness_m: f64,
    },
    /// `ε_zz = 0`: a slice of a long body.
    PlaneStrain {
        /// Thickness of the slice, in metres.
        thickness_m: f64,
    },
    /// All three dimensions.
    Solid,
}

impl Hypothesis {
    /// The space it belongs to.
    pub const fn space(self) -> Space {
        match self {
            Hypothesis::PlaneStress { .. } | Hypothesis::PlaneStrain { .. } => Space::Plane,
            Hypothesis::Solid => Space::Solid,
        }
    }

    /// Metres per unit of area in the plane; 1 (dimensionless) in the solid.
    pub const fn thickness(self) -> f64 {
        match self {
            Hypothesis::PlaneStress { thickness_m } | Hypothesis::PlaneStrain { thickness_m } => thickness_m,
            Hypothesis::Solid => 1.0,
        }
    }
}

impl Elasticity {
    /// Lamé's first constant `λ = Eν / (1+ν)(1−2ν)`, in Pa.
    pub fn lame_pa(&self) -> f64 {
        self.young_pa * self.poisson / ((1.0 + self.poisson) * (1.0 - 2.0 * self.poisson))
    }

    /// Shear modulus `μ = E / 2(1+ν)`, in Pa.
    pub fn shear_pa(&self) -> f64 {
        0.5 * self.young_pa / (1.0 + self.poisson)
    }

    /// Voigt stiffness: `σ = λ tr(ε) 1 + 2μ ε`. In plane stress `λ` is replaced by
    /// `2λμ/(λ+2μ)` and the rows and columns `zz, yz, zx` are zero (Timoshenko & Goodier 1970, §11).
    pub fn stiffness(&self, hypothesis: Hypothesis) -> Stiffness {
        let (lambda, mu) = (self.lame_pa(), self.shear_pa());
        let (normals, shears, lambda) = match hypothesis {
            Hypothesis::PlaneStress { .. } => (2, 1, 2.0 * lambda * mu / (lambda + 2.0 * mu)),
            Hypothesis::PlaneStrain { .. } => (3, 1, lambda),
            Hypothesis::Solid => (3, 3, lambda),
        };
        let mut c = Stiffness::zeros();
        for i in 0..normals {
            for j in 0..normals {
                c[(i, j)] = lambda;
            }
            c[(i, i)] += 2.0 * mu;
        }
        for s in 0..shears {
            c[(3 + s, 3 + s)] = mu;
        }
        c
    }

    /// Checks the constants and the thickness; `what` names their owner, e.g. `material 'steel'`.
    ///
    /// # Errors
    /// [`Error::Material`] for `E ≤ 0`, `ν` outside (−1, ½), a negative density, a thickness ≤ 0,
    /// or a value that is not finite.
    pub fn check(&self, hypothesis: Hypothesis, what: &str) -> Result<()> {
        let reject = |name, value, mend| Err(Error::Material { what: what.to_owned(), name, value, mend });
        let Elasticity { young_pa, poisson, density } = *self;
        if !(young_pa.is_finite() && young_pa > 0.0) {
            return reject("young_pa", young_pa, "Young's modulus must be positive");
        }
        if !(poisson > -1.0 && poisson < 0.5) {
            return reject(
                "poisson",
                poisson,
                "Poisson's ratio must lie strictly between -1 and 0.5; for nearly incompressible material use 0.4999 with b-bar",
            );
        }
        if !(density.is_finite() && density >= 0.0) {
            return reject("density", density, "the density must be zero or positive");
        }
        let thickness = hypothesis.thickness();
        if !(thickness.is_finite() && thickness > 0.0) {
            return reject("thickness_m", thickness, "the thickness must be positive");
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const STEEL: Elasticity = Elasticity { young_pa: 210e9, poisson: 0.3, density: 7850.0 };
    const SLICE: Hypothesis = Hypothesis::PlaneStrain { thickness_m: 0.1 };
    const PLATE: Hypothesis = Hypothesis::PlaneStress { thickness_m: 0.1 };

    /// Uniaxial stress in the solid: `ε_xx = σ/E`, `ε_yy = ε_zz = −νσ/E`.
    #[test]
    fn solid_inverts_to_young_and_poisson() {
        let s = STEEL.stiffness(Hypothesis::Solid).try_inverse().unwrap();
        let e = STEEL.young_pa;
        // Inversion of a 6×6 matrix of condition ~5: a few ulp.
        assert!((s[(0, 0)] * e - 1.0).abs() < 1e-14);
        assert!((s[(1, 0)] * e + 0.3).abs() < 1e-14);
        assert!((s[(3, 3)] * e - 2.6).abs() < 1e-14);
    }

    /// `σ_zz = ν(σ_xx + σ_yy)` in plane strain; `E/(1−ν²)` in plane stress.
    #[test]
    fn plane_hypotheses_follow_the_textbook() {
        let c = STEEL.stiffness(SLICE);
        assert!((c[(2, 0)] / (0.3 * (c[(0, 0)] + c[(1, 0)])) - 1.0).abs() < 1e-14);
        let c = STEEL.stiffness(PLATE);
        assert!((c[(0, 0)] * (1.0 - 0.09) / 210e9 - 1.0).abs() < 1e-14);
        assert!((c[(0, 1)] / c[(0, 0)] - 0.3).abs() < 1e-14);
        assert_eq!(c[(2, 2)], 0.0);
    }

    #[test]
    fn unphysical_constants_are_named() {
        let name = |material: Elasticity, hypothesis| match material.check(hypothesis, "material 'm'") {
            Err(Error::Material { name, .. }) => name,
            other => panic!("expected a material error, got {other:?}"),
        };
        assert!(STEEL.check(SLICE, "material 'm'").is_ok());
        assert_eq!(name(Elasticity { young_pa: -1.0, ..STEEL }, SLICE), "young_pa");
        assert_eq!(name(Elasticity { young_pa: f64::NAN, ..STEEL }, SLICE), "young_pa");
        for nu in [0.5, -1.0, f64::NAN] {
            assert_eq!(name(Elasticity { poisson: nu, ..STEEL }, SLICE), "poisson");
        }
        assert_eq!(name(Elasticity { density: -1.0, ..STEEL }, SLICE), "density");
        assert_eq!(name(STEEL, Hypothesis::PlaneStress { thickness_m: 0.0 }), "thickness_m");
    }
}
