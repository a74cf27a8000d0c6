//! CSV and Markdown.

use super::fixture;
use seam_reports::{csv, markdown};

#[test]
fn errors_and_curves_can_be_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let (results, cases) = (fixture::results(), fixture::cases());
    csv::write(&results, &cases, folder.path()).unwrap();
    let errors = std::fs::read_to_string(folder.path().join("errors.csv")).unwrap();
    assert_eq!(errors.lines().count(), 1 + 3 + 18);
    assert!(errors.lines().any(|l| l.starts_with("patch-fe,patch-02,m,2e-15,0.0,exact,")), "{errors}");
    let curve =
        std::fs::read_to_string(folder.path().join("clamped-beam-rotation/curve-rotation.csv")).unwrap();
    assert_eq!(curve.lines().count(), 1 + 3 * 37 + 4);
    let family = folder.path().join("clamped-beam-rotation/family-rotation-7-percent.csv");
    let family = std::fs::read_to_string(family).unwrap();
    assert_eq!(family.lines().count(), 1 + 176);
    assert!(family.contains("packing did not reach its solid fraction"));
}

#[test]
fn a_reader_of_the_summary_learns_verdicts_and_failures() {
    insta::assert_snapshot!(markdown::summary(&fixture::results()));
}
