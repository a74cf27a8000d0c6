//! Plain elements against CalculiX's fully integrated ones, node by node on the same bent mesh.

use seam_references::{Dataset, find};
use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::structured::{even, grid};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::Vec3;

/// CalculiX prints seven digits, which is up to 5e-7 of a displacement; the rest is rounding of the solves.
const TOLERANCE: f64 = 1e-6;

/// The three columns `<prefix>x`, `<prefix>y`, `<prefix>z`, the last one zero in the plane.
fn vectors(data: &Dataset, prefix: &str, unit: &str, dim: usize) -> Vec<Vec3> {
    let columns: Vec<&[f64]> =
        ["x", "y", "z"][..dim].iter().map(|a| data.column(&format!("{prefix}{a}"), unit).unwrap()).collect();
    (0..data.rows()).map(|k| Vec3::from_fn(|i, _| columns.get(i).map_or(0.0, |c| c[k]))).collect()
}

/// Seam's answer to the cantilever of a reference: its bent mesh, its forces, held at x = 0.
fn solve(data: &Dataset, hypothesis: Hypothesis, divisions: &[usize], formulation: Formulation) -> Vec<Vec3> {
    let dim = divisions.len();
    let axes: Vec<Vec<f64>> = divisions.iter().map(|&n| even(0.0, 1.0, n).unwrap()).collect();
    let mut mesh = grid(&axes).unwrap();
    mesh.nodes = vectors(data, "", "m", dim);
    let held = mesh.boundary_nodes("left").unwrap();
    let elasticity = Elasticity { young_pa: 70e9, poisson: 0.3, density: 0.0 };
    let space = mesh.space;
    let body = Continuum { name: "cantilever".to_owned(), mesh, elasticity, hypothesis, formulation };
    let value = |point, component, value| PointValue { part: 0, point, component, value };
    let forces = vectors(data, "f", "N", dim);
    let model = Model {
        space,
        parts: vec![Part::Continuum(body)],
        ties: Vec::new(),
        supports: held.iter().flat_map(|&k| (0..dim).map(move |i| value(k, i, 0.0))).collect(),
        loads: (0..forces.len())
            .flat_map(|k| (0..dim).map(move |i| (k, i)))
            .map(|(k, i)| value(k, i, forces[k][i]))
            .collect(),
    };
    let solution = statics::solve(&model).unwrap();
    (0..forces.len()).map(|k| solution.displacement(&model, 0, k)).collect()
}

/// Largest difference of a component, relative to the largest component of the reference.
fn difference(u: &[Vec3], reference: &[Vec3]) -> f64 {
    let largest = reference.iter().map(Vec3::amax).fold(0.0, f64::max);
    u.iter().zip(reference).map(|(a, b)| (a - b).amax()).fold(0.0, f64::max) / largest
}

fn agree(case: &str, hypothesis: Hypothesis, divisions: &[usize]) {
    let data = find(case, "calculix").unwrap().open().unwrap();
    let reference = vectors(&data, "u", "m", divisions.len());
    let plain = difference(&solve(&data, hypothesis, divisions, Formulation::Plain), &reference);
    println!("{case}: largest difference {plain:.1e} of the largest displacement");
    assert!(plain <= TOLERANCE, "{case}: {plain:e}");
    // The mesh is coarse enough to tell formulations apart: agreement is no accident.
    let other = difference(&solve(&data, hypothesis, divisions, Formulation::Incompatible), &reference);
    assert!(other > 0.01, "{case}: {other:e}");
}

#[test]
fn plane_strain_q4_agrees_with_cpe4() {
    agree("calculix-cpe4", Hypothesis::PlaneStrain { thickness_m: 1.0 }, &[20, 5]);
}

#[test]
fn h8_agrees_with_c3d8() {
    agree("calculix-c3d8", Hypothesis::Solid, &[10, 4, 3]);
}
