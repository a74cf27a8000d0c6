//! The box of elements that particles are to replace.

use crate::dem::block::Block;
use crate::error::{Error, Result};
use crate::fem::continuum::Continuum;
use crate::fem::mesh::Mesh;
use crate::fem::quadrature::tensor_gauss;
use crate::space::Vec3;
use std::collections::BTreeSet;

/// Area or volume may differ by this share before a region counts as no box: rounding of coordinates.
const ROUNDING: f64 = 1e-9;

/// Elements that fill a box.
#[derive(Debug, Clone, PartialEq)]
pub struct Region {
    /// Cells, ascending.
    pub cells: Vec<usize>,
    /// The box they fill.
    pub block: Block,
}

impl Region {
    /// The smallest box region that holds `cells`: all cells whose centre lies in their bounding box.
    ///
    /// # Errors
    /// No cells, cells that do not exist, or cells that do not fill their box: it must follow the lines of the mesh.
    pub fn covering(body: &Continuum, cells: &BTreeSet<usize>) -> Result<Region> {
        let mesh = &body.mesh;
        let refuse =
            |message: String| Error::Switch { what: format!("region in body '{}'", body.name), message };
        if cells.is_empty() {
            return Err(refuse(
                "it has no elements; widen the box or lower the criterion's trigger".to_owned(),
            ));
        }
        if let Some(bad) = cells.iter().find(|c| **c >= mesh.cell_count()) {
            return Err(refuse(format!("there is no element {bad}, only {}", mesh.cell_count())));
        }
        let corners = cells.iter().flat_map(|&c| mesh.cell(c)).map(|&n| mesh.nodes[n]);
        let empty = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        let (low, high) = corners.fold(empty, |(low, high), x| (low.inf(&x), high.sup(&x)));
        Region::in_box(body, Block::new(mesh.space, low, high)?)
    }

    /// The cells whose centre lies in a box; the region is the box that they fill.
    ///
    /// # Errors
    /// As [`Region::covering`].
    pub fn in_box(body: &Continuum, wanted: Block) -> Result<Region> {
        let mesh = &body.mesh;
        let dim = mesh.space.dim();
        let cells = cells_in(mesh, &wanted);
        let refuse =
            |message: String| Error::Switch { what: format!("region in body '{}'", body.name), message };
        if cells.is_empty() {
            return Err(refuse(format!(
                "no element has its centre between {:?} and {:?}; widen the box",
                &wanted.min.as_slice()[..dim],
                &wanted.max.as_slice()[..dim]
            )));
        }
        let corners = cells.iter().flat_map(|&c| mesh.cell(c)).map(|&n| mesh.nodes[n]);
        let empty = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
        let (low, high) = corners.fold(empty, |(low, high), x| (low.inf(&x), high.sup(&x)));
        let block = Block::new(mesh.space, low, high)?;
        let filled: f64 = cells.iter().map(|&c| measure(mesh, c)).sum();
        let whole = block.measure(mesh.space);
        if (filled / whole - 1.0).abs() > ROUNDING {
            return Err(refuse(format!(
                "its {} elements fill {:.4} of their box; particles are packed in boxes: choose elements along the lines of a \
                 rectangular mesh",
                cells.len(),
                filled / whole
            )));
        }
        Ok(Region { cells, block })
    }

    /// The smallest box region that holds `wanted` and is cut out along its faces alone: the cells whose centre lies in it. It may be
    /// hollow, as where a notch reaches into it; what fills it has to be hollow there too.
    ///
    /// # Errors
    /// No cells, or cells whose border to the others does not lie on the faces of their box.
    pub fn around(body: &Continuum, wanted: Block) -> Result<Region> {
        let mesh = &body.mesh;
        let refuse =
            |message: String| Error::Switch { what: format!("region in body '{}'", body.name), message };
        let mut cells = cells_in(mesh, &wanted);
        if cells.is_empty() {
            return Err(refuse("it has no elements; widen it".to_owned()));
        }
        let mut block;
        loop {
            let corners = cells.iter().flat_map(|&c| mesh.cell(c)).map(|&n| mesh.nodes[n]);
            let empty = (Vec3::repeat(f64::INFINITY), Vec3::repeat(f64::NEG_INFINITY));
            let (low, high) = corners.fold(empty, |(low, high), x| (low.inf(&x), high.sup(&x)));
            block = Block { min: low, max: high };
            let more = cells_in(mesh, &block);
            if more.len() == cells.len() {
                break;
            }
            cells = more;
        }
        let inside: BTreeSet<usize> = cells.iter().copied().collect();
        let on_face = |x: Vec3| Block::faces(mesh.space).iter().any(|f| block.on_face(x, f.1, f.2));
        for facets in mesh.facets_by_nodes().into_values().filter(|facets| facets.len() == 2) {
            if inside.contains(&facets[0].cell) == inside.contains(&facets[1].cell) {
                continue;
            }
            if let Some(&node) = mesh.facet_nodes(&facets[0]).iter().find(|&&n| !on_face(mesh.nodes[n])) {
                let x = mesh.nodes[node];
                return Err(refuse(format!(
                    "its border passes node {node} at ({:.6}, {:.6}) m, which is on no face of the box from ({:.6}, {:.6}) to ({:.6}, \
                     {:.6}) m; let the mesh have straight lines along the box, and the box reach beyond the notch",
                    x.x, x.y, block.min.x, block.min.y, block.max.x, block.max.y
                )));
            }
        }
        Ok(Region { cells, block })
    }

    /// Area (m²) or volume (m³) of its cells.
    pub fn measure(&self, mesh: &Mesh) -> f64 {
        self.cells.iter().map(|&c| measure(mesh, c)).sum()
    }
}

/// Cells whose centre lies in a box.
pub(crate) fn cells_in(mesh: &Mesh, block: &Block) -> Vec<usize> {
    let inside = |x: Vec3| (0..mesh.space.dim()).all(|i| x[i] > block.min[i] && x[i] < block.max[i]);
    (0..mesh.cell_count()).filter(|&c| inside(centre(mesh, c))).collect()
}

/// Mean of a cell's nodes, in m.
pub fn centre(mesh: &Mesh, cell: usize) -> Vec3 {
    let nodes = mesh.cell(cell);
    nodes.iter().map(|&n| mesh.nodes[n]).sum::<Vec3>() / nodes.len() as f64
}

/// Area (m²) or volume (m³) of a cell.
pub fn measure(mesh: &Mesh, cell: usize) -> f64 {
    let rule = tensor_gauss(mesh.space.dim(), 2);
    rule.iter().map(|&(xi, w)| w * mesh.sample(cell, xi).determinant).sum()
}
