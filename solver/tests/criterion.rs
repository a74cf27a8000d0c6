//! Which elements become particles: stress over strength, recovered error, buffer and memory.

mod common;

use common::{continuum, prescribe};
use seam_solver::fem::continuum::Continuum;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::transfer::criterion::{Criterion, Indicator, Memory};
use seam_solver::transfer::region::{Region, centre};
use std::collections::BTreeSet;

const LENGTH: usize = 40;
const HEIGHT: usize = 8;

/// A clamped beam 10 × 2 with a transverse end force of 10 N, and its displacements.
fn bent() -> (Continuum, Vec<f64>) {
    let mut body =
        continuum("beam", Space::Plane, Vec3::zeros(), Vec3::new(10.0, 2.0, 0.0), [LENGTH, HEIGHT, 0]);
    // A clamp that holds the contraction is singular in its corners.
    body.elasticity.poisson = 0.3;
    let end = body.mesh.boundary_nodes("right").unwrap();
    let parts = vec![Part::Continuum(body.clone())];
    let mut model =
        Model { space: Space::Plane, parts, ties: Vec::new(), supports: Vec::new(), loads: Vec::new() };
    prescribe(&mut model, |x| x.x == 0.0, |_| Vec3::zeros());
    for (k, &point) in end.iter().enumerate() {
        let share = if k == 0 || k == HEIGHT { 0.5 } else { 1.0 };
        model.loads.push(PointValue { part: 0, point, component: 1, value: 10.0 * share / HEIGHT as f64 });
    }
    let u = statics::solve(&model).unwrap().u;
    (body, u)
}

fn stress(strength: f64, trigger: f64, buffer_m: f64, memory: Memory) -> Criterion {
    let indicator = Indicator::Stress { strength_pa: Some(strength), length_m: 0.5 };
    Criterion { indicator, trigger, buffer_m, memory }
}

#[test]
fn bending_stress_is_the_beams() {
    let (body, u) = bent();
    let values = stress(1000.0, 0.5, 0.0, Memory::Irreversible).values(&body, &u).unwrap();
    // σ = M y/I at the centre of the lowest element at x = 5.125, averaged with its neighbours within 0.25 m: their mean y is
    // that of a T of four elements (one above, one to each side): −1 + (3·0.125 + 0.375)/4; M = 10 (10 − x), I = 0.5·8/12.
    let cell = 20;
    let (x, y) = (5.125, 1.0 - 0.75 / 4.0);
    assert!((centre(&body.mesh, cell) - Vec3::new(x, 0.125, 0.0)).norm() < 1e-12);
    let sigma = 10.0 * (10.0 - x) * y / (0.5 * 8.0 / 12.0);
    // The beam's shear turns the principal direction a little: (τ/σ)² of about 0.2 %.
    assert!((values[cell] * 1000.0 / sigma - 1.0).abs() < 5e-3, "{} {sigma}", values[cell] * 1000.0);
}

#[test]
fn the_region_reaches_as_far_as_the_stress_and_its_buffer() {
    let (body, u) = bent();
    let none = BTreeSet::new();
    let reach = |trigger: f64, buffer: f64| {
        let chosen = stress(300.0, trigger, buffer, Memory::Irreversible).choose(&body, &u, &none).unwrap();
        let far = |c: &usize| body.mesh.cell(*c).iter().map(|&n| body.mesh.nodes[n].x).fold(0.0, f64::max);
        chosen.iter().map(far).fold(0.0, f64::max)
    };
    let [low, middle, high] = [0.4, 0.5, 0.7].map(|t| reach(t, 0.0));
    assert!(low > middle && middle > high && high > 0.0, "{low} {middle} {high}");
    assert_eq!(
        reach(0.5, 0.0) + 0.75,
        reach(0.5, 1.0),
        "a buffer of 1 m is four elements, one of them always there"
    );
    assert_eq!(reach(5.0, 1.0), 0.0, "a trigger too high misses");
    let chosen = stress(300.0, 0.5, 0.0, Memory::Irreversible).choose(&body, &u, &none).unwrap();
    let region = Region::covering(&body, &chosen).unwrap();
    assert_eq!(region.cells.len() % HEIGHT, 0, "the tension and compression sides make whole columns");
}

#[test]
fn memory_keeps_or_releases() {
    let (body, u) = bent();
    let half: Vec<f64> = u.iter().map(|v| 0.5 * v).collect();
    let chosen = |memory| {
        let criterion = stress(300.0, 0.5, 0.0, memory);
        let first = criterion.choose(&body, &u, &BTreeSet::new()).unwrap();
        (criterion.choose(&body, &half, &first).unwrap().len(), first.len())
    };
    let (kept, first) = chosen(Memory::Irreversible);
    assert_eq!(kept, first);
    let (some, _) = chosen(Memory::Release(0.2));
    let (fewest, _) = chosen(Memory::Release(0.49));
    assert!(fewest < some && some < first, "{fewest} {some} {first}");
}

/// The singular corners of the clamp have the largest error; a patch under uniform stress has none.
#[test]
fn the_error_estimate_finds_the_corners_and_is_zero_on_a_patch() {
    let (body, u) = bent();
    let criterion =
        Criterion { indicator: Indicator::Error, trigger: 0.1, buffer_m: 0.0, memory: Memory::Irreversible };
    let values = criterion.values(&body, &u).unwrap();
    // The even traction at the tip is no beam's either: looked at is the half at the clamp.
    let clamped = |c: &usize| centre(&body.mesh, *c).x < 5.0;
    let worst = (0..values.len()).filter(clamped).max_by(|&a, &b| values[a].total_cmp(&values[b])).unwrap();
    assert!([0, (HEIGHT - 1) * LENGTH].contains(&worst), "{worst}");
    let uniform: Vec<f64> = body.mesh.nodes.iter().flat_map(|x| [1e-3 * x.x, 0.0]).collect();
    let values = criterion.values(&body, &uniform).unwrap();
    // Differences of equal stresses: rounding, under a root.
    assert!(values.iter().all(|v| *v < 1e-9), "{values:?}");
}

#[test]
fn criteria_that_cannot_be_judged_are_refused() {
    let (body, u) = bent();
    let sound = stress(300.0, 0.5, 0.0, Memory::Irreversible);
    let message = |criterion: Criterion| criterion.values(&body, &u).unwrap_err().to_string();
    let indicator = Indicator::Stress { strength_pa: None, length_m: 0.5 };
    assert!(message(Criterion { indicator, ..sound }).contains("strength that is not given"));
    let indicator = Indicator::Stress { strength_pa: Some(-1.0), length_m: 0.5 };
    assert!(message(Criterion { indicator, ..sound }).contains("positive strength"));
    let indicator = Indicator::Stress { strength_pa: Some(1.0), length_m: f64::NAN };
    assert!(message(Criterion { indicator, ..sound }).contains("length to average over"));
    assert!(message(Criterion { trigger: 0.0, ..sound }).contains("trigger"));
    assert!(message(Criterion { buffer_m: -1.0, ..sound }).contains("buffer_m"));
    assert!(message(Criterion { memory: Memory::Release(0.5), ..sound }).contains("below the trigger"));
}
