//! Fields for ParaView: VTK unstructured grids as XML text (VTK file formats, 4.2/4.3).

use crate::dem::network::Network;
use crate::error::Result;
use crate::fem::continuum::Continuum;
use crate::fem::stress::nodal_stress;
use crate::files::write_atomically;
use crate::model::{Model, Part};
use crate::solve::statics::Solution;
use crate::space::{Space, Vec3};
use std::fmt::Write;
use std::path::{Path, PathBuf};

/// VTK cell types.
const VERTEX: u8 = 1;
const LINE: u8 = 3;
const QUAD: u8 = 9;
const HEXAHEDRON: u8 = 12;

/// Values at points or cells: name, components, `components` numbers each.
struct Field {
    name: &'static str,
    components: usize,
    values: Vec<f64>,
}

impl Field {
    fn scalars(name: &'static str, values: impl IntoIterator<Item = f64>) -> Self {
        Field { name, components: 1, values: values.into_iter().collect() }
    }

    fn vectors(name: &'static str, values: &[Vec3]) -> Self {
        Field { name, components: 3, values: values.iter().flat_map(|v| v.iter().copied()).collect() }
    }
}

/// Points, cells and the fields on them.
struct Grid {
    points: Vec<Vec3>,
    cells: Vec<(u8, Vec<usize>)>,
    point_fields: Vec<Field>,
    cell_fields: Vec<Field>,
}

/// Writes one file `<body>.vtu` per part into `folder` (with its index where two names look alike) and
/// returns the paths.
///
/// # Errors
/// A file that cannot be written; an inverted element.
pub fn write_solution(folder: &Path, model: &Model, solution: &Solution) -> Result<Vec<PathBuf>> {
    let mut paths = Vec::new();
    for (index, part) in model.parts.iter().enumerate() {
        let points = 0..part.positions().len();
        let text = match part {
            Part::Continuum(continuum) => {
                let first = solution.numbering.offset(index);
                continuum_vtu(continuum, &solution.u[first..first + continuum.dof_count()])?
            }
            Part::Discrete { network, .. } => {
                let u: Vec<Vec3> = points.clone().map(|p| solution.displacement(model, index, p)).collect();
                let theta: Vec<Vec3> = points.map(|p| solution.rotation(model, index, p)).collect();
                network_vtu(network, &u, &theta)
            }
        };
        let mut path = folder.join(format!("{}.vtu", file_stem(part.name())));
        if paths.contains(&path) {
            path.set_file_name(format!("{}-{index}.vtu", file_stem(part.name())));
        }
        write_atomically(&path, text.as_bytes())?;
        paths.push(path);
    }
    Ok(paths)
}

/// A body of finite elements: displacement (m), nodal averages of stress and von Mises stress (Pa).
///
/// # Errors
/// An inverted element.
pub fn continuum_vtu(continuum: &Continuum, displacement: &[f64]) -> Result<String> {
    let mesh = &continuum.mesh;
    let dim = mesh.space.dim();
    let kind = if mesh.space == Space::Plane { QUAD } else { HEXAHEDRON };
    let stress = nodal_stress(continuum, displacement)?;
    let u: Vec<Vec3> = displacement
        .chunks_exact(dim)
        .map(|q| Vec3::from_fn(|i, _| q.get(i).copied().unwrap_or_default()))
        .collect();
    let tensors = stress.iter().flat_map(|s| s.voigt).collect();
    let grid = Grid {
        points: mesh.nodes.clone(),
        cells: (0..mesh.cell_count()).map(|c| (kind, mesh.cell(c).to_vec())).collect(),
        point_fields: vec![
            Field::vectors("displacement_m", &u),
            Field { name: "stress_Pa", components: 6, values: tensors },
            Field::scalars("von_mises_Pa", stress.iter().map(|s| s.von_mises())),
        ],
        cell_fields: Vec::new(),
    };
    Ok(grid.xml())
}

/// A bonded network: particles as vertices with radius (m), displacement (m) and rotation (rad);
/// bonds as lines with radius (m) and weight. Cells count the particles first, then the bonds;
/// `is_bond` tells them apart.
pub fn network_vtu(network: &Network, displacement: &[Vec3], rotation: &[Vec3]) -> String {
    let (particles, bonds) = (&network.particles, &network.bonds);
    let particle_cells = (0..particles.len()).map(|p| (VERTEX, vec![p]));
    let bond_cells = bonds.ends.iter().map(|ends| (LINE, ends.to_vec()));
    let both = |name, particle: Vec<f64>, bond: &[f64]| Field::scalars(name, [&particle[..], bond].concat());
    let grid = Grid {
        points: particles.position.clone(),
        cells: particle_cells.chain(bond_cells).collect(),
        point_fields: vec![
            Field::scalars("radius_m", particles.radius.iter().copied()),
            Field::vectors("displacement_m", displacement),
            Field::vectors("rotation_rad", rotation),
        ],
        cell_fields: vec![
            both("is_bond", vec![0.0; particles.len()], &vec![1.0; bonds.len()]),
            both("cell_radius_m", particles.radius.clone(), &bonds.radius),
            both("weight", vec![1.0; particles.len()], &bonds.weight),
        ],
    };
    grid.xml()
}

impl Grid {
    fn xml(&self) -> String {
        let mut text =
            String::from("<?xml version=\"1.0\"?>\n<VTKFile type=\"UnstructuredGrid\" version=\"0.1\">\n");
        let (points, cells) = (self.points.len(), self.cells.len());
        line(
            &mut text,
            format_args!("<UnstructuredGrid><Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">"),
        );
        text.push_str("<Points>\n");
        numbers(&mut text, &Field::vectors("position_m", &self.points));
        text.push_str("</Points>\n<Cells>\n");
        integers(&mut text, "Int64", "connectivity", self.cells.iter().flat_map(|c| &c.1));
        let ends = self.cells.iter().scan(0, |end, (_, nodes)| {
            *end += nodes.len();
            Some(*end)
        });
        integers(&mut text, "Int64", "offsets", ends);
        integers(&mut text, "UInt8", "types", self.cells.iter().map(|c| c.0));
        text.push_str("</Cells>\n<PointData>\n");
        self.point_fields.iter().for_each(|field| numbers(&mut text, field));
        text.push_str("</PointData>\n<CellData>\n");
        self.cell_fields.iter().for_each(|field| numbers(&mut text, field));
        text.push_str("</CellData>\n</Piece></UnstructuredGrid>\n</VTKFile>\n");
        text
    }
}

fn numbers(text: &mut String, field: &Field) {
    let Field { name, components, values } = field;
    line(
        text,
        format_args!(
            "<DataArray type=\"Float64\" Name=\"{name}\" NumberOfComponents=\"{components}\" format=\"ascii\">"
        ),
    );
    for row in values.chunks(*components) {
        // Shortest text that reads back to the same bits.
        line(text, format_args!("{}", row.iter().map(|v| format!("{v:e}")).collect::<Vec<_>>().join(" ")));
    }
    text.push_str("</DataArray>\n");
}

fn integers(
    text: &mut String,
    kind: &str,
    name: &str,
    values: impl IntoIterator<Item = impl std::fmt::Display>,
) {
    line(text, format_args!("<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">"));
    for value in values {
        line(text, format_args!("{value}"));
    }
    text.push_str("</DataArray>\n");
}

fn line(text: &mut String, content: std::fmt::Arguments) {
    writeln!(text, "{content}").expect("a String takes every write");
}

/// A body's name with everything but letters, digits, `-` and `_` replaced.
fn file_stem(name: &str) -> String {
    name.chars().map(|c| if c.is_alphanumeric() || c == '-' || c == '_' { c } else { '_' }).collect()
}
