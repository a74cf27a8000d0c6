//! The report as a user meets it: the same bytes from the same commit, and the validation document.

mod common;

use common::{files, seam};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

/// Runs three small cases, with some threads, into `out` below an empty folder, and reports them.
fn reported(jobs: &str) -> (tempfile::TempDir, BTreeMap<PathBuf, Vec<u8>>) {
    let home = tempfile::tempdir().unwrap();
    let run = ["run", "fe-fe-fe", "lattice-constants", "patch-triangular", "--jobs", jobs, "--quiet"];
    for words in [&run[..], &["report", "--markdown", "VALIDATION.md"]] {
        seam().current_dir(home.path()).args(words).assert().success();
    }
    let files = files(home.path());
    let files =
        files.into_iter().map(|(path, bytes)| (path.strip_prefix(home.path()).unwrap().to_owned(), bytes));
    let files = files.collect();
    (home, files)
}

#[test]
fn two_runs_give_the_same_bytes_apart_from_machine_and_timings() {
    let (one, two) = (reported("1").1, reported("2").1);
    assert_eq!(one.keys().collect::<Vec<_>>(), two.keys().collect::<Vec<_>>());
    let page = |files: &BTreeMap<PathBuf, Vec<u8>>| {
        let text = String::from_utf8(files[Path::new("out/report.html")].clone()).unwrap();
        let (before, rest) = text.split_once("<!-- machine: begin -->").unwrap();
        let (machine, after) = rest.split_once("<!-- machine: end -->").unwrap();
        assert!(machine.contains("fe-fe-fe") && !before.contains(" s</dd>"));
        (before.to_owned(), after.to_owned())
    };
    assert!(page(&one) == page(&two), "the page differs outside the marked block");
    for (path, bytes) in one.iter().filter(|(path, _)| !path.ends_with("report.html")) {
        if path.extension().is_some_and(|e| e == "json") {
            let kept = |bytes: &[u8]| {
                let text = String::from_utf8(bytes.to_vec()).unwrap();
                let timed = ["\"seconds\"", "\"started\"", "\"threads\""];
                text.lines().filter(|l| !timed.iter().any(|t| l.contains(t))).collect::<Vec<_>>().join("\n")
            };
            assert!(kept(bytes) == kept(&two[path]), "{}", path.display());
        } else if path.ends_with("junit.xml") {
            let kept = |bytes: &[u8]| {
                let text = String::from_utf8(bytes.to_vec()).unwrap();
                text.lines().map(|l| l.split(" time=").next().unwrap().to_owned()).collect::<Vec<_>>()
            };
            assert!(kept(bytes) == kept(&two[path]), "{}", path.display());
        } else {
            assert!(*bytes == two[path], "{}", path.display());
        }
    }
}

#[test]
fn the_validation_document_has_figures_and_no_machine() {
    let (_home, files) = reported("2");
    let text = String::from_utf8(files[Path::new("VALIDATION.md")].clone()).unwrap();
    assert!(text.starts_with("# Validation\n"));
    assert!(text.contains("| verification, exact | pass |"), "{text}");
    assert!(text.contains("< 1e-9"), "rounding error is written as its bound");
    let processor = std::fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let name = processor.lines().find_map(|l| l.strip_prefix("model name")?.split_once(": "));
    assert!(name.is_none_or(|(_, name)| !text.contains(name)));
    for line in text.lines().filter(|l| l.starts_with('|')) {
        let columns = line.replace("\\|", "").matches('|').count();
        assert!([5, 9].contains(&columns), "{columns} bars: {line}");
    }
}

#[test]
fn a_document_that_cannot_be_written_leaves_what_is_there() {
    let (home, _) = reported("2");
    let output = seam()
        .current_dir(home.path())
        .args(["report", "--markdown", "VALIDATION.md/inside.md"])
        .output()
        .unwrap();
    assert_eq!(output.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&output.stderr).contains("nothing was overwritten"));
    assert!(std::fs::read_to_string(home.path().join("VALIDATION.md")).unwrap().starts_with("# Validation"));
}
