//! The notched beam: linear fields come out exactly on its sheared cells, and its flanks are free.

mod common;

use common::prescribe;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::energy_release::energy_release_rate;
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::notched_beam::{FLANKS, NotchedBeam, NotchedMesh, Through};
use seam_solver::fem::refined::Refinement;
use seam_solver::fracture_mechanics::{mode_one_displacement, plane_modulus};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics::solve;
use seam_solver::space::{Space, Vec3};
use std::collections::BTreeSet;

fn model(angle: f64, space: Space) -> Model {
    let beam = NotchedBeam { length: 4.4, depth: 1.0, notch_depth: 0.4, angle, reach: 1.5 };
    let by = Refinement { finest: 1e-3, growth: 1.6, coarsest: 0.3 };
    let z = if space == Space::Solid { vec![0.0, 0.2, 0.5] } else { vec![] };
    let mesh = beam.mesh(by, &Through { x: vec![-2.0, 2.0], y: vec![], z }).unwrap().mesh;
    let hypothesis = match space {
        Space::Plane => Hypothesis::PlaneStress { thickness_m: 0.5 },
        Space::Solid => Hypothesis::Solid,
    };
    let body = Continuum {
        name: "beam".to_owned(),
        mesh,
        elasticity: Elasticity { young_pa: 3.0, poisson: 0.3, density: 1.0 },
        hypothesis,
        formulation: Formulation::Plain,
    };
    Model { space, parts: vec![Part::Continuum(body)], ties: vec![], supports: vec![], loads: vec![] }
}

#[test]
fn the_patch_test_holds() {
    for (angle, space) in [(0.0, Space::Plane), (1.0, Space::Plane), (2.0, Space::Plane), (1.0, Space::Solid)]
    {
        let mut model = model(angle, space);
        let field = |x: &Vec3| {
            Vec3::new(0.1 + x.x + 0.4 * x.y - 0.2 * x.z, 0.3 * x.x - 0.7 * x.y, 0.2 * x.y + 0.5 * x.z)
        };
        let Part::Continuum(body) = &model.parts[0] else { unreachable!("it has elements") };
        let mesh = &body.mesh;
        let boundary: BTreeSet<usize> =
            mesh.boundaries.keys().flat_map(|n| mesh.boundary_nodes(n).unwrap()).collect();
        let nodes = mesh.nodes.clone();
        for &point in &boundary {
            let value = field(&nodes[point]);
            for component in 0..space.dim() {
                model.supports.push(PointValue { part: 0, point, component, value: value[component] });
            }
        }
        let solution = solve(&model).unwrap();
        for (n, x) in nodes.iter().enumerate() {
            let error = solution.displacement(&model, 0, n)
                - if space == Space::Plane { field(x).xy().push(0.0) } else { field(x) };
            // Cells of 1e-3 beside cells of 0.3: ten digits.
            assert!(error.norm() < 1e-10, "{angle} {space:?}: {error} at {x}");
        }
    }
}

/// Pulled at its ends, the two flanks part: each node of the slit stands twice.
#[test]
fn the_slit_opens() {
    let mut model = model(0.0, Space::Plane);
    prescribe(&mut model, |x| x.x.abs() > 2.199, |x| Vec3::new(1e-3 * x.x.signum(), 0.0, 0.0));
    let solution = solve(&model).unwrap();
    let Part::Continuum(body) = &model.parts[0] else { unreachable!("it has elements") };
    let mut mouth: Vec<f64> = body
        .mesh
        .boundary_nodes(FLANKS)
        .unwrap()
        .into_iter()
        .filter(|&n| body.mesh.nodes[n].y == 0.0)
        .map(|n| solution.displacement(&model, 0, n).x)
        .collect();
    mouth.sort_by(f64::total_cmp);
    let [left, right] = mouth[..] else { panic!("two nodes at the mouth: {mouth:?}") };
    assert!(left < -1e-4 && (left + right).abs() < 1e-12, "{mouth:?}");
}

/// The field of a crack with `K_I` prescribed around a block, its flanks free: the energy release rate.
fn released(cells: usize, inner: f64, hypothesis: Hypothesis) -> f64 {
    let beam = NotchedBeam { length: 2.0, depth: 2.0, notch_depth: 1.0, angle: 0.0, reach: 1.0 };
    let size = 1.0 / cells as f64;
    let by = Refinement { finest: size, growth: 1.0, coarsest: size };
    let NotchedMesh { mesh, tip } = beam.mesh(by, &Through::default()).unwrap();
    let elasticity = Elasticity { young_pa: 3.0, poisson: 0.3, density: 1.0 };
    let at = mesh.nodes[tip[0]];
    // Of the nodes that stand twice the right one belongs to a cell on the right.
    let mut right = vec![false; mesh.nodes.len()];
    for cell in 0..mesh.cell_count() {
        let centre: f64 = mesh.cell(cell).iter().map(|&n| mesh.nodes[n].x).sum();
        mesh.cell(cell).iter().for_each(|&n| right[n] |= centre > 0.0);
    }
    let body =
        Continuum { name: "block".into(), mesh, elasticity, hypothesis, formulation: Formulation::Plain };
    let (mesh, elasticity) = (body.mesh.clone(), body.elasticity);
    let mut model = Model {
        space: Space::Plane,
        parts: vec![Part::Continuum(body)],
        ties: vec![],
        supports: vec![],
        loads: vec![],
    };
    for name in ["left", "right", "bottom", "top"] {
        for point in mesh.boundary_nodes(name).unwrap() {
            // Ahead is up, across is to the left.
            let x = mesh.nodes[point] - at;
            let side = if right[point] { -1.0 } else { 1.0 };
            let across = side * x.x.abs();
            let polar = [x.norm(), f64::atan2(across, x.y)];
            let [ahead, across] = mode_one_displacement(1.0, &elasticity, hypothesis, polar);
            let value = |component, value| PointValue { part: 0, point, component, value };
            model.supports.extend([value(0, -across), value(1, ahead)]);
        }
    }
    let solution = solve(&model).unwrap();
    let Part::Continuum(body) = &model.parts[0] else { unreachable!("it has elements") };
    let weight = |x: Vec3| ((0.9 - (x - at).amax()) / (0.9 - inner)).clamp(0.0, 1.0);
    energy_release_rate(body, &solution.u, Vec3::y(), weight).unwrap()
}

/// `J = K²/E'`; the error of an energy is twice that of the singular field: order `2 · ½`.
#[test]
fn the_domain_integral_gives_the_energy_release_rate() {
    for hypothesis in
        [Hypothesis::PlaneStress { thickness_m: 0.5 }, Hypothesis::PlaneStrain { thickness_m: 2.0 }]
    {
        let elasticity = Elasticity { young_pa: 3.0, poisson: 0.3, density: 1.0 };
        let exact = 1.0 / plane_modulus(&elasticity, hypothesis);
        let error = |cells| released(cells, 0.4, hypothesis) / exact - 1.0;
        let errors = [8, 16, 32].map(error);
        assert!(errors[2].abs() < 0.015, "{errors:?}");
        for pair in errors.windows(2) {
            assert!(((pair[0] / pair[1]).log2() - 1.0).abs() < 0.1, "{errors:?}");
        }
        // Whatever the weight.
        let other = released(32, 0.1, hypothesis) / exact - 1.0;
        assert!((other - errors[2]).abs() < 0.002, "{other} {errors:?}");
    }
}

#[test]
fn a_domain_without_a_rim_is_refused() {
    let mut model = model(0.0, Space::Plane);
    let Part::Continuum(body) = &mut model.parts[0] else { unreachable!("it has elements") };
    let u = vec![0.0; body.dof_count()];
    let refused = |body: &Continuum, words: &str| {
        let error = energy_release_rate(body, &u, Vec3::y(), |_| 1.0).unwrap_err().to_string();
        assert!(error.contains(words), "{error}");
    };
    refused(body, "weight is 1 at every node");
    body.formulation = Formulation::Incompatible;
    refused(body, "plain elements");
}
