//! The verbs of the command, as a user at a shell meets them.

mod common;

use common::{pass, scenes, seam};
use serde_json::Value;
use std::fs;

/// Words without a folder.
fn told(words: &[&str]) -> (Option<i32>, String, String) {
    let output = seam().args(words).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn help_names_the_verbs_and_the_exit_codes() {
    let (code, help, _) = told(&["--help"]);
    assert_eq!(code, Some(0));
    for word in ["validate", "list", "show", "run", "check", "report", "Exit codes:", "--strict"] {
        assert!(help.contains(word), "'{word}' is not in:\n{help}");
    }
}

#[test]
fn the_list_tells_what_a_case_is_and_needs() {
    let (code, text, _) = told(&["list", "--json"]);
    assert_eq!(code, Some(0));
    let list: Vec<Value> = serde_json::from_str(&text).unwrap();
    assert!(list.iter().any(|entry| entry["id"] == "clamped-beam-rotation"));
    for entry in &list {
        let keys: Vec<&str> = entry.as_object().unwrap().keys().map(String::as_str).collect();
        for key in ["id", "title", "tags", "tiers", "effects", "claims", "threads", "mem_mb", "minutes"] {
            assert!(keys.contains(&key), "{}: no '{key}' in {keys:?}", entry["id"]);
        }
        assert!(entry["minutes"].as_f64().unwrap() > 0.0 && entry["mem_mb"].as_u64().unwrap() > 0);
    }
    let (_, plain, _) = told(&["list"]);
    assert_eq!(plain.lines().count(), list.len());
}

#[test]
fn a_case_shows_its_page_and_its_scene() {
    let (code, text, _) = told(&["show", "bond-matrix"]);
    assert_eq!(code, Some(0));
    assert!(text.contains("# ") && text.contains("id = \"bond-matrix\""), "{text}");
}

#[test]
fn an_unknown_case_suggests_the_nearest() {
    for verb in ["show", "run"] {
        let (code, _, message) = told(&[verb, "bond-matrx"]);
        assert_eq!(code, Some(2));
        assert!(message.contains("no case 'bond-matrx'; did you mean 'bond-matrix'?"), "{message}");
    }
}

#[test]
fn a_case_is_run_checked_and_reported() {
    let home = tempfile::tempdir().unwrap();
    let out = home.path();
    let run = pass(&["run", "cook-membrane", "bond-matrix", "--out"], out);
    assert!(run.stderr.lines().any(|l| l.starts_with("1/2 ") || l.starts_with("2/2 ")), "{}", run.stderr);
    assert!(!run.stderr.contains('\x1b'), "a pipe gets plain lines: {}", run.stderr);
    for file in ["cook-membrane/result.json", "cook-membrane/panel.vtu", "bond-matrix/result.json"] {
        assert!(out.join(file).is_file(), "{file}");
    }

    let check = pass(&["check", "--from"], out);
    assert!(check.stdout.contains("tip-deflection") && check.stdout.contains("2 cases"), "{}", check.stdout);
    assert!(!check.stdout.contains('\x1b'), "no colours in a pipe: {}", check.stdout);

    pass(&["report", "--from"], out);
    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert!(page.contains("cook-membrane") && page.contains("<svg"));
    for loading in ["src=\"http", "href=\"http", "url(http", "@import", "<link", "src=\"//", "fetch("] {
        assert!(!page.contains(loading), "the page loads something: {loading}");
    }
}

#[test]
fn resume_keeps_what_is_there_and_runs_what_has_changed() {
    let home = tempfile::tempdir().unwrap();
    let result = home.path().join("bond-matrix/result.json");
    let written = || fs::metadata(&result).unwrap().modified().unwrap();
    pass(&["run", "bond-matrix", "--out"], home.path());
    let first = written();

    let again = pass(&["run", "bond-matrix", "--resume", "--out"], home.path());
    assert!(again.stderr.contains("bond-matrix: kept"), "{}", again.stderr);
    assert_eq!(written(), first);

    let full = pass(&["run", "bond-matrix", "--resume", "--tier", "full", "--out"], home.path());
    assert!(!full.stderr.contains("kept"), "another tier is another result: {}", full.stderr);
    pass(&["run", "bond-matrix", "--out"], home.path());
    assert!(written() > first, "without --resume the case runs again");
}

#[test]
fn quiet_says_nothing_on_standard_error() {
    let home = tempfile::tempdir().unwrap();
    let run = pass(&["run", "bond-matrix", "--quiet", "--out"], home.path());
    assert_eq!((run.stdout.as_str(), run.stderr.as_str()), ("", ""));
}

#[test]
fn set_changes_a_value_and_says_so_in_the_rerun_command() {
    let home = tempfile::tempdir().unwrap();
    let deflection = |words: &[&str]| {
        pass(words, home.path());
        let text = fs::read_to_string(home.path().join("own-beam/result.json")).unwrap();
        let result: Value = serde_json::from_str(&text).unwrap();
        let value = result["quantities"][0]["value"].as_f64().unwrap();
        (value, result["command"].as_str().unwrap().to_owned())
    };
    let (single, plain) = deflection(&["run", "own-beam.toml", "--out"]);
    let (double, changed) =
        deflection(&["run", "own-beam.toml", "--set", "parameters.force_N=2000", "--out"]);
    // The model is linear: only rounding is left.
    assert!((double / single - 2.0).abs() < 1e-9, "{single} {double}");
    assert!(!plain.contains("--set"), "{plain}");
    assert!(changed.contains("--set parameters.force_N=2000"), "{changed}");
}

#[test]
fn a_scene_of_ones_own_runs_checks_and_reports() {
    let home = tempfile::tempdir().unwrap();
    let scene = scenes().join("own-beam.toml");
    pass(&["run", scene.to_str().unwrap(), "--out"], home.path());
    let check = pass(&["check", "--from"], home.path());
    assert!(check.stdout.contains("1 passed, 0 failed"), "{}", check.stdout);
    pass(&["report", "--from"], home.path());
    let page = fs::read_to_string(home.path().join("report.html")).unwrap();
    assert!(page.contains("Deflection of the free end"));
}

#[test]
fn a_network_from_tables_runs() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "network.toml", "--out"], home.path());
    let text = fs::read_to_string(home.path().join("network/result.json")).unwrap();
    let result: Value = serde_json::from_str(&text).unwrap();
    // Two bars of length 1 m in line under F: U = F²L/2EA with A = π r².
    let exact = 1000f64.powi(2) * 2.0 / (2.0 * 30e9 * std::f64::consts::PI * 0.2f64.powi(2));
    let energy = result["quantities"][0]["value"].as_f64().unwrap();
    // Rounding of a few operations.
    assert!((energy / exact - 1.0).abs() < 1e-12, "{energy} {exact}");
}

#[test]
fn a_folder_that_cannot_be_written_is_told_before_anything_runs() {
    let home = tempfile::tempdir().unwrap();
    let file = home.path().join("taken");
    fs::write(&file, "mine").unwrap();
    let (code, _, message) = told(&["run", "bond-matrix", "--out", file.to_str().unwrap()]);
    assert_eq!(code, Some(2));
    assert!(message.contains("taken: ") && message.contains("name a folder"), "{message}");
    assert!(!message.contains("bond-matrix"), "the case has run: {message}");
    assert_eq!(fs::read_to_string(&file).unwrap(), "mine");
}

#[test]
fn a_case_that_fails_leaves_the_others_their_results() {
    let home = tempfile::tempdir().unwrap();
    let words = ["run", "mechanism.toml", "bond-matrix", "--out", home.path().to_str().unwrap()];
    let (code, _, message) = told(&words);
    assert_eq!(code, Some(2));
    assert!(message.contains("mechanism: failed") && message.contains("is free to move"), "{message}");
    assert!(home.path().join("bond-matrix/result.json").is_file());
    assert!(!home.path().join("mechanism").exists());
}

#[test]
fn each_curve_is_written_once() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "fe-fe-fe", "--out"], home.path());
    pass(&["report", "--from"], home.path());
    let names = fs::read_dir(home.path().join("fe-fe-fe")).unwrap();
    let mut names: Vec<_> = names.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    assert_eq!(names, ["deflection.csv", "left.vtu", "middle.vtu", "result.json", "right.vtu"]);
}
