//! The stiffness matrix of one element, its modes condensed, and the strain recovered from it.

use super::continuum::Continuum;
use super::element::Element;
use super::formulation::{Inverted, Kinematics};
use super::quadrature::tensor_gauss;
use nalgebra::{SMatrix, SVector};

/// What all elements of a body share: elasticity times thickness, and the Gauss rule `2^D`.
pub(super) struct ElementModel<'a, const D: usize, const V: usize> {
    continuum: &'a Continuum,
    /// `C`, in Pa.
    pub elasticity: SMatrix<f64, V, V>,
    rule: Vec<(SVector<f64, D>, f64)>,
}

/// Stiffness matrix of one element over nodal displacements `q` and modes `α`, row by row:
/// after condensation its leading block is the element stiffness, and the rows below give `α`.
pub(super) struct Condensed {
    matrix: Vec<f64>,
    size: usize,
    nodal: usize,
}

impl Condensed {
    /// Eliminates the modes, last one first: `K_ij ← K_ij − K_ip K_pj / K_pp` (static condensation).
    /// The matrix is positive definite on the modes, so no pivoting.
    fn new(mut matrix: Vec<f64>, size: usize, nodal: usize) -> Self {
        for p in (nodal..size).rev() {
            let (above, pivot_row) = matrix.split_at_mut(p * size);
            let inverse = 1.0 / pivot_row[p];
            for i in 0..p {
                let row = &mut above[i * size..(i + 1) * size];
                let k_ip = pivot_row[i];
                for j in 0..p {
                    row[j] -= k_ip * pivot_row[j] * inverse;
                }
            }
        }
        Condensed { matrix, size, nodal }
    }

    /// Copies the element stiffness, row by row.
    pub fn copy_stiffness(&self, into: &mut Vec<f64>) {
        into.clear();
        for row in self.matrix.chunks_exact(self.size).take(self.nodal) {
            into.extend_from_slice(&row[..self.nodal]);
        }
    }

    /// Modes from nodal displacements: `α_p = −Σ_{j<p} K_pj q_j / K_pp`, first mode first.
    pub fn modes(&self, displacement: &[f64]) -> Vec<f64> {
        let mut q = displacement.to_vec();
        for p in self.nodal..self.size {
            let row = &self.matrix[p * self.size..(p + 1) * self.size];
            let pull: f64 = row.iter().zip(&q).map(|(k, q)| k * q).sum();
            q.push(-pull / row[p]);
        }
        q.split_off(self.nodal)
    }
}

impl<'a, const D: usize, const V: usize> ElementModel<'a, D, V> {
    pub fn new(continuum: &'a Continuum) -> Self {
        let c = continuum.elasticity.stiffness(continuum.hypothesis);
        let point = |xi: [f64; 3]| SVector::from_fn(|i, _| xi[i]);
        ElementModel {
            continuum,
            elasticity: c.fixed_view::<V, V>(0, 0).into(),
            rule: tensor_gauss(D, 2).into_iter().map(|(xi, w)| (point(xi), w)).collect(),
        }
    }

    pub fn kinematics<E: Element<D, N>, const N: usize>(
        &self,
        cell: usize,
    ) -> Result<Kinematics<E, D, N, V>, Inverted> {
        let mesh = &self.continuum.mesh;
        let nodes = mesh.cell(cell);
        let x = std::array::from_fn(|a| SVector::from_fn(|i, _| mesh.nodes[nodes[a]][i]));
        Kinematics::new(x, self.continuum.formulation, &self.rule)
    }

    /// `K = ∫ [B G]ᵀ C [B G] dV`, with the modes condensed.
    pub fn stiffness<E: Element<D, N>, const N: usize>(
        &self,
        kinematics: &Kinematics<E, D, N, V>,
    ) -> Result<Condensed, Inverted> {
        let thickness = self.continuum.hypothesis.thickness();
        let (mut matrix, mut blocks) = (Vec::new(), Vec::with_capacity(N + D));
        let mut size = N * D;
        for (xi, w) in &self.rule {
            let operator = kinematics.at(xi)?;
            blocks.clear();
            blocks.extend(operator.nodes.iter().chain(operator.modes.iter().flatten()).copied());
            size = blocks.len() * D;
            matrix.resize(size * size, 0.0);
            let c = self.elasticity * (w * operator.jacobian * thickness);
            for (a, b_a) in blocks.iter().enumerate() {
                let stress = b_a.tr_mul(&c);
                for (b, b_b) in blocks.iter().enumerate().skip(a) {
                    let block = stress * b_b;
                    for i in 0..D {
                        for j in 0..D {
                            matrix[(a * D + i) * size + b * D + j] += block[(i, j)];
                        }
                    }
                }
            }
        }
        // Only the blocks on and above the diagonal were filled.
        for row in 0..size {
            for column in 0..row {
                matrix[row * size + column] = matrix[column * size + row];
            }
        }
        Ok(Condensed::new(matrix, size, N * D))
    }
}
