//! Meshes of quadrilaterals or hexahedra, with boundaries by name.

use crate::space::{Space, Vec3};
use std::collections::BTreeMap;

/// A mesh of 4-node quadrilaterals (plane) or 8-node hexahedra (solid).
#[derive(Debug, Clone, PartialEq)]
pub struct Mesh {
    /// Plane (Q4) or solid (H8).
    pub space: Space,
    /// Node positions, in metres; third component zero in the plane.
    pub nodes: Vec<Vec3>,
    /// Nodes of all cells one after the other, [`Mesh::nodes_per_cell`] each. Q4: counter-clockwise.
    /// H8: bottom face counter-clockwise seen from outside's opposite (ζ = −1), then the top face.
    pub cells: Vec<usize>,
    /// Named parts of the boundary.
    pub boundaries: BTreeMap<String, Vec<Facet>>,
}

/// An edge (two nodes) or quadrilateral face (four nodes) of one cell.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Facet {
    /// The cell it belongs to.
    pub cell: usize,
    /// Its nodes, ordered so that the normal points outwards (plane: outside to the right of
    /// the direction of travel). In the plane only the first two count.
    pub nodes: [usize; 4],
}

impl Mesh {
    /// 4 in the plane, 8 in the solid.
    pub const fn nodes_per_cell(&self) -> usize {
        match self.space {
            Space::Plane => 4,
            Space::Solid => 8,
        }
    }

    /// 2 in the plane, 4 in the solid.
    pub const fn nodes_per_facet(&self) -> usize {
        match self.space {
            Space::Plane => 2,
            Space::Solid => 4,
        }
    }

    /// Number of cells.
    pub fn cell_count(&self) -> usize {
        self.cells.len() / self.nodes_per_cell()
    }

    /// Nodes of one cell.
    pub fn cell(&self, index: usize) -> &[usize] {
        let n = self.nodes_per_cell();
        &self.cells[index * n..(index + 1) * n]
    }

    /// The nodes of a facet that count: two or four.
    pub fn facet_nodes<'a>(&self, facet: &'a Facet) -> &'a [usize] {
        &facet.nodes[..self.nodes_per_facet()]
    }

    /// Nodes of a named boundary, ascending and each once; `None` if there is no such name.
    pub fn boundary_nodes(&self, name: &str) -> Option<Vec<usize>> {
        let facets = self.boundaries.get(name)?;
        let mut nodes: Vec<usize> = facets.iter().flat_map(|f| self.facet_nodes(f).iter().copied()).collect();
        nodes.sort_unstable();
        nodes.dedup();
        Some(nodes)
    }
}
