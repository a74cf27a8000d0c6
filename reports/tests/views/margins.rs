//! Margins of hard cases in every view.

use super::fixture;
use seam_cases::map::{Cell, StabilityMap};
use seam_cases::margin::Margin;
use seam_cases::result::CaseResult;
use seam_reports::csv;
use seam_reports::exit::Exit;
use seam_reports::html;
use seam_reports::judge::judge;
use seam_reports::record::Recorded;
use seam_reports::results::Results;
use seam_reports::terminal::{Style, table};

/// A patch test with two margins and a map.
fn hard(step: f64) -> CaseResult {
    let margin = |id: &str, value: f64, open: bool| Margin {
        id: id.into(),
        row: "Δt = 0.99 / 1.01 of critical".into(),
        label: "distorted elements, plane, explicit".into(),
        axis: "step over the bound it is refused by".into(),
        unit: "1".into(),
        value,
        needed: 1.0,
        tolerance: 1e-3,
        open,
        criterion: "a run stays bounded".into(),
        how: "doubled, then bisected".into(),
    };
    let map = StabilityMap {
        id: "map".into(),
        title: "Step and contrast".into(),
        x_label: "step (1)".into(),
        y_label: "contrast (1)".into(),
        x: vec![0.5, 1.0, 2.0],
        y: vec![1e-6, 1.0, 1e6],
        cells: vec![vec![Cell::Bounded, Cell::Cautious, Cell::Refused]; 3],
    };
    let mut patch = fixture::patch_test();
    // The last of its numbers is past its bound.
    patch.quantities.pop();
    CaseResult {
        margins: vec![margin("step", step, false), margin("implicit", 1e6, true)],
        maps: vec![map],
        ..patch
    }
}

fn judged(step: f64, recorded: &Recorded) -> Results {
    judge(&[hard(step)], fixture::provenance(), recorded)
}

#[test]
fn a_margin_that_is_too_small_or_has_changed_turns_the_gate_red() {
    let none = Recorded::default();
    assert_eq!(judged(1.3, &none).exit(true), Exit::Pass);
    assert_eq!(judged(0.99, &none).exit(true), Exit::Failed);
    assert_eq!(judged(f64::NAN, &none).exit(true), Exit::Unmeasured);
    let recorded = none.updated(&judged(1.3, &none));
    let recorded = Recorded::parse(&recorded.to_toml().unwrap(), "recorded.toml").unwrap();
    assert_eq!(judged(1.3, &recorded).exit(true), Exit::Pass);
    for changed in [1.29, 1.31] {
        let results = judged(changed, &recorded);
        assert_eq!(results.exit(true), Exit::Failed, "{changed}");
        let text = table(&results, Style::Plain);
        assert!(text.contains("FAILED patch-fe / step"), "{text}");
        assert!(text.contains("1.3, recorded, within a factor of 1.001"), "{text}");
    }
    let text = table(&judged(0.99, &recorded), Style::Plain);
    assert!(text.contains("1 has to pass: a run stays bounded"), "{text}");
}

#[test]
fn every_view_shows_them() {
    let results = judged(1.3, &Recorded::default());
    let text = table(&results, Style::Plain);
    assert!(text.contains("Stability margins") && text.contains("≥ 1e6"), "{text}");
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{} columns: {line}", line.chars().count());
    }
    let rows = csv::margins(&results).unwrap();
    assert_eq!(rows.lines().count(), 3, "{rows}");
    assert!(rows.contains("patch-fe,step,Δt = 0.99 / 1.01 of critical,"), "{rows}");
    let page = html::page(&results, &[hard(1.3)]).unwrap();
    for part in [
        "id=\"stability\"",
        "passes when a run stays bounded",
        "ink-cautious",
        "2 of 2 margins hold",
        "≥ 1e6",
    ] {
        assert!(page.contains(part), "{part}");
    }
    let bare = html::page(&fixture::results(), &fixture::cases()).unwrap();
    assert!(!bare.contains("id=\"stability\""), "no margins, no section");
}
