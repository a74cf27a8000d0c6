//! The motion of elements at the places of particles.
//!
//! Displacement `u_d = Σ N_i(x_d) u_i`; rotation `½ curl u` there, or, when large, that of the polar
//! decomposition of `F = 1 + ∇u`; velocity and spin alike. Gradients jump between elements; they are averaged over
//! the elements that meet in a node and interpolated, which is one order better.

use crate::error::{Error, Result};
use crate::fem::continuum::Continuum;
use crate::fem::locate::Locator;
use crate::space::{Space, Vec3};
use nalgebra::Matrix3;
use serde::{Deserialize, Serialize};

/// What the particles take over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Mode {
    /// Displacement alone: bonds are strained by rotations that the particles do not have.
    #[serde(rename = "displacement")]
    Displacement,
    /// Displacement and rotation, at rest.
    #[serde(rename = "displacement+rotation")]
    Rotation,
    /// Displacement, rotation, velocity and spin; momentum is kept.
    #[serde(rename = "displacement+rotation+velocity")]
    Velocity,
    /// As before, with the displacements relaxed to equilibrium inside a held interface.
    #[serde(rename = "displacement+rotation+velocity+re-equilibrate")]
    ReEquilibrate,
}

/// Motion of one point.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct PointMotion {
    /// Displacement, in m.
    pub u: Vec3,
    /// Rotation vector, in rad.
    pub theta: Vec3,
    /// Velocity, in m/s.
    pub v: Vec3,
    /// Spin, in rad/s.
    pub spin: Vec3,
    /// Acceleration, in m/s².
    pub a: Vec3,
    /// Angular acceleration, in rad/s².
    pub alpha: Vec3,
}

/// Motion of a body at `points` (m), from `u`, `v`, `a` over its degrees of freedom (node · dimension + component).
/// `finite` takes rotations from the polar decomposition; it is meant for kinematics that count them so.
///
/// # Errors
/// A point outside the body by more than 1e-6 of the body's size.
pub fn at_points(
    body: &Continuum,
    [u, v, a]: [&[f64]; 3],
    points: &[Vec3],
    finite: bool,
) -> Result<Vec<PointMotion>> {
    let mesh = &body.mesh;
    let slopes = [u, v, a].map(|field| nodal_gradients(body, field));
    let locator = Locator::new(mesh);
    let size = mesh.nodes.iter().map(|x| (x - mesh.nodes[0]).norm()).fold(0.0, f64::max);
    points
        .iter()
        .enumerate()
        .map(|(i, &x)| {
            let at = locator.find_nearest(x, 1e-6 * size).ok_or_else(|| Error::Switch {
                what: format!("body '{}'", body.name),
                message: format!(
                    "particle {i} at {:?} lies outside of it; fill exactly the elements that are replaced",
                    x.as_slice()
                ),
            })?;
            let value = |field: &[f64]| -> Vec3 {
                at.weights.iter().map(|&(node, n)| nodal(mesh.space, field, node) * n).sum()
            };
            let slope = |which: usize| -> Matrix3<f64> {
                at.weights.iter().map(|&(node, n)| slopes[which][node] * n).sum()
            };
            let theta = if finite { polar_rotation(&slope(0)) } else { half_curl(&slope(0)) };
            Ok(PointMotion {
                u: value(u),
                theta,
                v: value(v),
                spin: half_curl(&slope(1)),
                a: value(a),
                alpha: half_curl(&slope(2)),
            })
        })
        .collect()
}

/// A nodal vector; zero beyond the dimension.
fn nodal(space: Space, field: &[f64], node: usize) -> Vec3 {
    let dim = space.dim();
    Vec3::from_fn(|i, _| if i < dim { field[node * dim + i] } else { 0.0 })
}

/// `∇u` at the nodes, row = component: mean over the cells that meet there of the value in the node's corner.
fn nodal_gradients(body: &Continuum, field: &[f64]) -> Vec<Matrix3<f64>> {
    let mesh = &body.mesh;
    let mut sums = vec![(Matrix3::zeros(), 0.0); mesh.nodes.len()];
    for cell in 0..mesh.cell_count() {
        for (corner, &node) in mesh.cell(cell).iter().enumerate() {
            let sample = mesh.sample(cell, mesh.corner(corner));
            let slope: Matrix3<f64> = mesh
                .cell(cell)
                .iter()
                .zip(sample.gradients)
                .map(|(&other, g)| nodal(mesh.space, field, other) * g.transpose())
                .sum();
            sums[node].0 += slope;
            sums[node].1 += 1.0;
        }
    }
    sums.into_iter().map(|(sum, count)| sum / f64::max(count, 1.0)).collect()
}

/// `½ curl u`.
fn half_curl(slope: &Matrix3<f64>) -> Vec3 {
    0.5 * Vec3::new(
        slope[(2, 1)] - slope[(1, 2)],
        slope[(0, 2)] - slope[(2, 0)],
        slope[(1, 0)] - slope[(0, 1)],
    )
}

/// Rotation vector of R in `F = R U`.
fn polar_rotation(slope: &Matrix3<f64>) -> Vec3 {
    nalgebra::Rotation3::from_matrix(&(Matrix3::identity() + slope)).scaled_axis()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fem::elasticity::{Elasticity, Hypothesis};
    use crate::fem::formulation::Formulation;
    use crate::fem::structured::{even, grid, jiggle};

    fn body() -> Continuum {
        let axes = [even(0.0, 2.0, 4).unwrap(), even(0.0, 1.0, 3).unwrap(), even(0.0, 1.0, 2).unwrap()];
        let mut mesh = grid(&axes).unwrap();
        jiggle(&mut mesh, 0.2, 3);
        let elasticity = Elasticity { young_pa: 1.0, poisson: 0.2, density: 1.0 };
        let (hypothesis, formulation) = (Hypothesis::Solid, Formulation::Plain);
        Continuum { name: "body".into(), mesh, elasticity, hypothesis, formulation }
    }

    fn field(body: &Continuum, slope: Matrix3<f64>) -> Vec<f64> {
        body.mesh.nodes.iter().flat_map(|x| (slope * x).as_slice().to_vec()).collect()
    }

    /// Linear fields are exact, to rounding, on distorted elements too.
    #[test]
    fn linear_fields_are_exact() {
        let body = body();
        let slope = Matrix3::new(1e-3, -2e-3, 4e-4, 3e-3, 5e-4, -1e-3, 2e-4, 6e-4, -3e-4);
        let x = Vec3::new(0.7, 0.4, 0.9);
        let (u, v) = (field(&body, slope), field(&body, 2.0 * slope));
        let zero = vec![0.0; u.len()];
        let at = at_points(&body, [&u, &v, &zero], &[x], false).unwrap()[0];
        let curl = 0.5 * Vec3::new(6e-4 + 1e-3, 4e-4 - 2e-4, 3e-3 + 2e-3);
        assert!((at.u - slope * x).norm() < 1e-15 && (at.theta - curl).norm() < 1e-14);
        assert!((at.v - 2.0 * slope * x).norm() < 1e-15 && (at.spin - 2.0 * curl).norm() < 1e-14);
        assert_eq!((at.a, at.alpha), (Vec3::zeros(), Vec3::zeros()));
    }

    /// A large rotation with a stretch: the polar part is the rotation, half the curl is not.
    #[test]
    fn large_rotations_come_from_the_polar_part() {
        let body = body();
        let turn = Vec3::new(0.3, -0.5, 0.9);
        let rotation = nalgebra::Rotation3::from_scaled_axis(turn).into_inner();
        let stretch = Matrix3::new(1.1, 0.02, 0.0, 0.02, 0.95, 0.03, 0.0, 0.03, 1.0);
        let u = field(&body, rotation * stretch - Matrix3::identity());
        let zero = vec![0.0; u.len()];
        let theta = |finite| {
            let x = Vec3::new(0.7, 0.4, 0.9);
            at_points(&body, [&u, &zero, &zero], &[x], finite).unwrap()[0].theta
        };
        // The decomposition iterates to about the root of rounding.
        assert!((theta(true) - turn).norm() < 1e-7, "{}", theta(true));
        assert!((theta(false) - turn).norm() > 0.05);
    }

    #[test]
    fn a_point_outside_is_refused() {
        let body = body();
        let zero = vec![0.0; 3 * body.mesh.nodes.len()];
        let far = at_points(&body, [&zero, &zero, &zero], &[Vec3::new(3.0, 0.0, 0.0)], false).unwrap_err();
        assert!(far.to_string().contains("particle 0"), "{far}");
    }
}
