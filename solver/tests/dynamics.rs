//! Explicit dynamics against exact answers: oscillator, bars, ledgers, momentum, critical steps.

mod common;

use common::{Sandwich, prescribe};
use seam_solver::coupling::Method;
use seam_solver::dem::network::{BondStiffness, Bonds, Network, Particles};
use seam_solver::dynamics::State;
use seam_solver::dynamics::damping::Damping;
use seam_solver::dynamics::explicit::{Explicit, Options};
use seam_solver::dynamics::forces::{InternalForces, Rotations};
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::system::System;
use seam_solver::dynamics::{critical, ledger::Ledger};
use seam_solver::error::Error;
use seam_solver::model::{Model, Numbering, Part, PointValue};
use seam_solver::space::{Space, Vec3};

/// A bar of particles along x, free along x only: `E A = 1`, `ρ A = 1`, length 1, so `c = 1`. Half a mass at each end,
/// as lumped linear elements have it. The first particle is held.
fn bar(bonds: usize) -> Model {
    let h = 1.0 / bonds as f64;
    let count = bonds + 1;
    let mut particles = Particles::default();
    for i in 0..count {
        particles.position.push(Vec3::new(i as f64 * h, 0.0, 0.0));
        particles.radius.push(0.5 * h);
        particles.mass.push(if i == 0 || i == bonds { 0.5 * h } else { h });
        particles.inertia.push(h.powi(3));
    }
    // Soft enough across that the axial mode decides the critical step.
    let k = BondStiffness { kn: 1.0 / h, ks: 1e-3 / h, kb: 1e-3 * h, kt: 0.0 };
    let network = Network {
        space: Space::Plane,
        particles,
        bonds: Bonds {
            ends: (0..bonds).map(|i| [i, i + 1]).collect(),
            radius: vec![0.1 * h; bonds],
            stiffness: vec![k; bonds],
            weight: vec![1.0; bonds],
        },
        faces: Default::default(),
    };
    let held = |point, component| PointValue { part: 0, point, component, value: 0.0 };
    let mut supports: Vec<PointValue> = (0..count).flat_map(|p| [held(p, 1), held(p, 2)]).collect();
    supports.push(held(0, 0));
    Model {
        space: Space::Plane,
        parts: vec![Part::Discrete { name: "bar".to_owned(), network }],
        ties: Vec::new(),
        supports,
        loads: Vec::new(),
    }
}

fn at_rest(model: &Model) -> State {
    State::at_rest(Numbering::new(model).len())
}

fn every(step_s: f64) -> Options {
    Options { step_s, ..Options::default() }
}

/// One mass on a spring, released from one: `u = cos ωt`, error O(Δt²).
#[test]
fn an_oscillator_is_second_order() {
    let model = bar(1);
    let (omega, end) = (2f64.sqrt(), 3.0);
    let error = |steps: u64| {
        let mut initial = at_rest(&model);
        initial.u[3] = 1.0;
        let mut run = Explicit::new(&model, every(end / steps as f64), &initial).unwrap();
        run.advance(steps).unwrap();
        let seen = run.observe().unwrap();
        assert!((seen.state.time - end).abs() < 1e-12);
        let v = -omega * (omega * end).sin();
        [(seen.state.u[3] - (omega * end).cos()).abs(), (seen.state.v[3] - v).abs()]
    };
    let [coarse, fine] = [error(80), error(160)];
    for i in 0..2 {
        let order = (coarse[i] / fine[i]).log2();
        // The next term of the error is Δt²/4 smaller: about 1e-3 of the order at 80 steps.
        assert!((order - 2.0).abs() < 5e-3, "{order}");
    }
}

/// Sudden load 1 at the end: the tip is a triangle wave of period 4 L/c between zero and twice the static L P/EA = 1.
/// At Δt = h/c central differences solve the wave equation exactly, so only rounding is left.
#[test]
fn a_bar_under_a_sudden_load_is_a_triangle_wave() {
    let n = 20;
    let mut model = bar(n);
    model.loads.push(PointValue { part: 0, point: n, component: 0, value: 1.0 });
    let dt = 1.0 / n as f64;
    let mut run = Explicit::new(&model, every(dt), &at_rest(&model)).unwrap();
    // The bound is exactly h/c here.
    assert!((run.critical().step_s / dt - 1.0).abs() < 1e-12);
    for step in 0..=8 * n as u64 {
        let seen = run.observe().unwrap();
        let phase = (step as f64 * dt).rem_euclid(4.0);
        let triangle = if phase < 2.0 { phase } else { 4.0 - phase };
        assert!((seen.state.u[3 * n] - triangle).abs() < 1e-12, "step {step}");
        assert!(seen.ledger.closure() < 1e-12, "{:?}", seen.ledger);
        run.advance(1).unwrap();
    }
}

/// A bar that flies into a wall at v₀: the wall feels σ = ρ c v₀ for 2 L/c, then it would pull.
#[test]
fn a_bar_hitting_a_wall_feels_rho_c_v() {
    let n = 40;
    let model = bar(n);
    let v0 = 0.01;
    let mut initial = at_rest(&model);
    (1..=n).for_each(|p| initial.v[3 * p] = -v0);
    let mut run = Explicit::new(&model, every(1.0 / n as f64), &initial).unwrap();
    let mut contact = 0;
    for step in 0..3 * n {
        let push = run.observe().unwrap().reactions[0];
        if push > 0.5 * v0 {
            contact += 1;
        }
        // The first and the last instant share a jump.
        if (2..2 * n - 1).contains(&step) {
            assert!((push / v0 - 1.0).abs() < 1e-12, "step {step}: {push}");
        }
        if step > 2 * n + 1 {
            assert!((push / v0 + 1.0).abs() < 1e-12, "step {step}: {push}");
        }
        run.advance(1).unwrap();
    }
    assert!((contact as f64 / n as f64 - 2.0).abs() <= 1.0 / n as f64, "{contact}");
}

/// A million steps at 0.99 of the critical one change no energy.
#[test]
fn a_million_undamped_steps_keep_the_energy() {
    let n = 4;
    let model = bar(n);
    let mut initial = at_rest(&model);
    (1..=n).for_each(|p| initial.u[3 * p] = (1.3 * p as f64).sin());
    let mut run = Explicit::new(&model, every(0.99 / n as f64), &initial).unwrap();
    let start = run.observe().unwrap().ledger.energy();
    for _ in 0..10 {
        run.advance(100_000).unwrap();
        let seen = run.observe().unwrap();
        assert!((seen.ledger.energy() / start - 1.0).abs() < 1e-9, "{:?}", seen.ledger);
        assert!(seen.state.u.iter().all(|u| u.abs() < 10.0));
    }
}

#[test]
fn a_step_beyond_the_critical_one_is_refused_with_both_numbers() {
    let model = bar(10);
    let error = Explicit::new(&model, every(0.101), &at_rest(&model)).err().unwrap();
    assert!(matches!(error, Error::UnstableStep { .. }), "{error}");
    let message = error.to_string();
    assert!(message.contains("1.010000e-1") && message.contains("1.000000e-1"), "{message}");
    // Local damping of α can stiffen by 1 + α, so that the bound is 0.1 s over its root.
    for (step_s, admitted) in [(0.079, true), (0.0791, false)] {
        let options = Options { damping: Damping::NonViscous { share: 0.6 }, ..every(step_s) };
        assert_eq!(Explicit::new(&model, options, &at_rest(&model)).is_ok(), admitted, "{step_s}");
    }
    for bad in [0.0, -1.0, f64::NAN] {
        assert!(Explicit::new(&model, every(bad), &at_rest(&model)).is_err());
    }
}

#[test]
fn states_and_bodies_that_do_not_fit_are_refused() {
    let mut model = bar(3);
    let refusal = |m: &Model, s: State| Explicit::new(m, every(0.01), &s).err().unwrap().to_string();
    assert!(refusal(&model, State::at_rest(3)).contains("needs 12 finite"));
    let mut broken = at_rest(&model);
    broken.u[4] = f64::NAN;
    assert!(refusal(&model, broken).contains("finite"));
    let Part::Discrete { network, .. } = &mut model.parts[0] else { unreachable!("a bar of particles") };
    network.particles.mass[2] = 0.0;
    assert!(refusal(&model, at_rest(&model)).contains("particle 2 has mass"));
}

/// Elements, particles, elements; clamped at the left, loaded at the right.
fn coupled(method: Method) -> Model {
    let mut model = Sandwich::plane(3, 5, 4, method).model();
    prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
    for point in 0..4 {
        model.loads.push(PointValue { part: 2, point, component: 1, value: -10.0 });
    }
    model
}

fn worst_closure(model: &Model, options: Options, steps: u64) -> (Ledger, f64, f64) {
    let mut run = Explicit::new(model, options, &at_rest(model)).unwrap();
    let (mut closure, mut gap) = (0.0f64, 0.0f64);
    let mut last = Ledger::default();
    for _ in 0..20 {
        run.advance(steps / 20).unwrap();
        let seen = run.observe().unwrap();
        let size = seen.state.u.iter().fold(0.0f64, |m, u| m.max(u.abs()));
        closure = closure.max(seen.ledger.closure());
        gap = gap.max(seen.gap / size);
        last = seen.ledger;
    }
    (last, closure, gap)
}

#[test]
fn the_ledger_of_a_coupled_run_closes_with_and_without_damping() {
    for method in [Method::Pointwise, Method::Mortar] {
        let model = coupled(method);
        // Local damping of 0.3 takes 1/√1.3 of the critical step.
        let step_s = critical::bound(&model).unwrap().step_s / 1.3f64.sqrt();
        let loads = LoadFactor::Ramp { start_s: 0.0, rise_s: 500.0 * step_s };
        let with = |damping| Options { step_s, loads: loads.clone(), damping, ..Options::default() };
        for (damping, damps) in [
            (Damping::None, false),
            (Damping::MassProportional { rate: 0.01 / step_s }, true),
            (Damping::NonViscous { share: 0.3 }, true),
        ] {
            let (ledger, closure, gap) = worst_closure(&model, with(damping), 2000);
            // Two thousand steps of rounding; forces are a thousand times their sum.
            assert!(closure < 1e-10, "{damping:?}: {closure:e} {ledger:?}");
            assert!(gap < 1e-11, "{damping:?}: {gap:e}");
            assert_eq!(ledger.work.damping < -1e-3 * ledger.work.external.abs(), damps, "{ledger:?}");
            assert!(ledger.work.interface.abs() < 1e-10 * ledger.work.external.abs());
        }
    }
}

/// Damped long enough, the run ends in the static solution: both codes, one answer.
#[test]
fn a_damped_run_settles_in_the_static_solution() {
    let model = coupled(Method::Mortar);
    let statics = seam_solver::solve::statics::solve(&model).unwrap();
    let critical_s = critical::bound(&model).unwrap().step_s;
    for (damping, step_s) in [
        (Damping::MassProportional { rate: 0.03 / critical_s }, critical_s),
        (Damping::NonViscous { share: 0.5 }, critical_s / 1.5f64.sqrt()),
    ] {
        let options = Options { step_s, damping, ..Options::default() };
        let mut run = Explicit::new(&model, options, &at_rest(&model)).unwrap();
        run.advance(20_000).unwrap();
        let size = statics.u.iter().fold(0.0f64, |m, u| m.max(u.abs()));
        let off = run.u().iter().zip(&statics.u).fold(0.0f64, |m, (a, b)| m.max((a - b).abs()));
        // What is left of the slowest mode.
        assert!(off < 1e-6 * size, "{damping:?}: {off:e} of {size:e}");
    }
}

/// A support that moves one metre along a free bar of FE and DE drags all of it along, and its work is on the ledger.
#[test]
fn a_moving_support_does_work() {
    let mut model = Sandwich::plane(3, 5, 4, Method::Pointwise).model();
    prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::new(1e-3, 0.0, 0.0));
    let step_s = critical::bound(&model).unwrap().step_s;
    let supports = LoadFactor::Ramp { start_s: 0.0, rise_s: 300.0 * step_s };
    let (ledger, closure, _) =
        worst_closure(&model, Options { step_s, supports, ..Options::default() }, 1000);
    assert!(ledger.work.external > 0.0 && ledger.energy() > 0.0);
    assert!(closure < 1e-9, "{closure:e} {ledger:?}");
}

/// Free in space: linear momentum and, about the undeformed places, angular momentum stay.
#[test]
fn ties_keep_momentum() {
    for method in [Method::Pointwise, Method::Mortar] {
        let model = Sandwich { rotations: true, ..Sandwich::plane(3, 5, 4, method) }.model();
        let numbering = Numbering::new(&model);
        let mut initial = at_rest(&model);
        // A field that all faces share: uniform stretching and turning.
        for (part, body) in model.parts.iter().enumerate() {
            for (point, x) in body.positions().iter().enumerate() {
                initial.v[numbering.unknown(part, point, 0)] = 1.0 + 0.1 * x.x - 0.5 * x.y;
                initial.v[numbering.unknown(part, point, 1)] = 2.0 + 0.5 * x.x;
                if matches!(body, Part::Discrete { .. }) {
                    initial.v[numbering.unknown(part, point, 2)] = 0.5;
                }
            }
        }
        let step_s = critical::bound(&model).unwrap().step_s;
        let mut run = Explicit::new(&model, every(step_s), &initial).unwrap();
        let momentum = |v: &[f64], system: &System| {
            let mut p = Vec3::zeros();
            for (part, body) in model.parts.iter().enumerate() {
                for (point, x) in body.positions().iter().enumerate() {
                    let q = |c: usize| {
                        let i = numbering.unknown(part, point, c);
                        system.mass[i] * v[i]
                    };
                    p += Vec3::new(q(0), q(1), x.x * q(1) - x.y * q(0));
                    if matches!(body, Part::Discrete { .. }) {
                        p.z += q(2);
                    }
                }
            }
            p
        };
        let before = momentum(&run.observe().unwrap().state.v, run.system());
        run.advance(500).unwrap();
        let after = momentum(&run.observe().unwrap().state.v, run.system());
        // Internal and tie forces cancel to rounding, five hundred times.
        assert!((after - before).amax() < 1e-12 * before.norm(), "{method:?}: {before} {after}");
    }
}

/// The bound is below the critical step of the whole, and above half of it, also at a contrast of a million.
#[test]
fn the_bound_is_safe_and_within_a_factor_of_two() {
    for (stiff, heavy) in [(1.0, 1.0), (1e6, 1.0), (1e-6, 1.0), (1.0, 1e6), (1.0, 1e-6)] {
        let sandwich = Sandwich { rotations: true, ..Sandwich::plane(3, 6, 4, Method::Pointwise) };
        let mut model = sandwich.model();
        let Part::Discrete { network, .. } = &mut model.parts[1] else { unreachable!("the middle") };
        for k in &mut network.bonds.stiffness {
            *k = BondStiffness { kn: k.kn * stiff, ks: k.ks * stiff, kb: k.kb * stiff, kt: k.kt * stiff };
        }
        network.particles.mass.iter_mut().chain(&mut network.particles.inertia).for_each(|m| *m *= heavy);
        let bound = critical::bound(&model).unwrap();
        let system = System::new(&model).unwrap();
        let forces = InternalForces::new(&model, &system.numbering, Rotations::Small).unwrap();
        let exact = critical::iterate(&system, &forces, 3000);
        assert!(bound.step_s <= exact && exact < 2.0 * bound.step_s, "{bound:?} {exact}");
        // The tied velocities agree at this contrast, or the run would have stopped.
        let mut initial = at_rest(&model);
        initial.v.iter_mut().enumerate().for_each(|(i, v)| *v = (i as f64).sin());
        let mut run = Explicit::new(&model, every(bound.step_s), &initial).unwrap();
        run.advance(2000).unwrap();
        assert!(run.observe().unwrap().ledger.closure() < 1e-10);
    }
}

/// A free chain that spins three times and bends on the way: energy within O(Δt²), momenta kept, and the
/// elements refuse to take part.
#[test]
fn a_spinning_chain_keeps_energy_to_second_order() {
    let mut model = bar(6);
    model.supports.clear();
    let Part::Discrete { network, .. } = &mut model.parts[0] else { unreachable!("a bar of particles") };
    for k in &mut network.bonds.stiffness {
        k.kb = 1e-2;
        k.ks = 12.0 * k.kb * 36.0;
    }
    let mut initial = at_rest(&model);
    let spin = 0.4;
    for p in 0..7 {
        let x = p as f64 / 6.0 - 0.5;
        initial.v[3 * p + 1] = spin * x + 0.05 * (6.0 * x).cos();
        initial.v[3 * p + 2] = spin;
    }
    let bound = critical::bound(&model).unwrap().step_s;
    let worst = |refinement: u64| {
        let step_s = 0.5 * bound / refinement as f64;
        let options = Options { step_s, rotations: Rotations::Finite, ..Options::default() };
        let mut run = Explicit::new(&model, options, &initial).unwrap();
        let (mut worst, mut turned) = (0.0f64, 0.0);
        for _ in 0..100 {
            run.advance((3.0 * std::f64::consts::TAU / spin / step_s / 100.0) as u64 + 1).unwrap();
            let seen = run.observe().unwrap();
            worst = worst.max((seen.ledger.energy() / seen.ledger.initial - 1.0).abs());
            turned = seen.state.u[2];
        }
        assert!(turned > 3.0 * std::f64::consts::TAU, "{turned}");
        worst
    };
    let (coarse, fine) = (worst(1), worst(2));
    assert!(coarse < 1e-2 && coarse / fine > 3.0, "{coarse:e} {fine:e}");

    let coupled = coupled(Method::Pointwise);
    let step_s = critical::bound(&coupled).unwrap().step_s;
    let options = Options { step_s, rotations: Rotations::Finite, ..Options::default() };
    let refusal = Explicit::new(&coupled, options, &at_rest(&coupled)).err().unwrap().to_string();
    assert!(refusal.contains("'left'") && refusal.contains("small strains"), "{refusal}");
}

mod restart {
    use super::*;
    use seam_solver::dynamics::checkpoint;

    fn run(model: &Model, rotations: Rotations) -> Explicit {
        let step_s = 0.9 * critical::bound(model).unwrap().step_s;
        let damping = Damping::NonViscous { share: 0.1 };
        let loads = LoadFactor::Ramp { start_s: 0.0, rise_s: 100.0 * step_s };
        let options = Options { step_s, loads, damping, rotations, ..Options::default() };
        Explicit::new(model, options, &at_rest(model)).unwrap()
    }

    /// Through a file and on: the same bits as without stopping, counters and ledger too.
    #[test]
    fn goes_on_bit_by_bit() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.checkpoint");
        let mut chain = bar(5);
        chain.supports.retain(|s| s.point == 0);
        chain.loads.push(PointValue { part: 0, point: 5, component: 1, value: 1e-4 });
        for (model, rotations) in [(coupled(Method::Mortar), Rotations::Small), (chain, Rotations::Finite)] {
            let mut whole = run(&model, rotations);
            whole.advance(120).unwrap();
            checkpoint::write(&path, &model, &whole).unwrap();
            let options = whole.options().clone();
            let mut resumed = checkpoint::resume(&path, &model, options).unwrap();
            whole.advance(130).unwrap();
            resumed.advance(130).unwrap();
            assert_eq!(whole.work(), resumed.work());
            assert_eq!(whole.observe().unwrap(), resumed.observe().unwrap());
            assert!(whole.u().iter().any(|u| *u != 0.0));
        }
    }

    #[test]
    fn of_another_model_or_a_broken_file_is_refused() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("run.checkpoint");
        let mut model = coupled(Method::Mortar);
        let whole = run(&model, Rotations::Small);
        checkpoint::write(&path, &model, &whole).unwrap();
        let refusal = |model: &Model, options: &Options| {
            checkpoint::resume(&path, model, options.clone()).err().unwrap().to_string()
        };
        let options = whole.options();
        let slower = Options { step_s: 0.5 * options.step_s, ..options.clone() };
        assert!(refusal(&model, &slower).contains("another model or with other options"));
        model.loads[0].value += 1e-9;
        assert!(refusal(&model, options).contains("another model or with other options"));
        model.loads[0].value -= 1e-9;
        let mut bytes = std::fs::read(&path).unwrap();
        bytes[200] ^= 1;
        std::fs::write(&path, &bytes).unwrap();
        assert!(refusal(&model, options).contains("damaged"));
        std::fs::write(&path, &bytes[..60]).unwrap();
        assert!(refusal(&model, options).contains("damaged"));
        std::fs::write(&path, b"").unwrap();
        assert!(refusal(&model, options).contains("no checkpoint"));
        std::fs::remove_file(&path).unwrap();
        assert!(refusal(&model, options).contains("run.checkpoint"));
    }
}
