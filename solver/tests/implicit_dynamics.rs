//! Implicit dynamics: second order, energy, constraints, natural frequencies.

mod common;

use common::{Sandwich, YOUNG, continuum, prescribe};
use seam_solver::coupling::Method;
use seam_solver::dynamics::modes;
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::quasi_static::QuasiStatic;
use seam_solver::dynamics::semidiscrete::{Motion, Semidiscrete};
use seam_solver::fem::formulation::Formulation;
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::solve::statics;
use seam_solver::space::{Space, Vec3};
use seam_solver::work::Work;
use std::f64::consts::PI;

/// One element that can only move along x at its right side: a spring of stiffness EA/L on half its mass, and the
/// frequency of this oscillator.
fn oscillator() -> (Model, f64) {
    let mut body = continuum("spring", Space::Plane, Vec3::zeros(), Vec3::new(1.0, 1.0, 0.0), [1, 1, 0]);
    body.formulation = Formulation::Plain;
    let mut model = Model {
        space: Space::Plane,
        parts: vec![Part::Continuum(body)],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    prescribe(&mut model, |x| x.x == 0.0, |_| Vec3::zeros());
    for point in [1, 3] {
        model.supports.push(PointValue { part: 0, point, component: 1, value: 0.0 });
    }
    // k = E t h / L, m = ρ t h L / 2 with E = 3e7 and ρ = 1: the two nodes move as one.
    (model, (2.0 * YOUNG).sqrt())
}

/// Error of the oscillator's displacement after one period and a third, released from u = 1.
fn oscillator_error(scheme: Scheme, steps: usize) -> f64 {
    let (model, omega) = oscillator();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let end = 2.0 * PI / omega * 4.0 / 3.0;
    let step = end / steps as f64;
    let newmark = Newmark::new(&system, scheme, step, 0.0, &mut work).unwrap();
    let (mut motion, _) = start(&system, (vec![1.0; 2], vec![0.0; 2]), 0.0, 0.0, 0.0, &mut work).unwrap();
    for _ in 0..steps {
        newmark.step(&mut motion, [0.0; 2], &mut work).unwrap();
    }
    (motion.u[0] - (omega * end).cos()).abs()
}

#[test]
fn both_schemes_are_of_second_order() {
    for scheme in [Scheme::TRAPEZOIDAL, Scheme::hht(-0.1).unwrap()] {
        let (coarse, fine) = (oscillator_error(scheme, 200), oscillator_error(scheme, 400));
        let order = (coarse / fine).log2();
        // 150 steps per period: the next term, ωΔt to the third or fourth power, bends the slope by a few per cent.
        assert!((order - 2.0).abs() < 0.1, "{scheme:?}: {order}");
    }
    // A first-order scheme is seen: γ ≠ ½ without α.
    let first = Scheme { beta: 0.36, gamma: 0.7, alpha: 0.0 };
    let order = (oscillator_error(first, 400) / oscillator_error(first, 800)).log2();
    assert!(order < 1.5, "{order}");
}

#[test]
fn a_scheme_out_of_range_is_refused() {
    assert!(Scheme::hht(-0.5).is_err() && Scheme::hht(0.1).is_err() && Scheme::hht(f64::NAN).is_err());
    let (model, _) = oscillator();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    for (scheme, step, damping) in [
        (Scheme::CENTRAL, 1e-5, 0.0),
        (Scheme::TRAPEZOIDAL, 0.0, 0.0),
        (Scheme::TRAPEZOIDAL, f64::NAN, 0.0),
        (Scheme::TRAPEZOIDAL, 1e-5, -1.0),
    ] {
        assert!(
            Newmark::new(&system, scheme, step, damping, &mut work).is_err(),
            "{scheme:?} {step} {damping}"
        );
    }
}

/// The oscillator's logarithmic decrement: `c M v` damps by the ratio `c / 2ω`.
#[test]
fn mass_damping_decays_at_half_its_rate() {
    let (model, omega) = oscillator();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let damping = 0.1 * omega;
    let damped = (omega * omega - 0.25 * damping * damping).sqrt();
    let steps = 2000;
    let step = 2.0 * PI / damped / steps as f64;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, damping, &mut work).unwrap();
    let (mut motion, _) = start(&system, (vec![1.0; 2], vec![0.0; 2]), 0.0, 0.0, damping, &mut work).unwrap();
    for _ in 0..steps {
        newmark.step(&mut motion, [0.0; 2], &mut work).unwrap();
    }
    let exact = (-0.5 * damping * steps as f64 * step).exp();
    // Second order: (2π/2000)²/12 of the phase, per radian; far below 1e-5.
    assert!((motion.u[0] - exact).abs() < 1e-5, "{} {exact}", motion.u[0]);
}

fn cantilever() -> Model {
    let body = continuum("beam", Space::Plane, Vec3::zeros(), Vec3::new(20.0, 1.0, 0.0), [60, 3, 0]);
    let mut model = Model {
        space: Space::Plane,
        parts: vec![Part::Continuum(body)],
        ties: Vec::new(),
        supports: Vec::new(),
        loads: Vec::new(),
    };
    prescribe(&mut model, |x| x.x == 0.0, |_| Vec3::zeros());
    model
}

#[test]
fn cantilever_frequencies_from_matrices_and_from_a_free_run() {
    let model = cantilever();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let modes = modes::lowest(&model, &system, 3, &mut work).unwrap();
    // ω = (βL)² √(EI/ρA)/L², ρ = 1, I/A = h²/12. Shear and rotatory inertia lower it (Timoshenko): by about
    // (βL)²(h/L)²/24·(1+E/κG), 0.2 % for the first mode at L/h = 20, 1.3 % for the second; the mesh adds less than 0.3 %.
    for (mode, (beta_l, within)) in modes.iter().zip([(1.875_104_1, 5e-3), (4.694_091_1, 2.5e-2)]) {
        let beam = f64::powi(beta_l, 2) * (YOUNG / 12.0).sqrt() / 400.0;
        assert!((mode.omega / beam - 1.0).abs() < within, "{} {beam}", mode.omega);
    }
    // Released from the first mode, the trapezoidal rule turns by 2 atan(ωΔt/2) each step, exactly.
    let omega = modes[0].omega;
    let step = 2.0 * PI / omega / 40.0;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, &mut work).unwrap();
    let still = vec![0.0; modes[0].shape.len()];
    let (mut motion, _) = start(&system, (modes[0].shape.clone(), still), 0.0, 0.0, 0.0, &mut work).unwrap();
    let tip = motion.u.len() - 1;
    let amplitude = motion.u[tip];
    let energy = system.strain(&motion.u);
    for _ in 0..100 {
        newmark.step(&mut motion, [0.0; 2], &mut work).unwrap();
    }
    let exact = amplitude * (100.0 * 2.0 * (0.5 * omega * step).atan()).cos();
    // Shape to the root of the tolerance on ω²: about 1e-7.
    assert!((motion.u[tip] - exact).abs() < 1e-6 * amplitude.abs(), "{} {exact}", motion.u[tip] / amplitude);
    let now = system.strain(&motion.u) + system.kinetic(&motion.v);
    assert!((now / energy - 1.0).abs() < 1e-10, "energy {now} {energy}");
}

fn coupled() -> Model {
    let mut model = Sandwich::plane(4, 4, 4, Method::Mortar).model();
    prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
    model.loads.push(PointValue { part: 2, point: 3, component: 1, value: -10.0 });
    model
}

#[test]
fn constraints_and_energy_hold_in_a_coupled_run() {
    let model = coupled();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let n = system.mass.len();
    let (mut motion, _) = start(&system, (vec![0.0; n], vec![0.0; n]), 0.0, 1.0, 0.0, &mut work).unwrap();
    let step = 2e-4;
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, step, 0.0, &mut work).unwrap();
    let factorised = work.factorisations;
    let mut largest = 0.0f64;
    for _ in 0..400 {
        newmark.step(&mut motion, [1.0; 2], &mut work).unwrap();
        largest = motion.u.iter().fold(largest, |m, u| m.max(u.abs()));
        // Rounding only: constraints are linear and start satisfied.
        assert!(system.gap(&motion.u) < 1e-11 * largest, "{}", system.gap(&motion.u) / largest);
    }
    assert_eq!(work.factorisations, factorised, "factorised once");
    let external: f64 = system.load.iter().zip(&motion.u).map(|(f, u)| f * u).sum();
    let energy = system.kinetic(&motion.v) + system.strain(&motion.u);
    // A constant load's work is f·u; the trapezoidal rule conserves the rest to rounding of 400 solves.
    assert!((energy / external - 1.0).abs() < 1e-9, "{energy} {external}");
}

#[test]
fn quasi_static_steps_are_the_statics_and_heavy_damping_ends_there() {
    let model = coupled();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let static_u = statics::solve(&model).unwrap().u;
    let steps = QuasiStatic::new(&model, &system, &mut work).unwrap();
    let (half, _) = steps.at(0.5, 0.5, &mut work).unwrap();
    let (full, _) = steps.at(1.0, 1.0, &mut work).unwrap();
    let scale = static_u.iter().fold(0.0f64, |m, u| m.max(u.abs()));
    let far = |m: &Motion, factor: f64| {
        let full = system.state(m).u;
        full.iter().zip(&static_u).fold(0.0f64, |w, (a, b)| w.max((a - factor * b).abs())) / scale
    };
    // Condition about 1e5 times rounding, refined.
    assert!(far(&half, 0.5) < 1e-10 && far(&full, 1.0) < 1e-10);
    let n = system.mass.len();
    let omega = modes::lowest(&model, &system, 1, &mut work).unwrap()[0].omega;
    let damping = 2.0 * omega;
    // Steps long against the high modes, which the trapezoidal rule would hardly damp; HHT does.
    let scheme = Scheme::hht(-0.3).unwrap();
    let newmark = Newmark::new(&system, scheme, 0.05 / omega, damping, &mut work).unwrap();
    let (mut motion, _) = start(&system, (vec![0.0; n], vec![0.0; n]), 0.0, 1.0, damping, &mut work).unwrap();
    for _ in 0..800 {
        newmark.step(&mut motion, [1.0; 2], &mut work).unwrap();
    }
    // Critical damping over 40/ω leaves e^−40 of each mode; statics and dynamics are solved to about 1e-12.
    assert!(far(&motion, 1.0) < 1e-9, "{}", far(&motion, 1.0));
}
