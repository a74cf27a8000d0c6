//! Verdicts over small families.

use super::*;
use seam_cases::result::Member;
use std::collections::BTreeMap;

fn text(pairs: &[(&str, &str)]) -> BTreeMap<String, String> {
    pairs.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect()
}

fn member(skin: &str, particles: usize, errors: &[(&str, f64)]) -> Member {
    Member {
        settings: text(&[("skin", skin), ("rows", &particles.to_string())]),
        errors: errors.iter().map(|(r, e)| ((*r).to_owned(), *e)).collect(),
        particles,
        ..Member::default()
    }
}

fn family(members: Vec<Member>, bound: f64) -> Family {
    Family {
        claim: "claim".into(),
        bound,
        members,
        readings: text(&[("a", "first"), ("b", "second")]),
        main_reading: "a".into(),
        axes: [("skin".to_owned(), vec![]), ("rows".to_owned(), vec![])].into(),
        paper_like: text(&[("skin", "full")]),
        ..Family::default()
    }
}

fn verdict_of(errors: &[[f64; 2]]) -> ClaimVerdict {
    let members =
        errors.iter().enumerate().map(|(i, [a, b])| member("full", 100 + i, &[("a", *a), ("b", *b)]));
    judge(&family(members.collect(), 0.07), None).verdict
}

#[test]
fn the_four_verdicts() {
    assert_eq!(verdict_of(&[[0.01, 0.02], [0.03, 0.07]]), ClaimVerdict::Supported);
    assert_eq!(verdict_of(&[[0.08, 0.09], [0.1, 0.2]]), ClaimVerdict::Contradicted);
    assert_eq!(verdict_of(&[[0.01, 0.09], [0.01, 0.02]]), ClaimVerdict::Conditional);
    let mut open = member("full", 100, &[("a", 0.069), ("b", 0.069)]);
    open.u = 0.01;
    let j = judge(&family(vec![open], 0.07), None);
    assert_eq!(j.verdict, ClaimVerdict::Undetermined);
    assert!(j.reason.contains("standard uncertainty below 0.061 %"), "{}", j.reason);
}

#[test]
fn a_run_without_a_number_is_not_measured() {
    for bad in [member("full", 100, &[("a", f64::NAN), ("b", 0.1)]), member("full", 100, &[("a", 0.1)])] {
        let j = judge(&family(vec![bad, member("full", 200, &[("a", 0.01), ("b", 0.01)])], 0.07), None);
        assert_eq!(j.verdict, ClaimVerdict::Undetermined);
        assert!(j.unmeasured.is_some());
    }
    assert!(judge(&family(vec![], 0.07), None).unmeasured.is_some());
}

#[test]
fn a_setting_that_could_not_be_run_keeps_a_claim_from_being_supported() {
    let failed = Member { failed: Some("mechanism".into()), ..member("weighted", 100, &[]) };
    let good = member("full", 100, &[("a", 0.01), ("b", 0.01)]);
    let j = judge(&family(vec![failed, good], 0.07), None);
    assert_eq!((j.verdict, j.unmeasured), (ClaimVerdict::Undetermined, None));
    assert!(j.reason.contains("1 setting could not be run"), "{}", j.reason);
}

#[test]
fn the_reason_names_share_readings_and_what_decides() {
    let members = vec![
        member("full", 57, &[("a", 0.15), ("b", 0.16)]),
        member("full", 202, &[("a", 0.099), ("b", 0.1)]),
        member("weighted", 57, &[("a", 0.03), ("b", 0.08)]),
        member("weighted", 202, &[("a", 0.007), ("b", 0.01)]),
    ];
    let j = judge(&family(members, 0.07), None);
    insta::assert_snapshot!(j.reason, @"50 % of 4 settings meet 7 % under the main reading, 25 % under the others. Skin decides: with weighted skin 100 % of settings meet 7 %, with full skin 0 %. The paper-like setting needs more than 202 particles for 7 %.");
}

#[test]
fn an_own_claim_is_held_to_the_cost_of_the_paper_like_setting() {
    let errors = |e: f64| [("a", e), ("b", e)];
    let paper = family(vec![member("full", 100, &errors(0.14)), member("full", 400, &errors(0.07))], 0.07);
    let own = |particles| Family {
        own: true,
        no_more_particles_than: Some("claim".into()),
        ..family(vec![member("weighted", particles, &errors(0.006))], 0.007)
    };
    let j = judge(&own(202), Some(&paper));
    assert_eq!(j.verdict, ClaimVerdict::Supported);
    assert!(j.reason.contains("needs about 400 particles") && j.reason.contains("2 times"), "{}", j.reason);
    assert_eq!(judge(&own(401), Some(&paper)).verdict, ClaimVerdict::Contradicted);
    assert!(judge(&own(202), None).unmeasured.is_some(), "no paper-like setting, no comparison");
}

#[test]
fn a_family_of_which_nothing_ran_is_unmeasured() {
    let failed = |particles| Member {
        failed: Some("the packing does not fit".into()),
        errors: BTreeMap::new(),
        ..member("full", particles, &[])
    };
    let j = judge(&family(vec![failed(57), failed(202)], 0.07), None);
    assert!(j.reason.contains("no member of the family could be run: the packing"), "{}", j.reason);
    let ran = member("full", 739, &[("a", 0.01), ("b", 0.01)]);
    assert!(judge(&family(vec![failed(57), ran], 0.07), None).unmeasured.is_none());
}
