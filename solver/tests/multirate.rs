//! Two time steps: energy of the interface, agreement with one step, refusals.

mod common;

use common::{Sandwich, prescribe};
use seam_solver::coupling::Method as Tying;
use seam_solver::dynamics::multirate::side::Stepping::{self, Explicit, Implicit};
use seam_solver::dynamics::multirate::{Ledger, Method, Multirate, Rates};
use seam_solver::dynamics::newmark::{Newmark, Scheme, start};
use seam_solver::dynamics::semidiscrete::{Motion, Semidiscrete};
use seam_solver::model::{Model, PointValue};
use seam_solver::space::Vec3;
use seam_solver::work::Work;

fn cantilever() -> Model {
    let mut model = Sandwich::plane(4, 4, 4, Tying::Pointwise).model();
    prescribe(&mut model, |x| x.x < 1e-9, |_| Vec3::zeros());
    for point in [3, 7, 11, 15, 19] {
        model.loads.push(PointValue { part: 2, point, component: 1, value: -10.0 });
    }
    model
}

/// A fifth of what the particles bear (about 5e-5 s), so that coarse steps of 100 still follow the load.
const FINE: f64 = 1e-5;

fn rates(method: Method, ratio: usize, coarse: Stepping) -> Rates {
    Rates { method, coarse_step: FINE * ratio as f64, ratio, coarse, fine: Explicit, fine_parts: vec![1] }
}

struct Run {
    ledger: Ledger,
    /// Largest algorithmic energy.
    largest: f64,
    /// Largest gain of algorithmic energy from the interface in one step.
    gain: f64,
    motion: Motion,
    /// Kinetic and strain energy at the end.
    energy: f64,
}

/// Runs a load that rises over 0.01 s and then stays, up to `end` (s).
fn run(rates: &Rates, end: f64) -> Run {
    let model = cantilever();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let n = system.mass.len();
    let (rest, lambda) = start(&system, (vec![0.0; n], vec![0.0; n]), 0.0, 0.0, 0.0, &mut work).unwrap();
    let mut run = Multirate::new(&model, &system, rates, (&rest, lambda), &mut work).unwrap();
    let (mut largest, mut gain) = (0.0f64, f64::MIN);
    let mut last = 0.0;
    for _ in 0..(end / rates.coarse_step).round() as usize {
        run.step(|t| (t / 0.01).min(1.0), &mut work).unwrap();
        largest = largest.max(run.ledger().algorithmic);
        gain = gain.max(run.ledger().interface - last);
        last = run.ledger().interface;
    }
    let motion = run.motion();
    let energy = system.kinetic(&motion.v) + system.strain(&motion.u);
    Run { ledger: run.ledger(), largest, gain, motion, energy }
}

#[test]
fn prakash_hjelmstad_takes_no_algorithmic_energy_at_any_ratio() {
    for ratio in [1, 2, 5, 10, 50, 100] {
        let Run { ledger, largest, energy, .. } =
            run(&rates(Method::PrakashHjelmstad, ratio, Implicit), 0.02);
        // The claim is 1e-8; sums of thousands of terms at rounding stay far below.
        assert!(ledger.interface.abs() < 1e-8 * largest, "{ratio}: {:e}", ledger.interface / largest);
        let closure = ledger.algorithmic - ledger.external - ledger.interface;
        assert!(closure.abs() < 1e-8 * largest, "{ratio}: {:e}", closure / largest);
        println!(
            "PH m={ratio}: interface {:.1e}, physical {:.1e} of the energy, gap {:.1e} m",
            ledger.interface / largest,
            ledger.physical_interface / energy,
            ledger.gap
        );
    }
}

#[test]
fn gravouil_combescure_never_gives_energy() {
    for ratio in [1, 2, 5, 10, 50, 100] {
        let Run { ledger, largest, gain, .. } =
            run(&rates(Method::GravouilCombescure, ratio, Implicit), 0.02);
        assert!(gain < 1e-10 * largest, "{ratio}: {:e}", gain / largest);
        let closure = ledger.algorithmic - ledger.external - ledger.interface;
        assert!(closure.abs() < 1e-8 * largest, "{ratio}: {:e}", closure / largest);
        if ratio == 1 {
            assert!(ledger.interface.abs() < 1e-10 * largest, "equal steps: nothing lost");
        } else {
            assert!(ledger.interface < -1e-8 * largest, "{ratio}: dissipation is seen");
        }
        println!("GC m={ratio}: interface {:.1e}", ledger.interface / largest);
    }
}

/// Both methods, ratios and schemes against one implicit step of the fine size.
#[test]
fn both_methods_agree_with_one_step_for_all() {
    let model = cantilever();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let n = system.mass.len();
    let (mut whole, _) = start(&system, (vec![0.0; n], vec![0.0; n]), 0.0, 0.0, 0.0, &mut work).unwrap();
    let newmark = Newmark::new(&system, Scheme::TRAPEZOIDAL, FINE, 0.0, &mut work).unwrap();
    let factor = |t: f64| (t / 0.01).min(1.0);
    for k in 0..1000 {
        newmark.step(&mut whole, [k, k + 1].map(|k| factor(k as f64 * FINE)), &mut work).unwrap();
    }
    let scale = whole.u.iter().fold(0.0f64, |m, u| m.max(u.abs()));
    for (method, ratio, coarse) in [
        (Method::PrakashHjelmstad, 1, Explicit),
        (Method::GravouilCombescure, 1, Explicit),
        (Method::PrakashHjelmstad, 10, Implicit),
        (Method::GravouilCombescure, 10, Implicit),
        (Method::PrakashHjelmstad, 2, Explicit),
    ] {
        let Run { motion, .. } = run(&rates(method, ratio, coarse), 0.01);
        let far = motion.u.iter().zip(&whole.u).fold(0.0f64, |m, (a, b)| m.max((a - b).abs())) / scale;
        // Second order in a step of 1e-4 s against a first period of about 0.1 s and second of 0.02 s.
        assert!(far < 1e-3, "{method:?} {ratio} {coarse:?}: {far:e}");
    }
}

#[test]
fn steps_and_sides_that_do_not_fit_are_refused() {
    let model = cantilever();
    let mut work = Work::default();
    let system = Semidiscrete::new(&model, &mut work).unwrap();
    let n = system.mass.len();
    let rest = Motion { time: 0.0, u: vec![0.0; n], v: vec![0.0; n], a: vec![0.0; n] };
    let sound = rates(Method::PrakashHjelmstad, 10, Implicit);
    let mut refusal = |rates: Rates| {
        let lambda = vec![0.0; system.rows.len()];
        Multirate::new(&model, &system, &rates, (&rest, lambda), &mut work)
            .map(|_| ())
            .unwrap_err()
            .to_string()
    };
    assert!(refusal(Rates { ratio: 0, ..sound.clone() }).contains("at least one fine step"));
    assert!(refusal(Rates { fine_parts: vec![7], ..sound.clone() }).contains("no free unknowns"));
    assert!(refusal(Rates { coarse_step: f64::NAN, ..sound.clone() }).contains("positive step"));
    assert!(refusal(Rates { coarse_step: 1e-2, ..sound.clone() }).contains("beyond the critical one"));
    assert!(refusal(Rates { fine_parts: vec![0, 1], ..sound }).contains("fine side to each other"));
}
