//! The sections of a Gmsh 4.1 file (Gmsh reference manual, §10.1.1 “MSH file format”).

use super::cursor::{Cursor, Encoding};
use crate::error::Result;
use crate::space::Vec3;
use std::collections::BTreeMap;

/// Dimension and tag of a geometric entity or physical group.
pub type Key = (i32, i32);

/// An element as the file has it.
#[derive(Debug, Clone, PartialEq)]
pub struct RawElement {
    /// Its tag.
    pub tag: u64,
    /// Tags of its nodes.
    pub nodes: Vec<u64>,
    /// The entity it lies on.
    pub entity: Key,
}

/// What Seam reads of a file.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct RawMesh {
    /// Names of physical groups.
    pub names: BTreeMap<Key, String>,
    /// Physical groups of each entity.
    pub groups: BTreeMap<Key, Vec<i32>>,
    /// Positions by node tag, in the file's unit of length.
    pub nodes: BTreeMap<u64, Vec3>,
    /// Lines, quadrilaterals and hexahedra, in the order of the file, by dimension.
    pub elements: BTreeMap<i32, Vec<RawElement>>,
}

/// Reads all sections; unknown ones are skipped.
pub fn read(file: &str, bytes: &[u8]) -> Result<RawMesh> {
    let mut cursor = Cursor::new(file, bytes);
    let mut mesh = RawMesh::default();
    if cursor.section()?.as_deref() != Some("MeshFormat") {
        return Err(cursor.fault("the file does not start with $MeshFormat; give a Gmsh .msh file"));
    }
    let encoding = read_format(&mut cursor)?;
    while let Some(name) = cursor.section()? {
        cursor.encoding = if name == "PhysicalNames" { Encoding::Ascii } else { encoding };
        let known = match name.as_str() {
            "PhysicalNames" => read_names(&mut cursor, &mut mesh).map(|()| true),
            "Entities" => read_entities(&mut cursor, &mut mesh).map(|()| true),
            "Nodes" => read_nodes(&mut cursor, &mut mesh).map(|()| true),
            "Elements" => read_elements(&mut cursor, &mut mesh).map(|()| true),
            _ => Ok(false),
        }?;
        cursor.end(&name, !known)?;
        cursor.encoding = Encoding::Ascii;
    }
    Ok(mesh)
}

/// `version file-type data-size`, then in binary the integer one to show the byte order.
fn read_format(cursor: &mut Cursor) -> Result<Encoding> {
    let line = cursor.line();
    let fields: Vec<&str> = line.split_whitespace().collect();
    let encoding = match fields[..] {
        ["4.1", "0", _] => Encoding::Ascii,
        ["4.1", "1", "8"] => {
            cursor.encoding = Encoding::Little;
            match cursor.int()?.to_le_bytes() {
                [1, 0, 0, 0] => Encoding::Little,
                [0, 0, 0, 1] => Encoding::Big,
                _ => {
                    return Err(
                        cursor.fault("the byte order mark is not the integer 1; is the file damaged?")
                    );
                }
            }
        }
        _ => {
            return Err(cursor.fault(format!(
                "format '{line}' is not supported; write version 4.1 with 8-byte sizes: gmsh -format msh41"
            )));
        }
    };
    cursor.end("MeshFormat", false)?;
    Ok(encoding)
}

/// `count`, then `dimension tag "name"` a line.
fn read_names(cursor: &mut Cursor, mesh: &mut RawMesh) -> Result<()> {
    for _ in 0..cursor.size()? {
        let key = (cursor.int()?, cursor.int()?);
        let name = cursor.line();
        let Some(name) = name.strip_prefix('"').and_then(|n| n.strip_suffix('"')) else {
            return Err(cursor.fault("a physical name must stand in double quotes"));
        };
        mesh.names.insert(key, name.to_owned());
    }
    Ok(())
}

/// Counts of points, curves, surfaces and volumes; then for each its tag, its position or bounding
/// box, its physical groups and (not for points) its bounding entities.
fn read_entities(cursor: &mut Cursor, mesh: &mut RawMesh) -> Result<()> {
    let counts = [cursor.size()?, cursor.size()?, cursor.size()?, cursor.size()?];
    for (dimension, count) in (0..).zip(counts) {
        for _ in 0..count {
            let tag = cursor.int()?;
            for _ in 0..if dimension == 0 { 3 } else { 6 } {
                cursor.double()?;
            }
            let mut groups = Vec::new();
            for _ in 0..cursor.size()? {
                groups.push(cursor.int()?);
            }
            mesh.groups.insert((dimension, tag), groups);
            if dimension > 0 {
                for _ in 0..cursor.size()? {
                    cursor.int()?;
                }
            }
        }
    }
    Ok(())
}

/// Blocks of node tags followed by as many positions, with parametric coordinates if so marked.
fn read_nodes(cursor: &mut Cursor, mesh: &mut RawMesh) -> Result<()> {
    let blocks = cursor.size()?;
    skip_totals(cursor)?;
    for _ in 0..blocks {
        let (dimension, _entity, parametric) = (cursor.int()?, cursor.int()?, cursor.int()?);
        let mut tags = Vec::new();
        for _ in 0..cursor.size()? {
            tags.push(cursor.size()?);
        }
        for tag in tags {
            let x = Vec3::new(cursor.double()?, cursor.double()?, cursor.double()?);
            for _ in 0..if parametric == 0 { 0 } else { dimension.clamp(0, 3) } {
                cursor.double()?;
            }
            if mesh.nodes.insert(tag, x).is_some() {
                return Err(cursor.fault(format!("node {tag} occurs twice; renumber the mesh")));
            }
        }
    }
    Ok(())
}

/// Blocks of elements of one type on one entity: `tag node…` each.
fn read_elements(cursor: &mut Cursor, mesh: &mut RawMesh) -> Result<()> {
    let blocks = cursor.size()?;
    skip_totals(cursor)?;
    for _ in 0..blocks {
        let (dimension, entity, kind) = (cursor.int()?, cursor.int()?, cursor.int()?);
        let (own_dimension, node_count) = shape_of(kind).map_err(|message| cursor.fault(message))?;
        if own_dimension != dimension {
            return Err(cursor.fault(format!(
                "elements of type {kind} stand on an entity of dimension {dimension}; is the file damaged?"
            )));
        }
        for _ in 0..cursor.size()? {
            let tag = cursor.size()?;
            let nodes = (0..node_count).map(|_| cursor.size()).collect::<Result<_>>()?;
            let element = RawElement { tag, nodes, entity: (dimension, entity) };
            mesh.elements.entry(dimension).or_default().push(element);
        }
    }
    Ok(())
}

/// Total, smallest and largest tag: what the blocks say themselves.
fn skip_totals(cursor: &mut Cursor) -> Result<()> {
    for _ in 0..3 {
        cursor.size()?;
    }
    Ok(())
}

/// Dimension and node count of a Gmsh element type that Seam can use.
fn shape_of(kind: i32) -> std::result::Result<(i32, usize), String> {
    let name = match kind {
        1 => return Ok((1, 2)),
        3 => return Ok((2, 4)),
        5 => return Ok((3, 8)),
        15 => return Ok((0, 1)),
        2 => "3-node triangle",
        4 => "4-node tetrahedron",
        6 => "6-node prism",
        7 => "5-node pyramid",
        8 => "3-node line",
        9 => "6-node triangle",
        10 => "9-node quadrilateral",
        11 => "10-node tetrahedron",
        12 => "27-node hexahedron",
        16 => "8-node quadrilateral",
        17 => "20-node hexahedron",
        _ => "neither a line, a 4-node quadrilateral nor an 8-node hexahedron",
    };
    Err(format!(
        "element type {kind} ({name}) is not supported; use 4-node quadrilaterals or 8-node hexahedra of first order (recombine the mesh)"
    ))
}
