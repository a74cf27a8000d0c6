//! VTU files hold what was solved, in a form that reads back.

use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::grid;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics::solve;
use seam_solver::space::{Space, Vec3};
use seam_solver::vtu::{continuum_vtu, network_vtu, write_solution};

/// All numbers of one data array.
fn array(text: &str, name: &str) -> Vec<f64> {
    let (_, rest) = text.split_once(&format!("Name=\"{name}\"")).unwrap();
    let (_, rest) = rest.split_once('>').unwrap();
    rest.split_once("</DataArray>").unwrap().0.split_whitespace().map(|w| w.parse().unwrap()).collect()
}

#[test]
fn a_stretched_body_reads_back() {
    let body = Continuum {
        name: "b".into(),
        mesh: grid(&[vec![0.0, 1.0, 3.0], vec![0.0, 0.5]]).unwrap(),
        elasticity: Elasticity { young_pa: 2.0, poisson: 0.0, density: 0.0 },
        hypothesis: Hypothesis::PlaneStress { thickness_m: 1.0 },
        formulation: Formulation::Plain,
    };
    let u: Vec<f64> = body.mesh.nodes.iter().flat_map(|x| [0.1 * x.x, 0.0]).collect();
    let text = continuum_vtu(&body, &u).unwrap();
    assert!(text.contains("NumberOfPoints=\"6\" NumberOfCells=\"2\""));
    assert_eq!(array(&text, "connectivity"), [0.0, 1.0, 4.0, 3.0, 1.0, 2.0, 5.0, 4.0]);
    assert_eq!(array(&text, "offsets"), [4.0, 8.0]);
    assert_eq!(array(&text, "types"), [9.0, 9.0]);
    let points = array(&text, "position_m");
    let displacement = array(&text, "displacement_m");
    for n in 0..6 {
        assert_eq!(points[3 * n..3 * n + 3], body.mesh.nodes[n].as_slice()[..]);
        assert_eq!(displacement[3 * n..3 * n + 3], [u[2 * n], u[2 * n + 1], 0.0]);
    }
    for stress in array(&text, "stress_Pa").chunks(6) {
        assert!((stress[0] - 0.2).abs() < 1e-15 && stress[1..].iter().all(|s| s.abs() < 1e-15));
    }
    assert!(array(&text, "von_mises_Pa").iter().all(|s| (s - 0.2).abs() < 1e-15));
}

#[test]
fn particles_are_vertices_and_bonds_lines() {
    let network = Network {
        space: Space::Plane,
        particles: Particles {
            position: vec![Vec3::zeros(), Vec3::x()],
            radius: vec![0.5, 0.25],
            mass: vec![1.0; 2],
            inertia: vec![1.0; 2],
        },
        bonds: Bonds {
            ends: vec![[0, 1]],
            radius: vec![0.125],
            stiffness: vec![BondStiffness::default()],
            weight: vec![0.5],
        },
        faces: Default::default(),
    };
    let text = network_vtu(&network, &[Vec3::zeros(), Vec3::y()], &[Vec3::z(), Vec3::zeros()]);
    assert_eq!(array(&text, "connectivity"), [0.0, 1.0, 0.0, 1.0]);
    assert_eq!(array(&text, "types"), [1.0, 1.0, 3.0]);
    assert_eq!(array(&text, "offsets"), [1.0, 2.0, 4.0]);
    assert_eq!(array(&text, "radius_m"), [0.5, 0.25]);
    assert_eq!(array(&text, "rotation_rad"), [0.0, 0.0, 1.0, 0.0, 0.0, 0.0]);
    assert_eq!(array(&text, "is_bond"), [0.0, 0.0, 1.0]);
    assert_eq!(array(&text, "cell_radius_m"), [0.5, 0.25, 0.125]);
    assert_eq!(array(&text, "weight"), [1.0, 1.0, 0.5]);
}

/// Two particles joined by a bond and a cell, held and pulled; each in its own file, whatever its name.
#[test]
fn a_solution_is_written_body_by_body() {
    let cell = Continuum {
        name: "a b".into(),
        mesh: grid(&[vec![0.0, 1.0], vec![0.0, 1.0]]).unwrap(),
        elasticity: Elasticity { young_pa: 2.0, poisson: 0.0, density: 0.0 },
        hypothesis: Hypothesis::PlaneStress { thickness_m: 1.0 },
        formulation: Formulation::Plain,
    };
    let network = Network {
        space: Space::Plane,
        particles: Particles {
            position: vec![Vec3::new(5.0, 0.0, 0.0), Vec3::new(6.0, 0.0, 0.0)],
            radius: vec![0.5; 2],
            mass: vec![1.0; 2],
            inertia: vec![1.0; 2],
        },
        bonds: Bonds {
            ends: vec![[0, 1]],
            radius: vec![0.1],
            stiffness: vec![BondStiffness { kn: 4.0, ks: 12.0, kb: 1.0, kt: 1.0 }],
            weight: vec![1.0],
        },
        faces: Default::default(),
    };
    let at = |part, point, component, value| PointValue { part, point, component, value };
    // The left edge held, the right one pulled by 0.2 N; a cantilever of one bond pulled and pushed up.
    let held = [0, 2].into_iter().flat_map(|node| [at(0, node, 0, 0.0), at(0, node, 1, 0.0)]);
    let model = Model {
        space: Space::Plane,
        parts: vec![Part::Continuum(cell), Part::Discrete { name: "a/b".into(), network }],
        ties: Vec::new(),
        supports: held.chain((0..3).map(|c| at(1, 0, c, 0.0))).collect(),
        loads: vec![at(0, 1, 0, 0.1), at(0, 3, 0, 0.1), at(1, 1, 0, 2.0), at(1, 1, 1, 3.0)],
    };
    let folder = tempfile::tempdir().unwrap();
    let paths = write_solution(folder.path(), &model, &solve(&model).unwrap()).unwrap();
    let names: Vec<&str> = paths.iter().map(|p| p.file_name().unwrap().to_str().unwrap()).collect();
    assert_eq!(names, ["a_b.vtu", "a_b-1.vtu"]);
    let texts: Vec<String> = paths.iter().map(|p| std::fs::read_to_string(p).unwrap()).collect();
    let near = |computed: Vec<f64>, exact: &[f64]| {
        assert_eq!(computed.len(), exact.len());
        // Direct solves of a dozen well-scaled unknowns.
        assert!(computed.iter().zip(exact).all(|(a, b)| (a - b).abs() < 1e-12), "{computed:?} {exact:?}");
    };
    // u = FL/EA = 0.1 m.
    near(array(&texts[0], "displacement_m"), &[0.0, 0.0, 0.0, 0.1, 0.0, 0.0, 0.0, 0.0, 0.0, 0.1, 0.0, 0.0]);
    // u = N/k_n; w = PL³/3EI and θ = PL²/2EI with EI = k_b L = 1, k_s = 12.
    near(array(&texts[1], "displacement_m"), &[0.0, 0.0, 0.0, 0.5, 1.0, 0.0]);
    near(array(&texts[1], "rotation_rad"), &[0.0, 0.0, 0.0, 0.0, 0.0, 1.5]);
}
