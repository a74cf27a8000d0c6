//! A point of a cell: shape functions, their gradients, the Jacobian, for either space.

use super::element::Element;
use super::h8::H8;
use super::mesh::Mesh;
use super::q4::Q4;
use crate::space::{Space, Vec3};
use nalgebra::{Matrix3, Vector2};

/// What the mesh knows at natural coordinates `ξ` of one cell. Arrays run over the nodes of
/// the cell; in the plane the last four entries are zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Position, in metres.
    pub position: Vec3,
    /// Shape functions `N_a`.
    pub values: [f64; 8],
    /// Gradients `∂N_a/∂x`, in 1/m; all zero where the cell is flat.
    pub gradients: [Vec3; 8],
    /// Jacobian matrix `J = ∂x/∂ξ`, in metres (`J_33 = 1` in the plane).
    pub jacobian: Matrix3<f64>,
    /// `det J`, in m² or m³; positive in a sound cell.
    pub determinant: f64,
}

/// Shape functions and natural gradients of either element, padded to eight nodes.
fn shape(space: Space, xi: [f64; 3]) -> ([f64; 8], [Vec3; 8]) {
    let mut values = [0.0; 8];
    let mut gradients = [Vec3::zeros(); 8];
    match space {
        Space::Plane => {
            let xi = Vector2::new(xi[0], xi[1]);
            values[..4].copy_from_slice(&Q4::values(&xi));
            for (padded, g) in gradients.iter_mut().zip(Q4::gradients(&xi)) {
                *padded = Vec3::new(g.x, g.y, 0.0);
            }
        }
        Space::Solid => {
            let xi = Vec3::from(xi);
            (values, gradients) = (H8::values(&xi), H8::gradients(&xi));
        }
    }
    (values, gradients)
}

impl Mesh {
    /// Samples a cell at natural coordinates `xi` (third one ignored in the plane):
    /// `x = Σ N_a x_a`, `J = Σ x_a ⊗ ∂N_a/∂ξ`, `∂N_a/∂x = J⁻ᵀ ∂N_a/∂ξ`.
    pub fn sample(&self, cell: usize, xi: [f64; 3]) -> Sample {
        let (values, natural) = shape(self.space, xi);
        let mut position = Vec3::zeros();
        let mut jacobian = Matrix3::zeros();
        for (a, &node) in self.cell(cell).iter().enumerate() {
            position += self.nodes[node] * values[a];
            jacobian += self.nodes[node] * natural[a].transpose();
        }
        if self.space == Space::Plane {
            jacobian[(2, 2)] = 1.0;
        }
        let inverse = jacobian.try_inverse().unwrap_or_default();
        let gradients = natural.map(|g| inverse.tr_mul(&g));
        Sample { position, values, gradients, jacobian, determinant: jacobian.determinant() }
    }

    /// Natural coordinates of the local node `a` of a cell.
    pub fn corner(&self, a: usize) -> [f64; 3] {
        match self.space {
            Space::Plane => [Q4::CORNERS[a][0], Q4::CORNERS[a][1], 0.0],
            Space::Solid => H8::CORNERS[a],
        }
    }
}
