//! The notched beam: linear fields come out exactly on its sheared cells, and its flanks are free.

mod common;

use common::prescribe;
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::notched_beam::{FLANKS, NotchedBeam, Through};
use seam_solver::fem::refined::Refinement;
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
