//! The hard cases: every one holds with its margins, and goes red when what it guards is broken.

mod common;

use common::{changed, outside};
use seam_cases::catalogue;
use seam_cases::result::CaseResult;

/// Ids of quantities outside of their interval and of margins below what is needed.
fn red(result: &CaseResult) -> Vec<String> {
    let small = |value: f64, needed: f64| value.is_nan() || value < needed;
    let margins = result.margins.iter().filter(|m| small(m.value, m.needed));
    let quantities = outside(result).into_iter().map(str::to_owned);
    quantities.chain(margins.map(|m| format!("margin {}", m.id))).collect()
}

fn holds(id: &str) {
    let result = changed(id, &[]);
    for m in &result.margins {
        let open = if m.open { "open" } else { "" };
        println!("{id:20} {:36} {:>11.4e} needed {:>9.2e} {open} {}", m.id, m.value, m.needed, m.how);
    }
    result.quantities.iter().for_each(|q| println!("{id:20} {:36} {:>11.4e}", q.id, q.value));
    println!("{id:20} {:.2} s {:?}", result.seconds, result.notes);
    assert!(!result.margins.is_empty() || !result.quantities.is_empty(), "{id}");
    assert_eq!(red(&result), Vec::<String>::new(), "{id}");
}

/// One test per case, and the list of all of them.
macro_rules! hard_cases {
    ($($name:ident: $id:literal),* $(,)?) => {
        const IDS: &[&str] = &[$($id),*];
        $(#[test]
        fn $name() {
            holds($id);
        })*
    };
}

hard_cases! {
    bad_states: "bad-states",
    bond_radius: "bond-radius",
    contact_after_break: "contact-after-break",
    critical_step: "critical-step",
    distorted_elements: "distorted-elements",
    interface_contrast: "interface-contrast",
    long_run: "long-run",
    near_incompressible: "near-incompressible",
    redundant_ties: "redundant-ties",
    reproducible: "reproducible",
    rigid_rotation: "rigid-rotation",
    single_break: "single-break",
    slender_beam: "slender-beam",
    stability_maps: "stability-maps",
    subcycling: "subcycling",
    transfer_at_peak: "transfer-at-peak",
}

#[test]
fn every_case_that_is_tagged_hard_is_tested() {
    let all = catalogue::list().unwrap();
    let tagged: Vec<String> =
        all.into_iter().filter(|e| e.tags.iter().any(|t| t == "hard")).map(|e| e.id).collect();
    assert_eq!(tagged, IDS);
}

/// Settings at which a hard case no longer holds.
#[test]
fn what_they_guard_shows_when_it_breaks() {
    let breaks = |id: &str, changes: &[&str], what: &str| {
        let result = changed(id, changes);
        assert!(red(&result).iter().any(|r| r == what), "{id}: {:?}", red(&result));
    };
    // A step that is longer than the contact.
    breaks("contact-after-break", &["parameters.step.value=1.5"], "squeezed-linear-plane");
    // Bending that is lost in the rounding of tension.
    breaks("bond-radius", &["parameters.slender.value=1e-6"], "modes-plane-0.000001");
    // Searches that end before what is needed.
    breaks("distorted-elements", &["parameters.aspect_to.value=50"], "margin modes-plain-plane");
    breaks("redundant-ties", &["parameters.condition_to.value=1e6"], "margin condition-plane");
}

#[test]
fn they_repeat_bit_for_bit() {
    for id in ["contact-after-break", "distorted-elements", "redundant-ties", "stability-maps"] {
        let [first, second] = [changed(id, &[]), changed(id, &[])];
        assert_eq!((&first.quantities, &first.margins), (&second.quantities, &second.margins), "{id}");
        assert_eq!((first.maps, first.work), (second.maps, second.work), "{id}");
    }
}
