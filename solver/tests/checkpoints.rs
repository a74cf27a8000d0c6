//! Runs that are stopped at a snapshot and go on from its bytes: the same bits, work and all.

mod common;

use common::cubic;
use common::ramp::{block, cantilever, implicit, period, ramp, rule, two_rates};
use seam_solver::dem::arrangement::Matter;
use seam_solver::dem::block::Block;
use seam_solver::dem::network::Network;
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::damping::Damping;
use seam_solver::dynamics::forces::Rotations;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::multirate::Method::{GravouilCombescure, PrakashHjelmstad};
use seam_solver::dynamics::newmark::Scheme;
use seam_solver::error::{Error, Result};
use seam_solver::model::{Model, Part, PointValue};
use seam_solver::simulation::{Outcome, Plan, Snapshot, Step, Stepping, SwitchRule, When, resume, run};
use seam_solver::space::{Space, Vec3};
use seam_solver::transfer::criterion::{Criterion, Indicator, Memory};

const EXPLICIT: Stepping = Stepping::Explicit { step: Step::ShareOfCritical(0.9) };

/// The end, and the debug text of every snapshot, which gives each number exactly.
struct Seen {
    outcome: Outcome,
    snapshots: Vec<String>,
    checkpoints: Vec<Vec<u8>>,
}

fn see(start: impl FnOnce(&mut dyn FnMut(&Snapshot) -> Result<()>) -> Result<Outcome>) -> Seen {
    let (mut snapshots, mut checkpoints) = (Vec::new(), Vec::new());
    let outcome = start(&mut |s: &Snapshot| {
        snapshots
            .push(format!("{:?} {:?} {:?} {:?} {}", s.state, s.energies, s.gap, s.reactions, s.switches));
        checkpoints.push(s.checkpoint());
        Ok(())
    });
    Seen { outcome: outcome.unwrap(), snapshots, checkpoints }
}

/// Stops at some snapshots and goes on from each.
fn goes_on(name: &str, model: &Model, plan: &Plan) {
    let whole = see(|watch| run(model.clone(), plan, watch));
    let count = whole.snapshots.len();
    assert!(whole.outcome.state.u.iter().any(|u| *u != 0.0), "{name}: nothing has moved");
    for at in [0, count / 3, count / 2, count - 2, count - 1] {
        let rest = see(|watch| resume(model.clone(), plan, &whole.checkpoints[at], watch));
        assert!(rest.snapshots == whole.snapshots[at + 1..], "{name}, from snapshot {at}: other snapshots");
        let [a, b] = [&whole.outcome, &rest.outcome];
        assert!(a.state == b.state && a.energies == b.energies, "{name}, from snapshot {at}");
        assert_eq!((a.work, a.worst_closure), (b.work, b.worst_closure), "{name}, from snapshot {at}");
        assert_eq!((&a.switches, &a.notes), (&b.switches, &b.notes), "{name}, from snapshot {at}");
    }
}

#[test]
fn every_stepping_goes_on_bit_by_bit_before_and_after_a_switch() {
    let hht = Stepping::Implicit { scheme: Scheme::hht(-0.2).unwrap(), step_s: period() / 25.0 };
    for (name, stepping, damping) in [
        ("implicit", implicit(100.0), Damping::MassProportional { rate: 1.0 / period() }),
        ("HHT", hht, Damping::None),
        ("explicit", EXPLICIT, Damping::NonViscous { share: 0.1 }),
        ("quasi-static", Stepping::QuasiStatic { step_s: period() / 10.0 }, Damping::None),
        ("Gravouil–Combescure", two_rates(GravouilCombescure, 100.0), Damping::None),
        ("Prakash–Hjelmstad", two_rates(PrakashHjelmstad, 100.0), Damping::None),
    ] {
        goes_on(name, &cantilever(), &Plan { damping, outputs: 6, ..ramp(stepping) });
    }
}

/// Square cells of the elements' size.
fn square(block: Block, _: Matter) -> Result<Network> {
    let rows = (block.sides().y * 8.0).round() as usize;
    Ok(cubic(Space::Plane, block.min, block.max, rows, Skin::Weighted))
}

/// The region has grown before some of the checkpoints and goes on growing after them.
#[test]
fn a_growing_region_goes_on_growing() {
    let indicator = Indicator::Stress { strength_pa: Some(1200.0), length_m: 0.25 };
    let criterion = Criterion { indicator, trigger: 0.6, buffer_m: 0.25, memory: Memory::Irreversible };
    let when = When::Criterion { criterion, every_s: period() / 4.0, most: 3, through: [false; 3] };
    let switches = vec![SwitchRule { fill: &square, ..rule(when) }];
    let plan = Plan { switches, outputs: 12, ..ramp(implicit(200.0)) };
    goes_on("growing", &cantilever(), &plan);
}

/// Particles alone, turning by any angle.
#[test]
fn finite_rotations_go_on_bit_by_bit() {
    let network = cubic(Space::Solid, Vec3::zeros(), Vec3::new(2.0, 1.0, 1.0), 2, Skin::Weighted);
    let held: Vec<usize> = network.faces["left"].clone();
    let tip = network.faces["right"][0];
    let parts = vec![Part::Discrete { name: "grains".to_owned(), network }];
    let place = |point, component, value| PointValue { part: 0, point, component, value };
    let supports = held.iter().flat_map(|&p| (0..6).map(move |c| place(p, c, 0.0))).collect();
    let loads = vec![place(tip, 1, 30.0), place(tip, 2, 20.0)];
    let model = Model { space: Space::Solid, parts, ties: Vec::new(), supports, loads };
    let end_s = 0.5 * period();
    let plan = Plan {
        end_s,
        loads: LoadFactor::Ramp { start_s: 0.0, rise_s: end_s },
        rotations: Rotations::Finite,
        outputs: 6,
        switches: Vec::new(),
        ..ramp(EXPLICIT)
    };
    goes_on("finite rotations", &model, &plan);
}

#[test]
fn another_model_another_plan_and_damage_are_refused() {
    let plan = || Plan { outputs: 4, ..ramp(implicit(40.0)) };
    let whole = see(|watch| run(cantilever(), &plan(), watch));
    // After the switch.
    let checkpoint = &whole.checkpoints[3];
    let refusal = |model: Model, plan: &Plan, bytes: &[u8]| {
        let error = resume(model, plan, bytes, &mut |_| Ok::<_, Error>(())).map(|_| ()).unwrap_err();
        assert!(matches!(error, Error::Checkpoint { .. }), "{error:?}");
        error.to_string()
    };
    let mut heavier = cantilever();
    heavier.loads[0].value = heavier.loads[0].value.next_up();
    assert!(refusal(heavier, &plan(), checkpoint).contains("another model or another plan"));
    let moved = vec![rule(When::LoadLevel { factor: 0.5, block: block(2.0, 6.0) })];
    for plan in [
        Plan { outputs: 5, ..plan() },
        Plan { switches: moved, ..plan() },
        Plan { switches: Vec::new(), ..plan() },
        Plan { stepping: implicit(41.0), ..plan() },
    ] {
        assert!(refusal(cantilever(), &plan, checkpoint).contains("another model or another plan"));
    }
    // The same plan, but what it packs is another network.
    let switches = vec![SwitchRule { fill: &square, ..plan().switches.remove(0) }];
    let message = refusal(cantilever(), &Plan { switches, ..plan() }, checkpoint);
    assert!(message.contains("another model or another plan"), "{message}");
    let mut broken = checkpoint.clone();
    broken[1000] ^= 1;
    assert!(refusal(cantilever(), &plan(), &broken).contains("damaged"));
}
