//! Consistent nodal loads from tractions and body forces, and lumped masses.

use super::continuum::Continuum;
use super::mesh::Facet;
use super::quadrature::tensor_gauss;
use super::sample::Sample;
use crate::error::{Error, Result};
use crate::space::Vec3;
use std::collections::BTreeMap;

/// Degree of freedom (node · dimension + component) and force in N, each once, ascending.
pub type NodalLoads = Vec<(usize, f64)>;

/// Gauss points per direction: exact for tractions and body forces of degree four on
/// parallelograms.
const POINTS: usize = 3;

/// `f_a = ∫ N_a t dA` over facets, with the traction `t(x, n)` in Pa at position `x` and outward
/// normal `n`; in the plane `dA` is thickness times length.
///
/// # Errors
/// A traction that is not finite.
pub fn facet_loads(
    continuum: &Continuum,
    facets: &[Facet],
    traction: impl Fn(Vec3, Vec3) -> Vec3,
) -> Result<NodalLoads> {
    let rule = tensor_gauss(continuum.mesh.space.dim() - 1, POINTS);
    let mut loads = Loads::new(continuum);
    for facet in facets {
        for &(eta, w) in &rule {
            let point = continuum.mesh.facet_point(facet, [eta[0], eta[1]]);
            let t = traction(point.position, point.normal);
            loads.add("traction", facet.cell, &point.sample, t, w * point.measure)?;
        }
    }
    Ok(loads.finish())
}

/// `f_a = ∫ N_a b dV` over the body, with the force density `b(x)` in N/m³.
///
/// # Errors
/// A force density that is not finite; an inverted element.
pub fn body_loads(continuum: &Continuum, density: impl Fn(Vec3) -> Vec3) -> Result<NodalLoads> {
    let mut loads = Loads::new(continuum);
    for_each_point(continuum, |cell, sample, volume| {
        loads.add("body force", cell, sample, density(sample.position), volume)
    })?;
    Ok(loads.finish())
}

/// Mass of each node, in kg: row sums `m_a = ∫ ρ N_a dV`, positive for multilinear elements.
///
/// # Errors
/// An inverted element.
pub fn lumped_mass(continuum: &Continuum) -> Result<Vec<f64>> {
    let mut mass = vec![0.0; continuum.mesh.nodes.len()];
    for_each_point(continuum, |cell, sample, volume| {
        for (&node, n) in continuum.mesh.cell(cell).iter().zip(sample.values) {
            mass[node] += continuum.elasticity.density * n * volume * continuum.hypothesis.thickness();
        }
        Ok(())
    })?;
    Ok(mass)
}

/// Visits the integration points of all cells with their area or volume.
fn for_each_point(
    continuum: &Continuum,
    mut visit: impl FnMut(usize, &Sample, f64) -> Result<()>,
) -> Result<()> {
    let rule = tensor_gauss(continuum.mesh.space.dim(), POINTS);
    for cell in 0..continuum.mesh.cell_count() {
        for &(xi, w) in &rule {
            let sample = continuum.mesh.sample(cell, xi);
            if sample.determinant <= 0.0 {
                return Err(continuum.inverted(cell, sample.determinant));
            }
            visit(cell, &sample, w * sample.determinant)?;
        }
    }
    Ok(())
}

struct Loads<'a> {
    continuum: &'a Continuum,
    sums: BTreeMap<usize, f64>,
}

impl<'a> Loads<'a> {
    fn new(continuum: &'a Continuum) -> Self {
        Loads { continuum, sums: BTreeMap::new() }
    }

    /// Adds `N_a q · measure · thickness` to the nodes of a cell that share in it.
    fn add(&mut self, what: &str, cell: usize, sample: &Sample, q: Vec3, measure: f64) -> Result<()> {
        if !q.iter().all(|v| v.is_finite()) {
            return Err(Error::Geometry {
                what: format!("body '{}'", self.continuum.name),
                message: format!(
                    "the {what} is not finite at {:?}; check its formula",
                    sample.position.as_slice()
                ),
            });
        }
        let dim = self.continuum.mesh.space.dim();
        let scale = measure * self.continuum.hypothesis.thickness();
        for (&node, n) in self.continuum.mesh.cell(cell).iter().zip(sample.values) {
            // Nodes off a facet weigh exactly nothing; leave them out.
            if n == 0.0 {
                continue;
            }
            for i in 0..dim {
                *self.sums.entry(node * dim + i).or_default() += n * q[i] * scale;
            }
        }
        Ok(())
    }

    fn finish(self) -> NodalLoads {
        self.sums.into_iter().collect()
    }
}
