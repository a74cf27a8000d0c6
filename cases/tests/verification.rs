//! Verification cases of dynamics, finite rotations, notches and cracks: they hold, they repeat, and what they guard shows when it
//! breaks.

mod common;

use common::{changed, outside};

fn hold_and_repeat(ids: &[&str]) {
    for id in ids {
        let [first, second] = [changed(id, &[]), changed(id, &[])];
        assert!(!first.quantities.is_empty() && first.work.total() > 0, "{id}");
        assert_eq!(outside(&first), Vec::<&str>::new(), "{id}");
        assert_eq!(first.quantities, second.quantities, "{id}");
        assert_eq!((first.curves, first.work), (second.curves, second.work), "{id}");
    }
}

#[test]
fn motion_holds_and_repeats_bit_for_bit() {
    hold_and_repeat(&[
        "time-step-orders",
        "interface-reflection",
        "subcycling",
        "cantilever-eigenfrequencies",
        "bar-impact",
        "bar-sudden-load",
        "elastica",
        "roll-up",
        "rigid-rotation",
    ]);
}

#[test]
fn cracks_hold_and_repeat_bit_for_bit() {
    hold_and_repeat(&["notch-singularity", "toughness", "notched-concrete"]);
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
    // The fit reaches where the other terms of the series count.
    red(
        "notch-singularity",
        &["parameters.fit_to.value=0.15", "parameters.fit_from.value=0.03"],
        "exponent-90",
    );
    // A crack in a mesh that does not resolve it.
    red(
        "notch-singularity",
        &["parameters.crack_finest.value=0.03", "parameters.crack_growth_quick.value=2"],
        "intensity-0.2",
    );
    // Calibrated on so coarse a lattice that the factor is another one.
    red("toughness", &["parameters.strip_rows_quick.value=4"], "grown-24");
    // A process zone smaller than a facet.
    red("notched-concrete", &["parameters.petersson_energy_J_m2.value=5"], "petersson-refined");
}
