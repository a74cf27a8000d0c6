//! CSV and Markdown.

use super::fixture;
use seam_reports::{csv, markdown};

#[test]
fn errors_and_families_can_be_read_back() {
    let folder = tempfile::tempdir().unwrap();
    let (results, cases) = (fixture::results(), fixture::cases());
    csv::write(&results, &cases, folder.path()).unwrap();
    let errors = std::fs::read_to_string(folder.path().join("errors.csv")).unwrap();
    assert_eq!(errors.lines().count(), 1 + 3 + 18);
    assert!(errors.lines().any(|l| l.starts_with("patch-fe,patch-02,m,2e-15,0.0,exact,")), "{errors}");
    let of_beam = folder.path().join("clamped-beam-rotation");
    let family = std::fs::read_to_string(of_beam.join("family-rotation-7-percent.csv")).unwrap();
    assert_eq!(family.lines().count(), 1 + 176);
    assert!(family.contains("packing did not reach its solid fraction"));
    let files = std::fs::read_dir(of_beam).unwrap().count();
    let beam = &fixture::cases()[0];
    assert_eq!(files, beam.families.len() + beam.costs.len(), "curves are written where a case is run");
}

#[test]
fn a_reader_of_the_summary_learns_verdicts_and_failures() {
    insta::assert_snapshot!(markdown::summary(&fixture::results()));
}
