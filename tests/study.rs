//! `seam study` on a user's own scenes: results beside the runs, resumable, judged with them.

mod common;

use common::{call, files, pass, seam};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn study(kind: &str, words: &[&str], home: &Path) -> common::Outcome {
    let output = seam().args(["study", kind]).args(words).arg("--out").arg(home).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    common::Outcome { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

fn json(path: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(path).unwrap()).unwrap()
}

#[test]
fn an_effect_left_out_that_the_scene_calls_for_is_1_and_not_trusted() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "left-out.toml", "--out"], home.path());
    let check = call(&["check", "--from"], home.path());
    assert_eq!(check.code, Some(1), "{}", check.stdout);
    for part in ["NOT TRUSTED left-out / inertia", "the scene calls for inertia", "seam run left-out.toml"] {
        assert!(check.stdout.contains(part), "'{part}' is not in:\n{}", check.stdout);
    }
    let results = json(&home.path().join("results.json"));
    assert_eq!(results["cases"][0]["trusted"], false);
    // With what it calls for, and with the choice left to its tables, it is trusted.
    for effects in [r#"["inertia"]"#, r#"["auto"]"#] {
        let home = tempfile::tempdir().unwrap();
        pass(&["run", "left-out.toml", "--set", &format!("effects={effects}"), "--out"], home.path());
        pass(&["check", "--from"], home.path());
        assert_eq!(json(&home.path().join("results.json"))["cases"][0]["trusted"], true);
    }
}

#[test]
fn a_judged_number_of_a_variant_is_trusted_only_if_the_variant_is() {
    let variant = r#"variants.still={ effects = [] }"#;
    let judged = r#", accept = { interval = [-1, 0], why = "Any deflection: what is tested is trust." }"#;
    for (accept, code, trusted) in [(judged, Some(1), false), ("", Some(0), true)] {
        let home = tempfile::tempdir().unwrap();
        let quantity =
            format!(r#"quantities.still={{ label = "Still", probe = "tip", variants = ["still"]{accept} }}"#);
        let sets = [r#"effects=["auto"]"#, variant, &quantity].map(|set| ["--set", set]).concat();
        pass(&[&["run", "left-out.toml"], &sets[..], &["--out"]].concat(), home.path());
        let check = call(&["check", "--from"], home.path());
        assert_eq!(check.code, code, "{}", check.stdout);
        assert_eq!(
            check.stdout.contains("NOT TRUSTED left-out / inertia (still)"),
            !trusted,
            "{}",
            check.stdout
        );
        assert_eq!(json(&home.path().join("results.json"))["cases"][0]["trusted"], trusted);
    }
}

#[test]
fn effects_that_cannot_be_switched_say_why() {
    for (effects, message) in [
        (r#"["inertai"]"#, "did you mean 'inertia'"),
        (r#"["auto", "inertia"]"#, "\"auto\" stands alone"),
        (r#"["inertia", "damping"]"#, "does not say how it is damped"),
        (r#"["damping"]"#, "needs inertia"),
        (r#"["substitution"]"#, "no switch says"),
        (r#"["rotation-coupling"]"#, "there is no tie"),
    ] {
        let words = ["run", "left-out.toml", "--set", &format!("effects={effects}")];
        let output = seam().args(words).output().unwrap();
        let said = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{said}");
        assert!(said.contains(message) && said.contains("effects"), "'{message}' is not in:\n{said}");
    }
}

#[test]
fn each_effect_is_switched_on_and_off_and_a_finished_study_is_kept() {
    let home = tempfile::tempdir().unwrap();
    let scene = ["left-out.toml", "--set", r#"effects=["auto"]"#];
    let first = study("effects", &scene, home.path());
    assert_eq!(first.code, Some(0), "{}{}", first.stdout, first.stderr);
    let found = json(&home.path().join("studies/effects/left-out.json"));
    let ablations = found["ablations"].as_array().unwrap();
    assert_eq!(ablations.len(), 8);
    let inertia = ablations.iter().find(|a| a["effect"] == "inertia").unwrap();
    assert_eq!(inertia["without"]["called_for"], true);
    assert_eq!(inertia["without"]["counter"], 0);
    assert!(inertia["changes"][0]["change"].as_f64().unwrap() > 0.1, "a sudden load swings to twice");
    assert!(first.stdout.contains("is called for"), "{}", first.stdout);
    // Once more: the parts are kept, and nothing changes.
    let before = files(&home.path().join("studies/effects/left-out"));
    let again = study("effects", &[&scene[..], &["--resume"]].concat(), home.path());
    assert!(again.stderr.matches(": kept").count() == 8, "{}", again.stderr);
    assert_eq!(before, files(&home.path().join("studies/effects/left-out")));
}

#[test]
fn cost_is_studied_without_anything_declared_and_joins_the_run() {
    let home = tempfile::tempdir().unwrap();
    let coarse =
        ["own-beam.toml", "--set", "bodies.clamped.fe.divisions=[5, 1]", "--set", "bodies.free.de.rows=2"];
    pass(&[&["run"], &coarse[..], &["--out"]].concat(), home.path());
    let cost = study("cost", &coarse, home.path());
    assert_eq!(cost.code, Some(0), "{}{}", cost.stdout, cost.stderr);
    assert!(cost.stdout.contains("error ≤ 1 %"), "{}", cost.stdout);
    let found = json(&home.path().join("studies/cost/own-beam.json"));
    let settings = found["costs"][0]["settings"].as_array().unwrap();
    let names: Vec<&str> = settings.iter().map(|s| s["name"].as_str().unwrap()).collect();
    assert!(names.contains(&"as given") && names.len() >= 2, "{names:?}");
    for setting in settings {
        assert!(setting["points"].as_array().unwrap().len() >= 4, "{setting}");
    }
    // Kept points are not run again; the run of the case takes the study in.
    let again = study("cost", &[&coarse[..], &["--resume"]].concat(), home.path());
    assert!(again.stderr.contains(": kept") && !again.stderr.contains("error "), "{}", again.stderr);
    pass(&["report", "--from"], home.path());
    let results = json(&home.path().join("results.json"));
    let cases = results["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 1, "the study belongs to the run");
    assert_eq!(cases[0]["costs"].as_array().unwrap().len(), 1);
    let page = fs::read_to_string(home.path().join("report.html")).unwrap();
    assert!(page.contains("Cheapest setting") && page.contains("Where the time goes"));
}

#[test]
fn a_study_by_itself_is_not_taken_for_a_run_of_its_case() {
    let home = tempfile::tempdir().unwrap();
    // Its records hold tolerances and work of a run, none of which an effect study repeats.
    let effects = study("effects", &["clamped-beam-rotation"], home.path());
    assert_eq!(effects.code, Some(0), "{}{}", effects.stdout, effects.stderr);
    assert!(
        !effects.stdout.contains("LOOSENED") && !effects.stdout.contains("less work"),
        "{}",
        effects.stdout
    );
    pass(&["check", "--from"], home.path());
    let records = home.path().join("recorded.toml");
    fs::write(&records, "schema = \"seam.recorded/1\"\n").unwrap();
    let words = ["bless", "--accept", "--recorded", records.to_str().unwrap(), "--from"];
    let bless = call(&words, home.path());
    assert!(bless.code == Some(4) && bless.stderr.contains("not recorded"), "{}", bless.stderr);
}

#[test]
fn a_study_of_another_version_of_the_scene_is_told_and_left_out() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "left-out.toml", "--set", r#"effects=["auto"]"#, "--out"], home.path());
    study("effects", &["left-out.toml"], home.path());
    pass(&["check", "--from"], home.path());
    let results = json(&home.path().join("results.json"));
    assert_eq!(results["cases"][0]["ablations"].as_array().unwrap().len(), 0);
}

#[test]
fn a_case_without_bodies_has_no_settings_to_study() {
    let home = tempfile::tempdir().unwrap();
    let cost = study("cost", &["bond-matrix"], home.path());
    assert_eq!(cost.code, Some(4), "{}", cost.stderr);
    assert!(cost.stderr.contains("no bodies"), "{}", cost.stderr);
}
