//! A manufactured solution: a smooth displacement field with the body force it needs
//! (Roache 2002, “Code verification by the method of manufactured solutions”).
//!
//! `u_i = a_i Π_j sin(κ x_j + φ_ij)` over the `d` coordinates, `φ_ij = 0.3 + 0.9 i + 0.5 j`, so
//! that no symmetry hides an error. From `σ = λ tr(ε) 1 + 2μ ε` and `∇·σ + b = 0`:
//!
//! `b_i = −(λ + μ) Σ_j ∂²u_j/∂x_i∂x_j − μ Σ_j ∂²u_i/∂x_j²`, where `Σ_j ∂²u_i/∂x_j² = −d κ² u_i`;
//! plane stress has `2λμ/(λ+2μ)` for `λ`.

use super::elasticity::{Elasticity, Hypothesis};
use crate::space::Vec3;
use nalgebra::{Matrix3, Vector6};

/// The field, for one material and hypothesis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Manufactured {
    /// Material.
    pub elasticity: Elasticity,
    /// Plane stress, plane strain or solid.
    pub hypothesis: Hypothesis,
    /// Amplitudes `a_i`, in metres.
    pub amplitude: Vec3,
    /// Wave number `κ`, in rad/m.
    pub wave_number: f64,
}

impl Manufactured {
    /// Displacement, in metres.
    pub fn displacement(&self, x: Vec3) -> Vec3 {
        Vec3::from_fn(|i, _| self.component(i, x, &[]))
    }

    /// Displacement gradient `∂u_i/∂x_j`.
    pub fn gradient(&self, x: Vec3) -> Matrix3<f64> {
        let dim = self.dim();
        Matrix3::from_fn(|i, j| if j < dim { self.component(i, x, &[j]) } else { 0.0 })
    }

    /// Stress tensor, in Pa.
    pub fn stress(&self, x: Vec3) -> Matrix3<f64> {
        let g = self.gradient(x);
        let shear = |i, j| g[(i, j)] + g[(j, i)];
        let strain = Vector6::new(g[(0, 0)], g[(1, 1)], g[(2, 2)], shear(0, 1), shear(1, 2), shear(2, 0));
        let s = self.elasticity.stiffness(self.hypothesis) * strain;
        Matrix3::new(s[0], s[3], s[5], s[3], s[1], s[4], s[5], s[4], s[2])
    }

    /// Body force, in N/m³.
    pub fn body_force(&self, x: Vec3) -> Vec3 {
        let dim = self.dim();
        let c = self.elasticity.stiffness(self.hypothesis);
        // C_xxyy is λ of the hypothesis, C_xyxy is μ.
        let (lambda, mu) = (c[(0, 1)], c[(3, 3)]);
        Vec3::from_fn(|i, _| {
            if i >= dim {
                return 0.0;
            }
            let divergence_slope: f64 = (0..dim).map(|j| self.component(j, x, &[i, j])).sum();
            let laplacian = -(dim as f64) * self.wave_number.powi(2) * self.component(i, x, &[]);
            -(lambda + mu) * divergence_slope - mu * laplacian
        })
    }

    fn dim(&self) -> usize {
        self.hypothesis.space().dim()
    }

    /// `u_i` differentiated along each axis in `along`: each derivative adds `π/2` to a phase and a
    /// factor `κ`.
    fn component(&self, i: usize, x: Vec3, along: &[usize]) -> f64 {
        if i >= self.dim() {
            return 0.0;
        }
        let factor = |j: usize| {
            let order = along.iter().filter(|&&a| a == j).count() as f64;
            let phase = 0.3 + 0.9 * i as f64 + 0.5 * j as f64 + order * std::f64::consts::FRAC_PI_2;
            (self.wave_number * x[j] + phase).sin()
        };
        let wave: f64 = (0..self.dim()).map(factor).product();
        self.amplitude[i] * self.wave_number.powi(along.len() as i32) * wave
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Gradient and `b = −∇·σ` against central differences, for each hypothesis.
    #[test]
    fn body_force_balances_the_stress() {
        let elasticity = Elasticity { young_pa: 3.0, poisson: 0.3, density: 1.0 };
        let plate = Hypothesis::PlaneStress { thickness_m: 1.0 };
        let slice = Hypothesis::PlaneStrain { thickness_m: 1.0 };
        for hypothesis in [plate, slice, Hypothesis::Solid] {
            let field = Manufactured {
                elasticity,
                hypothesis,
                amplitude: Vec3::new(1.0, -0.7, 0.4),
                wave_number: 1.7,
            };
            let x = Vec3::new(0.31, -0.42, 0.77);
            let h = 1e-5;
            let mut divergence = Vec3::zeros();
            for j in 0..hypothesis.space().dim() {
                let step = Vec3::ith(j, h);
                let slope = (field.displacement(x + step) - field.displacement(x - step)) / (2.0 * h);
                // Central differences: h² of truncation, ulp/h of rounding, both 1e-10.
                assert!((slope - field.gradient(x).column(j)).amax() < 1e-9, "{hypothesis:?}");
                let change = field.stress(x + step) - field.stress(x - step);
                divergence += change.column(j) / (2.0 * h);
            }
            assert!((divergence + field.body_force(x)).amax() < 1e-8, "{hypothesis:?}");
        }
    }
}
