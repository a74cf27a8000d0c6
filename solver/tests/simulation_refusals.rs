//! What a run in time refuses, and that it says where and what to do.

mod common;

use common::cubic;
use common::ramp::{block, cantilever, implicit, period, ramp, rule, two_rates};
use seam_solver::dem::skin::Skin;
use seam_solver::dynamics::critical;
use seam_solver::dynamics::damping::Damping;
use seam_solver::dynamics::forces::Rotations;
use seam_solver::dynamics::load::LoadFactor;
use seam_solver::dynamics::multirate::Method;
use seam_solver::dynamics::newmark::Scheme;
use seam_solver::error::Error;
use seam_solver::model::{Model, Part};
use seam_solver::simulation::{Plan, Snapshot, Step, Stepping, SwitchRule, When, run};
use seam_solver::space::{Space, Vec3};
use seam_solver::transfer::criterion::{Criterion, Indicator, Memory};

fn refusal_of(model: Model, plan: &Plan) -> Error {
    let mut seen = 0;
    let error = run(model, plan, &mut |_| {
        seen += 1;
        Ok::<_, Error>(())
    })
    .map(|_| ())
    .unwrap_err();
    assert_eq!(seen, 0, "refused before anything ran: {error}");
    error
}

fn refusal(plan: &Plan) -> String {
    refusal_of(cantilever(), plan).to_string()
}

/// The ramp with one rule.
fn switched(rule: SwitchRule<'static>) -> Plan<'static> {
    Plan { switches: vec![rule], ..ramp(implicit(20.0)) }
}

#[test]
fn a_step_above_the_critical_one() {
    let bound = critical::bound(&cantilever()).unwrap();
    let plan = |step| ramp(Stepping::Explicit { step });
    let error = refusal_of(cantilever(), &plan(Step::Seconds(1.5 * bound.step_s)));
    let Error::UnstableStep { critical_s, ref what, .. } = error else { panic!("{error:?}") };
    assert!(critical_s == bound.step_s && what.contains("body 'beam'"), "{error}");
    for share in [0.0, 1.01, f64::NAN] {
        assert!(refusal(&plan(Step::ShareOfCritical(share))).contains("share of the critical step"));
    }
    assert!(refusal(&plan(Step::Seconds(-1.0))).contains("positive step"));
}

/// A step that suits the elements need not suit the particles that come.
#[test]
fn a_step_that_a_switch_makes_unstable() {
    let step_s = 0.9 * critical::bound(&cantilever()).unwrap().step_s;
    for stepping in [
        Stepping::Explicit { step: Step::Seconds(step_s) },
        Stepping::TwoRates {
            method: Method::GravouilCombescure,
            scheme: Scheme::TRAPEZOIDAL,
            step_s: period() / 100.0,
            fine: Step::Seconds(step_s),
        },
    ] {
        let error = run(cantilever(), &ramp(stepping), &mut |_| Ok::<_, Error>(())).unwrap_err();
        assert!(matches!(&error, Error::UnstableStep { what, .. } if what.contains("'middle'")), "{error}");
    }
}

#[test]
fn rules_that_cannot_switch() {
    let at = |time_s: f64, from: f64, to: f64| rule(When::Time { time_s, block: block(from, to) });
    let end = 4.0 * period();
    assert!(refusal(&switched(at(0.1, 20.0, 21.0))).contains("no element has its centre"));
    assert!(refusal(&switched(at(1.1 * end, 3.0, 6.0))).contains("switch within it"));
    assert!(refusal(&switched(at(f64::NAN, 3.0, 6.0))).contains("switch within it"));
    let level = |factor| rule(When::LoadLevel { factor, block: block(3.0, 6.0) });
    assert!(refusal(&switched(level(1.5))).contains("does not reach 1.5"));
    let missing = refusal(&switched(SwitchRule { body: "bridge".to_owned(), ..at(0.1, 3.0, 6.0) }));
    assert!(missing.contains("no body 'bridge'; there are: beam"), "{missing}");
    assert!(
        refusal(&switched(SwitchRule { name: "beam".to_owned(), ..at(0.1, 3.0, 6.0) }))
            .contains("a body has")
    );
    let twice = Plan { switches: vec![at(0.1, 3.0, 6.0), at(0.2, 6.0, 7.0)], ..ramp(implicit(20.0)) };
    assert!(refusal(&twice).contains("rule 'middle': another rule has this name"));
    let network = cubic(Space::Plane, Vec3::zeros(), Vec3::new(9.0, 1.0, 0.0), 4, Skin::Weighted);
    let parts = vec![Part::Discrete { name: "beam".to_owned(), network }];
    let grains = Model { parts, supports: Vec::new(), loads: Vec::new(), ..cantilever() };
    assert!(refusal_of(grains, &switched(at(0.1, 3.0, 6.0))).to_string().contains("of particles already"));
}

#[test]
fn a_region_that_another_rule_took() {
    let at = |name: &str, time_s: f64, from: f64, to: f64| SwitchRule {
        name: name.to_owned(),
        ..rule(When::Time { time_s, block: block(from, to) })
    };
    let switches = vec![at("first", 0.1, 3.0, 6.0), at("second", 0.2, 4.0, 5.0)];
    let plan = Plan { switches, ..ramp(implicit(20.0)) };
    let error = run(cantilever(), &plan, &mut |_| Ok::<_, Error>(())).unwrap_err().to_string();
    assert!(error.contains("rule 'second': no elements of body 'beam' are left"), "{error}");
}

#[test]
fn criteria_that_cannot_choose() {
    let asking = |strength_pa: Option<f64>, every_s: f64, most: usize| {
        let indicator = Indicator::Stress { strength_pa, length_m: 0.2 };
        let criterion = Criterion { indicator, trigger: 0.5, buffer_m: 0.0, memory: Memory::Irreversible };
        refusal(&switched(rule(When::Criterion { criterion, every_s, most, through: [false; 3] })))
    };
    assert!(asking(None, 0.1, 1).contains("set strength_Pa"));
    assert!(asking(Some(1.0), 0.0, 1).contains("asked every 0 s"));
    assert!(asking(Some(1.0), 5.0 * period(), 1).contains("at most the"));
    assert!(asking(Some(1.0), 0.1, 0).contains("at least one"));
}

#[test]
fn runs_without_end_output_or_load() {
    let sound = || ramp(implicit(20.0));
    assert!(refusal(&Plan { outputs: 0, ..sound() }).contains("outputs = 0"));
    for end_s in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(refusal(&Plan { end_s, ..sound() }).contains("end_s"));
    }
    let late = LoadFactor::Ramp { start_s: 5.0 * period(), rise_s: 1.0 };
    assert!(refusal(&Plan { loads: late, ..sound() }).contains("begin it earlier"));
    let still = |_: usize, _: Vec3| Vec3::zeros();
    let pushed = Plan { initial_velocity: Some(&still), ..ramp(Stepping::QuasiStatic { step_s: 0.1 }) };
    assert!(refusal(&pushed).contains("initial velocity"));
}

#[test]
fn damping_schemes_and_rotations_that_do_not_fit() {
    let damped = |damping, stepping| refusal(&Plan { damping, ..ramp(stepping) });
    let local = Damping::NonViscous { share: 0.1 };
    assert!(damped(local, implicit(20.0)).contains("needs explicit steps"));
    let viscous = Damping::MassProportional { rate: 1.0 };
    assert!(
        damped(viscous, two_rates(Method::GravouilCombescure, 20.0)).contains("two rates know no damping")
    );
    assert!(damped(viscous, Stepping::QuasiStatic { step_s: 0.1 }).contains("nothing to damp"));
    let with = |beta, gamma, alpha| {
        refusal(&ramp(Stepping::Implicit { scheme: Scheme { beta, gamma, alpha }, step_s: 0.01 }))
    };
    assert!(with(0.25, 0.4, 0.0).contains("gamma = 0.4"));
    assert!(with(0.2, 0.5, 0.0).contains("beta = 0.2"));
    assert!(with(0.5, 0.9, -0.5).contains("alpha = -0.5"));
    let hht = Stepping::TwoRates {
        method: Method::GravouilCombescure,
        scheme: Scheme::hht(-0.1).unwrap(),
        step_s: 0.01,
        fine: Step::ShareOfCritical(0.9),
    };
    assert!(refusal(&ramp(hht)).contains("trapezoidal rule"));
    let explicit = Stepping::Explicit { step: Step::ShareOfCritical(0.9) };
    let error = refusal_of(cantilever(), &Plan { rotations: Rotations::Finite, ..ramp(explicit) });
    assert!(matches!(&error, Error::Formulation { body, .. } if body == "beam"), "{error}");
    let network = cubic(Space::Plane, Vec3::zeros(), Vec3::new(2.0, 1.0, 0.0), 4, Skin::Weighted);
    let parts = vec![Part::Discrete { name: "grains".to_owned(), network }];
    let grains = Model { parts, supports: Vec::new(), loads: Vec::new(), ..cantilever() };
    let plan = Plan { rotations: Rotations::Finite, switches: Vec::new(), ..ramp(implicit(20.0)) };
    let error = refusal_of(grains, &plan).to_string();
    assert!(error.contains("'grains': finite rotations of its particles need explicit steps"), "{error}");
}

/// What stops a watcher stops the run, in the watcher's own words.
#[test]
fn a_watcher_may_stop_a_run() {
    #[derive(Debug, PartialEq)]
    enum Stop {
        Full(usize),
        Solver(Error),
    }
    impl From<Error> for Stop {
        fn from(error: Error) -> Self {
            Stop::Solver(error)
        }
    }
    let mut seen = 0;
    let stopped = run(cantilever(), &ramp(implicit(20.0)), &mut |_: &Snapshot| {
        seen += 1;
        if seen == 3 { Err(Stop::Full(seen)) } else { Ok(()) }
    });
    assert_eq!(stopped.map(|_| ()).unwrap_err(), Stop::Full(3));
    let none = Plan { outputs: 0, ..ramp(implicit(20.0)) };
    let refused = run(cantilever(), &none, &mut |_| Ok::<_, Stop>(())).map(|_| ()).unwrap_err();
    assert!(matches!(refused, Stop::Solver(Error::Material { .. })), "{refused:?}");
}
