//! `results.json`, records and exit codes.

use super::fixture;
use seam_reports::exit::Exit;
use seam_reports::judge::judge;
use seam_reports::record::{RecordState, Recorded};
use seam_reports::results::Results;
use seam_reports::verdict::{ClaimVerdict, Verdict};
use std::collections::BTreeMap;

/// The beam alone, judged against some records after a change.
fn beam(recorded: &Recorded, change: impl FnOnce(&mut seam_cases::result::CaseResult)) -> Results {
    let mut case = fixture::clamped_beam();
    change(&mut case);
    judge(&[case], fixture::provenance(), recorded)
}

fn untouched() -> Results {
    beam(&Recorded::default(), |_| ())
}

#[test]
fn results_survive_being_written_and_read() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("new/results.json");
    let results = fixture::results();
    results.write(&path).unwrap();
    assert_eq!(Results::read(&path).unwrap(), results);
    assert_eq!(std::fs::read_dir(path.parent().unwrap()).unwrap().count(), 1, "no temporary file stays");
}

#[test]
fn a_damaged_file_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("results.json");
    let other = Results { schema: "seam.results/0".into(), ..fixture::results() };
    other.write(&path).unwrap();
    assert!(Results::read(&path).unwrap_err().to_string().contains("seam.results/0"));
    std::fs::write(&path, "{").unwrap();
    assert!(Results::read(&path).is_err());
}

#[test]
fn only_machine_and_seconds_differ_between_runs() {
    let again = |seconds: f64| {
        let mut case = fixture::clamped_beam();
        case.seconds = seconds;
        case.families[0].members[0].seconds = seconds;
        case.costs[0].settings[0].points[0].seconds = seconds;
        let mut results = judge(&[case], fixture::provenance(), &Recorded::default());
        results.provenance.machine.processor = format!("cpu {seconds}");
        results.to_json().unwrap()
    };
    let (one, two) = (again(1.0), again(2.0));
    let differ: Vec<(&str, &str)> = one.lines().zip(two.lines()).filter(|(a, b)| a != b).collect();
    assert_eq!(differ.len(), 2, "{differ:?}");
    assert!(differ.iter().all(|(a, _)| a.contains("\"processor\"") || a.contains("\"seconds\"")));
}

#[test]
fn a_sound_run_passes_and_the_most_severe_failure_wins() {
    assert_eq!(untouched().exit(true), Exit::Pass);
    let none = Recorded::default();
    let bad_number = |c: &mut seam_cases::result::CaseResult| c.quantities[0].value *= 1.05;
    let not_a_number = |c: &mut seam_cases::result::CaseResult| c.quantities[1].value = f64::NAN;
    assert_eq!(beam(&none, bad_number).exit_code(false), 1);
    assert_eq!(beam(&none, not_a_number).exit_code(false), 4);
    let both = beam(&none, |c| {
        bad_number(c);
        not_a_number(c);
    });
    assert_eq!(both.exit_code(false), 4);
    assert_eq!(judge(&[], fixture::provenance(), &none).exit_code(false), 4, "no cases");
    let empty = seam_cases::result::CaseResult::default();
    assert_eq!(judge(&[empty], fixture::provenance(), &none).exit_code(false), 4, "nothing was compared");
}

#[test]
fn an_altered_reference_value_is_not_a_pass() {
    let r = beam(&Recorded::default(), |c| c.quantities[0].reference = Some(f64::NAN));
    assert_eq!(r.cases[0].quantities[0].verdict, Some(Verdict::Undetermined));
    assert_eq!(r.exit_code(false), 4);
}

#[test]
fn more_work_than_recorded_is_a_cost_regression() {
    let recorded = Recorded::default().updated(&untouched());
    assert_eq!(beam(&recorded, |_| ()).exit_code(true), 0);
    let more = |c: &mut seam_cases::result::CaseResult| c.work.bond_updates += 1;
    assert_eq!(beam(&recorded, more).exit_code(false), 3);
    let other_scene = |c: &mut seam_cases::result::CaseResult| {
        more(c);
        c.scene_hash = "00".repeat(32);
    };
    assert_eq!(beam(&recorded, other_scene).exit_code(false), 0, "another scene is not compared");
}

#[test]
fn a_papers_claim_is_red_only_when_its_record_changes() {
    let first = untouched();
    assert_eq!(first.cases[0].claims[0].verdict, ClaimVerdict::Conditional);
    assert_eq!(first.cases[0].claims[0].record, RecordState::Unrecorded);
    let recorded = Recorded::default().updated(&first);
    assert_eq!(beam(&recorded, |_| ()).cases[0].claims[0].record, RecordState::Same);
    let better = beam(&recorded, |c| {
        let errors: BTreeMap<String, f64> =
            c.families[0].readings.keys().map(|r| (r.clone(), 1e-4)).collect();
        for member in &mut c.families[0].members {
            member.errors.clone_from(&errors);
            member.failed = None;
        }
    });
    assert_eq!(better.cases[0].claims[0].record, RecordState::Changed);
    assert_eq!(better.exit_code(false), 1);
    let trimmed = beam(&recorded, |c| c.families[0].members.truncate(170));
    assert_eq!(trimmed.cases[0].claims[0].record, RecordState::OtherFamily);
    assert_eq!(trimmed.exit_code(false), 1);
}

#[test]
fn an_own_claim_must_be_supported() {
    let own = |factor: f64, u: f64| {
        beam(&Recorded::default(), |c| {
            for member in &mut c.families[1].members {
                member.errors.values_mut().for_each(|e| *e *= factor);
                member.u = u;
            }
        })
    };
    assert_eq!(own(1.0, 0.0).exit_code(true), 0);
    assert_eq!(own(10.0, 0.0).exit_code(false), 1);
    assert_eq!(own(1.0, 0.1).exit_code(false), 0, "undetermined is no failure by default");
    assert_eq!(own(1.0, 0.1).exit_code(true), 5);
}

#[test]
fn a_model_that_covers_too_little_of_the_reference_fails() {
    let short = beam(&Recorded::default(), |c| {
        c.curves[0].series[1].x.truncate(30);
        c.curves[0].series[1].y.truncate(30);
    });
    assert_eq!(short.cases[0].curves[0].verdict, Verdict::Fail);
    assert_eq!(short.exit_code(false), 1);
    let bare = beam(&Recorded::default(), |c| c.curves[0].series[1].y.clear());
    assert_eq!(bare.exit_code(false), 4);
}

#[test]
fn records_survive_being_written_and_read() {
    let recorded = Recorded::default().updated(&fixture::results());
    let text = recorded.to_toml().unwrap();
    assert_eq!(Recorded::parse(&text, "recorded.toml").unwrap(), recorded);
    assert!(Recorded::parse("schema = \"seam.recorded/9\"", "r.toml").is_err());
    assert!(Recorded::parse("schema = \"seam.recorded/1\"\ntypo = 1", "r.toml").is_err());
    Recorded::project().unwrap();
}
