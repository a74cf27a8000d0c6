//! Cases of notches and cracks: they hold, they repeat, and what they guard shows when it breaks.

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

fn holds_and_repeats(id: &str) {
    let [first, second] = [changed(id, &[]), changed(id, &[])];
    assert_eq!(outside(&first), Vec::<&str>::new(), "{id}");
    assert!(first.work.total() > 0 && !first.curves.is_empty(), "{id}");
    assert_eq!(
        (first.quantities, first.curves, first.work),
        (second.quantities, second.curves, second.work),
        "{id}"
    );
}

#[test]
fn the_notch_singularity_holds() {
    holds_and_repeats("notch-singularity");
}

#[test]
fn toughness_holds() {
    holds_and_repeats("toughness");
}

#[test]
fn notched_concrete_holds() {
    holds_and_repeats("notched-concrete");
}

#[test]
fn what_they_guard_shows_when_it_breaks() {
    let red = |id: &str, changes: &[&str], quantity: &str| {
        let result = changed(id, changes);
        assert!(outside(&result).contains(&quantity), "{id}: {:?}", outside(&result));
    };
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
