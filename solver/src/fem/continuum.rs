//! A finite-element body: mesh, material, hypothesis and formulation.

use super::elasticity::{Elasticity, Hypothesis};
use super::formulation::Formulation;
use super::mesh::Mesh;
use crate::error::{Error, Result};

/// An elastic body of finite elements.
#[derive(Debug, Clone, PartialEq)]
pub struct Continuum {
    /// Its name, for messages.
    pub name: String,
    /// Its mesh.
    pub mesh: Mesh,
    /// Its material.
    pub elasticity: Elasticity,
    /// Plane stress, plane strain or solid; must suit the mesh.
    pub hypothesis: Hypothesis,
    /// How elements interpolate strain.
    pub formulation: Formulation,
}

impl Continuum {
    /// Degrees of freedom: nodes times dimension.
    pub fn dof_count(&self) -> usize {
        self.mesh.nodes.len() * self.mesh.space.dim()
    }

    /// Checks everything that does not need a Jacobian.
    ///
    /// # Errors
    /// Material constants out of range, a formulation that does not exist for the hypothesis, a
    /// hypothesis for the other space, cells or facets with nodes that do not exist, nodes that are not finite.
    pub fn check(&self) -> Result<()> {
        self.elasticity.check(self.hypothesis, &format!("body '{}'", self.name))?;
        self.formulation.check(self.hypothesis, &self.name)?;
        let bad_mesh = |message| Err(Error::Geometry { what: format!("body '{}'", self.name), message });
        let mesh = &self.mesh;
        if self.hypothesis.space() != mesh.space {
            return bad_mesh(format!(
                "hypothesis {:?} does not suit a {:?} mesh; use plane stress or plane strain for quadrilaterals, solid for hexahedra",
                self.hypothesis, mesh.space
            ));
        }
        if mesh.cells.is_empty() || !mesh.cells.len().is_multiple_of(mesh.nodes_per_cell()) {
            return bad_mesh(format!(
                "{} node indices in the cells; give {} for each of at least one cell",
                mesh.cells.len(),
                mesh.nodes_per_cell()
            ));
        }
        let count = mesh.nodes.len();
        if let Some(at) = mesh.cells.iter().position(|&n| n >= count) {
            let (cell, node) = (at / mesh.nodes_per_cell(), mesh.cells[at]);
            return bad_mesh(format!("cell {cell} uses node {node}, but there are {count} nodes"));
        }
        if let Some(node) = mesh.nodes.iter().position(|x| !x.iter().all(|v| v.is_finite())) {
            return bad_mesh(format!("node {node} is not finite; check its coordinates"));
        }
        for (name, facets) in &mesh.boundaries {
            let foreign = |f: &&super::mesh::Facet| {
                f.cell >= mesh.cell_count()
                    || mesh.facet_nodes(f).iter().any(|n| !mesh.cell(f.cell).contains(n))
            };
            if let Some(facet) = facets.iter().find(foreign) {
                return bad_mesh(format!(
                    "boundary '{name}': {:?} is no facet of cell {}",
                    mesh.facet_nodes(facet),
                    facet.cell
                ));
            }
        }
        Ok(())
    }

    /// The error for a cell whose Jacobian is not positive.
    pub(super) fn inverted(&self, cell: usize, jacobian: f64) -> Error {
        let nodes = self.mesh.cell(cell).to_vec();
        Error::InvertedElement { body: self.name.clone(), element: cell, jacobian, nodes }
    }
}
