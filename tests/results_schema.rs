//! `results.json` carries what was promised, and two runs give the same bytes.

mod common;

use common::{pass, seam};
use serde_json::Value;
use std::fs;
use std::path::Path;

fn judged(folder: &Path) -> Value {
    pass(&["check", "--from"], folder);
    serde_json::from_str(&fs::read_to_string(folder.join("results.json")).unwrap()).unwrap()
}

fn has(object: &Value, keys: &[&str]) {
    for key in keys {
        assert!(object.get(key).is_some(), "no '{key}' in {object}");
    }
}

#[test]
fn the_fields_are_there() {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "cook-membrane", "lattice-constants", "--out"], home.path());
    let results = judged(home.path());
    has(&results, &["schema", "provenance", "cases"]);
    assert_eq!(results["schema"], "seam.results/1");
    has(&results["provenance"], &["version", "commit", "command", "versions", "references", "machine"]);
    let cases = results["cases"].as_array().unwrap();
    assert_eq!(cases.len(), 2);
    let mut judged = 0;
    for case in cases {
        has(case, &["id", "title", "effects", "quantities", "claims", "work", "seconds"]);
        assert!(case["seconds"].as_f64().unwrap() > 0.0);
        for quantity in case["quantities"].as_array().unwrap() {
            let keys = ["id", "unit", "value", "reference", "kind", "error", "u_num", "u_ref", "accepted"];
            has(quantity, &keys);
            has(quantity, &["why", "regression", "verdict"]);
            judged += usize::from(quantity["verdict"] == "pass" && quantity["accepted"][1].is_f64());
        }
    }
    assert!(judged >= 6, "five lattices and a deflection are judged, not {judged}");
}

/// What may not differ between two runs of one commit: all but the machine and the seconds.
fn comparable(mut results: Value) -> Value {
    assert!(results["provenance"].as_object_mut().unwrap().remove("machine").is_some());
    for case in results["cases"].as_array_mut().unwrap() {
        assert!(case.as_object_mut().unwrap().remove("seconds").is_some());
    }
    results
}

/// The page without what lies between the marks of the machine block.
fn page(folder: &Path) -> String {
    let text = fs::read_to_string(folder.join("report.html")).unwrap();
    let (before, rest) = text.split_once("<!-- machine: begin -->").unwrap();
    let (_, after) = rest.split_once("<!-- machine: end -->").unwrap();
    format!("{before}{after}")
}

#[test]
fn two_runs_give_the_same_bytes() {
    let homes = [tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap()];
    for (home, jobs) in homes.iter().zip(["1", "2"]) {
        pass(&["run", "cook-membrane", "bond-matrix", "--jobs", jobs, "--out"], &home.path().join("out"));
        // The command is part of the provenance: the same words, each in its own folder.
        seam().current_dir(home.path()).args(["report", "--from", "out"]).assert().success();
    }
    let results = homes.each_ref().map(|home| {
        let text = fs::read_to_string(home.path().join("out/results.json")).unwrap();
        comparable(serde_json::from_str(&text).unwrap())
    });
    assert_eq!(results[0]["cases"].as_array().unwrap().len(), 2);
    assert_eq!(results[0], results[1]);
    let [one, two] = homes.each_ref().map(|home| page(&home.path().join("out")));
    assert!(one.contains("cook-membrane"));
    let differs = one.lines().zip(two.lines()).find(|(a, b)| a != b);
    assert!(one == two, "outside the machine block: {differs:?}");
}
