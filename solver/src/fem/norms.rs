//! Distance of a finite-element solution from a given exact one.

use super::continuum::Continuum;
use super::quadrature::tensor_gauss;
use super::stress::strain_at;
use crate::error::Result;
use crate::space::Vec3;
use nalgebra::{Matrix3, Vector6};

/// Norms of the error and, for relative errors, of the exact solution.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Norms {
    /// `√∫|u|² dV`, in m^(1+d/2).
    pub l2: f64,
    /// `√∫|∇u|² dV`, of the compatible part, in m^(d/2).
    pub h1: f64,
    /// `√∫ε:C:ε dV`, modes included, in √J.
    pub energy: f64,
}

/// Gauss points per direction: two more than assembly, so that the quadrature error of a smooth
/// exact field is of higher order than what is measured.
const POINTS: usize = 4;

/// Norms of `u_h − u` and of `u`, for the exact displacement (m) and its gradient
/// `∇u_ij = ∂u_i/∂x_j` that `exact(x)` gives.
///
/// # Errors
/// An inverted element.
pub fn error_norms(
    continuum: &Continuum,
    displacement: &[f64],
    exact: impl Fn(Vec3) -> (Vec3, Matrix3<f64>),
) -> Result<(Norms, Norms)> {
    let mesh = &continuum.mesh;
    let dim = mesh.space.dim();
    let rule = tensor_gauss(dim, POINTS);
    let points: Vec<[f64; 3]> = rule.iter().map(|&(xi, _)| xi).collect();
    let c = continuum.elasticity.stiffness(continuum.hypothesis);
    let thickness = continuum.hypothesis.thickness();
    let (mut error, mut size) = (Norms::default(), Norms::default());
    for cell in 0..mesh.cell_count() {
        let strains = strain_at(continuum, displacement, cell, &points)?;
        for (&(xi, w), strain) in rule.iter().zip(strains) {
            let sample = mesh.sample(cell, xi);
            let (u, slope) = exact(sample.position);
            let (mut u_h, mut slope_h) = (Vec3::zeros(), Matrix3::zeros());
            for (a, &node) in mesh.cell(cell).iter().enumerate() {
                let q = Vec3::from_fn(|i, _| if i < dim { displacement[node * dim + i] } else { 0.0 });
                u_h += q * sample.values[a];
                slope_h += q * sample.gradients[a].transpose();
            }
            let volume = w * sample.determinant * thickness;
            let energy = |e: Vector6<f64>| e.dot(&(c * e));
            error.l2 += volume * (u_h - u).norm_squared();
            error.h1 += volume * (slope_h - slope).norm_squared();
            error.energy += volume * energy(strain - strain_of(&slope));
            size.l2 += volume * u.norm_squared();
            size.h1 += volume * slope.norm_squared();
            size.energy += volume * energy(strain_of(&slope));
        }
    }
    Ok((error.root(), size.root()))
}

impl Norms {
    fn root(self) -> Norms {
        Norms { l2: self.l2.sqrt(), h1: self.h1.sqrt(), energy: self.energy.sqrt() }
    }
}

/// `ε = ½(∇u + ∇uᵀ)`, engineering shears.
fn strain_of(g: &Matrix3<f64>) -> Vector6<f64> {
    let shear = |i, j| g[(i, j)] + g[(j, i)];
    Vector6::new(g[(0, 0)], g[(1, 1)], g[(2, 2)], shear(0, 1), shear(1, 2), shear(2, 0))
}
