//! The table on a terminal.

use super::fixture;
use seam_reports::judge::judge;
use seam_reports::record::Recorded;
use seam_reports::terminal::{Style, table};

#[test]
fn a_green_run() {
    insta::assert_snapshot!(table(&fixture::results(), Style::Plain));
}

#[test]
fn failures_say_what_was_measured_and_how_to_run_it_again() {
    let mut cases = fixture::cases();
    let recorded = Recorded::default().updated(&fixture::results());
    cases[0].quantities[0].value = -9.9e-3;
    cases[0].families[0].members.truncate(100);
    cases[1].quantities[3].value = f64::NAN;
    cases[1].quantities[2].value = 1.2e-12;
    cases[1].work.solves += 100;
    let text = table(&judge(&cases, fixture::provenance(), &recorded), Style::Plain);
    let blocks: Vec<&str> = text.split("\n\n").skip(1).collect();
    insta::assert_snapshot!(blocks.join("\n\n"));
}

#[test]
fn no_line_is_wider_than_a_terminal() {
    let text = table(&fixture::results(), Style::Plain);
    assert!(text.contains("rotation-7-percent"));
    for line in text.lines() {
        assert!(line.chars().count() <= 80, "{} columns: {line}", line.chars().count());
    }
}

#[test]
fn colours_only_where_they_are_wanted() {
    let results = fixture::results();
    let (plain, colour) = (table(&results, Style::Plain), table(&results, Style::Colour));
    assert!(!plain.contains('\u{1b}') && colour.contains("\u{1b}[32m"));
    let mut bare = colour;
    for code in ["32", "1;31", "33", "1", "2", "0"] {
        bare = bare.replace(&format!("\u{1b}[{code}m"), "");
    }
    assert_eq!(bare, plain);
}
