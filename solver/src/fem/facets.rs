//! Facets of cells: which ones a cell has, and which ones are free.

use super::element::Element;
use super::h8::H8;
use super::mesh::{Facet, Mesh};
use super::q4::Q4;
use crate::space::Space;
use std::collections::BTreeMap;

impl Mesh {
    /// The facets of a cell with their normals outwards, in the order of its element.
    pub fn cell_facets(&self, cell: usize) -> impl Iterator<Item = Facet> + '_ {
        let facets = match self.space {
            Space::Plane => Q4::FACETS,
            Space::Solid => H8::FACETS,
        };
        facets.iter().map(move |local| {
            let mut nodes = [0; 4];
            for (k, &a) in local.iter().enumerate() {
                nodes[k] = self.cell(cell)[a];
            }
            Facet { cell, nodes }
        })
    }

    /// Every facet of the mesh by its sorted nodes, with the facets of the one or two cells it
    /// belongs to.
    pub fn facets_by_nodes(&self) -> BTreeMap<Vec<usize>, Vec<Facet>> {
        let mut map: BTreeMap<Vec<usize>, Vec<Facet>> = BTreeMap::new();
        for cell in 0..self.cell_count() {
            for facet in self.cell_facets(cell) {
                map.entry(self.facet_key(&facet)).or_default().push(facet);
            }
        }
        map
    }

    /// Facets that belong to one cell only: the whole boundary.
    pub fn free_facets(&self) -> Vec<Facet> {
        self.facets_by_nodes().into_values().filter(|cells| cells.len() == 1).flatten().collect()
    }

    fn facet_key(&self, facet: &Facet) -> Vec<usize> {
        let mut key = self.facet_nodes(facet).to_vec();
        key.sort_unstable();
        key
    }
}
