//! `seam check` as a gate: filters, views for CI, baselines, expected failures, and what has to be listed first.

mod common;

use common::{Outcome, call, pass, scenes, seam};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// Words with a folder at the end, then more.
fn check(folder: &Path, more: &[&str]) -> Outcome {
    let words = [&["check"], more, &["--from"]].concat();
    call(&words, folder)
}

fn text(path: PathBuf) -> String {
    fs::read_to_string(&path).unwrap_or_else(|e| panic!("{}: {e}", path.display()))
}

/// Changes a result that has been written.
fn edit(folder: &Path, case: &str, change: impl Fn(&mut Value)) {
    let path = folder.join(case).join("result.json");
    let mut result: Value = serde_json::from_str(&text(path.clone())).unwrap();
    change(&mut result);
    fs::write(path, result.to_string()).unwrap();
}

/// Bond matrix and a beam of one's own, run once.
fn two_cases() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "bond-matrix", "own-beam.toml", "--out"], home.path());
    home
}

#[test]
fn filters_choose_by_id_tag_effect_and_tier() {
    let told = |words: &[&str]| {
        let output = seam().args(words).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        (output.status.code(), text(output.stdout), text(output.stderr))
    };
    let ids = |words: &[&str]| -> Vec<String> {
        let (code, out, err) = told(&[&["list", "--json"], words].concat());
        assert_eq!(code, Some(0), "{err}");
        let list: Vec<Value> = serde_json::from_str(&out).unwrap();
        list.iter().map(|e| e["id"].as_str().unwrap().to_owned()).collect()
    };
    assert_eq!(ids(&["--tag", "calculix"]), ["calculix-elements"]);
    assert_eq!(ids(&["bond-matrix", "patch-fe", "--tag", "patch"]), ["patch-fe"]);
    let switched = ids(&["--effect", "substitution"]);
    assert!(switched.contains(&"ramp-transfer".to_owned()) && !switched.contains(&"patch-fe".to_owned()));
    assert!(ids(&["--tier", "quick"]).len() > 20);
    let (code, _, message) = told(&["list", "--tag", "calculx"]);
    assert_eq!(code, Some(2));
    assert!(message.contains("no case has the tag 'calculx'; did you mean 'calculix'?"), "{message}");

    let home = two_cases();
    let one = check(home.path(), &["bond-matrix"]);
    assert!(one.code == Some(0) && one.stdout.contains("1 case,"), "{}{}", one.stdout, one.stderr);
    let wrong = check(home.path(), &["bond-matrx"]);
    assert_eq!(wrong.code, Some(2));
    assert!(
        wrong.stderr.contains("no result of 'bond-matrx'; did you mean 'bond-matrix'?"),
        "{}",
        wrong.stderr
    );
    assert_eq!(check(home.path(), &["--tier", "full"]).code, Some(2));
}

#[test]
fn a_dry_run_says_what_would_run_and_runs_nothing() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path().join("out");
    let plan = pass(&["run", "--tag", "patch", "--dry-run", "--out"], &out);
    assert!(plan.stdout.contains("patch-fe") && plan.stdout.contains("mem_mb"), "{}", plan.stdout);
    assert!(!out.exists());
}

#[test]
fn only_what_failed_runs_again() {
    let home = two_cases();
    let again = |words: &[&str]| {
        call(&[&["run", "own-beam.toml", "bond-matrix", "--failed"], words].concat(), home.path())
    };
    assert!(again(&["--dry-run", "--out"]).stdout.contains("nothing to run"));
    edit(home.path(), "own-beam", |r| r["quantities"][0]["value"] = 1.0.into());
    let plan = again(&["--dry-run", "--out"]).stdout;
    assert!(plan.contains("own-beam") && !plan.contains("bond-matrix"), "{plan}");
    assert_eq!(again(&["--out"]).code, Some(0));
    assert!(again(&["--dry-run", "--out"]).stdout.contains("nothing to run"));
    fs::remove_dir_all(home.path().join("bond-matrix")).unwrap();
    assert!(again(&["--dry-run", "--out"]).stdout.contains("bond-matrix"), "what never ran has failed");
}

#[test]
fn a_ci_service_gets_junit_and_a_summary() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "unmeetable.toml", "bond-matrix", "--out"], home.path());
    assert_eq!(check(home.path(), &[]).code, Some(1));
    let xml = text(home.path().join("junit.xml"));
    assert!(xml.starts_with("<?xml") && xml.contains("<testsuite name=\"unmeetable\""), "{xml}");
    assert_eq!(xml.matches("<failure").count(), 1, "{xml}");
    assert!(
        xml.contains("rerun: seam run unmeetable.toml") && xml.contains("classname=\"seam.bond-matrix\""),
        "{xml}"
    );
    let summary = text(home.path().join("summary.md"));
    assert!(summary.starts_with("# Seam: failed") && summary.contains("**FAILED** unmeetable"), "{summary}");
    pass(&["check", "bond-matrix", "--from"], home.path());
    assert!(!text(home.path().join("junit.xml")).contains("<failure"));
}

/// What the failure is called, the exit code, and what is done to the run.
type Worse = (&'static str, i32, fn(&mut Value));

#[test]
fn a_baseline_tells_better_from_worse() {
    let home = two_cases();
    pass(&["check", "--from"], home.path());
    let baseline = home.path().join("before.json");
    fs::copy(home.path().join("results.json"), &baseline).unwrap();
    let against = |exit| {
        let outcome = check(home.path(), &["--baseline", baseline.to_str().unwrap()]);
        assert_eq!(outcome.code, Some(exit), "{}{}", outcome.stdout, outcome.stderr);
        outcome.stdout
    };
    assert!(against(0).contains("nothing is worse than it was"));

    let sound = text(home.path().join("own-beam/result.json"));
    let worse: [Worse; 4] = [
        ("CLOSER", 1, |r| {
            let q = &mut r["quantities"][0];
            q["value"] = (q["reference"].as_f64().unwrap() * 1.018).into();
        }),
        ("LOOSENED", 1, |r| r["quantities"][0]["accepted"] = serde_json::json!([-1.0, 1.0])),
        ("COSTS MORE", 3, |r| {
            let count = &mut r["work"]["factorisations"];
            *count = (count.as_u64().unwrap() + 1).into();
        }),
        ("FAILED", 1, |r| r["quantities"][0]["value"] = 1.0.into()),
    ];
    for (word, exit, change) in worse {
        edit(home.path(), "own-beam", change);
        let said = against(exit);
        assert!(said.starts_with("Against the baseline\n") && said.contains(word), "{word}:\n{said}");
        fs::write(home.path().join("own-beam/result.json"), &sound).unwrap();
    }
    let gone = check(home.path(), &["--baseline", "no-such.json"]);
    assert!(gone.code == Some(2) && gone.stderr.contains("no-such.json"), "{}", gone.stderr);
}

/// A scene with a quantity that fails, is known to, and then does not.
#[test]
fn an_expected_failure_is_no_failure_until_it_passes() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "known-failure.toml", "--out"], home.path());
    let known = check(home.path(), &["--strict"]);
    assert_eq!(known.code, Some(0), "{}", known.stdout);
    assert!(
        known.stdout.contains("xfail") && known.stdout.contains("1 failed as expected"),
        "{}",
        known.stdout
    );
    assert!(text(home.path().join("junit.xml")).contains("<skipped"));
    assert!(
        text(home.path().join("summary.md")).contains("**EXPECTED FAILURE** known-failure / deflection: ")
    );

    edit(home.path(), "known-failure", |r| r["quantities"][0]["value"] = 1.5.into());
    let alarm = check(home.path(), &[]);
    assert_eq!(alarm.code, Some(1));
    for part in ["PASSES AGAIN known-failure / deflection", "`expected_failures`", "a failure was expected"] {
        assert!(alarm.stdout.contains(part), "'{part}' is not in:\n{}", alarm.stdout);
    }
    edit(home.path(), "known-failure", |r| {
        r["expected_failures"] = serde_json::json!({ "deflexion": "a slip" })
    });
    assert_eq!(check(home.path(), &[]).code, Some(1), "a name that leads nowhere");
}

#[test]
fn iterations_have_a_tenth_and_other_counts_nothing() {
    let home = two_cases();
    let recorded = home.path().join("recorded.toml");
    fs::write(&recorded, "schema = \"seam.recorded/1\"\n").unwrap();
    let words = ["bless", "--accept", "--recorded", recorded.to_str().unwrap(), "--from"];
    pass(&words, home.path());
    let sound = text(home.path().join("own-beam/result.json"));
    let with = |counter: &str, factor: f64| {
        edit(home.path(), "own-beam", |r| {
            let count = &mut r["work"][counter];
            *count = ((count.as_u64().unwrap() as f64 * factor).round() as u64).into();
        });
        let outcome = check(home.path(), &["--recorded", recorded.to_str().unwrap()]);
        fs::write(home.path().join("own-beam/result.json"), &sound).unwrap();
        (outcome.code, outcome.stdout)
    };
    assert_eq!(with("solves", 1.0).0, Some(0));
    let (code, said) = with("solves", 3.0);
    assert!(code == Some(3) && said.contains("COSTS MORE own-beam / work"), "{said}");
    assert_eq!(with("element_updates", 1.1).0, Some(3), "not an iteration");
    let (code, said) = with("element_updates", 0.5);
    assert!(code == Some(0) && said.contains("less work than recorded: own-beam"), "{said}");
}

#[test]
fn the_most_severe_exit_code_wins() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "unmeetable.toml", "undetermined.toml", "bond-matrix", "--out"], home.path());
    let strict = || check(home.path(), &["--strict"]).code;
    edit(home.path(), "bond-matrix", |r| r["work"]["bond_updates"] = 1_000_000.into());
    assert_eq!(strict(), Some(1), "failed before cost and undetermined");
    fs::remove_dir_all(home.path().join("unmeetable")).unwrap();
    assert_eq!(strict(), Some(3), "cost before undetermined");
    edit(home.path(), "bond-matrix", |r| r["quantities"] = serde_json::json!([]));
    assert_eq!(strict(), Some(4), "not measured before all else");
}

#[test]
fn runs_in_turns_are_compared_with_another_program() {
    let own = env!("CARGO_BIN_EXE_seam");
    let gate = |slower: &str| {
        let words = ["gate", "bond-matrix", "--rounds", "5", "--slower", slower, "--binary", own];
        let output = seam().args(words).output().unwrap();
        (output.status.code(), String::from_utf8([output.stdout, output.stderr].concat()).unwrap())
    };
    // A program is neither a thousand times slower than itself nor a thousand times faster.
    let (code, said) = gate("1000");
    assert!(code == Some(0) && said.contains("nothing is worse than it was"), "{said}");
    let (code, said) = gate("0.001");
    assert!(code == Some(3) && said.contains("SLOWER than 0.001"), "{said}");
    // Too few for an interval: refused before anything is built.
    assert_eq!(
        seam().args(["gate", "--rounds", "4", "--binary", own]).output().unwrap().status.code(),
        Some(2)
    );
    let nowhere = seam().args(["gate", "--against", "no-such-commit"]).output().unwrap();
    assert_eq!(nowhere.status.code(), Some(2));
    assert!(String::from_utf8(nowhere.stderr).unwrap().contains("no-such-commit: no such commit"));
}

#[test]
fn defects_are_found_by_name() {
    let list = seam().args(["selftest", "--list"]).output().unwrap();
    let list = String::from_utf8(list.stdout).unwrap();
    assert!(list.lines().count() >= 25, "{list}");
    let some = ["flip-moment", "skip-skin-weights", "alter-a-hash", "one-sided-tolerance", "empty-case-list"];
    let output = seam().arg("selftest").args(some).output().unwrap();
    let said = String::from_utf8(output.stdout).unwrap();
    assert_eq!(output.status.code(), Some(0), "{said}");
    for name in some {
        assert!(said.lines().any(|l| l.starts_with(name) && l.contains(" red ")), "{name}:\n{said}");
    }
    assert_eq!(seam().args(["selftest", "halve-ie"]).output().unwrap().status.code(), Some(2));
    assert!(scenes().is_dir());
}
