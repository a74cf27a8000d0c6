//! How an element turns nodal displacements into strain: plain, incompatible modes, B-bar.

use super::elasticity::Hypothesis;
use super::element::Element;
use crate::error::{Error, Result};
use nalgebra::{SMatrix, SVector};
use serde::{Deserialize, Serialize};
use std::marker::PhantomData;

/// Interpolation of strain in an element.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Formulation {
    /// `ε = Σ B_a u_a`: locks in bending and near incompressibility.
    Plain,
    /// Bubble modes `1 − ξ_i²` added to the displacement, condensed in the element
    /// (Taylor, Beresford & Wilson 1976): bends without locking, passes the patch test.
    #[default]
    Incompatible,
    /// Volumetric strain replaced by its mean over the element (Hughes 1980): for near
    /// incompressibility in plane strain and solid.
    BBar,
}

impl Formulation {
    /// # Errors
    /// B-bar in plane stress, where the thickness is free to change and nothing locks by volume.
    pub fn check(self, hypothesis: Hypothesis, body: &str) -> Result<()> {
        match (self, hypothesis) {
            (Formulation::BBar, Hypothesis::PlaneStress { .. }) => Err(Error::Formulation {
                body: body.to_owned(),
                message: "b-bar does not exist in plane stress, which does not lock by volume; use incompatible or plain, or plane strain"
                    .to_owned(),
            }),
            _ => Ok(()),
        }
    }
}

/// `V×D` block of the strain operator of one shape function with gradient `g`:
/// `ε_ii = g_i u_i`, `γ_ij = g_j u_i + g_i u_j`, in the order `xx, yy, zz, xy, yz, zx`.
fn strain_operator<const D: usize, const V: usize>(g: &SVector<f64, D>) -> SMatrix<f64, V, D> {
    let mut b = SMatrix::zeros();
    for i in 0..D {
        b[(i, i)] = g[i];
    }
    for (row, (i, j)) in (3..V).zip([(0, 1), (1, 2), (2, 0)]) {
        b[(row, i)] = g[j];
        b[(row, j)] = g[i];
    }
    b
}

/// Strain operator of an element at one point: `ε = Σ_a B_a u_a + Σ_i G_i α_i`.
pub(super) struct StrainOperator<const D: usize, const N: usize, const V: usize> {
    /// Blocks `B_a` (or `B̄_a`) of the nodes.
    pub nodes: [SMatrix<f64, V, D>; N],
    /// Blocks `G_i` of the incompatible modes, if the formulation has them.
    pub modes: Option<[SMatrix<f64, V, D>; D]>,
    /// `det J`.
    pub jacobian: f64,
}

/// One element with what its formulation needs to know beforehand. `V` is the number of strain
/// components (4 in the plane, 6 in the solid).
pub(super) struct Kinematics<E, const D: usize, const N: usize, const V: usize> {
    nodes: [SVector<f64, D>; N],
    extra: Extra<D, N>,
    element: PhantomData<E>,
}

enum Extra<const D: usize, const N: usize> {
    None,
    /// `J₀⁻¹` and `j₀` at the centre.
    Centre(SMatrix<f64, D, D>, f64),
    /// `∇N̄_a = ∫∇N_a dV / ∫dV`.
    Mean([SVector<f64, D>; N]),
}

/// A Jacobian that is not positive.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inverted(pub f64);

impl<E: Element<D, N>, const D: usize, const N: usize, const V: usize> Kinematics<E, D, N, V> {
    pub fn new(
        nodes: [SVector<f64, D>; N],
        formulation: Formulation,
        rule: &[(SVector<f64, D>, f64)],
    ) -> std::result::Result<Self, Inverted> {
        let mut kinematics = Kinematics { nodes, extra: Extra::None, element: PhantomData };
        kinematics.extra = match formulation {
            Formulation::Plain => Extra::None,
            Formulation::Incompatible => {
                let (inverse, det) = invert(kinematics.jacobian(&SVector::zeros()))?;
                Extra::Centre(inverse, det)
            }
            Formulation::BBar => Extra::Mean(kinematics.mean_gradients(rule)?),
        };
        Ok(kinematics)
    }

    /// `J = Σ x_a ⊗ ∂N_a/∂ξ`.
    fn jacobian(&self, xi: &SVector<f64, D>) -> SMatrix<f64, D, D> {
        E::gradients(xi).iter().zip(&self.nodes).map(|(g, x)| x * g.transpose()).sum()
    }

    /// `∇N_a = J⁻ᵀ ∂N_a/∂ξ` and `det J`.
    fn gradients(&self, xi: &SVector<f64, D>) -> std::result::Result<([SVector<f64, D>; N], f64), Inverted> {
        let (inverse, det) = invert(self.jacobian(xi))?;
        Ok((E::gradients(xi).map(|g| inverse.tr_mul(&g)), det))
    }

    fn mean_gradients(
        &self,
        rule: &[(SVector<f64, D>, f64)],
    ) -> std::result::Result<[SVector<f64, D>; N], Inverted> {
        let mut sum = [SVector::zeros(); N];
        let mut volume = 0.0;
        for (xi, w) in rule {
            let (gradients, det) = self.gradients(xi)?;
            for (s, g) in sum.iter_mut().zip(gradients) {
                *s += g * (w * det);
            }
            volume += w * det;
        }
        Ok(sum.map(|s| s / volume))
    }

    /// The strain operator at natural coordinates `xi`.
    ///
    /// - Incompatible modes: `∇M_i = (j₀/j) J₀⁻ᵀ ∂M_i/∂ξ`, `M_i = 1 − ξ_i²`. With the centre
    ///   Jacobian `∫∇M_i dV = 0`, so that constant strain does no work on them: the patch test holds.
    /// - B-bar: `B̄_a = B_a + ⅓ 1⊗(∇N̄_a − ∇N_a)` on all three normal strains, also `ε_zz` of plane strain.
    pub fn at(&self, xi: &SVector<f64, D>) -> std::result::Result<StrainOperator<D, N, V>, Inverted> {
        let (gradients, jacobian) = self.gradients(xi)?;
        let mut nodes = gradients.map(|g| strain_operator(&g));
        let mut modes = None;
        match &self.extra {
            Extra::None => {}
            Extra::Centre(inverse, det) => {
                modes = Some(std::array::from_fn(|i| {
                    strain_operator(&(inverse.row(i).transpose() * (-2.0 * xi[i] * det / jacobian)))
                }));
            }
            Extra::Mean(mean) => {
                for a in 0..N {
                    let change = (mean[a] - gradients[a]) / 3.0;
                    for normal in 0..3 {
                        for i in 0..D {
                            nodes[a][(normal, i)] += change[i];
                        }
                    }
                }
            }
        }
        Ok(StrainOperator { nodes, modes, jacobian })
    }
}

fn invert<const D: usize>(j: SMatrix<f64, D, D>) -> std::result::Result<(SMatrix<f64, D, D>, f64), Inverted> {
    let det = determinant(&j);
    match j.try_inverse() {
        Some(inverse) if det > 0.0 => Ok((inverse, det)),
        _ => Err(Inverted(det)),
    }
}

/// `det J` for `D` = 2 or 3, by cofactors.
fn determinant<const D: usize>(j: &SMatrix<f64, D, D>) -> f64 {
    match D {
        2 => j[(0, 0)] * j[(1, 1)] - j[(0, 1)] * j[(1, 0)],
        _ => (0..3)
            .map(|i| {
                let (k, l) = ((i + 1) % 3, (i + 2) % 3);
                j[(0, i)] * (j[(1, k)] * j[(2, l)] - j[(1, l)] * j[(2, k)])
            })
            .sum(),
    }
}
