//! Meshes from Gmsh files: `.msh` 4.1, text or binary, quadrilaterals in the plane `z = 0` or hexahedra.
//!
//! Physical groups of curves (plane) or surfaces (solid) become boundaries under their names, or under
//! their tags where they have none. Nodes that no cell uses are left out.

mod cursor;
mod sections;

use super::mesh::{Facet, Mesh};
use crate::error::{Error, Result};
use crate::space::{Space, Vec3};
use sections::{RawElement, RawMesh};
use std::collections::BTreeMap;
use std::path::Path;

/// Reads a Gmsh file; coordinates count as metres.
///
/// # Errors
/// [`Error::File`]: the file cannot be read, is no Gmsh 4.1 file, is damaged, or has elements other
/// than points, lines, 4-node quadrilaterals and 8-node hexahedra.
pub fn read_gmsh(path: &Path) -> Result<Mesh> {
    let file = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|error| Error::File {
        file: file.clone(),
        line: None,
        message: format!("cannot be read: {error}; check the path"),
    })?;
    parse_gmsh(&bytes, &file)
}

/// Reads the bytes of a Gmsh file; `file` is its name for messages.
///
/// # Errors
/// As [`read_gmsh`].
pub fn parse_gmsh(bytes: &[u8], file: &str) -> Result<Mesh> {
    let raw = sections::read(file, bytes)?;
    let fault = |message| Error::File { file: file.to_owned(), line: None, message };
    let mut mesh = cells(&raw).map_err(fault)?;
    add_boundaries(&raw, &mut mesh).map_err(fault)?;
    Ok(mesh)
}

/// Index of each used node tag, ascending with the tags.
fn used_nodes(elements: &[RawElement]) -> BTreeMap<u64, usize> {
    let tags: std::collections::BTreeSet<u64> =
        elements.iter().flat_map(|e| e.nodes.iter().copied()).collect();
    tags.into_iter().zip(0..).collect()
}

fn cells(raw: &RawMesh) -> std::result::Result<Mesh, String> {
    let (space, elements) = match (raw.elements.get(&3), raw.elements.get(&2)) {
        (Some(hexahedra), _) => (Space::Solid, hexahedra),
        (None, Some(quadrilaterals)) => (Space::Plane, quadrilaterals),
        (None, None) => {
            return Err("it has no quadrilaterals and no hexahedra; mesh the geometry first".into());
        }
    };
    let index = used_nodes(elements);
    let mut nodes = Vec::with_capacity(index.len());
    for tag in index.keys() {
        let x = raw.nodes.get(tag).ok_or_else(|| {
            let user = elements.iter().find(|e| e.nodes.contains(tag)).map_or(0, |e| e.tag);
            format!("element {user} uses node {tag}, which does not exist; write the mesh again")
        })?;
        if space == Space::Plane && x.z != 0.0 {
            return Err(format!("node {tag} lies at z = {}; a plane mesh must lie in z = 0", x.z));
        }
        nodes.push(*x);
    }
    let cells = elements.iter().flat_map(|e| e.nodes.iter().map(|tag| index[tag])).collect();
    let mut mesh = Mesh { space, nodes, cells, boundaries: BTreeMap::new() };
    if space == Space::Plane {
        turn_counter_clockwise(&mut mesh);
    }
    Ok(mesh)
}

/// Gmsh turns quadrilaterals with their surface, which may look away; Q4 is counter-clockwise.
fn turn_counter_clockwise(mesh: &mut Mesh) {
    for cell in mesh.cells.chunks_exact_mut(4) {
        let [a, b, c, d]: [Vec3; 4] = std::array::from_fn(|k| mesh.nodes[cell[k]]);
        if (c - a).cross(&(d - b)).z < 0.0 {
            cell.swap(1, 3);
        }
    }
}

fn add_boundaries(raw: &RawMesh, mesh: &mut Mesh) -> std::result::Result<(), String> {
    let dimension = mesh.space.dim() as i32 - 1;
    let index = used_nodes(&raw.elements[&(dimension + 1)]);
    let facets = mesh.facets_by_nodes();
    let mut boundaries: BTreeMap<String, Vec<Facet>> = BTreeMap::new();
    for element in raw.elements.get(&dimension).into_iter().flatten() {
        let Some(groups) = raw.groups.get(&element.entity) else { continue };
        let key = element.nodes.iter().map(|tag| index.get(tag).copied()).collect::<Option<Vec<usize>>>();
        let facet = key.and_then(|mut key| {
            key.sort_unstable();
            facets.get(&key)
        });
        for group in groups {
            let name = raw.names.get(&(dimension, *group)).cloned().unwrap_or_else(|| group.to_string());
            let Some(facet) = facet else {
                return Err(format!(
                    "element {} of physical group '{name}' is no side of a cell; is the mesh conforming?",
                    element.tag
                ));
            };
            // An inner curve or surface borders two cells: the first one stands for it.
            boundaries.entry(name).or_default().push(facet[0]);
        }
    }
    mesh.boundaries = boundaries;
    Ok(())
}
