//! Order of convergence on manufactured solutions, and two classical benchmarks.

use seam_solver::fem::continuum::Continuum;
use seam_solver::fem::elasticity::{Elasticity, Hypothesis};
use seam_solver::fem::formulation::Formulation;
use seam_solver::fem::loads::{NodalLoads, body_loads, facet_loads};
use seam_solver::fem::manufactured::Manufactured;
use seam_solver::fem::mesh::Mesh;
use seam_solver::fem::norms::error_norms;
use seam_solver::fem::stress::nodal_stress;
use seam_solver::fem::structured::{BOX_SIDES, elliptic_sector, even, mapped, quadrilateral};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics::solve;
use seam_solver::space::{Space, Vec3};
use std::f64::consts::FRAC_PI_2;

const PLATE: Hypothesis = Hypothesis::PlaneStress { thickness_m: 0.5 };
const SLICE: Hypothesis = Hypothesis::PlaneStrain { thickness_m: 2.0 };

/// Displacements of a body under nodal loads, held at `(node, component, value)`.
fn displacements(body: &Continuum, held: Vec<(usize, usize, f64)>, loads: NodalLoads) -> Vec<f64> {
    let dim = body.mesh.space.dim();
    let at = |point, component, value| PointValue { part: 0, point, component, value };
    let model = Model {
        space: body.mesh.space,
        parts: vec![Part::Continuum(body.clone())],
        ties: Vec::new(),
        supports: held.into_iter().map(|(node, component, value)| at(node, component, value)).collect(),
        loads: loads.into_iter().map(|(dof, force)| at(dof / dim, dof % dim, force)).collect(),
    };
    solve(&model).unwrap().u
}

/// The unit square or cube, bent and sheared smoothly, `n` cells a side.
fn bent(space: Space, n: usize) -> Mesh {
    let axes = vec![even(0.0, 1.0, n).unwrap(); space.dim()];
    let bend =
        |x: Vec3| x + Vec3::new(0.2 * x.y * x.y + 0.1 * x.z, 0.15 * (2.0 * x.x).sin(), 0.1 * x.x * x.z);
    mapped(&axes, BOX_SIDES, |x| match space {
        Space::Plane => Vec3::new(bend(x).x, bend(x).y, 0.0),
        Space::Solid => bend(x),
    })
    .unwrap()
}

/// Slope of the least-squares line through `(ln h, ln e)`.
fn fitted_order(levels: &[usize], errors: &[f64]) -> f64 {
    let points: Vec<(f64, f64)> =
        levels.iter().zip(errors).map(|(&n, e)| (-(n as f64).ln(), e.ln())).collect();
    let count = points.len() as f64;
    let mean = points.iter().fold((0.0, 0.0), |m, p| (m.0 + p.0 / count, m.1 + p.1 / count));
    let covariance: f64 = points.iter().map(|p| (p.0 - mean.0) * (p.1 - mean.1)).sum();
    covariance / points.iter().map(|p| (p.0 - mean.0).powi(2)).sum::<f64>()
}

/// Fitted orders in L2, H1 and energy on smoothly bent meshes, displacement prescribed all round.
fn orders(hypothesis: Hypothesis, formulation: Formulation, levels: &[usize]) -> [f64; 3] {
    let elasticity = Elasticity { young_pa: 3.0, poisson: 0.3, density: 0.0 };
    let field =
        Manufactured { elasticity, hypothesis, amplitude: Vec3::new(1.0, -0.7, 0.4), wave_number: 1.5 };
    let mut errors = [(); 3].map(|()| Vec::new());
    for &n in levels {
        let mesh = bent(hypothesis.space(), n);
        let body = Continuum { name: "b".into(), mesh, elasticity, hypothesis, formulation };
        let mut held = Vec::new();
        for name in body.mesh.boundaries.keys() {
            for node in body.mesh.boundary_nodes(name).unwrap() {
                let u = field.displacement(body.mesh.nodes[node]);
                held.extend((0..body.mesh.space.dim()).map(|i| (node, i, u[i])));
            }
        }
        held.sort_by_key(|h| (h.0, h.1));
        held.dedup_by_key(|h| (h.0, h.1));
        let u = displacements(&body, held, body_loads(&body, |x| field.body_force(x)).unwrap());
        let (error, size) = error_norms(&body, &u, |x| (field.displacement(x), field.gradient(x))).unwrap();
        for (list, e) in
            errors.iter_mut().zip([error.l2 / size.l2, error.h1 / size.h1, error.energy / size.energy])
        {
            list.push(e);
        }
    }
    errors.map(|e| fitted_order(levels, &e))
}

/// Multilinear elements: h² in L2, h in H1 and energy (Hughes 2000, §4.1).
fn assert_orders(hypothesis: Hypothesis, formulation: Formulation, levels: &[usize]) {
    let fitted = orders(hypothesis, formulation, levels);
    println!("{hypothesis:?} {formulation:?}: L2, H1, energy orders {fitted:.3?}");
    for (order, theory) in fitted.into_iter().zip([2.0, 1.0, 1.0]) {
        assert!((order - theory).abs() < 0.1, "{hypothesis:?} {formulation:?}: {fitted:?}");
    }
}

#[test]
fn quadrilaterals_converge_at_their_orders() {
    use Formulation::{BBar, Incompatible, Plain};
    for (hypothesis, formulation) in
        [(PLATE, Plain), (PLATE, Incompatible), (SLICE, Incompatible), (SLICE, BBar)]
    {
        assert_orders(hypothesis, formulation, &[8, 16, 32]);
    }
}

#[test]
fn hexahedra_converge_at_their_orders() {
    for formulation in [Formulation::Plain, Formulation::Incompatible, Formulation::BBar] {
        assert_orders(Hypothesis::Solid, formulation, &[4, 6, 9]);
    }
}

/// Cook's membrane (Cook 1974): E = 1, ν = 1/3, t = 1, shear of resultant 1 on the right; u_y in the
/// middle of the right side, (48, 52).
fn cook(formulation: Formulation, n: usize) -> f64 {
    let corners = [[0.0, 0.0], [48.0, 44.0], [48.0, 60.0], [0.0, 44.0]].map(|[x, y]| Vec3::new(x, y, 0.0));
    let lines = even(0.0, 1.0, n).unwrap();
    let body = Continuum {
        name: "membrane".into(),
        mesh: quadrilateral(corners, &lines, &lines).unwrap(),
        elasticity: Elasticity { young_pa: 1.0, poisson: 1.0 / 3.0, density: 0.0 },
        hypothesis: Hypothesis::PlaneStress { thickness_m: 1.0 },
        formulation,
    };
    let held = body.mesh.boundary_nodes("left").unwrap();
    let held = held.into_iter().flat_map(|node| [(node, 0, 0.0), (node, 1, 0.0)]).collect();
    let shear = facet_loads(&body, &body.mesh.boundaries["right"], |_, _| Vec3::y() / 16.0).unwrap();
    let middle = Vec3::new(48.0, 52.0, 0.0);
    let node = body.mesh.nodes.iter().position(|x| (x - middle).norm() < 1e-9).unwrap();
    displacements(&body, held, shear)[2 * node + 1]
}

#[test]
fn cooks_membrane_comes_out() {
    // Published for plain Q4, to the digits given.
    for (n, published) in [(16, 23.430), (32, 23.818), (64, 23.925)] {
        let computed = cook(Formulation::Plain, n);
        assert!((computed - published).abs() < 6e-4, "{n}: {computed}");
    }
    // The converged value is 23.967. The corner singularity holds the rate down for every
    // formulation; incompatible modes still come nearer at half the divisions.
    let computed = cook(Formulation::Incompatible, 32);
    println!("Cook, incompatible, 32: {computed:.3}");
    assert!(computed > 23.925 && computed < 23.967, "{computed}");
}

/// NAFEMS LE1 (1990): elliptic membrane, E = 210 GPa, ν = 0.3, t = 0.1 m, outward pressure 10 MPa on
/// the outer edge; σ_yy at D (2, 0) is 92.7 MPa.
#[test]
fn nafems_le1_comes_out() {
    let stress = |n: usize| {
        let (s, t) = (even(0.0, 1.0, n).unwrap(), even(0.0, FRAC_PI_2, 2 * n).unwrap());
        let body = Continuum {
            name: "membrane".into(),
            mesh: elliptic_sector([2.0, 1.0], [3.25, 2.75], &s, &t).unwrap(),
            elasticity: Elasticity { young_pa: 210e9, poisson: 0.3, density: 0.0 },
            hypothesis: Hypothesis::PlaneStress { thickness_m: 0.1 },
            formulation: Formulation::Incompatible,
        };
        let on_y0 = body.mesh.boundary_nodes("start").unwrap().into_iter().map(|node| (node, 1, 0.0));
        let on_x0 = body.mesh.boundary_nodes("end").unwrap().into_iter().map(|node| (node, 0, 0.0));
        let pull = facet_loads(&body, &body.mesh.boundaries["outer"], |_, normal| normal * 10e6).unwrap();
        let u = displacements(&body, on_y0.chain(on_x0).collect(), pull);
        let d = body.mesh.nodes.iter().position(|x| (x - Vec3::new(2.0, 0.0, 0.0)).norm() < 1e-12).unwrap();
        nodal_stress(&body, &u).unwrap()[d].voigt[1] / 1e6
    };
    let (coarse, fine) = (stress(64), stress(128));
    println!("LE1: {coarse:.3} and {fine:.3} MPa");
    // Measured: the error here is of first order, as the re-entrant corners of the polygon that stands
    // for the ellipse would have it. Extrapolated, it meets the target to the three digits given.
    assert!((fine - 92.7).abs() < 0.3 && (fine - 92.7).abs() < (coarse - 92.7).abs(), "{coarse} {fine}");
    assert!((2.0 * fine - coarse - 92.7).abs() < 0.05, "{coarse} {fine}");
}
