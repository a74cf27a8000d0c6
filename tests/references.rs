//! References: whole ones are named with their hashes, an altered one stops the judging.

mod common;

use common::{call, pass};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};

/// A copy of the built-in references, and a folder with one result.
fn home() -> (tempfile::TempDir, PathBuf) {
    let home = tempfile::tempdir().unwrap();
    let references = home.path().join("references");
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("references/data");
    for (file, bytes) in common::files(&data) {
        let copy = references.join(file.strip_prefix(&data).unwrap());
        fs::create_dir_all(copy.parent().unwrap()).unwrap();
        fs::write(copy, bytes).unwrap();
    }
    pass(&["run", "bond-matrix", "--out"], &home.path().join("out"));
    (home, references)
}

fn hashes(home: &Path) -> Value {
    let text = fs::read_to_string(home.join("out/results.json")).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["provenance"]["references"].clone()
}

/// Judges beside changed references: exit code 4, nothing written, and each of `parts` in the message.
fn refused(change: impl Fn(&Path), parts: &[&str]) {
    let (home, references) = home();
    change(&references);
    let folder = references.to_str().unwrap();
    for verb in ["check", "report"] {
        let outcome = call(&[verb, "--references", folder, "--from"], &home.path().join("out"));
        assert_eq!(outcome.code, Some(4), "{}{}", outcome.stdout, outcome.stderr);
        for part in parts {
            assert!(outcome.stderr.contains(part), "'{part}' is not in: {}", outcome.stderr);
        }
        assert!(!home.path().join("out/results.json").exists(), "{verb} judged all the same");
    }
}

#[test]
fn the_hashes_of_whole_references_are_recorded() {
    let (home, references) = home();
    let out = home.path().join("out");
    pass(&["check", "--from"], &out);
    let built_in = hashes(home.path());
    let files = common::files(&references);
    assert_eq!(built_in.as_object().unwrap().len(), files.len());
    for (file, bytes) in files {
        let name = file.strip_prefix(&references).unwrap().to_str().unwrap();
        assert_eq!(built_in[name], seam_references::Sha256::of(&bytes).as_str(), "{name}");
    }
    pass(&["check", "--references", references.to_str().unwrap(), "--from"], &out);
    assert_eq!(hashes(home.path()), built_in, "a copy is as good as the built-in files");
}

#[test]
fn an_altered_number_is_4_and_names_the_generator() {
    refused(
        |references| {
            let csv = references.join("calculix-cpe4/calculix.csv");
            let text = fs::read_to_string(&csv).unwrap();
            fs::write(&csv, text + "\n").unwrap();
        },
        &["calculix-cpe4/calculix.csv: altered", "restore the file", "python3 references/generators/"],
    );
}

#[test]
fn a_number_without_its_provenance_is_4() {
    refused(
        |references| fs::remove_file(references.join("calculix-c3d8/calculix.toml")).unwrap(),
        &["calculix-c3d8/calculix.csv: ", "calculix.toml is missing", "run the generator again"],
    );
}

#[test]
fn a_missing_reference_is_4_and_says_what_to_put_back() {
    refused(
        |references| fs::remove_dir_all(references.join("calculix-c3d8")).unwrap(),
        &["the reference 'calculix-c3d8/calculix' is missing", "put calculix-c3d8/calculix.csv and"],
    );
}

#[test]
fn an_empty_folder_is_4() {
    let (home, references) = home();
    fs::remove_dir_all(&references).unwrap();
    fs::create_dir(&references).unwrap();
    let words = ["check", "--references", references.to_str().unwrap(), "--from"];
    let outcome = call(&words, &home.path().join("out"));
    assert_eq!(outcome.code, Some(4));
    assert!(outcome.stderr.contains("no references; put them there"), "{}", outcome.stderr);
}
