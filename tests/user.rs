//! A user's first hour: a scene to begin with, schemas, completions, an empty folder.

mod common;

use assert_cmd::Command;
use common::{pass, seam};
use std::fs;
use std::path::Path;

/// The command in a folder that has nothing of Seam's.
fn elsewhere(folder: &Path, words: &[&str]) -> (Option<i32>, String, String) {
    let output = Command::new(env!("CARGO_BIN_EXE_seam")).current_dir(folder).args(words).output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (output.status.code(), text(output.stdout), text(output.stderr))
}

#[test]
fn a_new_scene_runs_as_it_is_and_passes() {
    let home = tempfile::tempdir().unwrap();
    let told = |words: &[&str]| elsewhere(home.path(), words);
    let (code, _, said) = told(&["new", "my-beam"]);
    assert_eq!(code, Some(0), "{said}");
    assert!(said.contains("seam run ./my-beam.toml && seam check my-beam"), "{said}");
    assert_eq!(told(&["run", "my-beam.toml", "--quiet"]).0, Some(0));
    let (code, table, _) = told(&["check", "my-beam", "--strict"]);
    assert!(code == Some(0) && table.contains("1 passed, 0 failed"), "{table}");
    assert_eq!(told(&["report"]).0, Some(0));
    for file in ["out/report.html", "out/my-beam/free.vtu", "out/my-beam/deflection.csv"] {
        assert!(home.path().join(file).is_file(), "{file}");
    }
    let (_, _, all_fe) = told(&["run", "my-beam.toml", "--set", "bodies.free.method=fe", "--out", "fe"]);
    assert!(home.path().join("fe/my-beam/result.json").is_file(), "the comment promises it: {all_fe}");
}

#[test]
fn a_new_scene_overwrites_nothing_and_needs_a_name() {
    let home = tempfile::tempdir().unwrap();
    fs::write(home.path().join("mine.toml"), "mine").unwrap();
    let told = |words: &[&str]| elsewhere(home.path(), words);
    let (code, _, said) = told(&["new", "mine"]);
    assert!(code == Some(2) && said.contains("mine.toml: not written"), "{said}");
    assert_eq!(fs::read_to_string(home.path().join("mine.toml")).unwrap(), "mine");
    for (id, part) in [("Beam 1", "is not an id"), ("../out", "is not an id"), ("patch-fe", "has a case")] {
        let (code, _, said) = told(&["new", id]);
        assert!(code == Some(2) && said.contains(part), "{id}: {said}");
    }
    assert_eq!(fs::read_dir(home.path()).unwrap().count(), 1);
}

#[test]
fn the_catalogue_is_inside_of_the_program() {
    let home = tempfile::tempdir().unwrap();
    let (code, list, _) = elsewhere(home.path(), &["list"]);
    assert!(code == Some(0) && list.contains("clamped-beam-rotation"));
    assert_eq!(elsewhere(home.path(), &["run", "calculix-elements", "--quiet"]).0, Some(0));
    let (code, table, said) = elsewhere(home.path(), &["check", "calculix-elements"]);
    assert_eq!(code, Some(0), "references are inside too: {table}{said}");
}

#[test]
fn schemas_are_the_published_ones() {
    let home = env!("CARGO_MANIFEST_DIR");
    for (of, file) in [("scene", "cases/scene.schema.json"), ("results", "reports/results.schema.json")] {
        let output = seam().args(["schema", of]).output().unwrap();
        let published = fs::read_to_string(Path::new(home).join(file)).unwrap();
        assert!(String::from_utf8(output.stdout).unwrap() == published, "{file}");
    }
}

#[test]
fn shells_complete_verbs() {
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let output = seam().args(["completions", shell]).output().unwrap();
        let script = String::from_utf8(output.stdout).unwrap();
        assert!(output.status.success() && script.contains("selftest"), "{shell}");
    }
}

#[test]
fn every_case_with_bodies_leaves_files_for_paraview() {
    let home = tempfile::tempdir().unwrap();
    // One of each kind: statics, and a run in time that switches.
    let switched = "cases/tests/scenes/switched-beam.toml";
    let switched = Path::new(env!("CARGO_MANIFEST_DIR")).join(switched);
    pass(&["run", "patch-coupled", switched.to_str().unwrap(), "--out"], home.path());
    for case in ["patch-coupled", "switched-beam"] {
        let names = fs::read_dir(home.path().join(case)).unwrap();
        let vtu =
            names.filter(|e| e.as_ref().unwrap().path().extension().is_some_and(|e| e == "vtu")).count();
        assert!(vtu >= 2, "{case}: {vtu}");
    }
}

/// What the snippets for CI services call is what there is.
#[test]
fn snippets_for_ci_call_verbs_and_files_that_exist() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/ci");
    let help = String::from_utf8(seam().arg("--help").output().unwrap().stdout).unwrap();
    for name in ["github.yml", "gitlab.yml"] {
        let text = fs::read_to_string(folder.join(name)).unwrap();
        let calls: Vec<&str> =
            text.lines().filter_map(|l| l.split_once("seam ").map(|(_, rest)| rest)).collect();
        assert!(calls.len() >= 2, "{name}");
        for call in calls {
            let verb = call.split([' ', '&', '`']).next().unwrap();
            assert!(help.contains(&format!("\n  {verb} ")), "{name}: seam {verb}");
        }
        for file in ["junit.xml", "summary.md", "report.html"] {
            assert!(text.contains(file), "{name}: {file}");
        }
    }
}
