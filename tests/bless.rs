//! `seam bless`: shows before it writes, writes all or nothing, and nothing that was not asked for.

mod common;

use common::{Outcome, call, files, pass};
use std::fs;
use std::path::Path;

const EMPTY: &str = "schema = \"seam.recorded/1\"\n";

/// A run of two cases in `out`, and records of nothing.
fn home() -> tempfile::TempDir {
    let home = tempfile::tempdir().unwrap();
    pass(&["run", "bond-matrix", "own-beam.toml", "--out"], &home.path().join("out"));
    fs::write(home.path().join("recorded.toml"), EMPTY).unwrap();
    home
}

fn bless(home: &Path, more: &[&str]) -> Outcome {
    let recorded = home.join("recorded.toml");
    let words = [&["bless", "--recorded", recorded.to_str().unwrap()], more, &["--from"]].concat();
    call(&words, &home.join("out"))
}

fn records(home: &Path) -> String {
    fs::read_to_string(home.join("recorded.toml")).unwrap()
}

#[test]
fn the_difference_is_shown_before_anything_is_written() {
    let home = home();
    let shown = bless(home.path(), &[]);
    assert_eq!(shown.code, Some(0), "{}", shown.stderr);
    for part in
        ["new        quick own-beam / deflection", "unrecorded → -1.", "work       quick bond-matrix / work"]
    {
        assert!(shown.stdout.contains(part), "'{part}' is not in:\n{}", shown.stdout);
    }
    assert!(
        shown.stderr.contains("nothing is written; accept this with: seam bless --from"),
        "{}",
        shown.stderr
    );
    assert_eq!(records(home.path()), EMPTY);

    assert_eq!(bless(home.path(), &["--accept"]).code, Some(0));
    let written = records(home.path());
    for part in
        ["[values.quick.own-beam]", "[tolerances.quick.own-beam]\ndeflection = 0.0", "bond_updates = "]
    {
        assert!(written.contains(part), "'{part}' is not in:\n{written}");
    }
    let again = bless(home.path(), &["--accept"]);
    assert!(again.stdout.contains("nothing differs"), "{}", again.stdout);
    assert_eq!(records(home.path()), written);
}

#[test]
fn only_what_is_named_is_accepted_and_a_slip_accepts_nothing() {
    let home = home();
    let slip = bless(home.path(), &["bond-matrix", "own-baem", "--accept"]);
    assert_eq!(slip.code, Some(2));
    assert!(slip.stderr.contains("did you mean 'own-beam'?"), "{}", slip.stderr);
    assert_eq!(records(home.path()), EMPTY);
    assert_eq!(bless(home.path(), &["bond-matrix", "--accept"]).code, Some(0));
    let written = records(home.path());
    assert!(written.contains("bond-matrix") && !written.contains("own-beam"), "{written}");
}

#[test]
fn records_are_never_made_in_a_place_that_has_none() {
    let home = home();
    let before = files(home.path());
    let other = home.path().join("elsewhere.toml");
    let words = ["bless", "--accept", "--recorded", other.to_str().unwrap(), "--from"];
    let outcome = call(&words, &home.path().join("out"));
    assert_eq!(outcome.code, Some(2));
    assert!(
        outcome.stderr.contains("elsewhere.toml") && outcome.stderr.contains("first line"),
        "{}",
        outcome.stderr
    );
    assert!(files(home.path()) == before);
}

#[test]
fn what_was_not_measured_is_not_accepted() {
    let home = home();
    let result = home.path().join("out/bond-matrix/result.json");
    let mut value: serde_json::Value = serde_json::from_str(&fs::read_to_string(&result).unwrap()).unwrap();
    value["quantities"] = serde_json::json!([]);
    fs::write(&result, value.to_string()).unwrap();
    let outcome = bless(home.path(), &["--accept"]);
    assert_eq!(outcome.code, Some(4));
    assert!(outcome.stderr.contains("bond-matrix: not measured"), "{}", outcome.stderr);
    assert_eq!(records(home.path()), EMPTY);
}

/// Loosened tolerances come first, in the difference and in the table; accepting them is what bless is for.
#[test]
fn a_loosened_tolerance_is_listed_first_until_it_is_accepted() {
    let home = home();
    assert_eq!(bless(home.path(), &["--accept"]).code, Some(0));
    let recorded = home.path().join("recorded.toml");
    let out = home.path().join("out");
    let words = ["check", "--recorded", recorded.to_str().unwrap(), "--from"];
    pass(&words, &out);
    let set = "quantities.deflection.accept.relative=0.2";
    pass(&["run", "own-beam.toml", "--set", set, "--out"], &out);
    let red = call(&words, &out);
    assert_eq!(red.code, Some(1));
    assert!(red.stdout.starts_with("LOOSENED own-beam / deflection\n"), "{}", red.stdout);
    assert!(
        red.stdout.contains("accepted now: ± 20 %") && red.stdout.contains("recorded: ± 2 %"),
        "{}",
        red.stdout
    );
    let summary = fs::read_to_string(out.join("summary.md")).unwrap();
    assert!(summary.lines().nth(2).unwrap().starts_with("| loosened tolerance"), "{summary}");
    let shown = bless(home.path(), &[]);
    assert!(shown.stdout.starts_with("loosened   quick own-beam / deflection\n"), "{}", shown.stdout);
    assert_eq!(bless(home.path(), &["--accept"]).code, Some(0));
    pass(&words, &out);
}
