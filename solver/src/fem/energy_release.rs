//! Energy release rate of a straight crack by a domain integral.
//!
//! `J = ∫ (σ_ij u_i,k − W δ_kj) q,j e_k dA`, with the strain energy density W, the direction e the crack grows in, and any q that
//! is one around the tip and zero outside: the contour integral of Rice (1968) as an area integral (Li, Shih & Needleman 1985,
//! *Eng. Fract. Mech.* 21, 405–421, eq. 2.5). It is the energy that a virtual extension `q e` of the crack releases: exact for the energy
//! of the discrete model itself (Parks 1974). The flanks are straight, parallel to e and free of traction.

use super::continuum::Continuum;
use super::formulation::Formulation;
use super::quadrature::tensor_gauss;
use super::stress::stress_at;
use crate::error::{Error, Result};
use crate::space::Vec3;
use nalgebra::Matrix3;

/// Gauss points per direction: those of the stiffness, so that J belongs to its energy.
const POINTS: usize = 2;

/// J, in J/m²: `displacement` over all degrees of freedom of the body (m), `direction` e a unit vector, `weight` the nodal values of q.
///
/// # Errors
/// Elements that are not plain: what their inner modes do to the gradient is not followed. Inverted elements. No node, or every node,
/// inside q.
pub fn energy_release_rate(
    continuum: &Continuum,
    displacement: &[f64],
    direction: Vec3,
    weight: impl Fn(Vec3) -> f64,
) -> Result<f64> {
    let mesh = &continuum.mesh;
    if continuum.formulation != Formulation::Plain {
        return Err(Error::Formulation {
            body: continuum.name.clone(),
            message: "the domain integral needs plain elements".to_owned(),
        });
    }
    let q: Vec<f64> = mesh.nodes.iter().map(|&x| weight(x)).collect();
    if q.iter().all(|v| *v == q[0]) {
        return Err(Error::Geometry {
            what: format!("domain integral in body '{}'", continuum.name),
            message: format!("its weight is {} at every node; let it fall from one at the tip to zero", q[0]),
        });
    }
    let dim = mesh.space.dim();
    let rule = tensor_gauss(dim, POINTS);
    let points: Vec<[f64; 3]> = rule.iter().map(|&(xi, _)| xi).collect();
    let mut sum = 0.0;
    for cell in 0..mesh.cell_count() {
        let nodes = mesh.cell(cell);
        // Where q is constant it adds nothing.
        if nodes.iter().all(|&n| q[n] == q[nodes[0]]) {
            continue;
        }
        let stresses = stress_at(continuum, displacement, cell, &points)?;
        for (&(xi, w), stress) in rule.iter().zip(stresses) {
            let sample = mesh.sample(cell, xi);
            let (mut slope, mut fall) = (Matrix3::zeros(), Vec3::zeros());
            for (a, &node) in nodes.iter().enumerate() {
                let u = Vec3::from_fn(|i, _| if i < dim { displacement[node * dim + i] } else { 0.0 });
                slope += u * sample.gradients[a].transpose();
                fall += sample.gradients[a] * q[node];
            }
            // Outside the plane either σ or ∇u is zero.
            let sigma = stress.tensor();
            let energy = 0.5 * sigma.component_mul(&slope).sum();
            let flow = (sigma * (slope * direction)).dot(&fall) - energy * direction.dot(&fall);
            sum += w * sample.determinant * flow;
        }
    }
    Ok(sum)
}
