//! What statics must get right besides numbers: floating bodies, dependent rows, mechanisms, bad input.

mod common;

use common::{Sandwich, continuum, prescribe};
use seam_solver::coupling::{Method, Multipliers, Tie};
use seam_solver::error::Error;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::kkt::{Kkt, Layout};
use seam_solver::solve::sparse::{SymmetricMatrix, Triplets};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;

fn held() -> Model {
    let mut model = Sandwich::plane(4, 4, 4, Method::Pointwise).model();
    prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
    model.loads.push(PointValue { part: 2, point: 0, component: 1, value: -10.0 });
    model
}

/// Cantilever of three tied meshes against one mesh: matching pointwise ties are shared nodes.
#[test]
fn three_tied_meshes_are_one_mesh() {
    let at = |x: f64, upper: f64| Vec3::new(x, upper, 0.0);
    let body = |name: &str, a: f64, b: f64, n: usize| {
        Part::Continuum(continuum(name, Space::Plane, at(a, 0.0), at(b, 1.0), [n, 4, 0]))
    };
    let tie = |k: usize| Tie {
        name: format!("t{k}"),
        first: (k, "right".to_owned()),
        second: (k + 1, "left".to_owned()),
        method: Method::Pointwise,
        multipliers: Multipliers::Auto,
        rotations: false,
    };
    let solve = |parts: Vec<Part>| {
        let ties = (0..parts.len() - 1).map(tie).collect();
        let mut model = Model { space: Space::Plane, parts, ties, supports: Vec::new(), loads: Vec::new() };
        prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
        let last = model.parts.len() - 1;
        let tip = model.parts[last].positions().len() - 1;
        model.loads.push(PointValue { part: last, point: tip, component: 1, value: 1.0 });
        let solution = statics::solve(&model).unwrap();
        (solution.displacement(&model, last, tip).y, solution.energy)
    };
    let (tied, tied_energy) =
        solve(vec![body("a", 0.0, 1.0, 4), body("b", 1.0, 2.0, 4), body("c", 2.0, 3.0, 4)]);
    let (one, energy) = solve(vec![body("whole", 0.0, 3.0, 12)]);
    // Refined to a backward error of 1e-16; the beam's condition number is about 1e4.
    assert!((tied / one - 1.0).abs() < 1e-11, "{tied} {one}");
    assert!((tied_energy / energy - 1.0).abs() < 1e-11);
}

#[test]
fn reactions_balance_the_load() {
    let model = held();
    let solution = statics::solve(&model).unwrap();
    assert!(solution.residual < 1e-13, "{}", solution.residual);
    let mut sum = Vec3::zeros();
    for support in &model.supports {
        let i = solution.numbering.unknown(support.part, support.point, support.component);
        sum[support.component] += solution.reactions[i];
    }
    // Reactions are differences of forces a hundred times larger, at rounding.
    assert!((sum - Vec3::new(0.0, 10.0, 0.0)).amax() < 1e-9, "{sum}");
}

#[test]
fn a_tie_made_twice_changes_nothing_and_is_named() {
    let once = statics::solve(&held()).unwrap();
    let mut model = held();
    model.ties.push(Tie { name: "again".to_owned(), ..model.ties[0].clone() });
    let twice = statics::solve(&model).unwrap();
    assert_eq!(twice.notes.len(), 2 * 5, "{:?}", twice.notes);
    assert!(twice.notes.iter().all(|n| n.starts_with("dropped tie 'again': particle")), "{:?}", twice.notes);
    let scale = once.u.iter().fold(0.0f64, |m, v| m.max(v.abs()));
    let change = once.u.iter().zip(&twice.u).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
    assert!(change < 1e-12 * scale);
}

#[test]
fn a_support_against_a_tie_is_refused() {
    let mut model = held();
    // A tied particle and the node it sits on are held apart.
    let corner = |part: usize| {
        let tied = |x: &Vec3| (x - Vec3::new(1.0, 0.0, 0.0)).norm() < 1e-9;
        model.parts[part].positions().iter().position(tied).unwrap()
    };
    let (node, particle) = (corner(0), corner(1));
    model.supports.push(PointValue { part: 0, point: node, component: 1, value: 1e-3 });
    model.supports.push(PointValue { part: 1, point: particle, component: 1, value: 2e-3 });
    let error = statics::solve(&model).unwrap_err();
    assert!(matches!(error, Error::Contradiction { .. }), "{error}");
    assert!(error.to_string().contains("u_y"), "{error}");
}

#[test]
fn mechanisms_are_named() {
    let mut model = held();
    model.supports.clear();
    let error = statics::solve(&model).unwrap_err().to_string();
    assert!(error.contains("mechanism") && error.contains("body 'left' is free to"), "{error}");

    // Held along y at both ends: it still slides along x.
    let mut model = held();
    prescribe(&mut model, |x| x.x > 3.0 - 1e-9, |_| Vec3::zeros());
    model.supports.retain(|s| s.component == 1);
    let error = statics::solve(&model).unwrap_err().to_string();
    assert!(error.contains("move along x") && !error.contains("along y"), "{error}");

    let mut model = held();
    model.ties.pop();
    let error = statics::solve(&model).unwrap_err().to_string();
    assert!(error.contains("'right'") && !error.contains("'left'"), "{error}");
}

#[test]
fn disconnected_particles_are_named() {
    let mut model = held();
    let Part::Discrete { network, .. } = &mut model.parts[1] else { unreachable!("the middle is discrete") };
    let lonely = 12;
    for (ends, weight) in network.bonds.ends.iter().zip(&mut network.bonds.weight) {
        if ends.contains(&lonely) {
            *weight = 0.0;
        }
    }
    let error = statics::solve(&model).unwrap_err();
    assert_eq!(error, Error::Disconnected { body: "middle".to_owned(), count: 1, first: vec![lonely] });
}

#[test]
fn bad_models_are_refused_with_the_place() {
    let refused = |change: &dyn Fn(&mut Model), words: &[&str]| {
        let mut model = held();
        change(&mut model);
        let error = statics::solve(&model).unwrap_err().to_string();
        words.iter().for_each(|w| assert!(error.contains(w), "'{w}' is missing in: {error}"));
    };
    refused(&|m| m.parts.clear(), &["no bodies"]);
    refused(&|m| m.loads[0].value = f64::NAN, &["'right'", "not finite"]);
    refused(&|m| m.loads[0].point = 1000, &["'right'", "1000"]);
    refused(&|m| m.ties[0].first.1 = "nowhere".to_owned(), &["no face 'nowhere'", "left", "right"]);
    refused(&|m| m.ties[1].second.1 = "right".to_owned(), &["tie '1-2'"]);
    let part = |m: &mut Model| match m.parts.remove(1) {
        Part::Discrete { name, network } => (name, network),
        Part::Continuum(_) => unreachable!("the middle is discrete"),
    };
    refused(
        &|m| {
            let (name, mut network) = part(m);
            network.particles.position.iter_mut().for_each(|x| x.x -= 0.3);
            m.parts.insert(1, Part::Discrete { name, network });
        },
        &["overlap", "'left'", "'middle'"],
    );
    refused(
        &|m| {
            let (name, mut network) = part(m);
            network.bonds.stiffness[7].kn = f64::NAN;
            m.parts.insert(1, Part::Discrete { name, network });
        },
        &["bond 7", "finite"],
    );
    refused(
        &|m| {
            let (name, mut network) = part(m);
            network.faces.insert("left".to_owned(), Vec::new());
            m.parts.insert(1, Part::Discrete { name, network });
        },
        &["empty interface", "no points"],
    );
}

/// Error of the deflection of a cantilever, 20 elements long and `ratio` times as long as high, ν = 0.
fn slender(ratio: f64) -> Result<f64, Error> {
    let beam = continuum("beam", Space::Plane, Vec3::zeros(), Vec3::new(ratio, 1.0, 0.0), [20, 1, 0]);
    // Half a metre thick, as all plane continua of these tests.
    let section = 0.5 * beam.elasticity.young_pa;
    let parts = vec![Part::Continuum(beam)];
    let mut model =
        Model { space: Space::Plane, parts, ties: Vec::new(), supports: Vec::new(), loads: Vec::new() };
    prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
    let tip = model.parts[0].positions().iter().position(|x| x.x > ratio - 1e-9).unwrap();
    model.loads.push(PointValue { part: 0, point: tip, component: 1, value: 1.0 });
    let deflection = statics::solve(&model)?.displacement(&model, 0, tip).y;
    let exact = ratio.powi(3) / (3.0 * section / 12.0) + ratio / (5.0 / 6.0 * 0.5 * section);
    Ok(deflection / exact - 1.0)
}

#[test]
fn a_slender_beam_is_solved_or_refused() {
    // Twenty elements are 1 − 1/(4·20²) of a beam; the load on one corner, where its deflection is read, adds as much.
    for ratio in [10.0, 100.0] {
        let error = slender(ratio).unwrap();
        assert!(error.abs() < 2e-3, "L/h = {ratio}: {error}");
    }
    // What rounding leaves of the load is larger than the load here, or what holds the beam is lost in it.
    for ratio in [1e3, 3e3, 1e4, 1e5] {
        let found = slender(ratio);
        assert!(found.is_err(), "L/h = {ratio}: {found:?}");
    }
}

/// A chain of springs 1 … 1e-6 in two halves that a row holds together. One pass through the factor is enough: were the row
/// eliminated before its unknowns, its pivot would be −ε alone, and `b bᵀ/ε` would drown the springs.
#[test]
fn one_pass_is_exact_with_rows_too() {
    let n = 40;
    let mut springs = Triplets::default();
    for i in 0..n {
        let stiffness = 10f64.powf(-6.0 * i as f64 / n as f64);
        springs.push(i, i, 1e-3 * stiffness);
        if i > 0 && i != n / 2 {
            springs.push_block(0, &[i - 1, i], &[stiffness, -stiffness, -stiffness, stiffness]);
        }
    }
    let stiffness = SymmetricMatrix::from_triplets(n, &springs);
    let rows = vec![vec![(n / 2 - 1, 1.0), (n / 2, -1.0)], vec![(3, 0.5), (4, 0.5), (n - 2, -1.0)]];
    let group: Vec<u32> = (0..n as u32).collect();
    let positions: Vec<Vec3> = (0..n).map(|i| Vec3::new(i as f64, 0.0, 0.0)).collect();
    for space in [Space::Plane, Space::Solid] {
        let layout = Layout { space, group: &group, positions: &positions, row_positions: &positions[..2] };
        let mut work = Work::default();
        let kkt = Kkt::new(&stiffness, &rows, &layout, &mut work).unwrap();
        let force: Vec<f64> = (0..n).map(|i| (i as f64).cos()).collect();
        let exact = kkt.solve(&force, &[0.0, 1e-3], &mut work).unwrap();
        assert!(exact.residual < 1e-15, "{}", exact.residual);
        let [u, multipliers] = &kkt.apply(&[[&force, &[0.0, 1e-3]]], &mut work)[0];
        let largest = |x: &[f64]| x.iter().fold(0.0f64, |m, v| m.max(v.abs()));
        for (once, exact) in [(u, &exact.u), (multipliers, &exact.multipliers)] {
            let error = once.iter().zip(exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(error < 1e-11 * largest(exact), "{space:?}: {error:e}");
        }
    }
}

#[test]
fn what_is_not_finite_is_no_solution() {
    let mut springs = Triplets::with_capacity(3);
    springs.push_block(0, &[0, 1], &[2.0, -1.0, -1.0, 2.0]);
    let stiffness = SymmetricMatrix::from_triplets(2, &springs);
    let positions = [Vec3::zeros(), Vec3::new(1.0, 0.0, 0.0)];
    let layout = Layout { space: Space::Plane, group: &[0, 1], positions: &positions, row_positions: &[] };
    let mut work = Work::default();
    let kkt = Kkt::new(&stiffness, &[], &layout, &mut work).unwrap();
    let u = kkt.solve(&[1.0, 0.0], &[], &mut work).unwrap().u;
    assert!((u[0] - 2.0 / 3.0).abs() < 1e-15 && (u[1] - 1.0 / 3.0).abs() < 1e-15, "{u:?}");
    for bad in [f64::NAN, f64::INFINITY] {
        let error = kkt.solve(&[1.0, bad], &[], &mut work).unwrap_err().to_string();
        assert!(error.contains("not finite"), "{error}");
    }
}
