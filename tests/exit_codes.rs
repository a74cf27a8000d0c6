//! One exit code for each way a run can end.

mod common;

use common::{call, pass, seam};
use std::fs;

#[test]
fn nothing_wrong_is_0() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "own-beam.toml", "bond-matrix", "--out"], home.path());
    pass(&["check", "--strict", "--from"], home.path());
}

#[test]
fn a_promise_not_kept_is_1_and_says_how_to_run_it_again() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "unmeetable.toml", "--out"], home.path());
    let check = call(&["check", "--from"], home.path());
    assert_eq!(check.code, Some(1), "{}", check.stdout);
    for part in ["FAILED unmeetable / deflection", "measured", "bound", "meaning", "seam run unmeetable.toml"]
    {
        assert!(check.stdout.contains(part), "'{part}' is not in:\n{}", check.stdout);
    }
}

#[test]
fn wrong_words_are_2() {
    for words in [
        &["chekc"][..],
        &["run", "bond-matrix", "--tier", "medium"],
        &["run", "--set", "parameters.a=1"],
        &["run", "patch-fe", "--set", "parameters.strain=1"],
        &["run", "no-such-scene.toml"],
        &["run", "own-beam.toml", "own-beam.toml"],
    ] {
        let output = seam().args(words).output().unwrap();
        assert_eq!(output.status.code(), Some(2), "seam {words:?}");
        assert!(!output.stderr.is_empty(), "seam {words:?} says nothing");
    }
}

#[test]
fn no_results_are_4() {
    let home = tempfile::tempdir().unwrap();
    for folder in [home.path().to_owned(), home.path().join("nowhere")] {
        for verb in ["check", "report"] {
            let outcome = call(&[verb, "--from"], &folder);
            assert_eq!(outcome.code, Some(4), "{}", outcome.stderr);
            assert!(outcome.stderr.contains("run cases first: seam run --out"), "{}", outcome.stderr);
        }
    }
}

#[test]
fn a_value_that_is_no_number_is_4() {
    for no_number in ["NaN", "null", "1e999"] {
        let home = tempfile::tempdir().unwrap();
        pass(&["run", "own-beam.toml", "--out"], home.path());
        let result = home.path().join("own-beam/result.json");
        let text = fs::read_to_string(&result).unwrap();
        let value = text.lines().find(|l| l.trim_start().starts_with("\"value\": -")).unwrap();
        fs::write(&result, text.replace(value, &format!("\"value\": {no_number},"))).unwrap();
        let check = call(&["check", "--from"], home.path());
        assert_eq!(check.code, Some(4), "{no_number}: {}{}", check.stdout, check.stderr);
        assert!(check.stderr.contains("own-beam/result.json"), "{}", check.stderr);
        assert!(check.stderr.contains("run the case again"), "{}", check.stderr);
    }
}

#[test]
fn half_a_result_is_4() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "bond-matrix", "--out"], home.path());
    let result = home.path().join("bond-matrix/result.json");
    let text = fs::read(&result).unwrap();
    fs::write(&result, &text[..text.len() / 2]).unwrap();
    assert_eq!(call(&["check", "--from"], home.path()).code, Some(4));
}

#[test]
fn an_own_claim_left_open_is_5_where_that_is_asked_for() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "undetermined.toml", "--out"], home.path());
    let lenient = pass(&["check", "--from"], home.path());
    assert!(lenient.stdout.contains("undetermined  close"), "{}", lenient.stdout);
    assert!(!lenient.stdout.contains("could not be run"), "both packings are measured: {}", lenient.stdout);
    assert_eq!(call(&["check", "--strict", "--from"], home.path()).code, Some(5));
}

#[test]
fn more_work_than_recorded_for_the_same_scene_is_3() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "bond-matrix", "--out"], home.path());
    let path = home.path().join("bond-matrix/result.json");
    let text = fs::read_to_string(&path).unwrap();
    let mut result: serde_json::Value = serde_json::from_str(&text).unwrap();
    let updates = &mut result["work"]["bond_updates"];
    *updates = (updates.as_u64().unwrap() + 1).into();
    fs::write(&path, result.to_string()).unwrap();
    let check = call(&["check", "--from"], home.path());
    assert_eq!(check.code, Some(3), "{}{}", check.stdout, check.stderr);
    for part in ["COSTS MORE bond-matrix", "recorded for the same scene", "seam run bond-matrix"] {
        assert!(check.stdout.contains(part), "'{part}' is not in:\n{}", check.stdout);
    }
}
