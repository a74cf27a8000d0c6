//! Verification cases of dynamics and finite rotations: exact as they come, red when broken.

use seam_cases::catalogue;
use seam_cases::overrides::Override;
use seam_cases::procedures::run;
use seam_cases::result::CaseResult;
use seam_cases::scene::Tier;

fn changed(id: &str, changes: &[&str]) -> CaseResult {
    let changes: Vec<Override> = changes.iter().map(|c| Override::parse(c).unwrap()).collect();
    run(&catalogue::case(id, &changes).unwrap(), Tier::Quick).unwrap().result
}

fn outside(result: &CaseResult) -> Vec<&str> {
    let good = |value: f64, [low, high]: [f64; 2]| low <= value && value <= high;
    let bad =
        result.quantities.iter().filter(|q| q.accepted.is_some_and(|interval| !good(q.value, interval)));
    bad.map(|q| q.id.as_str()).collect()
}

const CASES: [&str; 9] = [
    "time-step-orders",
    "interface-reflection",
    "subcycling",
    "cantilever-eigenfrequencies",
    "bar-impact",
    "bar-sudden-load",
    "elastica",
    "roll-up",
    "rigid-rotation",
];

#[test]
fn they_hold_and_count_their_work() {
    for id in CASES.into_iter().chain(["long-run"]) {
        let result = changed(id, &[]);
        assert!(!result.quantities.is_empty() && result.work.total() > 0, "{id}");
        assert_eq!(outside(&result), Vec::<&str>::new(), "{id}");
    }
}

#[test]
fn they_repeat_bit_for_bit() {
    for id in CASES {
        let [first, second] = [changed(id, &[]), changed(id, &[])];
        assert_eq!(first.quantities, second.quantities, "{id}");
        assert_eq!((first.curves, first.work), (second.curves, second.work), "{id}");
    }
}

/// Settings for which theory no longer holds.
#[test]
fn what_they_guard_shows_when_it_breaks() {
    let red = |id: &str, changes: &[&str], quantity: &str| {
        let result = changed(id, changes);
        assert!(outside(&result).contains(&quantity), "{id}: {:?}", outside(&result));
    };
    // A pulse too short to have one frequency.
    red(
        "interface-reflection",
        &["parameters.width.value=0.3", "parameters.least_width_m.value=4"],
        "gc-1-4",
    );
    // A stout beam is not one.
    red("cantilever-eigenfrequencies", &["parameters.height_m.value=0.2"], "elements-3");
    // A beam that stretches.
    red("elastica", &["parameters.slenderness.value=300", "parameters.load_steps.value=16"], "deflection-5");
    // Steps too large for a spinning block to look conservative.
    red("long-run", &["parameters.step_share.value=1", "parameters.shake.value=5"], "swing-finite");
    // Particles few and far between smear the front.
    red("bar-sudden-load", &["parameters.cells.value=8"], "triangle-chain-half-step");
}
