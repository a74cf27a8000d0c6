//! Runs in time: steppers agree, energies close, switches keep momentum, nothing depends on output.

mod common;

use common::ramp::{block, cantilever, implicit, period, ramp, rule, two_rates};
use common::{cubic, prescribe};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::State;
use seam_solver::dynamics::damping::Damping;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::multirate::Method::{GravouilCombescure, PrakashHjelmstad};
use seam_solver::dynamics::newmark::Scheme;
use seam_solver::dynamics::semidiscrete::lumped;
use seam_solver::error::{Error, Result};
use seam_solver::model::{Model, Numbering, Part};
use seam_solver::simulation::{Energies, Outcome, Plan, Snapshot, Step, Stepping, SwitchRule, When, run};
use seam_solver::space::{Space, Vec3};
use seam_solver::transfer::criterion::{Criterion, Indicator, Memory};
use seam_solver::transfer::fields::Mode;
use seam_solver::transfer::momentum::Momentum;

/// The claim of the ledgers; rounding of some ten thousand steps stays a thousand times below.
const CLOSED: f64 = 1e-8;
const EXPLICIT: Stepping = Stepping::Explicit { step: Step::ShareOfCritical(0.9) };

fn tip(model: &Model, state: &State) -> f64 {
    let numbering = Numbering::new(model);
    let end = |p: &Part| p.positions().iter().position(|x| (x - Vec3::new(9.0, 0.5, 0.0)).norm() < 1e-9);
    let (part, point) = (0..model.parts.len()).find_map(|k| Some((k, end(&model.parts[k])?))).unwrap();
    state.u[numbering.unknown(part, point, 1)]
}

/// What a watcher keeps of a snapshot.
struct Seen {
    time: f64,
    tip: f64,
    energies: Energies,
    switches: usize,
    momentum: Momentum,
    gap: f64,
    /// Sum of supports and ties in y, in N.
    reaction: f64,
}

fn see(model: Model, plan: &Plan) -> (Outcome, Vec<Seen>) {
    let mut seen = Vec::new();
    let outcome = run(model, plan, &mut |s: &Snapshot| -> Result<()> {
        let numbering = Numbering::new(s.model);
        let mass = lumped(s.model, &numbering)?;
        let upright = (0..numbering.len()).filter(|&i| numbering.locate(i).2 == 1);
        seen.push(Seen {
            time: s.state.time,
            tip: tip(s.model, s.state),
            energies: s.energies,
            switches: s.switches,
            momentum: Momentum::of(s.model, &mass, &s.state.v),
            gap: s.gap,
            reaction: upright.map(|i| s.reactions[i]).sum(),
        });
        Ok(())
    })
    .unwrap();
    (outcome, seen)
}

/// Largest difference of the tips over the largest tip.
fn apart(a: &[Seen], b: &[Seen]) -> f64 {
    let largest = a.iter().fold(0.0f64, |m, s| m.max(s.tip.abs()));
    a.iter().zip(b).fold(0.0f64, |m, (a, b)| m.max((a.tip - b.tip).abs())) / largest
}

/// The ramp with particles relaxed at the switch, so that it sets no fast modes going.
fn relaxed(stepping: Stepping) -> Plan<'static> {
    let mut plan = ramp(stepping);
    plan.switches[0].mode = Mode::ReEquilibrate;
    plan
}

#[test]
fn steppers_agree_on_the_ramp_and_their_energies_close() {
    let mut reference: Vec<Seen> = Vec::new();
    for (name, stepping) in [
        ("implicit", implicit(1600.0)),
        ("explicit", EXPLICIT),
        ("two rates", two_rates(GravouilCombescure, 1600.0)),
    ] {
        let began = std::time::Instant::now();
        let (outcome, seen) = see(cantilever(), &relaxed(stepping));
        println!(
            "{name}: {:.3?}, work {}, closure {:.1e}, switch {:.3} s, interface {:.1e} of strain",
            began.elapsed(),
            outcome.work.total(),
            outcome.worst_closure,
            outcome.switch_seconds,
            outcome.energies.interface / outcome.energies.strain
        );
        assert_eq!(seen.len(), 21);
        assert!(outcome.worst_closure < CLOSED, "{name}: {:e}", outcome.worst_closure);
        let (body, report) = &outcome.switches[0];
        assert_eq!((body.as_str(), outcome.switches.len()), ("middle", 1));
        assert!((report.time / (2.0 * period()) - 1.0).abs() < 1e-3, "{}", report.time);
        assert!(report.momentum_jump() < 1e-12, "{}", report.momentum_jump());
        assert!(report.angular_momentum_jump(9.0) < 1e-12, "{}", report.angular_momentum_jump(9.0));
        if reference.is_empty() {
            reference = seen;
            continue;
        }
        let off = apart(&reference, &seen);
        println!("{name}: tip within {off:.1e} of implicit steps");
        // The claim. Output falls on step boundaries up to half a step apart: 1e-5 of the ramp in explicit steps.
        assert!(off < 1e-3, "{name}: {off:e}");
    }
}

/// Two rates tie velocities. Where a switch sets fast modes going that a long step does not resolve, displacements drift apart by what
/// the ledger shows as work of the interface: energies close all the same.
#[test]
fn unresolved_modes_drift_through_two_rates_and_the_ledger_tells() {
    let (_, reference) = see(cantilever(), &ramp(implicit(400.0)));
    let widest = |seen: &[Seen]| seen.iter().fold(0.0f64, |m, s| m.max(s.gap));
    assert!(widest(&reference) < 1e-9, "one step ties displacements");
    for (method, least) in [(GravouilCombescure, 1e-3), (PrakashHjelmstad, 1e-2)] {
        let share = |plan: &Plan| {
            let (outcome, seen) = see(cantilever(), plan);
            assert!(outcome.worst_closure < CLOSED, "{:e}", outcome.worst_closure);
            let Energies { interface, strain, .. } = outcome.energies;
            let off = apart(&reference, &seen);
            println!("{method:?}: interface {:.1e} of strain, tip off {off:.1e}", interface / strain);
            (interface / strain).abs()
        };
        let moving = share(&ramp(two_rates(method, 400.0)));
        let still = share(&relaxed(two_rates(method, 400.0)));
        // Measured: 0.56 % and 27 % of the strain energy; relaxed −0.06 % and 5 %.
        assert!(moving > least && still < 0.5 * moving, "{method:?}: {moving:e} {still:e}");
    }
}

/// The load acts on the side of small steps then.
#[test]
fn loads_on_the_particles_close_at_two_rates() {
    for method in [GravouilCombescure, PrakashHjelmstad] {
        let end = rule(When::LoadLevel { factor: 0.5, block: block(6.0, 9.0) });
        let (outcome, _) = see(cantilever(), &Plan { switches: vec![end], ..ramp(two_rates(method, 200.0)) });
        assert!(outcome.worst_closure < CLOSED, "{method:?}: {:e}", outcome.worst_closure);
    }
}

/// The snapshot at the switch is of the model that goes on, velocities on the ties: momentum is still the old one.
#[test]
fn momentum_passes_the_switch() {
    let (outcome, seen) = see(cantilever(), &ramp(implicit(400.0)));
    let after = seen.iter().find(|s| s.switches == 1).unwrap();
    let before = outcome.switches[0].1.before;
    assert_eq!(after.time, outcome.switches[0].1.time);
    let lost = after.momentum - before.momentum;
    assert!(lost.linear.norm() < 1e-12 * before.momentum_scale, "{lost:?}");
    assert!(lost.angular.norm() < 1e-12 * 9.0 * before.momentum_scale, "{lost:?}");
    // Nested faces fit to rounding at the switch, and tied velocities keep them so.
    let widest = seen.iter().fold(0.0f64, |m, s| m.max(s.gap));
    assert!(widest < 1e-9 * after.tip.abs(), "{widest:e}");
}

#[test]
fn nothing_depends_on_output() {
    for stepping in [implicit(100.0), EXPLICIT] {
        let end = |outputs: usize| {
            run(cantilever(), &Plan { outputs, ..ramp(stepping) }, &mut |_| Ok::<_, Error>(()))
        };
        let (few, many) = (end(1).unwrap(), end(37).unwrap());
        assert_eq!(few.state, many.state);
        assert_eq!(few.energies, many.energies);
        assert_eq!(few.switches, many.switches);
    }
    let (outcome, seen) = see(cantilever(), &Plan { outputs: 9, ..ramp(implicit(4.0)) });
    assert_eq!(seen.len(), 5, "one snapshot per step boundary");
    assert!(outcome.notes.iter().any(|n| n.contains("5 outputs share")), "{:?}", outcome.notes);
}

#[test]
fn steps_end_at_the_end_and_say_so() {
    let end_s = 4.0 * period();
    let stepping = Stepping::Implicit { scheme: Scheme::TRAPEZOIDAL, step_s: end_s / 9.5 };
    let (outcome, seen) = see(cantilever(), &ramp(stepping));
    assert_eq!(outcome.state.time, end_s);
    assert_eq!(seen.last().unwrap().time, end_s);
    assert!(outcome.notes.iter().any(|n| n.contains("10 steps")), "{:?}", outcome.notes);
    // Half of the load is reached at the fifth of ten steps.
    assert!((outcome.switches[0].1.time / end_s - 0.5).abs() < 1e-12);
}

#[test]
fn dissipation_of_the_scheme_and_damping_close_too() {
    let sway = |_: usize, x: Vec3| Vec3::new(0.0, 0.01 * x.x * x.x / 81.0, 0.0);
    let hht = Stepping::Implicit { scheme: Scheme::hht(-0.2).unwrap(), step_s: period() / 50.0 };
    let lossy = Scheme { beta: 0.4, gamma: 0.7, alpha: 0.0 };
    let lossy = Stepping::Implicit { scheme: lossy, step_s: period() / 50.0 };
    let viscous = Damping::MassProportional { rate: 1.0 / period() };
    for (stepping, damping) in [
        (hht, Damping::None),
        (lossy, Damping::None),
        (hht, viscous),
        (implicit(200.0), viscous),
        (EXPLICIT, viscous),
        (EXPLICIT, Damping::NonViscous { share: 0.1 }),
    ] {
        let plan = Plan { damping, initial_velocity: Some(&sway), ..ramp(stepping) };
        let (outcome, seen) = see(cantilever(), &plan);
        assert!(outcome.worst_closure < CLOSED, "{stepping:?} {damping:?}: {:e}", outcome.worst_closure);
        let Energies { initial, .. } = seen[0].energies;
        // ½ρA v² over the length: v = 0.01 (x/L)², A = 0.5, to the mesh's accuracy (72 nodes, trapezoidal rule).
        assert!((initial / (0.5 * 0.5 * 1e-4 * 9.0 / 5.0) - 1.0).abs() < 1e-3, "{initial}");
        let damping = outcome.energies.damping;
        assert!(damping < -1e-4 * initial, "{stepping:?}: {damping:e} of {initial:e}");
    }
}

#[test]
fn equilibria_follow_the_load_and_supports_carry_it() {
    let (outcome, seen) = see(cantilever(), &ramp(Stepping::QuasiStatic { step_s: period() / 10.0 }));
    assert!(outcome.worst_closure < CLOSED, "{:e}", outcome.worst_closure);
    for s in &seen {
        assert_eq!(s.energies.kinetic, 0.0);
        // Forces of ties cancel; solves leave 1e-9 of the forces at most.
        assert!((s.reaction + 10.0 * s.time / (4.0 * period())).abs() < 1e-7, "{}: {}", s.time, s.reaction);
    }
    let sudden = Plan { loads: LoadFactor::Sudden, ..ramp(Stepping::QuasiStatic { step_s: period() }) };
    let (outcome, seen) = see(cantilever(), &sudden);
    assert!(outcome.worst_closure < CLOSED && seen[0].energies.initial > 0.0);
    assert_eq!(seen[0].switches, 1, "half of a sudden load is there at once");
}

#[test]
fn a_rule_at_time_zero_couples_from_the_start() {
    for when in [
        When::Time { time_s: 0.0, block: block(3.0, 6.0) },
        When::LoadLevel { factor: 0.0, block: block(3.0, 6.0) },
    ] {
        let plan = Plan { switches: vec![rule(when)], ..ramp(implicit(100.0)) };
        let (outcome, seen) = see(cantilever(), &plan);
        assert_eq!((seen[0].switches, outcome.switches[0].1.time), (1, 0.0));
        assert_eq!(outcome.energies.transfer, 0.0);
        assert!(outcome.worst_closure < CLOSED);
    }
}

#[test]
fn two_rules_at_one_time_both_act() {
    let at = |name: &str, from: f64, to: f64| SwitchRule {
        name: name.to_owned(),
        ..rule(When::Time { time_s: period(), block: block(from, to) })
    };
    let switches = vec![at("left", 2.0, 4.0), at("right", 5.0, 7.0)];
    let (outcome, _) = see(cantilever(), &Plan { switches, ..ramp(implicit(100.0)) });
    let names: Vec<&str> = outcome.model.parts.iter().map(Part::name).collect();
    assert_eq!(names, ["beam", "beam.left", "left", "beam.left.right", "right"]);
    assert!(outcome.worst_closure < CLOSED);
}

/// Square cells of the elements' size.
fn square(block: Block, _: Matter) -> Result<seam_solver::dem::network::Network> {
    let rows = (block.sides().y * 8.0).round() as usize;
    Ok(cubic(Space::Plane, block.min, block.max, rows, Skin::Weighted))
}

/// Asks where the bending stress is at least `strength_pa`; the clamp is held in x only, so that particles can take it over.
fn growing(strength_pa: f64, outputs: usize, stepping: Stepping) -> Plan<'static> {
    let indicator = Indicator::Stress { strength_pa: Some(strength_pa), length_m: 0.25 };
    let criterion = Criterion { indicator, trigger: 0.6, buffer_m: 0.25, memory: Memory::Irreversible };
    let every_s = period() / 4.0;
    let grow = SwitchRule {
        fill: &square,
        ..rule(When::Criterion { criterion, every_s, most: 3, through: [false; 3] })
    };
    Plan { switches: vec![grow], outputs, ..ramp(stepping) }
}

#[test]
fn a_region_grows_with_the_stress() {
    // Bending stress at the clamp under the full load: M/W = 90/(0.5/6) = 1080 Pa.
    let (outcome, seen) = see(cantilever(), &growing(1200.0, 12, implicit(400.0)));
    let names: Vec<&str> = outcome.switches.iter().map(|s| s.0.as_str()).collect();
    println!("{names:?} {:?}", outcome.switches.iter().map(|s| (s.1.time, s.1.elements)).collect::<Vec<_>>());
    let times: Vec<f64> = outcome.switches.iter().map(|s| s.1.time).collect();
    assert!(times.first() < times.last(), "it grows in several rounds: {times:?}");
    assert!(outcome.worst_closure < CLOSED, "{:e}", outcome.worst_closure);
    for (k, (name, report)) in outcome.switches.iter().enumerate() {
        assert_eq!(*name, if k == 0 { "middle".to_owned() } else { format!("middle-{}", k + 1) });
        assert!(report.momentum_jump() < 1e-12, "{name}: {:e}", report.momentum_jump());
    }
    assert_eq!(seen.last().unwrap().switches, outcome.switches.len());
    let left: usize = outcome
        .model
        .parts
        .iter()
        .filter_map(|p| match p {
            Part::Continuum(body) => Some(body.mesh.cell_count()),
            Part::Discrete { .. } => None,
        })
        .sum();
    assert_eq!(left + outcome.switches.iter().map(|s| s.1.elements).sum::<usize>(), 72 * 8);
    let (again, _) = see(cantilever(), &growing(1200.0, 5, implicit(400.0)));
    assert_eq!(again.state, outcome.state, "asked by its own clock, not by output");
    let (calm, _) = see(cantilever(), &growing(1e6, 1, implicit(40.0)));
    assert!(calm.switches.is_empty());
}

#[test]
fn growth_needs_multipliers_at_fine_steps() {
    let (outcome, _) = see(cantilever(), &growing(1200.0, 4, two_rates(GravouilCombescure, 400.0)));
    assert!(outcome.switches.len() > 1 && outcome.worst_closure < CLOSED);
    let plan = growing(1200.0, 4, two_rates(PrakashHjelmstad, 400.0));
    let refused = run(cantilever(), &plan, &mut |_| Ok::<_, Error>(())).unwrap_err();
    assert!(matches!(refused, Error::EmptyInterface { .. }), "{refused:?}");
    assert!(refused.to_string().contains("use Gravouil-Combescure, or implicit steps"), "{refused}");
}

#[test]
fn a_body_may_go_altogether() {
    let mut model = cantilever();
    model.supports.clear();
    prescribe(&mut model, |x| x.x == 0.0, |_| Vec3::zeros());
    let all = || vec![rule(When::Time { time_s: 2.0 * period(), block: block(0.0, 9.0) })];
    for stepping in [implicit(100.0), two_rates(GravouilCombescure, 100.0)] {
        let (outcome, _) = see(model.clone(), &Plan { switches: all(), ..ramp(stepping) });
        assert_eq!(outcome.model.parts.len(), 1);
        assert!(outcome.worst_closure < CLOSED, "{:e}", outcome.worst_closure);
    }
}
