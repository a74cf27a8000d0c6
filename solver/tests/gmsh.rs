//! Gmsh files: what Gmsh 4.15.2 wrote (`data/generate.py`), and whatever else comes along.

use proptest::prelude::*;
use seam_solver::error::Error;
use seam_solver::fem::gmsh::{parse_gmsh, read_gmsh};
use seam_solver::fem::mesh::Mesh;
use seam_solver::fem::quadrature::tensor_gauss;
use seam_solver::space::Space;
use std::path::{Path, PathBuf};

const PLATE: &str = include_str!("data/plate_ascii.msh");
const PLATE_BINARY: &[u8] = include_bytes!("data/plate_binary.msh");

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data").join(name)
}

fn measure(mesh: &Mesh) -> f64 {
    let rule = tensor_gauss(mesh.space.dim(), 2);
    let cell = |c| rule.iter().map(|&(xi, w)| w * mesh.sample(c, xi).determinant).sum::<f64>();
    (0..mesh.cell_count()).map(cell).sum()
}

/// Text has 16 significant digits, binary has all: alike to one unit in the 16th.
fn assert_alike(text: &Mesh, binary: &Mesh) {
    assert_eq!(text.cells, binary.cells);
    assert_eq!(text.boundaries, binary.boundaries);
    assert_eq!(text.nodes.len(), binary.nodes.len());
    for (a, b) in text.nodes.iter().zip(&binary.nodes) {
        assert!((a - b).amax() <= 1e-15 * a.amax(), "{a} {b}");
    }
}

fn names(mesh: &Mesh) -> Vec<(&str, usize)> {
    mesh.boundaries.iter().map(|(name, facets)| (name.as_str(), facets.len())).collect()
}

#[test]
fn text_and_binary_give_the_same_plate() {
    let mesh = read_gmsh(&data("plate_ascii.msh")).unwrap();
    assert_alike(&mesh, &read_gmsh(&data("plate_binary.msh")).unwrap());
    assert_eq!(mesh.space, Space::Plane);
    // 5 × 4 nodes: the lone point of the file is left out.
    assert_eq!((mesh.cell_count(), mesh.nodes.len()), (12, 20));
    assert!((measure(&mesh) - 2.0).abs() < 1e-14);
    assert_eq!(names(&mesh), [("flat sides", 8), ("left", 3), ("right", 3)]);
    for node in mesh.boundary_nodes("left").unwrap() {
        assert_eq!(mesh.nodes[node].x, 0.0);
    }
    for facet in &mesh.boundaries["right"] {
        assert!((mesh.facet_point(facet, [0.0, 0.0]).normal.x - 1.0).abs() < 1e-14);
    }
}

#[test]
fn text_and_binary_give_the_same_block() {
    let mesh = read_gmsh(&data("block_ascii.msh")).unwrap();
    assert_alike(&mesh, &read_gmsh(&data("block_binary.msh")).unwrap());
    assert_eq!(mesh.space, Space::Solid);
    assert_eq!((mesh.cell_count(), mesh.nodes.len()), (24, 60));
    assert!((measure(&mesh) - 3.0).abs() < 1e-13);
    assert_eq!(names(&mesh), [("back", 12), ("front", 12)]);
    for facet in &mesh.boundaries["back"] {
        assert!((mesh.facet_point(facet, [0.0, 0.0]).normal.z + 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_clockwise_surface_is_turned() {
    let mesh = parse_gmsh(PLATE.as_bytes(), "plate.msh").unwrap();
    let mirrored: String = {
        // Mirror at x: the same cells seen from behind.
        let (head, rest) = PLATE.split_once("$Nodes\n").unwrap();
        let (nodes, tail) = rest.split_once("$EndNodes").unwrap();
        let flip = |line: &str| match line.split_whitespace().collect::<Vec<_>>()[..] {
            [x, y, z] => format!("{} {y} {z}", -x.parse::<f64>().unwrap()),
            _ => line.to_owned(),
        };
        let nodes: Vec<String> = nodes.lines().map(flip).collect();
        format!("{head}$Nodes\n{}\n$EndNodes{tail}", nodes.join("\n"))
    };
    let turned = parse_gmsh(mirrored.as_bytes(), "mirrored.msh").unwrap();
    assert_ne!(mesh.nodes, turned.nodes);
    assert!((measure(&turned) - 2.0).abs() < 1e-14);
}

/// The message, and the line if there is one.
fn fault(text: &str) -> (String, Option<usize>) {
    match parse_gmsh(text.as_bytes(), "m.msh") {
        Err(Error::File { message, line, .. }) => (message, line),
        other => panic!("expected a file error, got {other:?}"),
    }
}

#[test]
fn faults_are_named_with_their_place() {
    assert!(fault("hello").0.contains("expected the '$'"));
    assert!(fault("").0.contains("$MeshFormat"));
    assert!(fault("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n").0.contains("gmsh -format msh41"));
    assert!(fault("$MeshFormat\n4.1 0 8\n$EndMeshFormat\n").0.contains("no quadrilaterals"));
    assert!(fault(&PLATE[..PLATE.len() - 30]).0.contains("expected"));
    let line_of = |needle: &str, text: &str| text.lines().position(|l| l == needle).map(|n| n + 1);
    let marred = PLATE.replacen("2 1 0\n", "2 one 0\n", 1);
    let (message, line) = fault(&marred);
    assert!(message.contains("'one'"), "{message}");
    assert_eq!(line, line_of("2 one 0", &marred));
    assert!(fault(&PLATE.replacen("2 1 0\n", "2 nan 0\n", 1)).0.contains("no coordinate"));
    assert!(fault(&PLATE.replacen("2 1 0\n", "2 1 0.5\n", 1)).0.contains("z = 0.5"));
    let triangles = read_gmsh(&data("triangles_ascii.msh")).unwrap_err().to_string();
    assert!(
        triangles.contains("3-node triangle") && triangles.contains("triangles_ascii.msh:"),
        "{triangles}"
    );
    let binary = read_gmsh(&data("triangles_binary.msh")).unwrap_err().to_string();
    assert!(binary.contains("3-node triangle"), "{binary}");
    assert!(read_gmsh(Path::new("nowhere.msh")).unwrap_err().to_string().contains("nowhere.msh"));
    // The last element points at a node that is not there.
    let (head, last) = PLATE.trim_end().trim_end_matches("$EndElements").trim_end().rsplit_once(' ').unwrap();
    let foreign = format!("{head} {last}999\n$EndElements\n");
    assert!(fault(&foreign).0.contains("which does not exist"));
}

proptest! {
    #[test]
    fn arbitrary_bytes_never_panic(bytes in prop::collection::vec(any::<u8>(), 0..400)) {
        let _ = parse_gmsh(&bytes, "noise.msh");
        let headed = [&b"$MeshFormat\n4.1 1 8\n\x01\0\0\0\n$EndMeshFormat\n$Nodes\n"[..], &bytes].concat();
        let _ = parse_gmsh(&headed, "noise.msh");
    }

    #[test]
    fn damaged_files_never_panic(at in 0..PLATE_BINARY.len(), byte in any::<u8>(), length in 0..PLATE.len()) {
        let mut binary = PLATE_BINARY.to_vec();
        binary[at] = byte;
        if let Ok(mesh) = parse_gmsh(&binary, "damaged.msh") {
            prop_assert!(mesh.cells.iter().all(|&n| n < mesh.nodes.len()));
        }
        let mut text = PLATE.as_bytes()[..length].to_vec();
        let _ = parse_gmsh(&text, "cut.msh");
        text.extend([byte, b' ', byte]);
        let _ = parse_gmsh(&text, "cut.msh");
    }
}
