//! Stress at points and nodes, from the strain of the formulation, modes included.

use super::continuum::Continuum;
use super::element::Element;
use super::formulation::Inverted;
use super::h8::H8;
use super::q4::Q4;
use super::quadrature::tensor_gauss;
use super::stiffness::ElementModel;
use crate::error::Result;
use crate::space::Space;
use nalgebra::{Matrix3, SVector, Vector6};

/// A stress tensor, in Pa, tension positive.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Stress {
    /// Components `xx, yy, zz, xy, yz, zx`.
    pub voigt: [f64; 6],
}

impl Stress {
    /// The symmetric 3×3 tensor.
    pub fn tensor(&self) -> Matrix3<f64> {
        let [xx, yy, zz, xy, yz, zx] = self.voigt;
        Matrix3::new(xx, xy, zx, xy, yy, yz, zx, yz, zz)
    }

    /// Principal stresses, largest first.
    pub fn principal(&self) -> [f64; 3] {
        let mut values: [f64; 3] = self.tensor().symmetric_eigenvalues().into();
        values.sort_by(|a, b| b.total_cmp(a));
        values
    }

    /// The largest principal stress; in closed form where shear acts in the x–y plane alone.
    pub fn largest(&self) -> f64 {
        let [xx, yy, zz, xy, yz, zx] = self.voigt;
        if yz != 0.0 || zx != 0.0 {
            return self.principal()[0];
        }
        let (centre, half) = (0.5 * (xx + yy), 0.5 * (xx - yy));
        (centre + half.hypot(xy)).max(zz)
    }

    /// Von Mises stress `√(3/2 s:s)` with the deviator `s`.
    pub fn von_mises(&self) -> f64 {
        let tensor = self.tensor();
        let deviator = tensor - Matrix3::identity() * (tensor.trace() / 3.0);
        (1.5 * deviator.norm_squared()).sqrt()
    }
}

/// Stress at natural coordinates `points` of a cell; `displacement` over all degrees of freedom of the body (m).
///
/// # Errors
/// An inverted element.
pub fn stress_at(
    continuum: &Continuum,
    displacement: &[f64],
    cell: usize,
    points: &[[f64; 3]],
) -> Result<Vec<Stress>> {
    let c = continuum.elasticity.stiffness(continuum.hypothesis);
    let strains = strain_at(continuum, displacement, cell, points)?;
    Ok(strains.into_iter().map(|strain| Stress { voigt: (c * strain).into() }).collect())
}

/// Stress at every node: extrapolated in each cell from its Gauss points, where it converges
/// fastest (Barlow 1976), then averaged over the cells that meet there. Nodes of no cell get zero.
///
/// # Errors
/// An inverted element.
pub fn nodal_stress(continuum: &Continuum, displacement: &[f64]) -> Result<Vec<Stress>> {
    let mesh = &continuum.mesh;
    let dim = mesh.space.dim();
    let gauss: Vec<[f64; 3]> = tensor_gauss(dim, 2).into_iter().map(|(xi, _)| xi).collect();
    let mut sums = vec![(Vector6::zeros(), 0.0); mesh.nodes.len()];
    for cell in 0..mesh.cell_count() {
        let stresses = stress_at(continuum, displacement, cell, &gauss)?;
        for (a, &node) in mesh.cell(cell).iter().enumerate() {
            let corner = mesh.corner(a);
            for (xi, stress) in gauss.iter().zip(&stresses) {
                // The multilinear function that is one at this Gauss point: ξ_g = ±1/√3.
                let weight: f64 = (0..dim).map(|i| 0.5 * (1.0 + 3.0 * xi[i] * corner[i])).product();
                sums[node].0 += Vector6::from(stress.voigt) * weight;
            }
            sums[node].1 += 1.0;
        }
    }
    let average = |(sum, count): (Vector6<f64>, f64)| Stress { voigt: (sum / count.max(1.0)).into() };
    Ok(sums.into_iter().map(average).collect())
}

/// Strain at points of a cell as its formulation sees it, engineering shears; `ε_zz` of plane
/// stress is left at zero.
pub(super) fn strain_at(
    continuum: &Continuum,
    displacement: &[f64],
    cell: usize,
    points: &[[f64; 3]],
) -> Result<Vec<Vector6<f64>>> {
    match continuum.mesh.space {
        Space::Plane => recover::<Q4, 2, 4, 4>(continuum, displacement, cell, points),
        Space::Solid => recover::<H8, 3, 8, 6>(continuum, displacement, cell, points),
    }
    .map_err(|inverted| continuum.inverted(cell, inverted.0))
}

/// Stress at the centre of a cell as a matrix on its nodal displacements, node by node: six rows `xx, yy, zz, xy, yz, zx`, in Pa/m.
/// Incompatible modes have no strain there (`G_i ∝ ξ_i`).
///
/// # Errors
/// An inverted element.
pub fn centre_operator(continuum: &Continuum, cell: usize) -> Result<Vec<f64>> {
    match continuum.mesh.space {
        Space::Plane => operator::<Q4, 2, 4, 4>(continuum, cell),
        Space::Solid => operator::<H8, 3, 8, 6>(continuum, cell),
    }
    .map_err(|inverted| continuum.inverted(cell, inverted.0))
}

/// `C B_a` at the centre, row by row.
fn operator<E: Element<D, N>, const D: usize, const N: usize, const V: usize>(
    continuum: &Continuum,
    cell: usize,
) -> std::result::Result<Vec<f64>, Inverted> {
    let c = continuum.elasticity.stiffness(continuum.hypothesis);
    let model = ElementModel::<D, V>::new(continuum);
    let strain = model.kinematics::<E, N>(cell)?.at(&SVector::zeros())?;
    let mut rows = vec![0.0; 6 * N * D];
    for (a, b) in strain.nodes.iter().enumerate() {
        for row in 0..6 {
            for i in 0..D {
                let sum: f64 = (0..V).map(|k| c[(row, k)] * b[(k, i)]).sum();
                rows[row * N * D + a * D + i] = sum;
            }
        }
    }
    Ok(rows)
}

/// `ε = Σ B_a u_a + Σ G_i α_i` with the modes `α` that the condensation left behind.
fn recover<E: Element<D, N>, const D: usize, const N: usize, const V: usize>(
    continuum: &Continuum,
    displacement: &[f64],
    cell: usize,
    points: &[[f64; 3]],
) -> std::result::Result<Vec<Vector6<f64>>, Inverted> {
    let model = ElementModel::<D, V>::new(continuum);
    let kinematics = model.kinematics::<E, N>(cell)?;
    let nodes = continuum.mesh.cell(cell);
    let q: Vec<f64> = nodes.iter().flat_map(|&n| &displacement[n * D..(n + 1) * D]).copied().collect();
    let modes = model.stiffness(&kinematics)?.modes(&q);
    let component =
        |values: &[f64], a: usize| SVector::<f64, D>::from_column_slice(&values[a * D..(a + 1) * D]);
    points
        .iter()
        .map(|xi| {
            let operator = kinematics.at(&SVector::from_fn(|i, _| xi[i]))?;
            let mut strain: SVector<f64, V> =
                operator.nodes.iter().enumerate().map(|(a, b)| b * component(&q, a)).sum();
            for (i, g) in operator.modes.iter().flatten().enumerate() {
                strain += g * component(&modes, i);
            }
            Ok(Vector6::from_fn(|i, _| if i < V { strain[i] } else { 0.0 }))
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn uniaxial_shear_and_pressure_have_their_invariants() {
        let uniaxial = Stress { voigt: [0.0, 5.0, 0.0, 0.0, 0.0, 0.0] };
        assert!((uniaxial.von_mises() - 5.0).abs() < 1e-14);
        let shear = Stress { voigt: [0.0, 0.0, 0.0, 0.0, 2.0, 0.0] };
        assert!((shear.von_mises() - 12f64.sqrt()).abs() < 1e-14);
        for (computed, exact) in shear.principal().into_iter().zip([2.0, 0.0, -2.0]) {
            assert!((computed - exact).abs() < 1e-14);
        }
        for voigt in [
            [1.0, -2.0, 0.3, 0.7, 0.0, 0.0],
            [-4.0, -2.0, 0.3, 0.1, 0.0, 0.0],
            [1.0, 2.0, 3.0, 4.0, 5.0, 6.0],
        ] {
            let stress = Stress { voigt };
            assert!((stress.largest() - stress.principal()[0]).abs() < 1e-14, "{voigt:?}");
        }
        assert!(Stress { voigt: [3.0, 3.0, 3.0, 0.0, 0.0, 0.0] }.von_mises() < 1e-14);
    }

    /// The matrix gives what the element gives, modes and B-bar included, on a cell that is no rectangle.
    #[test]
    fn the_operator_of_the_centre_is_the_stress_there() {
        use crate::fem::elasticity::{Elasticity, Hypothesis};
        use crate::fem::formulation::Formulation;
        use crate::fem::structured::{BOX_SIDES, mapped};
        let bend =
            |x: crate::space::Vec3| crate::space::Vec3::new(x.x + 0.2 * x.y, x.y + 0.1 * x.x * x.y, x.z);
        let axes = |dim: usize| vec![vec![0.0, 1.0]; dim];
        for (dim, formulation) in [
            (2, Formulation::Plain),
            (2, Formulation::Incompatible),
            (2, Formulation::BBar),
            (3, Formulation::Incompatible),
        ] {
            let body = Continuum {
                name: "cell".to_owned(),
                mesh: mapped(&axes(dim), BOX_SIDES, bend).unwrap(),
                elasticity: Elasticity { young_pa: 3.0, poisson: 0.3, density: 1.0 },
                hypothesis: if dim == 2 {
                    Hypothesis::PlaneStrain { thickness_m: 0.1 }
                } else {
                    Hypothesis::Solid
                },
                formulation,
            };
            let u: Vec<f64> = (0..body.dof_count()).map(|i| (1.0 + 2.3 * i as f64).sin()).collect();
            let q: Vec<f64> =
                body.mesh.cell(0).iter().flat_map(|&n| &u[n * dim..(n + 1) * dim]).copied().collect();
            let exact = stress_at(&body, &u, 0, &[[0.0; 3]]).unwrap()[0];
            let rows = centre_operator(&body, 0).unwrap();
            for (row, exact) in rows.chunks_exact(q.len()).zip(exact.voigt) {
                let found: f64 = row.iter().zip(&q).map(|(c, q)| c * q).sum();
                assert!((found - exact).abs() < 1e-12, "{dim} {formulation:?}: {found} {exact}");
            }
        }
    }
}
