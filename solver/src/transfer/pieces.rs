//! What stays of a body when a box of its elements goes.

use super::region::Region;
use super::substitution::Switch;
use crate::dem::block::Block;
use crate::fem::continuum::Continuum;
use crate::fem::mesh::{Facet, Mesh};
use crate::space::Vec3;
use std::collections::{BTreeMap, BTreeSet};

/// Some elements of a body as a body.
pub(super) struct Piece {
    pub body: Continuum,
    /// Old number of each node.
    pub nodes: Vec<usize>,
}

/// The cells that stay, by connection through nodes, each as a body of its own.
pub(super) fn pieces(body: &Continuum, switch: &Switch) -> Vec<Piece> {
    let mesh = &body.mesh;
    let gone: BTreeSet<usize> = switch.region.cells.iter().copied().collect();
    let stay: Vec<usize> = (0..mesh.cell_count()).filter(|c| !gone.contains(c)).collect();
    let mut cells_of_node: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    for &cell in &stay {
        mesh.cell(cell).iter().for_each(|&n| cells_of_node.entry(n).or_default().push(cell));
    }
    let mut seen = BTreeSet::new();
    let mut pieces = Vec::new();
    for &first in &stay {
        if !seen.insert(first) {
            continue;
        }
        let (mut cells, mut next) = (Vec::new(), vec![first]);
        while let Some(cell) = next.pop() {
            cells.push(cell);
            for neighbour in mesh.cell(cell).iter().flat_map(|n| &cells_of_node[n]) {
                if seen.insert(*neighbour) {
                    next.push(*neighbour);
                }
            }
        }
        cells.sort_unstable();
        let name =
            if pieces.is_empty() { body.name.clone() } else { format!("{}.{}", body.name, switch.name) };
        let name = if pieces.len() > 1 { format!("{name}.{}", pieces.len()) } else { name };
        pieces.push(cut(body, &cells, name, |facet| {
            face_between(mesh, &switch.region, facet).map(|face| new_boundary(switch, face))
        }));
    }
    pieces
}

/// Name of the boundary of a piece along a face of the region.
pub(super) fn new_boundary(switch: &Switch, face: &str) -> String {
    format!("{}:{face}", switch.name)
}

/// Some cells of a body as a body; `name_of` names facets besides the old names.
pub(super) fn cut(
    body: &Continuum,
    cells: &[usize],
    name: String,
    name_of: impl Fn(&Facet) -> Option<String>,
) -> Piece {
    let mesh = &body.mesh;
    let nodes: BTreeSet<usize> = cells.iter().flat_map(|&c| mesh.cell(c).iter().copied()).collect();
    let nodes: Vec<usize> = nodes.into_iter().collect();
    let place = |node: usize| nodes.binary_search(&node).expect("a node of these cells");
    let renumber = |facet: &Facet, cell: usize| {
        let mut own = Facet { cell, nodes: [0; 4] };
        for (k, &n) in mesh.facet_nodes(facet).iter().enumerate() {
            own.nodes[k] = place(n);
        }
        own
    };
    let mut boundaries: BTreeMap<String, Vec<Facet>> = BTreeMap::new();
    for (old, facets) in &mesh.boundaries {
        for facet in facets {
            if let Ok(cell) = cells.binary_search(&facet.cell) {
                boundaries.entry(old.clone()).or_default().push(renumber(facet, cell));
            }
        }
    }
    for (index, &cell) in cells.iter().enumerate() {
        for facet in mesh.cell_facets(cell) {
            if let Some(boundary) = name_of(&facet) {
                boundaries.entry(boundary).or_default().push(renumber(&facet, index));
            }
        }
    }
    let own = Mesh {
        space: mesh.space,
        nodes: nodes.iter().map(|&n| mesh.nodes[n]).collect(),
        cells: cells.iter().flat_map(|&c| mesh.cell(c)).map(|&n| place(n)).collect(),
        boundaries,
    };
    Piece { body: Continuum { name, mesh: own, ..body.clone() }, nodes }
}

/// The face of the region that a facet lies on and within; `None` elsewhere.
pub(super) fn face_between(mesh: &Mesh, region: &Region, facet: &Facet) -> Option<&'static str> {
    let nodes = mesh.facet_nodes(facet);
    let middle = nodes.iter().map(|&n| mesh.nodes[n]).sum::<Vec3>() / nodes.len() as f64;
    let block = &region.block;
    let dim = mesh.space.dim();
    let on = |axis: usize, upper: bool| nodes.iter().all(|&n| block.on_face(mesh.nodes[n], axis, upper));
    let within =
        |axis: usize| (0..dim).all(|i| i == axis || (middle[i] > block.min[i] && middle[i] < block.max[i]));
    let faces = Block::faces(mesh.space).iter();
    faces.filter(|(_, axis, upper)| on(*axis, *upper) && within(*axis)).map(|f| f.0).next()
}
